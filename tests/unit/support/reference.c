/* The plainest reading of the resampling rules, which the resampler is held to. */
#include "tests/unit/support/reference.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double f_notch(double v) {
    double s = fabs(v);
    return s < 1 ? 0.5 - s * s / 4 : s < 2 ? s * s / 4 - s + 1 : 0;
}

static double mitchell(const reference *r, double v) {
    double x = fabs(v), b = r->b, c = r->c;
    if (x < 1)
        return ((12 - 9 * b - 6 * c) * x * x * x + (-18 + 12 * b + 6 * c) * x * x + 6 - 2 * b) /
               6;
    if (x < 2)
        return ((-b - 6 * c) * x * x * x + (6 * b + 30 * c) * x * x + (-12 * b - 48 * c) * x +
                8 * b + 24 * c) /
               6;
    return 0;
}

static double length_within(double z0, double z1, double low, double high) {
    return fmax(0, fmin(z1, high) - fmax(z0, low));
}

static int is(const reference *r, const char *name) {
    return !strcmp(r->aperture, name);
}

static double steps(const reference *r, double v) {
    int step = (int)(fabs(v) * 8);
    return step < r->step_count ? r->steps[step] : 0;
}

/* Integral over u in [u0, u1] and q in [q0, q1] at height v, u and q from the aperture's
 * center. */
static double slice(const reference *r, const double u[2], const double q[2], double v) {
    double half_u = r->step_count ? r->half_u : 0.5;
    double across = length_within(u[0], u[1], -half_u, half_u), along = q[1] - q[0];
    if (r->step_count) return across * along * steps(r, v);
    if (is(r, "line") || is(r, "rotated")) return fabs(v) < 0.5 ? across * along : 0;
    if (is(r, "box") || is(r, "ccd")) return fabs(v) < 1 ? across * along : 0;
    if (is(r, "notch")) return across * along * f_notch(v);
    if (is(r, "mitchell")) return across * along * mitchell(r, v);
    if (is(r, "shaped")) {
        double half = 2 * f_notch(v);
        return length_within(u[0], u[1], -half, half) * along;
    }
    double rest = 1 - fabs(v);
    if (rest <= 0) return 0;
    if (r->tau == 0) return across * rest;
    return across * length_within(q[0], q[1], -r->tau * rest / 2, r->tau * rest / 2);
}

