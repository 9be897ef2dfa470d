/* Contrast sensitivity against what its authors published and what has been measured, and what
 * pictures look like through it against closed forms. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <cmocka.h>

#include "filters/seen/seen.h"
#include "filters/seen/sensitivity.h"

static void assert_near(double value, double expected, double relative, const char *what) {
    if (!(fabs(value / expected - 1) <= relative))
        fail_msg("%s: %.6g, expected %.6g within %.2g of it", what, value, expected, relative);
}

/* ---- The table ---- */

/* Sensitivities to gratings of 0.5, 1, 2, 4, 8 and 16 cycles a degree: what the program that
 * the authors of castleCSF published (version 0.2.4) answers, run in Octave. */
static const struct {
    double hz, cd_m2, area_degree2, sensitivity[6];
} gratings[] = {
    {12.5, 1, 2.5, {19.496, 20.161, 18.08, 12.546, 6.2102, 2.3793}},
    {12.5, 100, 121, {159.91, 157.98, 137.16, 88.179, 41.134, 15.233}},
    {15, 1, 2.5, {12.578, 12.731, 11.28, 7.8612, 3.9632, 1.5522}},
    {15, 10, 121, {62.865, 63.214, 52.748, 32.135, 14.388, 5.3024}},
    {15, 1000, 121, {240.58, 228.1, 187.9, 118.48, 55.811, 21.502}},
    {25, 1, 121, {3.5335, 3.3665, 2.6727, 1.6133, 0.73991, 0.28591}},
    {25, 10, 2.5, {10.833, 10.361, 8.908, 6.3169, 3.3574, 1.3876}},
    {25, 100, 121, {52.078, 48.664, 39.013, 24.1, 11.268, 4.3999}},
    {25, 1000, 121, {125.51, 117.07, 93.624, 57.787, 27.036, 10.578}},
    {30, 1, 2.5, {0.96312, 0.92082, 0.78869, 0.55638, 0.295, 0.12221}},
    {30, 1, 121, {1.5123, 1.4202, 1.1312, 0.69201, 0.3214, 0.12531}},
    {30, 10, 121, {8.7803, 8.2041, 6.5591, 4.0401, 1.886, 0.73707}},
    {30, 100, 2.5, {19.813, 18.87, 16.134, 11.404, 6.073, 2.5245}},
    {30, 100, 121, {30.788, 28.706, 22.936, 14.143, 6.6135, 2.5885}},
    {30, 1000, 121, {82.393, 76.784, 61.308, 37.795, 17.676, 6.9221}},
};

/* The same of disks of 1, 5 and 14 degrees of radius. */
static const struct {
    double hz, cd_m2, sensitivity[3];
} disks[] = {
    {25, 1, {2.1848, 3.7284, 5.2482}},   {25, 10, {10.735, 18.319, 25.786}},
    {25, 100, {33.153, 56.576, 79.638}}, {25, 1000, {80.024, 136.56, 192.23}},
    {30, 1, {0.95424, 1.6284, 2.2922}},  {30, 10, {5.5919, 9.5426, 13.432}},
    {30, 100, {19.639, 33.513, 47.174}}, {30, 1000, {52.578, 89.724, 126.3}},
};

static void the_authors_table(void **state) {
    (void)state;
    static const double radius[] = {1, 5, 14};
    for (size_t i = 0; i < sizeof gratings / sizeof *gratings; i++)
        for (int k = 0; k < 6; k++)
            assert_near(wf_sensitivity(0.5 * (1 << k), gratings[i].hz, gratings[i].cd_m2,
                                       gratings[i].area_degree2),
                        gratings[i].sensitivity[k], 0.002, "a grating");
    for (size_t i = 0; i < sizeof disks / sizeof *disks; i++)
        for (int k = 0; k < 3; k++)
            assert_near(wf_sensitivity_disk(disks[i].hz, disks[i].cd_m2, radius[k]),
                        disks[i].sensitivity[k], 0.002, "a disk");
}

/* Foveal thresholds of flickering gratings from 20 to 33 Hz as three laboratories measured
 * them: log10 of the contrast just seen, read off the papers' figures for castleCSF's set of
 * data. They differ from each other by up to three times, so that a single one says little. */
