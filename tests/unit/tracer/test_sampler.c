/* Samplers: every elementary interval holds its share, cells differ, the same seed gives the
 * same samples, and integrals converge as their theory says. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "tracer/sample/sampler.h"

#define MOST 1024

typedef struct drawn {
    float v[3][MOST];
} drawn;

static void draw(wf_sampler_kind kind, int count, uint64_t seed, wf_cell cell, drawn *d) {
    wf_sampler *s = wf_sampler_new(kind, count, seed);
    assert_non_null(s);
    wf_sampler_draw(s, cell, d->v[0], d->v[1], d->v[2]);
    wf_sampler_free(s);
}

static void within_the_cell(void **state) {
    (void)state;
    for (int kind = WF_SAMPLER_JITTER; kind <= WF_SAMPLER_GRID; kind++)
        for (int count = 1; count <= 70; count++) {
            drawn d;
            draw((wf_sampler_kind)kind, count, 5, (wf_cell){2, 3, 4, 0}, &d);
            for (int c = 0; c < 3; c++)
                for (int i = 0; i < count; i++) assert_true(d.v[c][i] >= 0 && d.v[c][i] < 1);
        }
}

/* Of 2^k samples one lies in each interval of length 2^-k of every axis, and one in each box of
 * a 2^a x 2^b grid with a + b = k of x and y: a (0, k, 2)-net. */
static void nets(void **state) {
    (void)state;
    for (int k = 0; k <= 8; k++)
        for (int set = 0; set < 4; set++) {
            drawn d;
            int count = 1 << k;
            draw(WF_SAMPLER_SOBOL, count, 9, (wf_cell){0, 17, 3, set}, &d);
            for (int c = 0; c < 3; c++) {
                uint8_t seen[MOST] = {0};
                for (int i = 0; i < count; i++) seen[(int)(d.v[c][i] * (float)count)]++;
                for (int i = 0; i < count; i++) assert_int_equal(seen[i], 1);
            }
            for (int a = 0; a <= k; a++) {
                uint8_t seen[MOST] = {0};
                int across = 1 << a, down = 1 << (k - a);
                for (int i = 0; i < count; i++)
                    seen[(int)(d.v[0][i] * (float)across) * down +
                         (int)(d.v[1][i] * (float)down)]++;
                for (int i = 0; i < count; i++) assert_int_equal(seen[i], 1);
            }
        }
}

static void strata(void **state) {
    (void)state;
    drawn d;
    uint8_t seen[64] = {0};
    draw(WF_SAMPLER_JITTER, 64, 1, (wf_cell){0, 0, 0, 0}, &d);
    for (int i = 0; i < 64; i++) seen[(int)(d.v[0][i] * 8) * 8 + (int)(d.v[1][i] * 8)]++;
    for (int i = 0; i < 64; i++) assert_int_equal(seen[i], 1);
    draw(WF_SAMPLER_GRID, 16, 1, (wf_cell){0, 0, 0, 0}, &d);
    for (int i = 0; i < 16; i++) {
        assert_true(d.v[0][i] == ((float)(i % 4) + 0.5f) / 4);
        assert_true(d.v[1][i] == ((float)(i / 4) + 0.5f) / 4);
    }
}

static void cells_and_seeds(void **state) {
    (void)state;
    static const wf_cell cells[] = {{0, 5, 7, 0}, {1, 5, 7, 0}, {0, 6, 7, 0},
                                    {0, 5, 8, 0}, {0, 7, 5, 0}, {0, 5, 7, 1}};
    drawn first, again, other;
    for (int kind = WF_SAMPLER_JITTER; kind <= WF_SAMPLER_SOBOL; kind++) {
        memset(&first, 0, sizeof first), memset(&again, 0, sizeof again);
        draw((wf_sampler_kind)kind, 16, 3, cells[0], &first);
        draw((wf_sampler_kind)kind, 16, 3, cells[0], &again);
        assert_memory_equal(&first, &again, sizeof first);
        for (size_t n = 1; n < sizeof cells / sizeof *cells; n++) {
            memset(&other, 0, sizeof other);
            draw((wf_sampler_kind)kind, 16, 3, cells[n], &other);
            for (int c = 0; c < 3; c++)
                assert_memory_not_equal(first.v[c], other.v[c], sizeof other.v[c]);
        }
        draw((wf_sampler_kind)kind, 16, 4, cells[0], &other);
        assert_memory_not_equal(first.v[0], other.v[0], sizeof other.v[0]);
    }
}

/* Root mean square error of a smooth integral over many cells. */
static double error_of(wf_sampler_kind kind, int count) {
    double sum = 0;
    const double truth = (M_E - 1) * sin(1) * (2.0 / M_PI);
    for (int cell = 0; cell < 200; cell++) {
        drawn d;
        double mean = 0;
        draw(kind, count, 11, (wf_cell){cell, 1, 2, 0}, &d);
        for (int i = 0; i < count; i++)
            mean += exp((double)d.v[0][i]) * cos((double)d.v[1][i]) *
                    sin(M_PI * (double)d.v[2][i]) / count;
        sum += (mean - truth) * (mean - truth);
    }
    return sqrt(sum / 200);
}

/* Scrambled nets: -3/2 for smooth functions (Owen 1997). Strata of two axes of three: a little
 * better than chance. */
static void convergence(void **state) {
    (void)state;
    double sobol = log2(error_of(WF_SAMPLER_SOBOL, 16) / error_of(WF_SAMPLER_SOBOL, 1024)) / 6;
    double jitter =
        log2(error_of(WF_SAMPLER_JITTER, 16) / error_of(WF_SAMPLER_JITTER, 1024)) / 6;
    print_message("slopes: sobol %.2f, jitter %.2f\n", -sobol, -jitter);
    assert_true(sobol > 1.15);
    assert_true(jitter > 0.38);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(within_the_cell), cmocka_unit_test(nets),
        cmocka_unit_test(strata),          cmocka_unit_test(cells_and_seeds),
        cmocka_unit_test(convergence),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
