/* The table of apertures, their integrals over cells and their responses. */
#include "filters/aperture/aperture.h"

#include <math.h>
#include <string.h>

#include "filters/aperture/design.h"
#include "filters/aperture/profile.h"
#include "filters/base/sinc.h"

static double clamp(double z, double low, double high) {
    return fmin(fmax(z, low), high);
}

/* The length of the part of z0 .. z1 that lies within |z| <= half. */
static double overlap(double z0, double z1, double half) {
    return clamp(z1, -half, half) - clamp(z0, -half, half);
}

double wf_cell_u(const wf_aperture *a, double u0, double u1) {
    return overlap(u0, u1, a->half_u);
}

/* ---- The quadratic notch filter f (paper, section 5) and its integral from 0 ---- */

static double notch_f(double v) {
    v = fabs(v);
    if (v < 1) return 0.5 - 0.25 * v * v;
    return v < 2 ? 0.25 * (2 - v) * (2 - v) : 0;
}

static double notch_integral(double v) {
    double s = fmin(fabs(v), 2), t = 2 - s;
    double area = s < 1 ? s * (0.5 - s * s / 12) : 0.5 - t * t * t / 12;
    return copysign(area, v);
}

/* The s >= 0 at which f(s) = level, for level > 0; 0 where level is above the peak of f. */
static double notch_inverse(double level) {
    if (level >= 0.5) return 0;
    return level >= 0.25 ? 2 * sqrt(0.5 - level) : 2 - 2 * sqrt(level);
}

/* The integral over v in [v0, v1] of clamp(u, -2 f(v), 2 f(v)): how much of the shaped region
 * lies left of u, but for a term that does not depend on u. */
static double shaped_left(double u, double v0, double v1) {
    double c = fabs(u), knee = notch_inverse(c / 2), area[2] = {v0, v1};
    for (int e = 0; e < 2; e++) {
        double s = fabs(area[e]), inner = fmin(s, knee);
        double outer = 2 * (notch_integral(s) - notch_integral(inner));
        area[e] = copysign(c * inner + outer, area[e]);
    }
    return copysign(area[1] - area[0], u);
}

static double shaped_cell_uv(const wf_aperture *a, double u0, double u1, double v0, double v1) {
    (void)a;
    return shaped_left(u1, v0, v1) - shaped_left(u0, v0, v1);
}

/* ---- Mitchell and Netravali's family ---- */

void wf_mitchell_poly(const wf_aperture *a, double near[4], double far[4]) {
    double b = a->parameter[0], c = a->parameter[1];
    double n[4] = {6 - 2 * b, 0, -18 + 12 * b + 6 * c, 12 - 9 * b - 6 * c};
    double f[4] = {8 * b + 24 * c, -12 * b - 48 * c, 6 * b + 30 * c, -b - 6 * c};
    memcpy(near, n, sizeof n);
    memcpy(far, f, sizeof f);
}

static double poly_integral(const double p[4], double s) {
    return s * (p[0] + s * (p[1] / 2 + s * (p[2] / 3 + s * p[3] / 4)));
}

static double mitchell_integral(const wf_aperture *a, double v) {
    double near[4], far[4], s = fmin(fabs(v), 2);
    wf_mitchell_poly(a, near, far);
    double area = poly_integral(near, fmin(s, 1));
    if (s > 1) area += poly_integral(far, s) - poly_integral(far, 1);
    return copysign(area / 6, v);
}

static double mitchell_value(const wf_aperture *a, double v) {
    double near[4], far[4], s = fabs(v);
    if (s >= 2) return 0;
    wf_mitchell_poly(a, near, far);
    const double *p = s < 1 ? near : far;
    return (p[0] + s * (p[1] + s * (p[2] + s * p[3]))) / 6;
}

/* ---- Cells ---- */

static double line_cell_v(const wf_aperture *a, double v0, double v1) {
    (void)a;
    return overlap(v0, v1, 0.5);
}

static double box_cell_v(const wf_aperture *a, double v0, double v1) {
    (void)a;
    return overlap(v0, v1, 1);
}

static double notch_cell_v(const wf_aperture *a, double v0, double v1) {
    (void)a;
    return notch_integral(v1) - notch_integral(v0);
}

static double shaped_cell_v(const wf_aperture *a, double v0, double v1) {
    return 4 * notch_cell_v(a, v0, v1);
}

static double mitchell_cell_v(const wf_aperture *a, double v0, double v1) {
    return mitchell_integral(a, v1) - mitchell_integral(a, v0);
}

static double design_cell_v(const wf_aperture *a, double v0, double v1) {
    return wf_stairs_integral(&a->stairs, v1) - wf_stairs_integral(&a->stairs, v0);
}

/* The integral from 0 of 1 - |v|, which is the diamond seen along time. */
static double tent_integral(double v) {
    double s = fmin(fabs(v), 1);
    return copysign(s - s * s / 2, v);
}

static double diamond_cell_v(const wf_aperture *a, double v0, double v1) {
    (void)a;
    return tent_integral(v1) - tent_integral(v0);
}

