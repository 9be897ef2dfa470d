#include "filters/aperture.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "filters/profile.h"

static double sinc(double z) {
    return z == 0 ? 1 : sin(M_PI * z) / (M_PI * z);
}

static double clamp(double z, double low, double high) {
    return fmin(fmax(z, low), high);
}

/* Length of [z0, z1] within |z| <= half. */
static double overlap(double z0, double z1, double half) {
    return clamp(z1, -half, half) - clamp(z0, -half, half);
}

double wf_cell_u(double u0, double u1) {
    return overlap(u0, u1, 0.5);
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

/* The s >= 0 at which f falls to level, 0 < level; 0 above the peak. */
static double notch_inverse(double level) {
    if (level >= 0.5) return 0;
    return level >= 0.25 ? 2 * sqrt(0.5 - level) : 2 - 2 * sqrt(level);
}

/* Integral over [v0, v1] of clamp(u, -2f, 2f): how much of the shaped region lies left of u, up
 * to a term that does not depend on u. */
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

/* Integral from 0 of 1 - |v|: the diamond seen along time. */
static double tent_integral(double v) {
    double s = fmin(fabs(v), 1);
    return copysign(s - s * s / 2, v);
}

static double diamond_cell_v(const wf_aperture *a, double v0, double v1) {
    (void)a;
    return tent_integral(v1) - tent_integral(v0);
}

/* Integral over p in [p0, p1] of clamp(v, -(1 - |p|), 1 - |p|): as shaped_left, for the diamond
 * |v| + |p| <= 1. */
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
    return wf_cell_u(u0, u1) * a->kind->cell_v(a, v0, v1);
}

/* ---- Responses ---- */

static double line_response(const wf_aperture *a, double tau, double fx, double fy, double ft) {
    (void)a;
    return sinc(fx) * sinc(fy) * sinc(tau * ft);
}

static double box_response(const wf_aperture *a, double tau, double fx, double fy, double ft) {
    (void)a;
    return sinc(fx) * sinc(2 * fy) * sinc(tau * ft);
}

static double notch_response(const wf_aperture *a, double tau, double fx, double fy,
                             double ft) {
    return box_response(a, tau, fx, fy, ft) * sinc(fy) * sinc(fy);
}

static double diamond_response(const wf_aperture *a, double tau, double fx, double fy,
                               double ft) {
    (void)a;
    return sinc(fx) * sinc(fy + tau * ft / 2) * sinc(fy - tau * ft / 2);
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
    return notch_f(v) * sinc(4 * notch_f(v) * fx);
}

static double shaped_response(const wf_aperture *a, double tau, double fx, double fy,
                              double ft) {
    double vertical = cosine_integral(a, shaped_integrand, fx, fy);
    return vertical * sinc(tau * ft);
}

static double mitchell_integrand(const wf_aperture *a, double v, double fx) {
    (void)fx;
    return mitchell_value(a, v);
}

static double mitchell_response(const wf_aperture *a, double tau, double fx, double fy,
                                double ft) {
    double vertical = cosine_integral(a, mitchell_integrand, 0, fy);
    return sinc(fx) * vertical * sinc(tau * ft);
}

/* ---- The table (resampling.md, Apertures) ---- */

