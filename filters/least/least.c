/* Tiles of columns: which of them hold their bounds as they are, and segments of the others. */
#include "filters/least/least.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "filters/least/segments.h"

enum { WIDTH = WF_LEAST_COLUMNS };

_Static_assert((int)WF_LEAST_COLUMNS == (int)wf_least_tile_px, "a tile is a tile");

WF_ISA_DISPATCH(wf_least_ops)

/* ---- The matrix ---- */

double wf_least_entry(const wf_least_desc *d, int j, int right) {
    static const double inside[3] = {0.375, -0.25, 0.0625};
    double same = right == 0, sum = 0;
    if (j >= 2 && j + right < d->lines - 2) return same + d->weight * inside[right];
    for (int row = j - 1; row <= j + 1; row++)
        sum += wf_least_b(d->lines, row, j) * wf_least_b(d->lines, row, j + right);
    return same + d->weight * sum;
}

static void factor(wf_least *least) {
    const wf_least_desc *d = &least->desc;
    double *pivot = least->pivot, *f1 = least->f1, *f2 = least->f2;
    for (int j = 0; j < d->lines; j++) {
        double h2 = j > 1 ? wf_least_entry(d, j - 2, 2) : 0;
        double rest = j ? wf_least_entry(d, j - 1, 1) - h2 * f1[j - 1] : 0;
        f2[j] = j > 1 ? h2 / pivot[j - 2] : 0;
        f1[j] = j ? rest / pivot[j - 1] : 0;
        pivot[j] = wf_least_entry(d, j, 0) - f1[j] * rest - f2[j] * h2;
        least->inverse[j] = 1 / pivot[j];
    }
}

/* After how many lines what a bound changes has died away to 1e-9 of itself. Roots z of
 * 1 + weight sin^4 have 2 - z - 1/z = 4 i / sqrt(weight). */
static int find_tail(double weight) {
    if (!(weight > 0)) return 0;
    double half_im = -2 / sqrt(weight);
    double re = -half_im * half_im, im = 2 * half_im; /* (1 + i half_im)^2 - 1 */
    double size = hypot(re, im), a = sqrt((size + re) / 2), b = -sqrt((size - re) / 2);
    double z = fmin(hypot(1 - a, half_im - b), hypot(1 + a, half_im + b));
    return (int)ceil(log(1e-9) / log(z));
}

/* ---- Life ---- */

wf_least *wf_least_new(const wf_least_desc *desc) {
    wf_least *least = calloc(1, sizeof *least);
    size_t lines = (size_t)desc->lines;
    if (!least) return NULL;
    least->desc = *desc;
    least->ops = wf_least_ops_best();
    least->tail = find_tail(desc->weight);
    least->f1 = calloc(4 * lines, sizeof *least->f1);
    if (!least->f1) {
        free(least);
        return NULL;
    }
    least->f2 = least->f1 + lines;
    least->pivot = least->f2 + lines;
    least->inverse = least->pivot + lines;
    factor(least);
    return least;
}

void wf_least_free(wf_least *least) {
    if (least) free(least->f1);
    free(least);
}

static size_t tile_samples(const wf_least *least) {
    return (size_t)least->desc.lines * WIDTH;
}

static size_t pack_samples(const wf_least *least) {
    size_t rows = (size_t)least->desc.lines + 2 * WF_LEAST_GUARD;
    return WF_LEAST_ARRAYS * rows * WF_LEAST_LANES;
}

static bool bounded(const wf_least *least) {
    return least->desc.limit < HUGE_VAL;
}

/* Columns of segments that do not touch have at least 5 lines each. */
static size_t most_segments(const wf_least *least) {
    return WIDTH * ((size_t)least->desc.lines / 5 + 1);
}

size_t wf_least_scratch_bytes(const wf_least *least) {
    size_t tile = tile_samples(least) * sizeof(double);
    if (!bounded(least)) return tile;
    return 6 * tile + pack_samples(least) * sizeof(double) +
           most_segments(least) * sizeof(wf_least_segment) +
           (size_t)least->desc.lines * 6 * sizeof(double);
}

