#ifndef WF_TRACER_SAMPLE_SAMPLER_H
#define WF_TRACER_SAMPLE_SAMPLER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Where samples lie in one cell: one pixel of one frame line and one window of time. */

typedef enum wf_sampler_kind {
    WF_SAMPLER_JITTER,
    WF_SAMPLER_SOBOL,
    WF_SAMPLER_GRID
} wf_sampler_kind;

/* Which cell, and which independent set of samples in it. */
typedef struct wf_cell {
    int64_t time; /* number of its window */
    int x, y;
    int set;
} wf_cell;

/* Immutable once made; any threads. */
typedef struct wf_sampler wf_sampler;

/* count: samples a cell, 1 and more. NULL: no memory. */
wf_sampler *wf_sampler_new(wf_sampler_kind kind, int count, uint64_t seed);
void wf_sampler_free(wf_sampler *sampler); /* NULL is fine */

/* The samples of a cell, each coordinate in [0, 1): of x and y within pixel and line, of f
 * within the window. Arrays of [count]. The same cell of the same sampler has the same ones. */
void wf_sampler_draw(const wf_sampler *sampler, wf_cell cell, float *x, float *y, float *f);

/* Samples first <= i < first + count of a cell's Sobol set, whatever the sampler's kind: a set
 * is drawn piece by piece as it turns out how many are needed. */
void wf_sampler_draw_more(const wf_sampler *sampler, wf_cell cell, int first, int count,
                          float *x, float *y, float *f);

#endif
