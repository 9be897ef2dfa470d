/* The nearest picture whose flicker is weighed and bounded. */
#ifndef WF_FILTERS_LEAST_LEAST_H
#define WF_FILTERS_LEAST_LEAST_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Of a column S of light on all lines of a frame, the column L that minimizes
 *     sum (L - S)^2 + weight sum b(L)^2   where |b(L)| <= limit and 0 <= L <= most,
 * b being the flicker that a bob display shows: b_j = (L_j - (L_{j-1} + L_{j+1}) / 2) / 2, the
 * neighbor that is missing at an edge being the one on the other side
 * (filters/least/README.md). Without a limit there are no bounds at all, and L is S filtered:
 * of a frequency of f cycles a line 1 / (1 + weight sin^4(pi f)) is left. */
typedef struct wf_least_desc {
    int lines;     /* 2 or more */
    double weight; /* 0 or more */
    double limit;  /* above 0; INFINITY: there is none */
    double most;   /* above 0; INFINITY: there is none */
} wf_least_desc;

/* What is made of a description once: immutable, any threads. */
typedef struct wf_least wf_least;

/* NULL: no memory. */
wf_least *wf_least_new(const wf_least_desc *desc);
void wf_least_free(wf_least *least); /* NULL is fine */

/* Buffers of one thread. NULL: no memory. */
typedef struct wf_least_scratch wf_least_scratch;
size_t wf_least_scratch_bytes(const wf_least *least);
wf_least_scratch *wf_least_scratch_new(const wf_least *least);
void wf_least_scratch_free(wf_least_scratch *scratch); /* NULL is fine */

/* Counts of what was done. */
typedef struct wf_least_counts {
    int64_t clipped; /* samples of S that were below 0 or above most, and were set to these */
    int64_t solved;  /* columns that needed the interior point method */
    int64_t failed;  /* of these, columns whose solution was not proved */
    double gap;      /* the largest duality gap of a column, over max(1, max S)^2 */
} wf_least_counts;

/* Solves columns 0 <= x < width of planes [lines][stride] that lie side by side, in tiles:
 * tile t is columns t wf_least_tile_px to (t + 1) wf_least_tile_px. S is taken from `from` and
 * L put into `to`, which may be the same. Each column's bits depend on its tile alone. The
 * solution is within 1e-10 max(1, max S)^2 of the least sum, by its dual (limits below 0.003
 * times the root of max(1, max S): as much more as the square of that over the limit); a column
 * for which that is not reached is counted as failed. Adds to *counts. */
enum { wf_least_tile_px = 32 };
void wf_least_tile(const wf_least *least, wf_least_scratch *scratch, int tile, int width,
                   size_t stride, const float *from, float *to, wf_least_counts *counts);

/* The same where each pixel has a limit of its own: limits[lines][stride], above 0, beside
 * `from`. The description's limit only has to be finite. */
void wf_least_tile_within(const wf_least *least, wf_least_scratch *scratch, int tile, int width,
                          size_t stride, const float *from, const float *limits, float *to,
                          wf_least_counts *counts);

/* For tests: the multipliers of the columns of the tile solved last: of b, up less down, and of
 * the bounds 0 and most, up less down. Column i of line j is [j * wf_least_tile_px + i]. */
const double *wf_least_tension(const wf_least_scratch *scratch);
const double *wf_least_press(const wf_least_scratch *scratch);

#endif
