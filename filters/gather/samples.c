/* Irregular samples into the pixels of a field. */
#include "filters/gather/samples_inside.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* How far from the instant samples count where the window is an instant, in field periods. */
#define INSTANT 0x1p-12

/* ---- Windows ---- */

/* How many instants one field is before another; exact but for fields beyond any run, whose
 * difference no integer may hold. */
static double instants_apart(const wf_gather_desc *d, int64_t from, int64_t to) {
    return (double)wf_raster_instant(d->raster, to) -
           (double)wf_raster_instant(d->raster, from);
}

/* The window's middle, in field periods after the instant. */
static double middle_of(const wf_gather_desc *d) {
    return (0.5 - wf_position_anchor(d->position)) * wf_ratio_value(d->width);
}

static double skew_of(const wf_gather_desc *d) {
    return wf_ratio_given(d->skew) ? wf_ratio_value(d->skew) : 0;
}

static double half_window(const wf_gather_desc *d) {
    double tau = wf_ratio_value(d->width);
    return tau > 0 ? tau / 2 : INSTANT;
}

/* Farther fields than a run has: what is beyond them is as far as this, in numbers that can be
 * added. */
#define FAR_FIELDS 0x1p40

static int64_t nearer(double fields) {
    return (int64_t)fmin(fmax(fields, -FAR_FIELDS), FAR_FIELDS);
}

void wf_gather_fields(const wf_gather_desc *d, int64_t field, double t0, double t1,
                      int64_t *first, int64_t *last) {
    double middle = middle_of(d), half = half_window(d);
    double low = ceil(t0 - middle - half - skew_of(d)), high = floor(t1 - middle + half);
    int64_t base = wf_raster_instant(d->raster, nearer((double)field));
    *first = wf_raster_first_field(d->raster, base + nearer(low));
    *last = wf_raster_first_field(d->raster, base + nearer(high) + 1) - 1;
    if (*first < 0) *first = 0;
}

void wf_gather_lines(const wf_gather_desc *d, int64_t field, double y0, double y1, int *first,
                     int *end) {
    double reach = d->aperture.reach_v;
    int parity = wf_raster_parity(d->raster, field), step = wf_raster_line_step(d->raster);
    int lines = wf_raster_field_lines(d->raster, parity);
    double low = ceil((y0 - reach - 0.5 - parity) / step);
    double high = floor((y1 + reach - 0.5 - parity) / step);
    *first = low > 0 ? (low < lines ? (int)low : lines) : 0;
    *end = high < lines - 1 ? (high >= 0 ? (int)high + 1 : 0) : lines;
    if (*end < *first) *end = *first;
}

/* ---- Life ---- */

size_t wf_gather_bytes(const wf_gather_desc *d, int lines) {
    size_t pixel = sizeof(wf_pixel_sum) + (d->alpha ? sizeof(double) : 0);
    return (size_t)lines * (size_t)d->raster->width_px * pixel;
}

wf_patch wf_gather_patch(const wf_gather_desc *d, int64_t field, const double x[2],
                         const double y[2]) {
    double reach = d->aperture.reach_u;
    int width = d->raster->width_px;
    double low = ceil(x[0] - reach - 0.5), high = floor(x[1] + reach - 0.5);
    wf_patch p = {low > 0 ? (int)low : 0, high < width - 1 ? (int)high + 1 : width, 0, 0};
    wf_gather_lines(d, field, y[0], y[1], &p.first, &p.end);
    return p;
}

wf_gather *wf_gather_new(const wf_gather_desc *d, int64_t field, int first, int end) {
    return wf_gather_new_patch(d, field, (wf_patch){0, d->raster->width_px, first, end});
}