/* The integral over p in [p0, p1] of clamp(v, -(1 - |p|), 1 - |p|): what shaped_left is, of the
 * diamond |v| + |p| <= 1. */
static double diamond_below(double v, double p0, double p1) {
    double c = fmin(fabs(v), 1), knee = 1 - c, area[2] = {p0, p1};
    for (int e = 0; e < 2; e++) {
        double s = fmin(fabs(area[e]), 1), inner = fmin(s, knee);
        area[e] = copysign(c * inner + tent_integral(s) - tent_integral(inner), area[e]);
    }
    return copysign(area[1] - area[0], v);
}

static double diamond_cell_vq(double tau, double v0, double v1, double q0, double q1) {
    double p0 = 2 * q0 / tau, p1 = 2 * q1 / tau;
    return tau / 2 * (diamond_below(v1, p0, p1) - diamond_below(v0, p0, p1));
}

static double separable_cell_uv(const wf_aperture *a, double u0, double u1, double v0,
                                double v1) {
    return wf_cell_u(a, u0, u1) * a->kind->cell_v(a, v0, v1);
}

/* ---- Responses ---- */

static double line_response(const wf_aperture *a, double tau, double fx, double fy, double ft) {
    (void)a;
    return wf_sinc(fx) * wf_sinc(fy) * wf_sinc(tau * ft);
}

/* filters/least: lines' weights are those of `line`, and what follows is linear. */
static double least_response(const wf_aperture *a, double tau, double fx, double fy,
                             double ft) {
    double s = sin(M_PI * fy), flicker = s * s * s * s;
    return line_response(a, tau, fx, fy, ft) / (1 + a->parameter[0] * flicker);
}

static double box_response(const wf_aperture *a, double tau, double fx, double fy, double ft) {
    (void)a;
    return wf_sinc(fx) * wf_sinc(2 * fy) * wf_sinc(tau * ft);
}

static double notch_response(const wf_aperture *a, double tau, double fx, double fy,
                             double ft) {
    return box_response(a, tau, fx, fy, ft) * wf_sinc(fy) * wf_sinc(fy);
}

static double diamond_response(const wf_aperture *a, double tau, double fx, double fy,
                               double ft) {
    (void)a;
    return wf_sinc(fx) * wf_sinc(fy + tau * ft / 2) * wf_sinc(fy - tau * ft / 2);
}

typedef double integrand(const wf_aperture *a, double v, double fx);

/* Twice the integral over v in [0, 2] of weight(v) cos(2 pi fy v): Gauss-Legendre of five
 * points on panels short against the fastest oscillation, with a knot at v = 1 where the pieces
 * join. */
static double cosine_integral(const wf_aperture *a, integrand *weight, double fx, double fy) {
    static const double node[5] = {-0.9061798459386640, -0.5384693101056831, 0,
                                   0.5384693101056831, 0.9061798459386640};
    static const double share[5] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                    0.4786286704993665, 0.2369268850561891};
    int panels = 2 * (16 + (int)ceil(4 * fmin(fabs(fx) + fabs(fy), 1e4)));
    double half = 1.0 / panels, sum = 0;
    for (int p = 0; p < panels; p++)
        for (int g = 0; g < 5; g++) {
            double v = (2 * p + 1 + node[g]) * half;
            sum += share[g] * weight(a, v, fx) * cos(2 * M_PI * fy * v);
        }
    return 2 * sum * half;
}

static double shaped_integrand(const wf_aperture *a, double v, double fx) {
    (void)a;
    return notch_f(v) * wf_sinc(4 * notch_f(v) * fx);
}

static double shaped_response(const wf_aperture *a, double tau, double fx, double fy,
                              double ft) {
    double vertical = cosine_integral(a, shaped_integrand, fx, fy);
    return vertical * wf_sinc(tau * ft);
}

static double mitchell_integrand(const wf_aperture *a, double v, double fx) {
    (void)fx;
    return mitchell_value(a, v);
}

static double mitchell_response(const wf_aperture *a, double tau, double fx, double fy,
                                double ft) {
    double vertical = cosine_integral(a, mitchell_integrand, 0, fy);
    return wf_sinc(fx) * vertical * wf_sinc(tau * ft);
}

static double design_response(const wf_aperture *a, double tau, double fx, double fy,
                              double ft) {
    return wf_sinc(2 * a->half_u * fx) * wf_stairs_response(&a->stairs, fy) * wf_sinc(tau * ft);
}

/* ---- The table (filters/README.md, Apertures) ---- */