static const struct {
    double cd_m2, cycles_degree, hz, area_degree2, log_contrast;
} measured[] = {
    /* Robson, JOSA 56(8), 1966 */
    {20, 0.5, 22.63, 6.25, -1.254},
    {20, 0.7071, 22.63, 6.25, -1.247},
    {20, 1, 22.63, 6.25, -1.240},
    {20, 1.414, 22.63, 6.25, -1.233},
    {20, 2, 22.63, 6.25, -1.191},
    {20, 2.828, 22.63, 6.25, -1.137},
    {20, 4, 22.63, 6.25, -1.086},
    {20, 5.657, 22.63, 6.25, -0.946},
    {20, 8, 22.63, 6.25, -0.761},
    {20, 11.31, 22.63, 6.25, -0.595},
    {20, 0.5, 22.63, 6.25, -1.268},
    {20, 0.5, 32, 6.25, -0.586},
    {20, 4, 22.63, 6.25, -1.143},
    {20, 4, 32, 6.25, -0.484},
    {20, 16, 22.63, 6.25, -0.397},
    /* Snowden, Hess and Waugh, Vision Research 35(6), 1995 */
    {2.89, 0.1, 24.25, 8.03, -1.048},
    {2.89, 0.1, 27.86, 8.03, -0.804},
    {2.89, 0.1, 29.86, 8.03, -0.596},
    {2.89, 0.25, 22.63, 8.03, -0.994},
    {2.89, 0.25, 29.86, 8.03, -0.600},
    {2.89, 1, 24.25, 8.03, -0.987},
    {2.89, 4, 25.99, 8.03, -0.438},
    {3.85, 0.1, 24.25, 8.03, -0.996},
    {3.85, 0.1, 27.86, 8.03, -0.857},
    {3.85, 0.1, 29.86, 8.03, -0.500},
    {3.85, 0.25, 22.63, 8.03, -1.108},
    {3.85, 0.25, 29.86, 8.03, -0.447},
    {3.85, 1, 24.25, 8.03, -0.751},
    {3.85, 5, 24.25, 8.03, -0.282},
    {78, 20, 22.63, 0.5022, -0.654},
    {78, 20, 29.86, 0.5022, -0.294},
    {108, 10, 24.25, 2.009, -0.902},
    {147, 10, 24.25, 2.009, -0.958},
    {170, 0.1, 24.25, 8.03, -1.752},
    {170, 0.25, 24.25, 8.03, -1.846},
    {170, 1, 24.25, 8.03, -1.961},
    {170, 4, 25.99, 8.03, -1.645},
    {236, 0.1, 25.99, 8.03, -1.604},
    {236, 0.25, 24.25, 8.03, -1.752},
    {236, 1, 24.25, 8.03, -1.643},
    /* Laird, Rosen, Pelz, Montag and Daly, Human Vision and Electronic Imaging XI, 2006 */
    {60, 4, 20, 4.753, -1.510},
    {60, 4, 30, 4.753, -1.040},
    {60, 8, 20, 4.753, -1.040},
    {60, 8, 30, 4.753, -0.820},
    {60, 16, 20, 4.753, -0.280},
};

static void measured_thresholds(void **state) {
    (void)state;
    const size_t count = sizeof measured / sizeof *measured;
    double sum = 0, squares = 0;
    for (size_t i = 0; i < count; i++) {
        double model = wf_sensitivity(measured[i].cycles_degree, measured[i].hz,
                                      measured[i].cd_m2, measured[i].area_degree2);
        double off = log10(model) + measured[i].log_contrast;
        sum += off;
        squares += off * off;
    }
    double mean = pow(10, sum / (double)count), rms = 20 * sqrt(squares / (double)count);
    print_message("%zu thresholds: geometric mean of the ratio %.3f, RMS %.2f dB\n", count,
                  mean, rms);
    assert_near(mean, 1, 0.1, "the mean ratio");
    assert_true(rms < 3.5);
}

/* ---- The bank ---- */

static const wf_viewing sd = {6, 100, 30000 / 1001.0, 720, 486, 10 / 11.0};

static void the_bank_has_the_sensitivity(void **state) {
    (void)state;
    static const double hz[] = {25, 30000 / 1001.0, 12.5, 15000 / 1001.0};
    static wf_eye eye;
    for (int i = 0; i < 4; i++) {
        wf_viewing v = sd;
        double worst = 0, area;
        v.hz = hz[i];
        wf_eye_init(&eye, &v);
        area =
            4 * atan(0.5 / 6) * atan(0.5 / 6 * 720 / 486 * 10 / 11) * 180 / M_PI * 180 / M_PI;
        for (double l = 0.3; l < 10000; l *= 1.3) {
            double whole = wf_sensitivity_disk(v.hz, l, sqrt(area / M_PI));
            double bank = wf_eye_sensitivity(&eye, 0, l);
            if (i < 2) assert_near(bank, whole, 0.005, "the whole field");
            for (double f = 0.7; f < 32; f *= 1.1) {
                double wanted = wf_sensitivity(f, v.hz, l, area);
                if (wanted < 0.03 * bank) continue;
                worst = fmax(worst, fabs(wf_eye_sensitivity(&eye, f, l) / wanted - 1));
            }
        }
        print_message("%.4g Hz: the bank is within %.1f %%\n", v.hz, 100 * worst);
        assert_true(worst < (i < 2 ? 0.07 : 0.1));
    }
}