wf_gather *wf_gather_new_patch(const wf_gather_desc *d, int64_t field, wf_patch patch) {
    wf_gather *g = calloc(1, sizeof *g);
    if (!g) return NULL;
    *g = (wf_gather){.desc = *d, .field = field, .held = patch};
    g->parity = wf_raster_parity(d->raster, field);
    g->line_step = wf_raster_line_step(d->raster);
    g->field_lines = wf_raster_field_lines(d->raster, g->parity);
    g->tau = wf_ratio_value(d->width);
    g->middle = middle_of(d);
    g->half = half_window(d);
    g->skew_a_line = skew_of(d) / d->raster->lines;
    size_t pixels = (size_t)(patch.end - patch.first) * (size_t)(patch.right - patch.left);
    g->sum = calloc(pixels + 1, sizeof *g->sum);
    if (d->alpha) g->alpha = calloc(pixels + 1, sizeof *g->alpha);
    if (g->sum && (g->alpha || !d->alpha)) return g;
    wf_gather_free(g);
    return NULL;
}

void wf_gather_free(wf_gather *g) {
    if (!g) return;
    free(g->sum);
    free(g->alpha);
    free(g);
}

/* ---- Adding ---- */

WF_ISA_DISPATCH(wf_gather_ops)

double wf_gather_apart(const wf_gather *g, int64_t field) {
    return instants_apart(&g->desc, field, g->field);
}

/* Cells that an aperture reaches: it is at most 4 pixels wide. */
#define MOST_ACROSS 5
#define MOST_DOWN   (2 * WF_STAIRS_LINES + 1)

/* The means of an aperture over cells: [k][n] of the cell that begins first_u + n pixels and
 * first_v + k lines from the pixel's middle. */
typedef struct cell_heights {
    double of[MOST_DOWN][MOST_ACROSS], first_u, first_v;
    int across, down;
} cell_heights;

static cell_heights heights_of(const wf_aperture *a) {
    cell_heights h = {.first_u = -ceil(a->reach_u + 0.5) + 0.5,
                      .first_v = -ceil(a->reach_v + 0.5) + 0.5};
    h.across = (int)fmin(-2 * h.first_u, MOST_ACROSS);
    h.down = (int)fmin(-2 * h.first_v, MOST_DOWN);
    for (int k = 0; k < h.down; k++)
        for (int n = 0; n < h.across; n++) {
            double u = h.first_u + n, v = h.first_v + k;
            h.of[k][n] = a->kind->cell_uv(a, u, u + 1, v, v + 1);
        }
    return h;
}

static void add_cell(wf_gather *g, const cell_heights *h, int x, int y, const double rgba[4]) {
    for (int k = 0; k < h->down; k++) {
        int j = y - (int)(h->first_v + k + 0.5), line = (j - g->parity) / g->line_step;
        if (j < g->parity || (j - g->parity) % g->line_step || line < g->held.first ||
            line >= g->held.end)
            continue;
        wf_pixel_sum *sum = wf_gather_sums(g, line);
        double *alpha = wf_gather_alphas(g, line);
        for (int n = 0; n < h->across; n++) {
            int i = x - (int)(h->first_u + n + 0.5);
            if (h->of[k][n] == 0 || i < g->held.left || i >= g->held.right) continue;
            sum[i].r += h->of[k][n] * rgba[0];
            sum[i].g += h->of[k][n] * rgba[1];
            sum[i].b += h->of[k][n] * rgba[2];
            sum[i].weight += h->of[k][n];
            if (alpha) alpha[i] += h->of[k][n] * rgba[3];
        }
    }
}

static void add_cells(wf_gather *g, const wf_sample_cells *cells) {
    const cell_heights heights = heights_of(&g->desc.aperture);
    for (size_t n = 0; n < cells->count; n++) {
        const double rgba[4] = {(double)cells->rgb[0][n], (double)cells->rgb[1][n],
                                (double)cells->rgb[2][n],
                                cells->alpha ? (double)cells->alpha[n] : 1};
        add_cell(g, &heights, cells->x[n], cells->y[n], rgba);
    }
}

void wf_gather_add(wf_gather *g, const wf_samples *samples) {
    double apart = wf_gather_apart(g, samples->field);
    wf_gather_ops_best()->add(g, samples, apart);
    if (samples->cells && apart == 0) add_cells(g, samples->cells);
}

