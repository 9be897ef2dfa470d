/* Operations of the hot loops (*_isa.c), each run at one level of the processor, or plainly, on
 * input drawn from a seed: what unit/base/test_isa.c loops over. */
#ifndef WF_TESTS_UNIT_SUPPORT_LEVELS_H
#define WF_TESTS_UNIT_SUPPORT_LEVELS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* One run of one operation. The same seed, size and wildness give the same input. */
typedef struct level_run {
    size_t level;
    bool plain;   /* by the reference in the test, where the row has one, not at a level */
    bool wild;    /* NaN, Inf, -0, denormals and largest numbers among the input */
    size_t count; /* samples; operations on packets take it modulo their size */
    uint32_t draws;
    int buffers;    /* handed out */
    double *result; /* everything that the operation wrote, as doubles */
    size_t results;
} level_run;

typedef struct level_row {
    const char *name; /* TABLE.FUNCTION */
    void (*run)(level_run *run);
    bool has_plain;
    double bound; /* how far from the plain reference, in shares of its largest result; 0: not a
                     bit. Levels must agree in every bit. */
} level_row;

/* The functions of one table. */
typedef struct level_table {
    const char *file;
    size_t functions; /* pointers in the table */
    const level_row *rows;
    size_t count; /* of rows: at least one for each function */
} level_table;

extern const level_table level_filters[], level_color[], level_read[], level_tracer[];

/* Memory whose end is that of readable memory, and which is looked after in front. It is as
 * aligned as its size is. The first level_begin makes it; level_end says whether what lies in
 * front of every buffer is still there. */
void level_begin(level_run *run);
bool level_end(const level_run *run);
void *level_buffer(level_run *run, size_t bytes);

uint32_t level_draw(level_run *run);
double level_uniform(level_run *run, double low, double high);
double level_number(level_run *run); /* from -2 to 2, and where the run is wild, anything */

/* Buffers of numbers. */
double *level_doubles(level_run *run, size_t count);
float *level_floats(level_run *run, size_t count);
uint16_t *level_halves(level_run *run, size_t count);
uint8_t *level_bytes(level_run *run, size_t count);

/* Adds to the result. */
void level_keep_doubles(level_run *run, const double *value, size_t count);
void level_keep_floats(level_run *run, const float *value, size_t count);
void level_keep_codes(level_run *run, const uint16_t *value, size_t count);
void level_keep_bytes(level_run *run, const uint8_t *value, size_t count);
void level_keep_integers(level_run *run, const int64_t *value, size_t count);

#define LEVEL_FUNCTIONS(ops) (sizeof(ops) / sizeof(void (*)(void)))
#define LEVEL_TABLE(path, ops, its_rows)                                                       \
    {                                                                                          \
        .file = path, .functions = LEVEL_FUNCTIONS(ops), .rows = its_rows,                     \
        .count = sizeof its_rows / sizeof *its_rows                                            \
    }

#endif
