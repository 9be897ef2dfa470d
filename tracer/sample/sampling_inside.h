#ifndef WF_TRACER_SAMPLE_SAMPLING_INSIDE_H
#define WF_TRACER_SAMPLE_SAMPLING_INSIDE_H

#include <math.h>

#include "tracer/sample/sampling.h"

/* Between sampling.c and the files of adaptive sampling. */

/* Tiles of cells: what can be seen in one is looked for once. */
#define TILE_WIDTH  16
#define TILE_HEIGHT 8

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
    wf_error_sum
        *tile_error; /* [tiles]: what was last found of each; of one thread at a time */
    double start;    /* of the unit's window, field periods from the field's instant */
};

/* Memory that looking for edges keeps from tile to tile. */
typedef struct wf_edge_room {
    void *seekers, *seen;
    size_t seen_room;
} wf_edge_room;

struct wf_sampling_scratch {
    wf_trace_scratch *trace;
    size_t room; /* samples */
    float *x, *y, *f, *t, *rgb[3];
    double *trace_x, *trace_y, *trace_f;
    wf_adaptive_samples kept, probes;
    wf_edge_room edges;
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
    bool timeless; /* all of its window shows the same */
    int64_t time;  /* of its cells: the unit, or that of all tiles that are still */
} wf_tile;

/* ---- sampling.c ---- */

wf_rational wf_sampling_period(const wf_sampling *s);
bool wf_find_row_time(const wf_sampling *s, int row,
                      wf_row_time *time); /* false: none is needed */

static inline float wf_in_cell(float v, int cell) {
    float at = (float)cell + v, end = (float)(cell + 1);
    return at < end ? at : nextafterf(end, 0);
}

/* Times are whole millionths (2^-20) of a field, so that a float holds them whichever field
 * they are counted from. */
static inline double wf_on_time_grid(double t) {
    double whole = (double)(int64_t)(t * 0x1p20);
    return (whole - (whole > t * 0x1p20)) * 0x1p-20;
}

/* Where in the window a sample of time t lies; f: its number, where the window is an instant.
 */
double wf_window_fraction(const wf_sampling *s, double t, double late, double f);

/* ---- adaptive.c ---- */

/* The cells of a tile and those about it, row by row: one to each side, two above and below. */
#define ABOUT      1
#define ABOUT_ROWS 2
#define GRID_WIDTH (TILE_WIDTH + 2 * ABOUT)
#define GRID_ROWS  (TILE_HEIGHT + 2 * ABOUT_ROWS)
#define GRID_CELLS (GRID_WIDTH * GRID_ROWS)

/* A cell that is sampled as its error asks. */
typedef struct wf_adaptive_cell {
    bool there; /* it has samples */
    bool own;   /* it is the tile's, and not one beside it */
    int each;   /* samples of each quarter */
    double sum[WF_QUARTERS][3];
    float low[3], high[3];    /* of its samples' light */
    double mean[3], steep[3]; /* and what an error of it is on the display */
    double error;             /* of the mean, display-encoded; squared */
} wf_adaptive_cell;

/* One edge through a cell: where it is, and what is on its sides. */
typedef struct wf_adaptive_edge {
    bool tried, followed, found;
    double n[3], d;      /* side 0: n . p < d, p the place in the cell, 0..1 each; x, y, time */
    double rgb[2][3][4]; /* side, channel: at p = 0, and how it grows with x, y, time */
    int lines;           /* that the cell is integrated over, at most WF_MOST_LINES */
    double unseen;       /* error of what its samples may have missed; squared */
} wf_adaptive_edge;

typedef struct wf_adaptive {
    const wf_tile *tile;
    const wf_sampling *s;
    wf_sampling_scratch *c;
    int first; /* row */
    wf_adaptive_cell cell[GRID_CELLS];
    wf_adaptive_edge edge[GRID_CELLS];
    int more[GRID_CELLS]; /* how many samples of a quarter cells are to have, or that they are
                             to be looked at; 0: not in question */
    wf_row_time time[GRID_ROWS];
} wf_adaptive;

