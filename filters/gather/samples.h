/* Fields from irregular samples. */
#ifndef WF_FILTERS_GATHER_SAMPLES_H
#define WF_FILTERS_GATHER_SAMPLES_H

#include "filters/aperture/aperture.h"
#include "filters/raster/raster.h"
#include "filters/raster/timing.h"

/* Irregular samples (x, y, t, color, weight) to fields (filters/README.md, Irregular samples):
 * a pixel is sum(h w c) / sum(h w) over the samples that its aperture reaches. Samples may come
 * in any order and number; a sample is added to every pixel that it reaches and need not be
 * kept. */

typedef struct wf_gather_desc {
    const wf_raster *raster;
    wf_aperture aperture;
    wf_rational width; /* tau, field periods; 0: samples within 2^-12 of the instant count */
    wf_position position;
    wf_rational skew; /* 0..1; {0, 0}: 0 */
    bool alpha;       /* is gathered beside color, with the same weights */
} wf_gather_desc;

/* Cells of the raster, each one pixel of one frame line, and the mean color of each over the
 * window of the samples' field. An aperture's integral over a cell is known; that many samples
 * of the cell lie in it is not. */
typedef struct wf_sample_cells {
    size_t count;
    const int *x, *y;    /* [count] */
    const float *rgb[3]; /* [count] each */
    const float *alpha;  /* [count]; NULL: 1 each */
} wf_sample_cells;

/* A block of samples, one array for each property, borrowed. */
typedef struct wf_samples {
    size_t count;
    const float *x, *y; /* raster coordinates: pixels, frame lines */
    const float *t;     /* field periods after the instant of `field` */
    int64_t field;
    const float *rgb[3]; /* scene-linear, over the background */
    const float *weight; /* NULL: 1 each */
    const float *alpha;  /* by which rgb is multiplied; NULL: 1 each */
    /* NULL, or the cells in which all of these samples lie: then rgb (and alpha, which is 0
     * where it is NULL) is what each sample differs from its cell's mean, weights add up to 1
     * in each cell, and a pixel is sum(H C + sum(h w c)) / sum(H), H the mean of h over the
     * cell, C the cell's color. For apertures that do not couple v and q, and samples that lie
     * evenly in the window of their field and of those at the same instant. */
    const wf_sample_cells *cells;
} wf_samples;

/* How a raster is cut into rectangles of samples. */
typedef struct wf_sample_tiling {
    int count, width_px, rows;
} wf_sample_tiling;

/* One such rectangle. */
typedef struct wf_sample_tile {
    int index;                   /* which, counted over the raster */
    int left, right, first, end; /* pixels, frame rows */
    const float *all; /* R, G, B of everything in the tile and within a tile's size of it, which
                         then has no samples; NULL where it has */
    bool still; /* its samples are the same at all times, if times are counted from the instant
                   of the samples' field */
    bool both;  /* and they serve fields of both parities */
} wf_sample_tile;

/* Functions that take samples, with `user` handed to each. */
typedef struct wf_receiver {
    void *user;
    void (*samples)(void *user, const wf_samples *samples);
    /* Told before the samples of a tile; false: they are not wanted. NULL: nobody asks. */
    bool (*tile)(void *user, const wf_sample_tile *tile);
} wf_receiver;

/* A part of a field: its lines first <= l < end, pixels left <= i < right of each. */
typedef struct wf_patch {
    int left, right, first, end;
} wf_patch;

/* Sums of some lines of one field, in double. One thread at a time; gathers are independent.
 * The bits depend on the order in which samples are added and gathers merged, and on nothing
 * else: whoever shares the work among threads cuts the samples into runs that do not depend on
 * the number of threads, and merges them in one order. */
typedef struct wf_gather wf_gather;

/* The lines of a field that samples of y0 <= y <= y1 can reach: first <= l < end, counted in
 * the field. */
void wf_gather_lines(const wf_gather_desc *desc, int64_t field, double y0, double y1,
                     int *first, int *end);

/* Fields whose windows can hold samples of t0 <= t <= t1 field periods after the instant of
 * field: *first <= n <= *last; none if *first > *last. */
void wf_gather_fields(const wf_gather_desc *desc, int64_t field, double t0, double t1,
                      int64_t *first, int64_t *last);

/* The pixels that samples of x0 <= x <= x1 and y0 <= y <= y1 can reach. */
wf_patch wf_gather_patch(const wf_gather_desc *desc, int64_t field, const double x[2],
                         const double y[2]);

/* Lines first <= l < end of a field, or a patch of it, all sums 0. NULL when memory is out.
 * desc is copied; the raster must outlive the gather. */
wf_gather *wf_gather_new(const wf_gather_desc *desc, int64_t field, int first, int end);
wf_gather *wf_gather_new_patch(const wf_gather_desc *desc, int64_t field, wf_patch patch);
void wf_gather_free(wf_gather *gather); /* NULL is fine */
size_t wf_gather_bytes(const wf_gather_desc *desc, int lines);

/* Adds samples; those that reach no pixel that is held add nothing. */
void wf_gather_add(wf_gather *gather, const wf_samples *samples);

/* Adds a sample of weight 1 to each pixel whose middle lies in a rectangle, of a color that
 * all other samples that these pixels see have too. */
void wf_gather_fill(wf_gather *gather, const wf_sample_tile *tile, const float rgb[3]);

/* Adds the sums of `from` where they overlap; of the same field, or of one that is to look like
 * it: of the same parity. */
void wf_gather_merge(wf_gather *gather, const wf_gather *from);

/* Alpha of line l, of a gather that has it: width_px samples, 0 where no sample reached. */
void wf_gather_alpha(const wf_gather *gather, int line, float *alpha);

/* Line l as R, G, B of width_px samples. Returns -1, or the first pixel that no sample reached
 * (or whose weights cancel); such pixels are 0 there. */
int wf_gather_line(const wf_gather *gather, int line, float *const rgb[3]);

/* Whether any sample reached a pixel. */
bool wf_gather_reached(const wf_gather *gather, int line, int pixel);

/* What pixel of line l takes from the nearest pixel of the gather that samples reached, by
 * distance on the raster: R, G, B and alpha, which is 1 where it is not gathered. False where
 * no sample reached any. */
bool wf_gather_nearest(const wf_gather *gather, int line, int pixel, float rgba[4]);

#endif
