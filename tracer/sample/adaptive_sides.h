#ifndef WF_TRACER_SAMPLE_ADAPTIVE_SIDES_H
#define WF_TRACER_SAMPLE_ADAPTIVE_SIDES_H

#include "tracer/sample/adaptive_cells.h"

/* The two sides of the edge through a cell, as its samples show them. */

/* What a sample of a cell saw. */
typedef struct wf_seen {
    double p[3]; /* 0..1 each: x, y, when in the window; 0 where time makes no difference */
    double rgb[3];
    int side;
} wf_seen;

/* Where a plane meets the edges of a cube, doubles included; and the middle, which is last. */
#define WF_MOST_SUPPORTS 13

/* A line along an axis, on which an edge is looked for. */
typedef struct wf_support {
    double at[3];     /* where the plane is thought to cross it */
    double low, high; /* one side ends, the other begins */
    bool found;       /* low and high are known */
    bool asked;       /* rays are sent along it now */
} wf_support;

/* A cell whose edge is looked for. */
typedef struct wf_seeker {
    int at; /* cell */
    bool lost;
    wf_seen *first, *end;
    double mean[2][3], reach; /* colors of the sides; the square of their distance */
    double n[3], d;           /* the plane, as in wf_adaptive_edge */
    int axis;                 /* the one that the plane stands most across */
    double bend;              /* how far the edge's middle lies off it */
    double narrow;            /* how far apart low and high may be in the end */
    int supports;
    wf_support support[WF_MOST_SUPPORTS];
} wf_seeker;

typedef struct wf_seeking {
    wf_adaptive *a;
    int dims; /* 2: time makes no difference */
    wf_seeker *seekers;
    int count;
    wf_seen *seen; /* of all cells, cell by cell */
} wf_seeking;

/* What was seen of one side: means, and mean products of what differs from them. */
typedef struct wf_side_sums {
    double count, p[3], rgb[3], pp[3][3], p_rgb[3][3];
} wf_side_sums;

/* Solves m x = b, m symmetric and positive; x takes the place of b. */
void wf_solve(double m[3][3], double *b);

/* Between two colors; squared. */
double wf_distance(const double *a, const double *b);

/* Which side a color is of; -1: neither. */
int wf_side_of(const wf_seeker *e, const double rgb[3]);

/* The sides of the samples by the colors that they have, or by two found among them. A third
 * color, and the cell is lost. */
void wf_find_sides(wf_seeker *e);
void wf_find_colors(wf_seeker *e);

void wf_sum_side(const wf_seeker *e, int side, wf_side_sums *sums);

/* A side's color as it changes evenly over the cell. Where nothing was seen of it, it is what a
 * neighbor saw. */
void wf_fit_color(const wf_side_sums *sums, const double mean[3], double rgb[3][4]);

/* Added to variances of places: in directions in which samples say little, what is fitted to
 * them stays flat. */
#define WF_FLAT 0.01

#endif