/* Where on the raster a cell of the grid is. */
static inline int wf_cell_x(const wf_adaptive *a, int at) {
    return a->tile->x0 + at % GRID_WIDTH - ABOUT;
}

static inline int wf_cell_y(const wf_adaptive *a, int at) {
    return a->first + at / GRID_WIDTH - ABOUT_ROWS;
}

/* How many rows above and below a tile, and whether a column to each side of it, are looked at,
 * too. */
int wf_adaptive_rows_about(const wf_sampling *s);

/* The edge of a cell's neighbor, so many to the right and down, if it comes into the cell as
 * it goes on; else NULL. */
const wf_adaptive_edge *wf_edge_coming(const wf_adaptive *a, int at, int right, int down);

bool wf_adaptive_tile(const wf_tile *tile, int first, int end, bool empty);

/* How steep Rec. 709's transfer is at a value: what an error of light is on the display. */
double wf_display_steepness(double v);

/* The part of a cell's error that is left in an output pixel; of its square. */
double wf_adaptive_share(const wf_adaptive *a);

/* The error that a cell may have; squared. */
double wf_adaptive_target(const wf_adaptive *a);

/* ---- adaptive_edges.c ---- */

/* Looks for one edge through each cell in question: where its samples differ, or where that
 * of a neighbor goes on. False: no memory. */
bool wf_edges_find(wf_adaptive *a);
bool wf_edges_follow(wf_adaptive *a);

/* Makes cells in question ones of an edge that passes them by: of one color, however few
 * samples they have. False: no memory. */
bool wf_edges_fill(wf_adaptive *a);
void wf_edges_free(wf_edge_room *room);

/* The axis that a plane stands most across. */
int wf_axis_across(const double n[3]);

static inline double wf_dot(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* One channel of a side's color at a place in the cell. */
static inline double wf_edge_color(const double rgb[4], const double p[3]) {
    double v = rgb[0] + wf_dot(&rgb[1], p);
    return v > 0 ? v : 0;
}

/* ---- adaptive_lines.c ---- */

/* Most lines that a cell is integrated over. */
#define WF_MOST_LINES 256

/* Samples on each side of a line: enough for an aperture that is smooth over a cell. */
#define WF_FEW_PIECES 2
int wf_edge_pieces(const wf_aperture *aperture);

/* Hands over the cells whose edges were found, each with the weight 1. False: no memory. */
bool wf_edges_emit(const wf_adaptive *a);

/* ---- adaptive_points.c ---- */

/* Gives every cell in question as many samples as it is to have, more than it has, and adds
 * their light to its sums; emit hands over all of a tile but cells with edges, each cell with
 * the weight 1. False: no memory. */
bool wf_points_draw(wf_adaptive *a);
void wf_points_emit(const wf_adaptive *a);
void wf_points_free(wf_adaptive_samples *samples);

/* Room for so many more. False: no memory. */
bool wf_points_room(wf_adaptive_samples *samples, size_t more);

/* How uncertain the share of a cell is that so many scattered points tell; squared, as measured
 * on random edges. */
static inline double wf_points_share_error(double points) {
    return 0.1 / (points * sqrt(points));
}

/* Adds a sample at a place in a cell, 0..1 each, for which there is room; returns its number.
 * v[6] holds when in the window it is, until it is handed over with a weight. */
size_t wf_points_place(const wf_adaptive *a, wf_adaptive_samples *to, int at,
                       const double p[3]);

/* Light at all of them. False: no memory. */
bool wf_points_trace(const wf_adaptive *a, wf_adaptive_samples *samples, size_t first);

/* So many places in a cell that lie evenly, in x, y and time; [3][count or more]. */
void wf_points_spread(const wf_adaptive *a, int at, int count, float *const spread[3]);

void wf_points_hand_over(const wf_adaptive *a, const wf_adaptive_samples *samples);

#endif
