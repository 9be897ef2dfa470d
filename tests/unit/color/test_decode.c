/* R'G'B' to light: every code of every depth against the standards' formulas in long double,
 * and back again within one code. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "color/line/line.h"
#include "color/space/builtin.h"
#include "color/space/decode.h"

/* ---- The standards' formulas ---- */

static long double bt1886(long double v) {
    return powl(v, 2.4L);
}

static long double srgb(long double v) {
    return v <= 0.04045L ? v / 12.92L : powl((v + 0.055L) / 1.055L, 2.4L);
}

static long double bt709(long double v) {
    return v < 0.081L ? v / 4.5L : powl((v + 0.099L) / 1.099L, 1 / 0.45L);
}

static long double bt2020(long double v) {
    const long double alpha = 1.09929682680944L, beta = 0.018053968510807L;
    return v < 4.5L * beta ? v / 4.5L : powl((v + alpha - 1) / alpha, 1 / 0.45L);
}

/* Rec. ITU-R BT.2100 table 4, and the tangent at 1.25 beyond it. */
static long double pq(long double v) {
    const long double m1 = 2610.0L / 16384, m2 = 2523.0L / 4096 * 128;
    const long double c1 = 3424.0L / 4096, c2 = 2413.0L / 4096 * 32, c3 = 2392.0L / 4096 * 32;
    long double bent = fminl(v, 1.25L), t = powl(bent, 1 / m2);
    long double light = powl(fmaxl(t - c1, 0) / (c2 - c3 * t), 1 / m1);
    return (light + 143.168329691278899L * (v - bent)) * 10000 / 203;
}

/* Table 5, and 75 % for reference white. */
static long double hlg_scene(long double v) {
    const long double a = 0.17883277L, b = 1 - 4 * a, c = 0.5L - a * logl(4 * a);
    return v <= 0.5L ? v * v / 3 : (expl((v - c) / a) + b) / 12;
}

static long double hlg(long double v) {
    return hlg_scene(v) / hlg_scene(0.75L);
}

typedef long double formula(long double signal);

static const struct {
    const char *space;
    formula *light;
} rows[] = {
    {"sRGB", srgb},
    {"rec709", bt1886},
    {"rec601-525", bt1886},
    {"rec601-625", bt1886},
    {"rec2020", bt1886},
    {"rec709-camera", bt709},
    {"rec2020-camera", bt2020},
    {"rec2100-pq", pq},
    {"rec2100-hlg", hlg},
};
enum { ROWS = sizeof rows / sizeof *rows };

static long double expected(int row, long double v) {
    return v < 0 ? -rows[row].light(-v) : rows[row].light(v);
}

static const wf_curve *curve_of(int row) {
    char why[900];
    const wf_space *space = wf_space_find(rows[row].space, why, sizeof why);
    assert_non_null(space);
    return space->curve;
}

/* ---- All codes ---- */

enum { CODES = 1 << 16 };

/* Code of n bits to its signal: full range, or narrow with all that is above and below. */
static double signal_of(int code, int bits, bool full) {
    double step = exp2(bits - 8);
    return full ? code / (exp2(bits) - 1) : (code - 16 * step) / (219 * step);
}

/* The constants of BT.709's OETF have four digits, and no light has a signal in the gap that
 * they leave at its toe. */
static double gap(int row) {
    return rows[row].light == bt709 ? 2.5e-4 : 0;
}

static double worst; /* share of full scale */

