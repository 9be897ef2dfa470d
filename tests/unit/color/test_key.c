/* The laws of fill and key: closed forms of one channel, and a search over fills and keys that
 * shares no code with them. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <cmocka.h>

#include "color/codes/key_law.h"

enum { BACKGROUNDS = 2000 };

static double power(double v, double exponent) {
    return copysign(pow(fabs(v), exponent), v);
}

static double wanted(double light, double alpha, double v) {
    return power(light + (1 - alpha) * power(v, 2.4), 1 / 2.4);
}

/* The largest error of a fill and key over all backgrounds. */
static double worst_error(double light, double alpha, double fill, double key) {
    double worst = 0;
    for (int i = 0; i <= BACKGROUNDS; i++) {
        double v = (double)i / BACKGROUNDS;
        double error = fabs(fill + (1 - key) * v - wanted(light, alpha, v));
        if (error > worst) worst = error;
    }
    return worst;
}

/* Half the range of t(v) - m v: the error that the best fill of a key leaves. */
static double least_error(double light, double alpha, double key) {
    double low = 1e9, high = -1e9;
    for (int i = 0; i <= BACKGROUNDS; i++) {
        double v = (double)i / BACKGROUNDS, rest = wanted(light, alpha, v) - (1 - key) * v;
        low = fmin(low, rest);
        high = fmax(high, rest);
    }
    return (high - low) / 2;
}

static void lay(wf_key_law law, const double light[3], double alpha, double out[4]) {
    float pixel[4] = {0, 0, 0, (float)alpha};
    float *rgba[4] = {&pixel[0], &pixel[1], &pixel[2], &pixel[3]};
    for (int c = 0; c < 3; c++) pixel[c] = (float)power(light[c], 1 / 2.4);
    wf_key_line(law, rgba, 1);
    for (int c = 0; c < 4; c++) out[c] = (double)pixel[c];
}

/* In codes of 876: what is lost by each law, and by the best fill for K = alpha. */
static void errors_of_gray(void **state) {
    (void)state;
    static const struct {
        double light, alpha, by_light, by_fill, by_both;
    } rows[] = {{0.5, 0.5, 218, 109, 30}, {0.1, 0.1, 248, 124, 52}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        double a = rows[i].light, light[3] = {a, a, a}, out[4];
        lay(WF_KEY_LIGHT, light, rows[i].alpha, out);
        assert_true(out[3] == (double)(float)rows[i].alpha);
        assert_true(fabs(876 * worst_error(a, rows[i].alpha, out[0], out[3]) -
                         rows[i].by_light) <= 0.6);
        assert_true(
            fabs(876 * least_error(a, rows[i].alpha, rows[i].alpha) - rows[i].by_fill) <= 0.6);
        lay(WF_KEY_ENCODED, light, rows[i].alpha, out);
        assert_true(
            fabs(876 * worst_error(a, rows[i].alpha, out[0], out[3]) - rows[i].by_both) <= 0.6);
    }
}

/* One channel: K = 1 - m with m = t(1) - t(0). */
static void key_of_gray_in_closed_form(void **state) {
    (void)state;
    for (int i = 1; i < 200; i++) {
        double alpha = (i % 20) / 20.0, a = alpha * (i % 7) / 6, light[3] = {a, a, a}, out[4];
        if (a == 0) continue;
        lay(WF_KEY_ENCODED, light, alpha, out);
        double m = wanted(a, alpha, 1) - wanted(a, alpha, 0);
        assert_true(fabs(out[3] - (1 - m)) <= 1e-6);
    }
}

/* Colors, some brighter than white: no key does better, and the fill is the best of its key. */
static void no_key_does_better(void **state) {
    (void)state;
    uint32_t seed = 7;
    for (int i = 0; i < 60; i++) {
        double light[3], out[4], worst = 0, best = 1e9;
        seed = seed * 1664525u + 1013904223u;
        double alpha = (seed >> 8 & 255) / 256.0;
        for (int c = 0; c < 3; c++) {
            seed = seed * 1664525u + 1013904223u;
            light[c] = (seed >> 8 & 255) / 255.0 * (i % 5 == 0 ? 3 : alpha);
        }
        lay(WF_KEY_ENCODED, light, alpha, out);
        for (int c = 0; c < 3; c++)
            worst = fmax(worst, worst_error(light[c], alpha, out[c], out[3]));
        for (int k = 0; k <= 200; k++) {
            double of_key = 0;
            for (int c = 0; c < 3; c++)
                of_key = fmax(of_key, least_error(light[c], alpha, k / 200.0));
            best = fmin(best, of_key);
        }
        assert_true(worst <= best + 1e-5);
    }
}

/* Black, and what hides everything, are exact by either law; nothing stays nothing. */
static void exact_ones(void **state) {
    (void)state;
    static const double rows[][4] = {
        {0, 0, 0, 0.3}, {0, 0, 0, 0.9}, {0.2, 0.5, 4, 1}, {-0.01, 0.5, 0, 1}, {0, 0, 0, 0}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        double out[4];
        lay(WF_KEY_ENCODED, rows[i], rows[i][3], out);
        for (int c = 0; c < 3; c++)
            assert_true(worst_error(rows[i][c], rows[i][3], out[c], out[3]) <= 1e-6);
        assert_true(out[3] >= 0 && out[3] <= 1);
    }
}

static void straight_fills_are_counted(void **state) {
    (void)state;
    float r[4] = {0.25f, 0.75f, 0, 0.5f}, g[4] = {0.25f, 0, 0, 0.5f}, b[4] = {0, 0, 0.5f, 0.5f};
    float key[4] = {0.5f, 0.5f, 0, 1};
    assert_int_equal(wf_key_straighten((float *[]){r, g, b, key}, 4), 1);
    assert_true(r[0] == 0.5f && r[1] == 1 && r[2] == 0 && r[3] == 0.5f && b[2] == 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(errors_of_gray),
        cmocka_unit_test(key_of_gray_in_closed_form),
        cmocka_unit_test(no_key_does_better),
        cmocka_unit_test(exact_ones),
        cmocka_unit_test(straight_fills_are_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
