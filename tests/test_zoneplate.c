/* The zone plate through every aperture against its closed form: cos(a (x^2 + y^2)) is the real
 * part of a product of Fresnel integrals, one along x and one along y; the shaped aperture
 * needs both at once. Integrals by Gauss and Legendre's rule, far within double's reach on
 * pieces this short. */
#include <complex.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "tests/scene_fields.h"

#define ASPECT (10.0 / 11.0)

/* 525i; a smaller picture of the same under sanitizers, which take ten times as long. */
static int width = 720, lines = 486;
static const char *raster = "525i";

/* ---- Integrals ---- */

#define NODES 10
static const double node[NODES / 2] = {0.1488743389816312, 0.4333953941292472,
                                       0.6794095682990244, 0.8650633666889845,
                                       0.9739065285171717};
static const double weight[NODES / 2] = {0.2955242247147529, 0.2692667193099963,
                                         0.2190863625159820, 0.1494513491505806,
                                         0.0666713443086881};

typedef double complex wave_fn(double z, const void *user);

static double complex integral(wave_fn *fn, const void *user, double from, double to) {
    double complex sum = 0;
    double middle = (from + to) / 2, half = (to - from) / 2;
    for (int k = 0; k < NODES / 2; k++)
        sum +=
            weight[k] * (fn(middle - half * node[k], user) + fn(middle + half * node[k], user));
    return sum * half;
}

static double chirp(void) {
    return M_PI / lines;
}

static double complex wave_x(double x, const void *user) {
    double r = (x - width / 2.0) * ASPECT;
    (void)user;
    return cexp(I * chirp() * r * r);
}

static double complex wave_y(double y) {
    double r = y - lines / 2.0;
    return cexp(I * chirp() * r * r);
}

static double f(double v) {
    double s = fabs(v);
    return s < 1 ? 0.5 - s * s / 4 : s < 2 ? s * s / 4 - s + 1 : 0;
}

/* ---- Apertures ---- */

typedef struct pixel {
    double x, y; /* its middle */
} pixel;

static double complex plain(double v, const void *user) {
    const pixel *p = user;
    return wave_y(p->y + v);
}

static double complex notched(double v, const void *user) {
    return f(v) * plain(v, user);
}

static double complex shaped(double v, const void *user) {
    const pixel *p = user;
    double half = 2 * f(v);
    double complex across =
        integral(wave_x, NULL, p->x - half, p->x) + integral(wave_x, NULL, p->x, p->x + half);
    return across * plain(v, user);
}

static double seen(double complex light, double area) {
    return 0.5 + 0.5 * creal(light) / area;
}

static double complex column(pixel p) {
    return integral(wave_x, NULL, p.x - 0.5, p.x + 0.5);
}

static double line_truth(pixel p) {
    return seen(column(p) * integral(plain, &p, -0.5, 0.5), 1);
}

static double box_truth(pixel p) {
    return seen(column(p) * (integral(plain, &p, -1, 0) + integral(plain, &p, 0, 1)), 2);
}

static double over_pieces(wave_fn *fn, pixel p, double complex across, double area) {
    double complex sum = 0;
    for (int piece = -2; piece < 2; piece++) sum += integral(fn, &p, piece, piece + 1);
    return seen(across * sum, area);
}

static double notch_truth(pixel p) {
    return over_pieces(notched, p, column(p), 1);
}

static double shaped_truth(pixel p) {
    return over_pieces(shaped, p, 1, 4);
}

/* ---- Comparison ---- */

/* The picture's outermost pixels see less than their aperture and are left out: the closed
 * forms are of whole ones. Of the shaped aperture's costly truth every third pixel of every
 * second line. */
static double error_of(const float *field, double (*truth)(pixel), int step) {
    int skip = step == 1 ? 1 : 2;
    double sum = 0;
    long count = 0;
    /* 525i is bottom first: field 0 has the odd lines. */
    for (int l = 1; l < lines / 2 - 1; l += skip)
        for (int i = 2 + l % step; i < width - 2; i += step) {
            pixel p = {i + 0.5, 2 * l + 1.5};
            double e = (double)field[3 * (l * width + i)] - truth(p);
            sum += e * e;
            count++;
        }
    return sqrt(sum / (double)count);
}

static void against_closed_forms(void **state) {
    static const struct {
        const char *aperture;
        double (*truth)(pixel);
        int step;
    } rows[] = {{"line", line_truth, 1},
                {"box", box_truth, 1},
                {"notch", notch_truth, 1},
                {"shaped", shaped_truth, 3}};
    (void)state;
    for (size_t n = 0; n < sizeof rows / sizeof *rows; n++)
        for (int count = 64; count <= 256; count *= 4) {
            scene_job job = {.path = "zoneplate.lua",
                             .raster = raster,
                             .aperture = rows[n].aperture,
                             .width = {0, 1},
                             .sampler = WF_SAMPLER_SOBOL,
                             .count = count};
            float *field = scene_field(&job, 0);
            double error = error_of(field, rows[n].truth, rows[n].step);
            print_message("%-7s %3d samples: RMSE %.2e\n", rows[n].aperture, count, error);
            assert_true(error <= (count == 64 ? 6e-3 : 2e-3));
            free(field);
        }
}

int main(void) {
    const char *sanitizer = getenv("WEFT_SANITIZE");
    if (sanitizer && *sanitizer) {
        raster = "180x122@30i,bff,par=10:11";
        width = 180;
        lines = 122;
        printf("under sanitizers: %s instead of 525i\n", raster);
    }
    const struct CMUnitTest tests[] = {cmocka_unit_test(against_closed_forms)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