static const wf_aperture_kind kinds[] = {
    {"line",
     "1 pixel x 1 line",
     "Figure 8",
     {1, 2},
     0.5,
     0.5,
     0,
     false,
     false,
     separable_cell_uv,
     line_cell_v,
     NULL,
     line_response,
     WF_PROFILE_LINE},
    {"rotated",
     "1 pixel x 1 line, a whole frame long",
     "section 4",
     {2, 1},
     0.5,
     0.5,
     0,
     false,
     false,
     separable_cell_uv,
     line_cell_v,
     NULL,
     line_response,
     WF_PROFILE_LINE},
    {"box",
     "1 pixel x 2 lines",
     "Figure 6",
     {1, 2},
     0.5,
     1,
     0,
     false,
     false,
     separable_cell_uv,
     box_cell_v,
     NULL,
     box_response,
     WF_PROFILE_BOX},
    {"ccd",
     "1 pixel x 2 lines, a whole field long",
     "Figures 4 and 5",
     {1, 1},
     0.5,
     1,
     0,
     false,
     false,
     separable_cell_uv,
     box_cell_v,
     NULL,
     box_response,
     WF_PROFILE_BOX},
    {"notch",
     "1 pixel x the quadratic f over 4 lines",
     "section 5",
     {1, 2},
     0.5,
     2,
     0,
     false,
     false,
     separable_cell_uv,
     notch_cell_v,
     NULL,
     notch_response,
     WF_PROFILE_NOTCH},
    {"shaped",
     "4 f(v) pixels wide over 4 lines",
     "Figure 9",
     {1, 2},
     1,
     2,
     0,
     true,
     false,
     shaped_cell_uv,
     shaped_cell_v,
     NULL,
     shaped_response,
     WF_PROFILE_SHAPED},
    {"diamond",
     "1 pixel x a diamond over 2 lines and tau",
     "Figure 7",
     {2, 1},
     0.5,
     1,
     0,
     false,
     true,
     separable_cell_uv,
     diamond_cell_v,
     diamond_cell_vq,
     diamond_response,
     WF_PROFILE_DIAMOND},
    {"mitchell",
     "1 pixel x Mitchell and Netravali's cubic B,C over 4 lines",
     "section 5",
     {1, 2},
     0.5,
     2,
     2,
     false,
     false,
     separable_cell_uv,
     mitchell_cell_v,
     NULL,
     mitchell_response,
     WF_PROFILE_MITCHELL},
};

const wf_aperture_kind *wf_aperture_at(size_t index) {
    return index < sizeof kinds / sizeof *kinds ? &kinds[index] : NULL;
}

static bool list_names(char *why, size_t why_size, const char *text) {
    int used = snprintf(why, why_size, "no aperture is called '%s'; there are", text);
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        if (used < 0 || (size_t)used >= why_size) break;
        used += snprintf(why + used, why_size - (size_t)used, "%s %s%s", i ? "," : "",
                         kinds[i].name, kinds[i].parameters ? ":B,C" : "");
    }
    return false;
}

/* Reads "1.5" or "3/2"; *end is where it stopped, text itself if it is no number. */
static double read_number(const char *text, char **end) {
    double value = strtod(text, end);
    if (*end == text || **end != '/') return value;
    const char *below = *end + 1;
    value /= strtod(below, end);
    if (*end == below) *end = (char *)(uintptr_t)text;
    return value;
}

/* Reads "B,C" after the colon. Beyond +-10 the cubic's lobes cancel to nothing useful. */
static bool parse_parameters(const char *text, wf_aperture *out) {
    for (int p = 0; p < out->kind->parameters; p++) {
        char *end;
        double value = read_number(text, &end);
        char follows = p + 1 < out->kind->parameters ? ',' : '\0';
        if (end == text || *end != follows || !(fabs(value) <= 10)) return false;
        out->parameter[p] = value;
        text = end + 1;
    }
    return true;
}

bool wf_aperture_parse(const char *text, wf_aperture *out, char *why, size_t why_size) {
    size_t length = strcspn(text, ":");
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        if (strlen(kinds[i].name) != length || strncmp(kinds[i].name, text, length)) continue;
        wf_aperture found = {.kind = &kinds[i]};
        bool fits = kinds[i].parameters
                        ? text[length] && parse_parameters(text + length + 1, &found)
                        : !text[length];
        if (fits) {
            *out = found;
            return true;
        }
        snprintf(
            why, why_size,
            kinds[i].parameters
                ? "aperture '%s': write it %s:B,C with two numbers from -10 to 10, such as "
                  "mitchell:3/2,-1/4"
                : "aperture '%s': %s takes no parameters",
            text, kinds[i].name);
        return false;
    }
    return list_names(why, why_size, text);
}

double wf_response(const wf_aperture *a, double tau, double fx, double fy, double ft) {
    return a->kind->response(a, tau, fx, fy, ft);
}

double wf_aperture_value(const wf_aperture *a, double tau, double u, double v, double q) {
    double height, half_u;
    wf_profiles_best()[a->kind->profile](a, tau, 1, &v, &q, &height, &half_u);
    return fabs(q) <= tau / 2 && fabs(u) <= half_u ? height : 0;
}
