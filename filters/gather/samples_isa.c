/* Samples into the sums of the pixels that they reach.
 *
 * Samples mostly come many to a cell of the raster: those that follow one another within one
 * pixel of one line are taken together, line by line and pixel by pixel of what they reach, in
 * eight sums that are added up at the end. */
#include <math.h>

#include "filters/aperture/profile.h"
#include "filters/base/isa_file.h"
#include "filters/gather/samples_inside.h"

#define RUN   64 /* samples taken together */
#define LANES 8

/* Samples of one cell. Copies of one of them, which weigh nothing, fill up the lanes. */
typedef struct run {
    int count, padded;
    _Alignas(64) double x[RUN], y[RUN], t[RUN], light[4][RUN]; /* weight * (r, g, b, 1) */
    _Alignas(64) double alpha[RUN]; /* weight * alpha, if it is gathered */
    _Alignas(64) double v[RUN], q[RUN], height[RUN], half_u[RUN];
} run;

static bool in_cell(const float *x, const float *y, float i, float j) {
    return (*x >= i) & (*x < i + 1) & (*y >= j) & (*y < j + 1);
}

/* How many samples from `first` on lie in the cell of the first of them. */
static int same_cell(const wf_samples *s, size_t first) {
    const float *x = s->x + first, *y = s->y + first, i = floorf(*x), j = floorf(*y);
    int most = s->count - first < RUN ? (int)(s->count - first) : RUN, outside = 0, n = 1;
    for (int k = 0; k < most; k++) outside += !in_cell(x + k, y + k, i, j);
    if (!outside) return most;
    while (n < most && in_cell(x + n, y + n, i, j)) n++;
    return n;
}

/* Differences of samples that say nothing of alpha are none. */
static void load_alpha(const wf_samples *s, size_t first, run *r) {
    for (int i = 0; i < r->padded; i++) {
        size_t at = first + (size_t)(i < r->count ? i : 0);
        double w = i >= r->count ? 0 : s->weight ? (double)s->weight[at] : 1;
        r->alpha[i] = w * (s->alpha ? (double)s->alpha[at] : s->cells ? 0 : 1);
    }
}

static void load(const wf_samples *s, size_t first, double apart, run *r) {
    r->padded = (r->count + LANES - 1) / LANES * LANES;
    for (int i = 0; i < r->padded; i++) {
        size_t at = first + (size_t)(i < r->count ? i : 0);
        double w = i >= r->count ? 0 : s->weight ? (double)s->weight[at] : 1;
        r->x[i] = (double)s->x[at];
        r->y[i] = (double)s->y[at];
        r->t[i] = (double)s->t[at] - apart;
        r->light[0][i] = w * (double)s->rgb[0][at];
        r->light[1][i] = w * (double)s->rgb[1][at];
        r->light[2][i] = w * (double)s->rgb[2][at];
        r->light[3][i] = s->cells ? 0 : w;
    }
}

/* Eight sums side by side, whatever the instruction set makes of them. */
typedef double lanes __attribute__((vector_size(64), may_alias));
typedef int64_t lane_mask __attribute__((vector_size(64), may_alias));

/* Vectors are passed between functions of this file only, which are inlined. */
#pragma GCC diagnostic ignored "-Wpsabi"

static inline double total(lanes v) {
    return ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7]));
}

static inline lanes larger(lanes a, lanes b) {
    lane_mask over = a > b;
    return (lanes)(((lane_mask)a & over) | ((lane_mask)b & ~over));
}

static inline lanes where(lane_mask mask, lanes v) {
    return (lanes)((lane_mask)v & mask);
}

/* Inlined with alpha NULL and not, so that color alone is as fast as it can be. */
static inline __attribute__((always_inline)) void add_lanes(const run *r, int pixel,
                                                            wf_pixel_sum *sum, double *alpha) {
    lanes red = {0}, green = {0}, blue = {0}, weight = {0}, opaque = {0};
    double left = pixel + 0.5;
    for (int i = 0; i < r->padded; i += LANES) {
        lanes u = *(const lanes *)&r->x[i] - left, half = *(const lanes *)&r->half_u[i];
        lanes h = where((u <= half) & (-u <= half), *(const lanes *)&r->height[i]);
        red += h * *(const lanes *)&r->light[0][i];
        green += h * *(const lanes *)&r->light[1][i];
        blue += h * *(const lanes *)&r->light[2][i];
        weight += h * *(const lanes *)&r->light[3][i];
        if (alpha) opaque += h * *(const lanes *)&r->alpha[i];
    }
    sum->r += total(red);
    sum->g += total(green);
    sum->b += total(blue);
    sum->weight += total(weight);
    if (alpha) *alpha += total(opaque);
}