/* ---- Pictures ---- */

enum { WIDTH = 96, LINES = 480 };

static float real[LINES][WIDTH], other[LINES][WIDTH], mean[LINES][WIDTH], jnd[LINES][WIDTH];

/* 45 degrees of phase make that no pixel is at the top of it: the highest is looked for. */
static double highest(int margin) {
    double most = 0;
    for (int y = margin; y < LINES - margin; y++)
        for (int x = 0; x < WIDTH; x++) most = fmax(most, (double)jnd[y][x]);
    return most;
}

static wf_viewing small_viewing(double heights) {
    return (wf_viewing){heights, 100, 30, WIDTH, LINES, 1};
}

static void gratings_through_the_bank(void **state) {
    (void)state;
    static const double heights[] = {6, 3, 1.5};
    static wf_eye eye;
    for (int h = 0; h < 3; h++) {
        wf_viewing v = small_viewing(heights[h]);
        wf_seen *seen = wf_seen_new(&v, 1, 1);
        wf_eye_init(&eye, &v);
        assert_non_null(seen);
        for (double f = 0; f < 0.3; f += 0.04) { /* cycles a line */
            double contrast = 0.02, light = 0.4;
            for (int y = 0; y < LINES; y++)
                for (int x = 0; x < WIDTH; x++) {
                    mean[y][x] = (float)light;
                    real[y][x] =
                        (float)(light * contrast * cos(2 * M_PI * f * (y - LINES / 2)));
                }
            wf_seen_jnd(seen, real[0], NULL, mean[0], jnd[0]);
            double degree = wf_viewing_lines_degree(&v);
            double wanted = contrast * wf_eye_sensitivity(&eye, f * degree, 100 * light);
            assert_near(highest(LINES / 4), wanted, 0.002, "a grating through the bank");
            /* Both parts of a modulation: its amplitude. */
            wf_seen_jnd(seen, real[0], real[0], mean[0], jnd[0]);
            assert_near(highest(LINES / 4), sqrt(2) * wanted, 0.002, "both parts");
        }
        wf_seen_free(seen);
    }
}

static double uniform(uint32_t *seed) {
    uint32_t v = *seed += 0x9e3779b9u;
    v = (v ^ v >> 16) * 0x21f0aaadu;
    v = (v ^ v >> 15) * 0x735a2d97u;
    return (v ^ v >> 15) / 4294967296.0;
}

static int mirrored(int at, int count) {
    while (at < 0 || at >= count) at = at < 0 ? -at : 2 * (count - 1) - at;
    return at;
}

/* A picture through a Gaussian, in double and far out. */
static double through(const float (*picture)[WIDTH], double deviation, int x0, int y0) {
    int reach = (int)(7 * deviation) + 2;
    double sum = 0, all = 0;
    for (int y = y0 - reach; y <= y0 + reach; y++)
        for (int x = x0 - reach; x <= x0 + reach; x++) {
            int line = mirrored(y, LINES), column = mirrored(x, WIDTH);
            double r2 = (x - x0) * (x - x0) + (y - y0) * (y - y0);
            double w = exp(-0.5 * r2 / (deviation * deviation));
            sum += w * (double)picture[line][column];
            all += w;
        }
    return sum / all;
}

/* The definition, in double. */
static double plainly(const wf_viewing *v, const wf_eye *eye, int x, int y) {
    double degree = wf_viewing_lines_degree(v), sum = 0;
    double local = through(mean, 0.5 * degree, x, y), quarters = 4 * 100 * local * 128;
    int octave = (int)floor(log2(quarters / 4)), knot;
    double at = 4 * octave + quarters / exp2(octave) - 4;
    knot = (int)at;
    for (int k = 0; k < WF_EYE_BANDS; k++) {
        double a = (double)eye->weight[knot][k], b = (double)eye->weight[knot + 1][k];
        double part = through(real, degree / (2 * M_PI * wf_eye_width[k]), x, y);
        sum += (a + (at - knot) * (b - a)) * part;
    }
    return fabs(sum) / local;
}