static const wf_aperture_kind kinds[] = {
    {.name = "line",
     .shape = "1 pixel x 1 line",
     .paper = "Figure 8",
     .default_width = {1, 2},
     .reach_u = 0.5,
     .reach_v = 0.5,
     .cell_uv = separable_cell_uv,
     .cell_v = line_cell_v,
     .response = line_response,
     .profile = WF_PROFILE_LINE},
    {.name = "rotated",
     .shape = "1 pixel x 1 line, a whole frame long",
     .paper = "section 4",
     .default_width = {2, 1},
     .reach_u = 0.5,
     .reach_v = 0.5,
     .cell_uv = separable_cell_uv,
     .cell_v = line_cell_v,
     .response = line_response,
     .profile = WF_PROFILE_LINE},
    {.name = "box",
     .shape = "1 pixel x 2 lines",
     .paper = "Figure 6",
     .default_width = {1, 2},
     .reach_u = 0.5,
     .reach_v = 1,
     .cell_uv = separable_cell_uv,
     .cell_v = box_cell_v,
     .response = box_response,
     .profile = WF_PROFILE_BOX},
    {.name = "ccd",
     .shape = "1 pixel x 2 lines, a whole field long",
     .paper = "Figures 4 and 5",
     .default_width = {1, 1},
     .reach_u = 0.5,
     .reach_v = 1,
     .cell_uv = separable_cell_uv,
     .cell_v = box_cell_v,
     .response = box_response,
     .profile = WF_PROFILE_BOX},
    {.name = "notch",
     .shape = "1 pixel x the quadratic f over 4 lines",
     .paper = "section 5",
     .default_width = {1, 2},
     .reach_u = 0.5,
     .reach_v = 2,
     .cell_uv = separable_cell_uv,
     .cell_v = notch_cell_v,
     .response = notch_response,
     .profile = WF_PROFILE_NOTCH},
    {.name = "shaped",
     .shape = "4 f(v) pixels wide over 4 lines",
     .paper = "Figure 9",
     .default_width = {1, 2},
     .reach_u = 1,
     .reach_v = 2,
     .couples_uv = true,
     .cell_uv = shaped_cell_uv,
     .cell_v = shaped_cell_v,
     .response = shaped_response,
     .profile = WF_PROFILE_SHAPED},
    {.name = "diamond",
     .shape = "1 pixel x a diamond over 2 lines and tau",
     .paper = "Figure 7",
     .default_width = {2, 1},
     .reach_u = 0.5,
     .reach_v = 1,
     .couples_vq = true,
     .cell_uv = separable_cell_uv,
     .cell_v = diamond_cell_v,
     .cell_vq = diamond_cell_vq,
     .response = diamond_response,
     .profile = WF_PROFILE_DIAMOND},
    {.name = "mitchell",
     .shape = "1 pixel x Mitchell and Netravali's cubic B,C over 4 lines",
     .paper = "section 5",
     .default_width = {1, 2},
     .reach_u = 0.5,
     .reach_v = 2,
     .follows = "B,C",
     .example = "0.333,0.333",
     .parameters = 2,
     .low = -10,
     .high = 10,
     .cell_uv = separable_cell_uv,
     .cell_v = mitchell_cell_v,
     .response = mitchell_response,
     .profile = WF_PROFILE_MITCHELL},
    {.name = "least",
     .shape = "line, then the nearest picture whose flicker weighs MU",
     .paper = "",
     .default_width = {1, 2},
     .reach_u = 0.5,
     .reach_v = 0.5,
     .follows = "MU",
     .example = "4",
     .parameters = 1,
     .high = 1e6,
     .nearest = true,
     .cell_uv = separable_cell_uv,
     .cell_v = line_cell_v,
     .response = least_response,
     .profile = WF_PROFILE_LINE},
    {.name = "crisp",
     .shape = "1.6 pixels x a kernel of 8 lines, designed to be sharp",
     .paper = "",
     .default_width = {1, 2},
     .reach_u = 1,
     .reach_v = 4,
     .design = "overshoot=0.078,sharp=0.802,width=1.6",
     .comb = wf_comb_crisp,
     .cell_uv = separable_cell_uv,
     .cell_v = design_cell_v,
     .response = design_response,
     .profile = WF_PROFILE_DESIGN},
    {.name = "calm",
     .shape = "1 pixel x a kernel of 8 lines, designed to flicker little",
     .paper = "",
     .default_width = {1, 2},
     .reach_u = 0.5,
     .reach_v = 4,
     .design = "overshoot=0.049,sharp=0.951,at=0.125,sharp=0.492,at=0.25",
     .comb = wf_comb_calm,
     .cell_uv = separable_cell_uv,
     .cell_v = design_cell_v,
     .response = design_response,
     .profile = WF_PROFILE_DESIGN},
    {.name = "design",
     .shape = "1 pixel or more x a kernel designed to measure",
     .paper = "",
     .default_width = {1, 2},
     .reach_u = 0.5,
     .reach_v = 4,
     .follows = "KEY=VALUE,..",
     .example = "sharp=0.7",
     .cell_uv = separable_cell_uv,
     .cell_v = design_cell_v,
     .response = design_response,
     .profile = WF_PROFILE_DESIGN},
};

const wf_aperture_kind *wf_aperture_at(size_t index) {
    return index < sizeof kinds / sizeof *kinds ? &kinds[index] : NULL;
}

double wf_response(const wf_aperture *a, double tau, double fx, double fy, double ft) {
    return a->kind->response(a, tau, fx, fy, ft);
}

double wf_aperture_value(const wf_aperture *a, double tau, double u, double v, double q) {
    double height, half_u;
    wf_profile_ops_best()->of[a->kind->profile](a, tau, 1, &v, &q, &height, &half_u);
    return fabs(q) <= tau / 2 && fabs(u) <= half_u ? height : 0;
}
