/* What the files of the nearest picture share. */
#ifndef WF_FILTERS_LEAST_SEGMENTS_H
#define WF_FILTERS_LEAST_SEGMENTS_H

#include "filters/least/least.h"
#include "filters/least/pack.h"

struct wf_least {
    wf_least_desc desc;
    const wf_least_ops *ops;
    int tail;                          /* lines */
    double *f1, *f2, *pivot, *inverse; /* [lines] each: I + weight B'B = F D F' */
};

/* Lines first <= j < end of a column, which bounds change. */
typedef struct wf_least_segment {
    int column, first, end;
    bool boxed; /* bounds on L may be met */
} wf_least_segment;

/* Tiles are [lines][WF_LEAST_COLUMNS]. */
struct wf_least_scratch {
    double *l;                      /* S, then L without bounds, then L */
    double *s, *base;               /* S; L without bounds */
    double *tension, *press;        /* multipliers */
    double *limit;                  /* of |b|: line j has limit[j * limit_step + column] */
    ptrdiff_t limit_step;           /* 0: it is one line, which all have */
    double scale[WF_LEAST_COLUMNS]; /* max(1, max S) */
    double *breaks; /* [lines] of a column: by how much its bounds are broken there */
    int pieces[WF_LEAST_COLUMNS]; /* segments of each column */
    double *settling;             /* [5][lines] */
    wf_least_segment *segments;
    int segment_count;
    wf_least_pack pack;
};

/* Row `row` of B at column `column`; 0 outside the picture. */
static inline double wf_least_b(int lines, int row, int column) {
    if (row < 0 || row >= lines) return 0;
    if (row == column) return 0.5;
    if (row == 0) return column == 1 ? -0.5 : 0;
    if (row == lines - 1) return column == lines - 2 ? -0.5 : 0;
    return column == row - 1 || column == row + 1 ? -0.25 : 0;
}

/* Column j + right of line j of I + weight B'B; right: 0 to 2. */
double wf_least_entry(const wf_least_desc *desc, int j, int right);

/* b at line j of a column x of the tile. (segments.c) */
double wf_least_flicker(const wf_least *least, const double *x, int j);

/* What is to be proved of the tile. (proof.c) */
wf_least_claim wf_least_claim_of(const wf_least *least, const wf_least_scratch *scratch);

/* (proof.c) By how much each column of the tile breaks its bounds at most, and how much more
 * than the least sum it may cost, over scale squared. */
void wf_least_judge(const wf_least *least, const wf_least_scratch *scratch, double *excess,
                    double *gap);

/* (proof.c) The multipliers of bounds that are met take up what is left of the gradient. */
void wf_least_settle(const wf_least *least, wf_least_scratch *scratch, int column);

/* Makes the columns of the tile whose l breaks bounds hold them, and proves it. */
void wf_least_hold(const wf_least *least, wf_least_scratch *scratch, int columns,
                   wf_least_counts *counts);

#endif