static void noise_against_the_definition(void **state) {
    (void)state;
    static wf_eye eye;
    uint32_t seed = 5;
    wf_viewing v = small_viewing(12);
    wf_seen *seen = wf_seen_new(&v, 1, 1);
    wf_eye_init(&eye, &v);
    assert_non_null(seen);
    for (int y = 0; y < LINES; y++)
        for (int x = 0; x < WIDTH; x++) {
            mean[y][x] = (float)(0.05 + uniform(&seed) * (x < WIDTH / 2 ? 0.02 : 0.9));
            real[y][x] = (float)((uniform(&seed) - 0.5) * 0.1 * (double)mean[y][x]);
        }
    wf_seen_jnd(seen, real[0], NULL, mean[0], jnd[0]);
    /* Bands of less than a sample are not Gaussians of samples, so that noise, which has all
     * frequencies, comes out a little otherwise. */
    double most = highest(0);
    for (int i = 0; i < 40; i++) {
        int x = (int)(uniform(&seed) * WIDTH), y = (int)(uniform(&seed) * LINES);
        double wanted = plainly(&v, &eye, x, y);
        if (fabs((double)jnd[y][x] - wanted) > 0.02 * most)
            fail_msg("at %d, %d: %g and not %g", x, y, (double)jnd[y][x], wanted);
    }
    wf_seen_free(seen);
}

/* What is left out, where there is nothing, and pieces that several workers take in any order,
 * are the same in every bit as a picture that has something everywhere: 1e-30 of white, which
 * is far below the last bit of what is seen. */
static void pieces_of_sparse_pictures(void **state) {
    (void)state;
    static float pieces[LINES][WIDTH];
    uint32_t seed = 7;
    wf_viewing v = small_viewing(3);
    wf_seen *all = wf_seen_new(&v, 1, 1), *some = wf_seen_new(&v, 3, 4);
    assert_true(all && some);
    for (int kind = 0; kind < 4; kind++) {
        for (int y = 0; y < LINES; y++)
            for (int x = 0; x < WIDTH; x++) {
                bool there = kind < 2 ? uniform(&seed) < 0.001 : x + y < 9;
                mean[y][x] = (float)(0.05 + 0.9 * uniform(&seed));
                real[y][x] = there ? 0.1f : 0;
                other[y][x] = real[y][x] + 1e-30f;
            }
        const float *turn = kind % 2 ? real[0] : NULL, *turns = kind % 2 ? other[0] : NULL;
        wf_seen_jnd(all, other[0], turns, mean[0], jnd[0]);
        wf_seen_begin(some, real[0], turn, mean[0], pieces[0]);
        for (int n = wf_seen_preparations(some) - 1; n >= 0; n--)
            wf_seen_prepare(some, n % 4, n);
        for (int n = wf_seen_tiles(some) - 1; n >= 0; n--) wf_seen_tile(some, (n + 1) % 4, n);
        for (int y = 0; y < LINES; y += 3)
            for (int x = 0; x < WIDTH; x++)
                if (fabs((double)jnd[y][x] - (double)pieces[y / 3][x]) > 1e-25)
                    fail_msg("kind %d at %d, %d: %g and not %g", kind, x, y,
                             (double)pieces[y / 3][x], (double)jnd[y][x]);
    }
    wf_seen_free(all);
    wf_seen_free(some);
}

/* Modulations of any sign that keep to the bound are not seen more than it allows. */
static void the_bound_holds(void **state) {
    (void)state;
    static float bound[LINES][WIDTH];
    uint32_t seed = 9;
    wf_viewing v = small_viewing(6);
    wf_seen *seen = wf_seen_new(&v, 1, 1);
    assert_non_null(seen);
    for (int kind = 0; kind < 4; kind++) {
        for (int y = 0; y < LINES; y++)
            for (int x = 0; x < WIDTH; x++) {
                double steps[] = {0.3, 0.1 + 0.8 * (y / 40 % 2), y / 7 % 2 ? 0.9 : 0.002,
                                  pow(uniform(&seed), 4)};
                mean[y][x] = (float)steps[kind];
            }
        wf_seen_bound(seen, mean[0], 1.5, bound[0]);
        for (int sign = 0; sign < 2; sign++) {
            for (int y = 0; y < LINES; y++)
                for (int x = 0; x < WIDTH; x++)
                    other[y][x] = sign && uniform(&seed) < 0.5 ? -bound[y][x] : bound[y][x];
            wf_seen_jnd(seen, other[0], NULL, mean[0], jnd[0]);
            double most = highest(0);
            print_message("kind %d, %s: %.3f of 1.5 JND\n", kind, sign ? "random" : "one sign",
                          most);
            assert_true(most <= 1.5 * 1.1);
            if (kind == 0 && !sign) assert_true(most > 1.499);
        }
    }
    wf_seen_free(seen);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_authors_table),
        cmocka_unit_test(measured_thresholds),
        cmocka_unit_test(the_bank_has_the_sensitivity),
        cmocka_unit_test(gratings_through_the_bank),
        cmocka_unit_test(noise_against_the_definition),
        cmocka_unit_test(pieces_of_sparse_pictures),
        cmocka_unit_test(the_bound_holds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
