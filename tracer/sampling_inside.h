#ifndef WF_TRACER_SAMPLING_INSIDE_H
#define WF_TRACER_SAMPLING_INSIDE_H

#include "tracer/sampling.h"

/* Between sampling.c and adaptive.c. */

/* Tiles of cells: what can be seen in one is looked for once. */
#define TILE_WIDTH  16
#define TILE_HEIGHT 8

/* Adaptive samples of a cell come in so many independent sets, each of at most so many. */
#define WF_SETS      4
#define WF_MOST_EACH 1024

/* Samples that wait for their weights. */
typedef struct wf_adaptive_samples {
    float *v[7]; /* x, y, t, r, g, b, weight */
    int *cell;   /* and set: cell * WF_SETS + set */
    size_t count, room;
} wf_adaptive_samples;

struct wf_sampling {
    wf_sampling_desc desc;
    wf_tracer *tracer;
    wf_sampler *sampler;
    wf_raster raster;
    double tau, skew, anchor;
    bool periods;  /* units are field periods */
    bool instants; /* each line has an instant of its own */
    int64_t unit, field;
    double start; /* of the unit's window, field periods from the field's instant */
};

struct wf_sampling_scratch {
    wf_trace_scratch *trace;
    size_t room; /* samples */
    float *x, *y, *f, *t, *rgb[3];
    double *trace_x, *trace_y, *trace_f;
    wf_adaptive_samples kept;
    wf_error_sum error;
};

/* What a row's samples are drawn for: times from..to field periods after the field's instant,
 * and how late its own instant is. */
typedef struct wf_row_time {
    double from, to, late;
} wf_row_time;

typedef struct wf_tile {
    const wf_sampling *s;
    wf_sampling_scratch *c;
    int x0, x1;
    wf_sampling_emit_fn *emit;
    void *user;
} wf_tile;

/* ---- sampling.c ---- */

wf_rational wf_sampling_period(const wf_sampling *s);
bool wf_find_row_time(const wf_sampling *s, int row,
                      wf_row_time *time); /* false: none is needed */
bool wf_within_reach(const wf_sampling *s, double y, double t);
double wf_on_time_grid(double t);
float wf_in_cell(float v, int cell);
/* Where in the window a sample of time t lies; f: its number, where the window is an instant.
 */
double wf_window_fraction(const wf_sampling *s, double t, double late, double f);

/* ---- adaptive.c ---- */

bool wf_adaptive_tile(const wf_tile *tile, int first, int end, const wf_trace_tile *found);
void wf_adaptive_free(wf_adaptive_samples *samples);

#endif
