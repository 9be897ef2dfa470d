#ifndef WF_TRACER_SAMPLE_ADAPTIVE_CELLS_H
#define WF_TRACER_SAMPLE_ADAPTIVE_CELLS_H

#include <math.h>

#include "tracer/sample/row_time.h"

/* The cells that adaptive sampling works on: what is known of each, and of the edge through it.
 */

/* The cells of a tile and those about it, row by row: one to each side. */
#define ABOUT      1
#define GRID_WIDTH (TILE_WIDTH + 2 * ABOUT)
#define GRID_ROWS  (TILE_HEIGHT + 2 * ABOUT)
#define GRID_CELLS (GRID_WIDTH * GRID_ROWS)

/* A cell that is sampled as its error asks. */
typedef struct wf_adaptive_cell {
    bool there;                 /* it has samples */
    bool own;                   /* it is the tile's, and not one about it */
    bool rare;                  /* what it may hold is seen by hardly any other cell */
    int first;                  /* samples of each quarter that see what it may hold */
    int each;                   /* samples of each quarter */
    int set;                    /* which of the sampler's sets they are of */
    double sum[WF_QUARTERS][3]; /* of their light, beyond what its edge, if found, says */
    double square[3];           /* sums of its square */
    double expected[3];         /* sums of what its edge says where its samples are */
    bool beyond;                /* the sums are of what samples differ from an edge */
    double mean[3], steep[3];   /* light, and what an error of it is on the display */
    double one;  /* the square of what it would be off with one sample, had it no edge */
    double need; /* the square of what it is off, as those about it say it, too; on the display,
                    in an output pixel */
    double allowed; /* how many times the error that the tile's cells may have; squared */
} wf_adaptive_cell;

/* One edge through a cell: where it is, and what is on its sides. */
typedef struct wf_adaptive_edge {
    bool seen, followed, found;
    int tried;           /* with how many samples of a quarter; 0: not yet */
    double n[3], d;      /* side 0: n . p < d, p the place in the cell, 0..1 each; x, y, time */
    double rgb[2][3][4]; /* side, channel: at p = 0, and how it grows with x, y, time */
    int lines;           /* that the cell is integrated over, at most WF_MOST_LINES */
    double error;        /* of the lines; squared, in an output pixel */
} wf_adaptive_edge;

typedef struct wf_adaptive {
    const wf_tile *tile;
    const wf_sampling *s;
    wf_sampling_scratch *c;
    int first; /* row */
    int step;  /* rows to the next that is wanted: 1, or 2 where the lines of a field alone are
                */
    wf_adaptive_cell cell[GRID_CELLS];
    wf_adaptive_edge edge[GRID_CELLS];
    int more[GRID_CELLS]; /* how many samples of a quarter cells are to have, or that they are
                             to be looked at; 0: not in question */
    wf_row_time time[GRID_ROWS];
    bool hopeless;  /* hardly any edge was found where one was looked for */
    double caution; /* the RMS error that cells may have, of the one asked for */
    double fall;    /* errors' squares fall with this power of the number of samples */
} wf_adaptive;

/* Where on the raster a cell of the grid is. */
static inline int wf_cell_x(const wf_adaptive *a, int at) {
    return a->tile->x0 + at % GRID_WIDTH - ABOUT;
}

static inline int wf_cell_y(const wf_adaptive *a, int at) {
    return a->first + at / GRID_WIDTH - ABOUT;
}

/* A cell so many to the right and so many wanted rows down, if it has samples; else NULL. */
const wf_adaptive_cell *wf_cell_beside(const wf_adaptive *a, int at, int right, int down);

/* Finds the cell's mean. */
void wf_cell_find_mean(wf_adaptive_cell *cell);

/* What an edge says of a place in its cell: R, G, B. */
void wf_edge_colors(const wf_adaptive_edge *edge, const double p[3], double rgb[3]);

/* How steep Rec. 709's transfer is at a value: what an error of light is on the display. */
double wf_display_steepness(double v);

/* The part of a cell's error that is left in an output pixel, which sees several cells; of its
 * square. */
double wf_adaptive_share(const wf_adaptive *a);

/* The error that a cell may have; squared, display-encoded. */
double wf_adaptive_target(const wf_adaptive *a);

/* Samples on each side of a line through a cell: two are enough for an aperture that is smooth
 * over a cell. */
#define WF_FEW_PIECES 2
int wf_edge_pieces(const wf_aperture *aperture);

/* Whether the aperture's edge cuts cells, so that it matters where in a cell light is. */
bool wf_cuts_cells(const wf_sampling *s);

/* Whether the receiver is told each cell's mean, and weighs it by what the aperture sees of the
 * cell, exactly. */
bool wf_cells_are_weighed(const wf_sampling *s);

/* Whether the edge through a cell's neighbor, so many to the right and down, comes no nearer
 * than `past` (in cells) when it goes on as it is. */
bool wf_edge_passes_by(const wf_adaptive *a, const wf_adaptive_edge *edge, int right, int down,
                       double past);

/* The edge of such a neighbor if it comes into the cell as it goes on; else NULL. */
const wf_adaptive_edge *wf_edge_coming(const wf_adaptive *a, int at, int right, int down);

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

#endif