static void check_codes(size_t level, int row, int bits, bool full) {
    static float signal[CODES], light[CODES];
    const wf_curve *curve = curve_of(row);
    size_t count = (size_t)1 << bits;
    for (size_t i = 0; i < count; i++) signal[i] = (float)signal_of((int)i, bits, full);
    memcpy(light, signal, sizeof light);
    wf_line_ops_at(level)->decode[curve->kind](curve, light, count);
    long double scale = fmaxl(1, rows[row].light(1)); /* light at full scale */
    for (size_t i = 0; i < count; i++) {
        long double want = expected(row, signal_of((int)i, bits, full));
        long double error = fabsl((long double)light[i] - want) / fmaxl(scale, fabsl(want));
        worst = fmax(worst, (double)error);
        if (!(error <= 1e-6L))
            fail_msg("%s: code %zu of %d bits is %.9Lg, not %.9g", rows[row].space, i, bits,
                     want, (double)light[i]);
    }
    wf_line_ops_at(level)->curve[curve->kind](curve, light, count);
    double step = full ? exp2(bits) - 1 : 219 * exp2(bits - 8);
    for (size_t i = 0; i < count; i++) {
        double back = (double)light[i] * step + (full ? 0 : 16 * exp2(bits - 8));
        if (fabs(back - (double)i) > 0.5 + gap(row) * step)
            fail_msg("%s: code %zu of %d bits comes back as %g", rows[row].space, i, bits,
                     back);
    }
}

static void all_codes(void **state) {
    (void)state;
    for (int row = 0; row < ROWS; row++) {
        worst = 0;
        for (int bits = 8; bits <= 16; bits++)
            for (int full = 0; full < 2; full++)
                check_codes(wf_isa_levels() - 1, row, bits, full);
        print_message("%-14s %.2g of full scale\n", rows[row].space, worst);
    }
    for (size_t level = 0; level < wf_isa_levels(); level++)
        for (int row = 0; row < ROWS; row++) check_codes(level, row, 10, false);
}

/* R'G'B' of narrow Y'CbCr: far beyond both ends, and back within a fifth of a 16-bit code. */
static void out_of_gamut_comes_back(void **state) {
    (void)state;
    enum { COUNT = 8192 };
    static float signal[COUNT], light[COUNT];
    for (int row = 0; row < ROWS; row++) {
        const wf_curve *curve = curve_of(row);
        for (int i = 0; i < COUNT; i++) signal[i] = light[i] = (float)(-1.2 + 3.4 * i / COUNT);
        wf_line_ops_best()->decode[curve->kind](curve, light, COUNT);
        for (int i = 0; i < COUNT; i++)
            assert_true(isfinite(light[i]) && (!i || light[i] >= light[i - 1]));
        wf_line_ops_best()->curve[curve->kind](curve, light, COUNT);
        for (int i = 0; i < COUNT; i++)
            if (fabs((double)light[i] - (double)signal[i]) > 3e-6 + gap(row))
                fail_msg("%s: %.9g comes back as %.9g", rows[row].space, (double)signal[i],
                         (double)light[i]);
    }
}

static void what_is_no_signal(void **state) {
    (void)state;
    const float bad[] = {NAN, -NAN, INFINITY, -INFINITY, 3e38f, -3e38f, 1e-45f, -0.0f, 0};
    for (int row = 0; row < ROWS; row++)
        for (int i = 0; i < 9; i++) {
            const wf_curve *curve = curve_of(row);
            float x = bad[i];
            wf_line_ops_best()->decode[curve->kind](curve, &x, 1);
            assert_true(isfinite(x));
            if (i < 2 || i > 5) assert_true(fabsf(x) < 1e-30f);
        }
}

/* ---- Transforms ---- */

/* From one encoding to itself and to the light of its primaries. */
static void encoded_inputs(void **state) {
    (void)state;
    char why[900];
    for (int row = 0; row < ROWS; row++) {
        wf_transform t;
        float rgb[3] = {0.8f, -0.1f, 1.05f}, was[3] = {0.8f, -0.1f, 1.05f};
        assert_true(
            wf_builtin_transform(rows[row].space, rows[row].space, &t, why, sizeof why));
        t.apply(t.self, &rgb[0], &rgb[1], &rgb[2], 1);
        for (int c = 0; c < 3; c++) assert_true(fabsf(rgb[c] - was[c]) < 3e-6f);
        t.free(t.self);
    }
}