void wf_gather_fill(wf_gather *g, const wf_sample_tile *tile, const float rgb[3]) {
    for (int line = g->held.first; line < g->held.end; line++) {
        int row = g->parity + line * g->line_step;
        if (row < tile->first || row >= tile->end) continue;
        wf_pixel_sum *sum = wf_gather_sums(g, line);
        double *alpha = wf_gather_alphas(g, line);
        for (int i = tile->left; i < tile->right; i++) {
            sum[i].r += (double)rgb[0];
            sum[i].g += (double)rgb[1];
            sum[i].b += (double)rgb[2];
            sum[i].weight += 1;
            if (alpha) alpha[i] += 1;
        }
    }
}

static wf_patch overlap(const wf_patch *a, const wf_patch *b) {
    return (wf_patch){.left = a->left > b->left ? a->left : b->left,
                      .right = a->right < b->right ? a->right : b->right,
                      .first = a->first > b->first ? a->first : b->first,
                      .end = a->end < b->end ? a->end : b->end};
}

void wf_gather_merge(wf_gather *g, const wf_gather *from) {
    wf_patch both = overlap(&g->held, &from->held);
    for (int line = both.first; line < both.end; line++) {
        wf_pixel_sum *to = wf_gather_sums(g, line);
        const wf_pixel_sum *add = wf_gather_sums(from, line);
        double *alpha = wf_gather_alphas(g, line);
        const double *more = wf_gather_alphas(from, line);
        for (int i = both.left; i < both.right; i++) {
            to[i].r += add[i].r;
            to[i].g += add[i].g;
            to[i].b += add[i].b;
            to[i].weight += add[i].weight;
            if (alpha && more) alpha[i] += more[i];
        }
    }
}

/* ---- Finishing ---- */

int wf_gather_line(const wf_gather *g, int line, float *const rgb[3]) {
    const wf_pixel_sum *sum = wf_gather_sums(g, line);
    int empty = -1;
    for (int i = 0; i < g->desc.raster->width_px; i++) {
        bool reached = sum[i].weight != 0;
        double share = reached ? 1 / sum[i].weight : 0;
        if (!reached && empty < 0) empty = i;
        rgb[0][i] = (float)(sum[i].r * share);
        rgb[1][i] = (float)(sum[i].g * share);
        rgb[2][i] = (float)(sum[i].b * share);
    }
    return empty;
}

void wf_gather_alpha(const wf_gather *g, int line, float *alpha) {
    const wf_pixel_sum *sum = wf_gather_sums(g, line);
    const double *sums = wf_gather_alphas(g, line);
    for (int i = 0; i < g->desc.raster->width_px; i++)
        alpha[i] = sum[i].weight != 0 ? (float)(sums[i] / sum[i].weight) : 0;
}

bool wf_gather_reached(const wf_gather *g, int line, int pixel) {
    return wf_gather_sums(g, line)[pixel].weight != 0;
}

/* The pixel of one line nearest to `pixel` that samples reached, or -1. */
static int nearest_in_line(const wf_gather *g, int line, int pixel) {
    const wf_pixel_sum *sum = wf_gather_sums(g, line);
    int width = g->desc.raster->width_px;
    for (int d = 0; d < width; d++) {
        if (pixel - d >= 0 && sum[pixel - d].weight != 0) return pixel - d;
        if (pixel + d < width && sum[pixel + d].weight != 0) return pixel + d;
    }
    return -1;
}

bool wf_gather_nearest(const wf_gather *g, int line, int pixel, float rgba[4]) {
    const wf_pixel_sum *best = NULL;
    double best_distance = HUGE_VAL;
    for (int l = g->held.first; l < g->held.end; l++) {
        double down = (double)(l - line) * g->line_step;
        if (down * down >= best_distance) continue;
        int found = nearest_in_line(g, l, pixel);
        double across = found - pixel, distance = down * down + across * across;
        if (found < 0 || distance >= best_distance) continue;
        best_distance = distance;
        best = &wf_gather_sums(g, l)[found];
    }
    if (!best) return false;
    double alpha = g->alpha ? g->alpha[best - g->sum] : best->weight;
    rgba[0] = (float)(best->r / best->weight);
    rgba[1] = (float)(best->g / best->weight);
    rgba[2] = (float)(best->b / best->weight);
    rgba[3] = (float)(alpha / best->weight);
    return true;
}
