#ifndef WF_TRACER_SAMPLING_INSIDE_H
#define WF_TRACER_SAMPLING_INSIDE_H

#include "tracer/sampling.h"

/* Between sampling.c and adaptive.c. */

/* Tiles of cells: what can be seen in one is looked for once. */
#define TILE_WIDTH  16
#define TILE_HEIGHT 8

#define TILE_CELLS (TILE_WIDTH * TILE_HEIGHT)

/* Adaptive samples of a cell come in quarters, each of at most so many. */
#define WF_QUARTERS  4
#define WF_MOST_EACH 1024

/* Samples that wait for their weights. */
typedef struct wf_adaptive_samples {
    float *v[7]; /* x, y, t, r, g, b, weight */
    int *cell;   /* and quarter: cell * WF_QUARTERS + quarter */
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
    bool still;   /* nothing seen moves in the unit */
    bool nothing; /* but background is seen */
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
    const wf_receiver *receiver;
    int64_t time; /* of its cells: the unit, or that of all tiles that are still */
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

/* A cell of a tile that is sampled as its error asks. */
typedef struct wf_adaptive_cell {
    int each; /* samples of each quarter */
    double sum[WF_QUARTERS][3];
    double error; /* of the mean, display-encoded; squared */
} wf_adaptive_cell;

typedef struct wf_adaptive {
    const wf_tile *tile;
    const wf_sampling *s;
    wf_sampling_scratch *c;
    int first, rows, width;
    wf_adaptive_cell cell[TILE_CELLS]; /* [row][TILE_WIDTH] */
    bool more[TILE_CELLS];             /* are to have more samples */
    wf_row_time time[TILE_HEIGHT];
    bool needed[TILE_HEIGHT]; /* rows */
} wf_adaptive;

bool wf_adaptive_tile(const wf_tile *tile, int first, int end, bool empty);

/* How steep Rec. 709's transfer is at a value: what an error of light is on the display. */
double wf_display_steepness(double v);

/* ---- adaptive_points.c ---- */

/* Gives every cell that wants more its first samples, or as many again as it has, and adds
 * their light to its sums; emit hands over all of a tile, each cell with the weight 1. False:
 * no memory. */
bool wf_points_draw(wf_adaptive *a);
void wf_points_emit(const wf_adaptive *a);
void wf_points_free(wf_adaptive_samples *samples);

#endif