wf_least_scratch *wf_least_scratch_new(const wf_least *least) {
    wf_least_scratch *s = calloc(1, sizeof *s);
    size_t tile = tile_samples(least), tiles = bounded(least) ? 6 : 1;
    if (!s) return NULL;
    s->l = calloc(tiles * tile, sizeof *s->l);
    bool good = s->l;
    if (bounded(least)) {
        s->pack.capacity = least->desc.lines;
        s->pack.arrays = calloc(pack_samples(least), sizeof *s->pack.arrays);
        s->segments = calloc(most_segments(least), sizeof *s->segments);
        s->settling = calloc(5 * (size_t)least->desc.lines, sizeof *s->settling);
        s->breaks = calloc((size_t)least->desc.lines, sizeof *s->breaks);
        good = good && s->pack.arrays && s->segments && s->breaks && s->settling;
    }
    if (!good) {
        wf_least_scratch_free(s);
        return NULL;
    }
    s->s = s->l + tile;
    s->base = s->s + tile;
    s->tension = s->base + tile;
    s->press = s->tension + tile;
    s->limit = s->press + tile;
    return s;
}

void wf_least_scratch_free(wf_least_scratch *s) {
    if (!s) return;
    free(s->l);
    free(s->pack.arrays);
    free(s->segments);
    free(s->breaks);
    free(s->settling);
    free(s);
}

const double *wf_least_tension(const wf_least_scratch *s) {
    return s->tension;
}

const double *wf_least_press(const wf_least_scratch *s) {
    return s->press;
}

/* ---- Tiles ---- */

/* Columns beyond the picture repeat its last. NaN counts as 0. */
static void load(const wf_least *least, wf_least_scratch *s, int first, int columns,
                 size_t stride, const float *from) {
    for (int j = 0; j < least->desc.lines; j++) {
        const float *line = from + (size_t)j * stride + first;
        double *row = s->l + (size_t)j * WIDTH;
        for (int i = 0; i < columns; i++) row[i] = line[i] == line[i] ? (double)line[i] : 0;
        for (int i = columns; i < WIDTH; i++) row[i] = row[columns - 1];
    }
}

static int64_t clip(const wf_least *least, double *x, int columns) {
    double most = least->desc.most;
    int64_t clipped = 0;
    for (int j = 0; j < least->desc.lines; j++, x += WIDTH)
        for (int i = 0; i < WIDTH; i++) {
            bool out = x[i] < 0 || x[i] > most;
            clipped += out && i < columns;
            x[i] = x[i] < 0 ? 0 : x[i] > most ? most : x[i];
        }
    return clipped;
}

static void store(const wf_least *least, const wf_least_scratch *s, int first, int columns,
                  size_t stride, float *to) {
    for (int j = 0; j < least->desc.lines; j++) {
        float *line = to + (size_t)j * stride + first;
        const double *row = s->l + (size_t)j * WIDTH;
        for (int i = 0; i < columns; i++) line[i] = (float)row[i];
    }
}

/* Of a limit that all pixels have one line is kept. */
static void load_limits(const wf_least *least, wf_least_scratch *s, int first, int columns,
                        size_t stride, const float *limits) {
    s->limit_step = limits ? WIDTH : 0;
    for (int i = 0; i < WIDTH && !limits; i++) s->limit[i] = least->desc.limit;
    for (int j = 0; j < least->desc.lines && limits; j++) {
        const float *line = limits + (size_t)j * stride + first;
        double *row = s->limit + j * WIDTH;
        for (int i = 0; i < WIDTH; i++) row[i] = (double)line[i < columns ? i : columns - 1];
    }
}

void wf_least_tile(const wf_least *least, wf_least_scratch *s, int tile, int width,
                   size_t stride, const float *from, float *to, wf_least_counts *counts) {
    wf_least_tile_within(least, s, tile, width, stride, from, NULL, to, counts);
}

void wf_least_tile_within(const wf_least *least, wf_least_scratch *s, int tile, int width,
                          size_t stride, const float *from, const float *limits, float *to,
                          wf_least_counts *counts) {
    int first = tile * WIDTH, columns = width - first < WIDTH ? width - first : WIDTH;
    const wf_least_factor f = {least->f1, least->f2, least->inverse, least->desc.lines};
    size_t bytes = tile_samples(least) * sizeof(double);
    load(least, s, first, columns, stride, from);
    if (bounded(least)) {
        load_limits(least, s, first, columns, stride, limits);
        counts->clipped += clip(least, s->l, columns);
        memcpy(s->s, s->l, bytes);
    }
    if (least->desc.weight > 0) least->ops->smooth(&f, s->l);
    if (bounded(least)) wf_least_hold(least, s, columns, counts);
    store(least, s, first, columns, stride, to);
}