static void code_points(void **state) {
    (void)state;
    const struct {
        int code_point;
        const char *name;
    } known[] = {{1, "BT.1886"}, {4, "gamma 2.2"},  {5, "gamma 2.8"}, {6, "BT.1886"},
                 {8, "linear"},  {13, "sRGB"},      {14, "BT.1886"},  {15, "BT.1886"},
                 {16, "PQ"},     {17, "gamma 2.6"}, {18, "HLG"}};
    const int unknown[] = {-1, 0, 2, 3, 7, 9, 10, 19, 255, 1 << 30};
    wf_decoding d;
    char text[24];
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        assert_true(wf_decoding_of_code_point(known[i].code_point, &d));
        assert_string_equal(wf_decoding_name(&d, text), known[i].name);
    }
    for (size_t i = 0; i < sizeof unknown / sizeof *unknown; i++)
        assert_false(wf_decoding_of_code_point(unknown[i], &d));
    assert_ptr_equal(wf_chromaticities_of_code_point(9),
                     &wf_chromaticities_of[WF_PRIMARIES_2020]);
    assert_null(wf_chromaticities_of_code_point(2));
    assert_true(wf_chromaticities_usable(wf_chromaticities_of_code_point(10)));
}

/* A narrow-range signal of 10 bits, as samples of 0 to 1. */
static void scaled_samples(void **state) {
    (void)state;
    wf_decoding d = wf_decoding_of(&wf_curve_bt1886);
    d.scale = 1023 / 876.0f;
    d.offset = -64 / 876.0f;
    float r = 64 / 1023.0f, g = 940 / 1023.0f, b = 502 / 1023.0f;
    wf_transform t;
    assert_true(wf_decoding_transform(&d, &t));
    t.apply(t.self, &r, &g, &b, 1);
    t.free(t.self);
    assert_true(fabsf(r) < 1e-12f && fabsf(g - 1) < 1e-6f);
    assert_true(fabs((double)b - pow(0.5, 2.4)) < 1e-6);
}

/* ---- Primaries ---- */

static void any_primaries(void **state) {
    (void)state;
    const wf_chromaticities ap1 = {
        "", "", {0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}, {0.32168, 0.33767}};
    float rgb[3] = {0.8f, 0.1f, 0.1f}, named[3] = {0.8f, 0.1f, 0.1f};
    wf_transform t;
    char why[900];
    assert_int_equal(wf_primaries_like(&ap1), WF_PRIMARIES_AP1);
    const wf_space *rec709 = wf_space_find("lin_rec709", why, sizeof why);
    assert_true(wf_builtin_from_light(&ap1, rec709, &t));
    t.apply(t.self, &rgb[0], &rgb[1], &rgb[2], 1);
    t.free(t.self);
    assert_true(wf_builtin_transform("ACEScg", "lin_rec709", &t, why, sizeof why));
    t.apply(t.self, &named[0], &named[1], &named[2], 1);
    t.free(t.self);
    for (int c = 0; c < 3; c++) assert_true(fabsf(rgb[c] - named[c]) < 1e-6f);
}

static void unusable_primaries(void **state) {
    (void)state;
    wf_chromaticities c = wf_chromaticities_of[WF_PRIMARIES_709];
    assert_true(wf_chromaticities_usable(&c));
    c.white[1] = 0;
    assert_false(wf_chromaticities_usable(&c));
    c = wf_chromaticities_of[WF_PRIMARIES_709];
    memcpy(c.green, c.red, sizeof c.red);
    assert_false(wf_chromaticities_usable(&c));
    c.green[0] = NAN;
    assert_false(wf_chromaticities_usable(&c));
    assert_false(wf_chromaticities_usable(&(wf_chromaticities){.name = ""}));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_codes),         cmocka_unit_test(out_of_gamut_comes_back),
        cmocka_unit_test(what_is_no_signal), cmocka_unit_test(encoded_inputs),
        cmocka_unit_test(code_points),       cmocka_unit_test(scaled_samples),
        cmocka_unit_test(any_primaries),     cmocka_unit_test(unusable_primaries),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