static int ascending(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

#define MOST_KNOTS 128

/* Heights at which the slice is not smooth. */
static int knots(const reference *r, const double u[2], const double q[2], const double v[2],
                 double out[MOST_KNOTS]) {
    double all[MOST_KNOTS];
    int n = 0, kept = 0;
    for (int e = -4; e <= 4; e++) all[n++] = e / 2.0;
    int first = (int)fmax(floor(v[0] * 8), -r->step_count);
    for (int e = first; e <= r->step_count && e < v[1] * 8; e++) all[n++] = e / 8.0;
    for (int e = 0; e < 2 && is(r, "shaped"); e++) {
        double level = fabs(u[e]) / 2;
        double at = level > 0.5 ? 0 : level > 0.25 ? sqrt(2 - 4 * level) : 2 - 2 * sqrt(level);
        all[n++] = at;
        all[n++] = -at;
    }
    for (int e = 0; e < 2 && is(r, "diamond") && r->tau > 0; e++) {
        double at = 1 - fabs(2 * q[e] / r->tau);
        all[n++] = at;
        all[n++] = -at;
    }
    out[kept++] = v[0];
    qsort(all, (size_t)n, sizeof *all, ascending);
    for (int k = 0; k < n; k++)
        if (all[k] > v[0] && all[k] < v[1]) out[kept++] = all[k];
    out[kept++] = v[1];
    return kept;
}

/* W of one cell; three Gauss-Legendre points between knots are exact for the cubics here. */
static double cell_weight(const reference *r, const double u[2], const double v[2],
                          const double q[2]) {
    static const double node[3] = {-0.7745966692414834, 0, 0.7745966692414834};
    static const double share[3] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
    double edge[MOST_KNOTS], sum = 0;
    int count = knots(r, u, q, v, edge);
    for (int k = 0; k + 1 < count; k++) {
        double half = (edge[k + 1] - edge[k]) / 2, mid = (edge[k + 1] + edge[k]) / 2;
        for (int g = 0; g < 3; g++)
            sum += half * share[g] * slice(r, u, q, mid + half * node[g]);
    }
    return sum;
}

static double clamp(double z, double low, double high) {
    return fmin(fmax(z, low), high);
}

/* Part of subframe k's time cell in the window of line j, from the window's center, in field
 * periods. 0 where they do not meet; 2 where the window is an instant, or meets nothing, and
 * takes this subframe alone. */
static int instant(const reference *r, int64_t field, int j, int k, double q[2]) {
    double t = (double)(r->psf ? field / 2 : field) + r->skew * j / r->lines;
    double cell = 1 / (r->rate * r->field_period_s);
    double from = t - r->position * r->tau, to = from + r->tau;
    double zero = r->center ? -cell / 2 : 0, last = zero + r->subframes * cell;
    if (r->tau == 0 || to <= zero + 1e-12 || from >= last - 1e-12) {
        double nearest = clamp(floor((from - zero) / cell + 1e-9), 0, r->subframes - 1);
        q[0] = 0;
        q[1] = 1;
        return k == (int)nearest ? 2 : 0;
    }
    double middle = from + r->tau / 2;
    q[0] = clamp(zero + k * cell, from, to) - middle;
    q[1] = clamp(zero + (k + 1) * cell, from, to) - middle;
    return q[1] - q[0] > 1e-12;
}

typedef struct sums {
    double weight, light, alpha, scale;
} sums;

static int in_data(const reference *r, int a, int b) {
    return a >= r->data[0] && b >= r->data[1] && a < r->data[2] && b < r->data[3];
}

static void add_cell(const reference *r, int k, int a, int b, int channel, double w, sums *s) {
    int in_display = a >= 0 && b >= 0 && a < r->cells_x && b < r->cells_y;
    int shown = in_data(r, a, b) && (in_display || !r->padded);
    if (!in_display && !shown && !r->padded) return;
    s->weight += w;
    double sample = shown ? (double)r->sample(r->user, k, a, b, channel) : 0;
    double alpha = in_display || !r->padded ? 1 : 0;
    if (r->has_alpha) alpha = shown ? (double)r->sample(r->user, k, a, b, 3) : 0;
    s->light += w * sample;
    s->scale += fabs(w * sample);
    s->alpha += w * alpha;
}

/* Cell edges from a center; cells of padding end where the picture ends. */
static void edges(double origin, double cell, int a, int cells, double center, double end,
                  int padded, double out[2]) {
    out[0] = origin + a * cell;
    out[1] = origin + (a + 1) * cell;
    for (int e = 0; e < 2; e++) {
        if (padded && (a < 0 || a >= cells)) out[e] = clamp(out[e], 0, end);
        out[e] -= center;
    }
}

static void add_subframe(const reference *r, int i, int j, int k, int channel,
                         const double q[2], sums *s) {
    int a0 = (int)floor((i + 0.5 - 1.5 - r->origin_x) / r->cell_w) - 1;
    int a1 = (int)ceil((i + 0.5 + 1.5 - r->origin_x) / r->cell_w) + 1;
    double lines = fmax(2.5, r->step_count / 8.0);
    int b0 = (int)floor((j + 0.5 - lines - r->origin_y) / r->cell_h) - 1;
    int b1 = (int)ceil((j + 0.5 + lines - r->origin_y) / r->cell_h) + 1;
    for (int b = b0; b <= b1; b++)
        for (int a = a0; a <= a1; a++) {
            double u[2], v[2];
            edges(r->origin_x, r->cell_w, a, r->cells_x, i + 0.5, r->width, r->padded, u);
            edges(r->origin_y, r->cell_h, b, r->cells_y, j + 0.5, r->lines, r->padded, v);
            double w = u[1] > u[0] && v[1] > v[0] ? cell_weight(r, u, v, q) : 0;
            if (w != 0) add_cell(r, k, a, b, channel, w, s);
        }
}

reference_value reference_pixel(const reference *r, int i, int j, int64_t field, int channel) {
    sums s = {0};
    for (int k = 0; k < r->subframes; k++) {
        double q[2];
        int meets = instant(r, field, j, k, q);
        if (!meets) continue;
        reference seen = *r;
        if (meets == 2) seen.tau = 0;
        add_subframe(&seen, i, j, k, channel, q, &s);
    }
    double behind = (1 - s.alpha / s.weight) * (double)r->background[channel];
    return (reference_value){s.light / s.weight + behind, s.scale / s.weight + fabs(behind)};
}
