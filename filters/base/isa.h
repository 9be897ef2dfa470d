/* Which level of the processor's architecture hot loops are run at. */
#ifndef WF_FILTERS_BASE_ISA_H
#define WF_FILTERS_BASE_ISA_H

/* Which of the tables of hot loops is used. A file named *_isa.c is compiled once for each
 * level of the processor's architecture and defines one table of functions, a const struct, for
 * each of them (isa_file.h). All tables of one type give the same bits. */

#include <stddef.h>

/* How many levels this processor runs, 1 or more. Level 0 is the baseline, 1 and 2 are
 * x86-64-v3 and x86-64-v4; other architectures have level 0 alone. */
size_t wf_isa_levels(void);

/* "v1", "v3" or "v4", for people. */
const char *wf_isa_name(size_t level);

/* WF_ISA_DECLARE(wf_row_ops), in the header that defines the struct wf_row_ops, declares
 *     wf_row_ops_at(level)  the table of a level, slowest first; NULL past the last level that
 *                           this processor runs
 *     wf_row_ops_best()     the fastest that it runs
 * and the tables themselves. WF_ISA_DISPATCH(wf_row_ops) defines both functions in one .c file.
 * Tables are static storage; any thread may ask. */
#define WF_ISA_DECLARE(ops)                                                                    \
    extern const ops ops##_v1, ops##_v3, ops##_v4;                                             \
    const ops *ops##_at(size_t level);                                                         \
    const ops *ops##_best(void)

#if defined(__x86_64__)
#define WF_ISA_TABLES(ops)                                                                     \
    { &ops##_v1, &ops##_v3, &ops##_v4 }
#else
#define WF_ISA_TABLES(ops)                                                                     \
    { &ops##_v1 }
#endif

#define WF_ISA_DISPATCH(ops)                                                                   \
    static const ops *const ops##_tables[] = WF_ISA_TABLES(ops);                               \
    const ops *ops##_at(size_t level) {                                                        \
        return level < wf_isa_levels() ? ops##_tables[level] : NULL;                           \
    }                                                                                          \
    const ops *ops##_best(void) {                                                              \
        return ops##_tables[wf_isa_levels() - 1];                                              \
    }

#endif
