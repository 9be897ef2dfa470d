#ifndef WF_CONVERT_READ_EXR_DWA_RULES_H
#define WF_CONVERT_READ_EXR_DWA_RULES_H

#include <stdint.h>

#include "convert/read/exr/shape.h"

/* Which of DWA's ways each channel of a chunk went. */

typedef enum wf_dwa_way { WF_DWA_DEFLATED, WF_DWA_LOSSY, WF_DWA_RUNS } wf_dwa_way;

typedef struct wf_dwa_plan {
    wf_dwa_way *way; /* [channels] */
    int (*color)[3]; /* red, green and blue of channels that were transformed together */
    int colors;
    bool *colored; /* [channels]: it is one of these */
} wf_dwa_plan;

/* Bytes that a plan's arrays take for so many channels. */
size_t wf_dwa_plan_bytes(int channels);

/* Settles the plan, whose arrays lie in `memory`, aligned for pointers. rules: those that the
 * chunk holds, `size` bytes; NULL: it is of a version that has none, and the first rules are
 * meant. Returns what is wrong with them, or NULL. */
const char *wf_dwa_plan_make(wf_dwa_plan *plan, void *memory, const wf_exr_shape *shape,
                             const uint8_t *rules, size_t size);

#endif