static void add_to_pixel(const run *r, int pixel, wf_pixel_sum *sum) {
    add_lanes(r, pixel, sum, NULL);
}

static void add_with_alpha(const run *r, int pixel, wf_pixel_sum *sum, double *alpha) {
    add_lanes(r, pixel, sum, alpha);
}

/* At an instant the aperture has only u and v; the diamond's is then the tent that it tends to.
 */
static void find_heights(const wf_gather *g, run *r, int j) {
    const wf_aperture *a = &g->desc.aperture;
    double late = g->skew_a_line * j + g->middle, line = j + 0.5, half = g->half;
    bool instant = !(g->tau > 0), tent = instant && a->kind->couples_vq;
    for (int i = 0; i < r->padded; i++) {
        r->v[i] = r->y[i] - line;
        r->q[i] = r->t[i] - late;
    }
    static const double none[RUN];
    wf_profile_fn *profile = WF_ISA_TABLE(wf_profile_ops).of[a->kind->profile];
    profile(a, instant ? 1 : g->tau, r->padded, r->v, instant ? none : r->q, r->height,
            r->half_u);
    for (int i = 0; i < r->padded; i++) {
        double height = tent ? r->height[i] * (1 - fabs(r->v[i])) : r->height[i];
        r->height[i] = fabs(r->q[i]) <= half ? height : 0;
    }
}

static inline double largest(lanes v) {
    double most = v[0];
    for (int k = 1; k < LANES; k++) most = v[k] > most ? v[k] : most;
    return most;
}

/* The largest half_u of the run's samples on the line; < 0: none of them reaches it. */
static double widest(const run *r) {
    lanes most = {-1, -1, -1, -1, -1, -1, -1, -1}, none = most;
    for (int i = 0; i < r->padded; i += LANES) {
        lane_mask some = *(const lanes *)&r->height[i] != 0;
        lane_mask half = (*(const lane_mask *)&r->half_u[i] & some) | ((lane_mask)none & ~some);
        most = larger((lanes)half, most);
    }
    return largest(most);
}

/* The least and the largest of the run's values. Those that pad it are copies. */
static void find_ends(const double *v, int padded, double *low, double *high) {
    lanes most = *(const lanes *)v, least = -most;
    for (int i = LANES; i < padded; i += LANES) {
        most = larger(*(const lanes *)&v[i], most);
        least = larger(-*(const lanes *)&v[i], least);
    }
    *low = -largest(least);
    *high = largest(most);
}

static void add_to_line(wf_gather *g, run *r, int line, double low, double high) {
    find_heights(g, r, g->parity + line * g->line_step);
    double half = widest(r);
    if (half < 0) return;
    double first = ceil(low - 0.5 - half), last = floor(high - 0.5 + half);
    int from = first > g->held.left ? (int)first : g->held.left;
    int to = last < g->held.right - 1 ? (int)last : g->held.right - 1;
    wf_pixel_sum *sums = wf_gather_sums(g, line);
    double *alphas = wf_gather_alphas(g, line);
    for (int i = from; !alphas && i <= to; i++) add_to_pixel(r, i, &sums[i]);
    for (int i = from; alphas && i <= to; i++) add_with_alpha(r, i, &sums[i], &alphas[i]);
}

static void add_run(wf_gather *g, run *r) {
    double reach = g->desc.aperture.reach_v;
    double low[2], high[2];
    find_ends(r->x, r->padded, &low[0], &high[0]);
    find_ends(r->y, r->padded, &low[1], &high[1]);
    if (!(fabs(low[0]) < 1e9 && fabs(low[1]) < 1e9)) return;
    double from = ceil((low[1] - reach - 0.5 - g->parity) / g->line_step);
    double to = floor((high[1] + reach - 0.5 - g->parity) / g->line_step);
    int first = from > g->held.first ? (int)from : g->held.first;
    int last = to < g->held.end - 1 ? (int)to : g->held.end - 1;
    for (int line = first; line <= last; line++) add_to_line(g, r, line, low[0], high[0]);
}

static void add(wf_gather *g, const wf_samples *s, double apart) {
    run r;
    for (size_t first = 0; first < s->count; first += (size_t)r.count) {
        r.count = same_cell(s, first);
        load(s, first, apart, &r);
        if (g->alpha) load_alpha(s, first, &r);
        add_run(g, &r);
    }
}

const wf_gather_ops WF_ISA_TABLE(wf_gather_ops) = {.add = add};
