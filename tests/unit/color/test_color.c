/* Spaces and curves: published matrices, closed forms in double over all that a half can hold.
 */
#include <float.h>
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
#include "color/space/space.h"
#include "filters/base/half.h"

enum { HALVES = 0x7c00 }; /* the finite ones that are not negative */

static uint64_t random_bits(uint64_t *state) {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return *state;
}

static double random_unit(uint64_t *state) {
    return (double)(random_bits(state) >> 11) * 0x1p-53;
}

/* ---- The standards' formulas ---- */

static double bt1886(double x) {
    return pow(x, 1 / 2.4);
}

static double bt709(double x) {
    return x < 0.018 ? 4.5 * x : 1.099 * pow(x, 0.45) - 0.099;
}

static double bt2020(double x) {
    const double alpha = 1.09929682680944, beta = 0.018053968510807;
    return x < beta ? 4.5 * x : alpha * pow(x, 0.45) - (alpha - 1);
}

static double pq(double x) {
    const double m1 = 2610.0 / 16384, m2 = 2523.0 / 4096 * 128;
    const double c1 = 3424.0 / 4096, c2 = 2413.0 / 4096 * 32, c3 = 2392.0 / 4096 * 32;
    const double line = 12.86680405825513; /* of 10000 cd/m2: a signal of 1.25, and its slope */
    if (203 * x / 10000 > line) return 1.25 + (203 * x / 10000 - line) / 143.168329691278899;
    double t = pow(203 * x / 10000, m1);
    return pow((c1 + c2 * t) / (1 + c3 * t), m2);
}

static double hlg(double x) {
    const double a = 0.17883277, b = 1 - 4 * a, c = 0.5 - a * log(4 * a);
    double e = x * (exp((0.75 - c) / a) + b) / 12;
    return e <= 1.0 / 12 ? sqrt(3 * e) : a * log(12 * e - b) + c;
}

static double srgb(double x) {
    return x < 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055;
}

typedef double formula(double light);

/* What is negative gives the negative of what its magnitude gives. */
static double odd(formula *curve, double x) {
    return x < 0 ? -curve(-x) : curve(x);
}

static const struct {
    const char *name;
    formula *curve;
    wf_primaries primaries;
} outputs[] = {
    {"rec601-525", bt1886, WF_PRIMARIES_SMPTE_C},
    {"rec601-625", bt1886, WF_PRIMARIES_EBU},
    {"rec709", bt1886, WF_PRIMARIES_709},
    {"rec2020", bt1886, WF_PRIMARIES_2020},
    {"rec601-525-camera", bt709, WF_PRIMARIES_SMPTE_C},
    {"rec601-625-camera", bt709, WF_PRIMARIES_EBU},
    {"rec709-camera", bt709, WF_PRIMARIES_709},
    {"rec2020-camera", bt2020, WF_PRIMARIES_2020},
    {"rec2100-pq", pq, WF_PRIMARIES_2020},
    {"rec2100-hlg", hlg, WF_PRIMARIES_2020},
    {"sRGB", srgb, WF_PRIMARIES_709},
};
enum { OUTPUTS = sizeof outputs / sizeof *outputs };

static const struct {
    const char *name;
    wf_primaries primaries;
} inputs[] = {
    {"lin_rec709", WF_PRIMARIES_709}, {"ACEScg", WF_PRIMARIES_AP1},
    {"ACES2065-1", WF_PRIMARIES_AP0}, {"lin_rec2020", WF_PRIMARIES_2020},
    {"lin_p3d65", WF_PRIMARIES_P3},   {"lin_rec601-525", WF_PRIMARIES_SMPTE_C},
    {"lin_rec601-625", WF_PRIMARIES_EBU},
};
enum { INPUTS = sizeof inputs / sizeof *inputs };

static wf_transform transform_of(const char *from, const char *to) {
    wf_transform t;
    char why[900];
    if (!wf_builtin_transform(from, to, &t, why, sizeof why)) fail_msg("%s", why);
    return t;
}

/* ---- Names ---- */

static void shipped_names(void **state) {
    (void)state;
    size_t count = 0;
    for (int i = 0; i < INPUTS; i++, count++) {
        assert_string_equal(wf_space_at(count)->name, inputs[i].name);
        assert_null(wf_space_at(count)->curve);
    }
    for (int i = 0; i < OUTPUTS; i++, count++) {
        assert_string_equal(wf_space_at(count)->name, outputs[i].name);
        assert_non_null(wf_space_at(count)->curve);
    }
    assert_null(wf_space_at(count));
}

static void unknown_names(void **state) {
    (void)state;
    const struct {
        const char *from, *to, *says;
    } cases[] = {
        {"lin_rec790", "rec709", "did you mean lin_rec709?"},
        {"lin_rec709", "rec710", "did you mean rec709?"},
        {"acesgc", "rec709", "did you mean ACEScg?"},
        {"lin_rec709", "rec2020camera", "did you mean rec2020-camera?"},
        {"lin_rec709", "xyzzy", "\"xyzzy\"; there are lin_rec709, ACEScg,"},
        {"lin_rec709", "", "\"\"; there are lin_rec709"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        wf_transform t;
        char why[900];
        assert_false(wf_builtin_transform(cases[i].from, cases[i].to, &t, why, sizeof why));
        if (!strstr(why, cases[i].says)) fail_msg("%s", why);
        assert_non_null(strstr(why, "lin_p3d65"));
        assert_null(t.apply);
    }
    wf_transform t;
    char small[8], name[5000];
    memset(name, 'x', sizeof name - 1);
    name[sizeof name - 1] = '\0';
    assert_false(wf_builtin_transform(name, "rec709", &t, small, sizeof small));
    assert_true(strlen(small) < sizeof small);
}

static void names_in_any_case(void **state) {
    (void)state;
    const char *from[] = {"LIN_REC709", "acescg", "lin_srgb", "lin_AP1", "Lin_ap0"};
    for (int i = 0; i < 5; i++) {
        wf_transform t = transform_of(from[i], "Rec709");
        t.free(t.self);
    }
}

/* ---- Matrices ---- */

static void published_matrices(void **state) {
    (void)state;
    const struct {
        wf_primaries primaries;
        double tolerance, to_xyz[3][3];
    } cases[] = {
        {WF_PRIMARIES_709,
         6e-5, /* IEC 61966-2-1, four decimals */
         {{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}}},
        {WF_PRIMARIES_AP0,
         1e-12, /* OpenColorIO's ACES-AP0_to_CIE-XYZ-D65_BFD */
         {{0.9382798492772554, -0.004451445812361399, 0.01662752358677617},
          {0.3373688907878367, 0.7295215666902654, -0.06689045747810234},
          {0.001173950849685879, -0.003710706402052562, 1.091594506312247}}},
    };
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        double m[3][3];
        wf_rgb_to_xyz(cases[n].primaries, m);
        for (int i = 0; i < 9; i++)
            assert_true(fabs(m[i / 3][i % 3] - cases[n].to_xyz[i / 3][i % 3]) <=
                        cases[n].tolerance);
    }
}

/* The share of each primary in the luminance of white. */
static void published_luminances(void **state) {
    (void)state;
    const struct {
        wf_primaries primaries;
        double tolerance, y[3];
    } cases[] = {
        {WF_PRIMARIES_709, 6e-5, {0.2126, 0.7152, 0.0722}},  /* BT.709 item 3.2 */
        {WF_PRIMARIES_2020, 6e-5, {0.2627, 0.6780, 0.0593}}, /* BT.2020 table 4 */
        {WF_PRIMARIES_SMPTE_C,
         6e-4,
         {0.212, 0.701, 0.087}},                         /* SMPTE 240M, of the same primaries */
        {WF_PRIMARIES_EBU, 6e-4, {0.222, 0.707, 0.071}}, /* EBU Tech. 3213 */
        {WF_PRIMARIES_P3, 6e-4, {0.229, 0.692, 0.079}},  /* Display P3 */
    };
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        double m[3][3];
        wf_rgb_to_xyz(cases[n].primaries, m);
        for (int j = 0; j < 3; j++)
            assert_true(fabs(m[1][j] - cases[n].y[j]) <= cases[n].tolerance);
    }
}

/* OpenColorIO's ACES-AP1_to_LINEAR-REC709_BFD, and BT.2087's 709 to 2020 with its four digits.
 */
static void published_conversions(void **state) {
    (void)state;
    const double from_ap1[3][3] = {
        {1.705050992657983, -0.6217921206570055, -0.08325887200097848},
        {-0.1302564175070438, 1.140804736575402, -0.01054831906835806},
        {-0.02400335680461801, -0.1289689760649706, 1.152972332869589}};
    const double to_2020[3][3] = {
        {0.6274, 0.3293, 0.0433}, {0.0691, 0.9195, 0.0114}, {0.0164, 0.0880, 0.8956}};
    double m[3][3];
    wf_rgb_to_rgb(WF_PRIMARIES_AP1, WF_PRIMARIES_709, m);
    for (int i = 0; i < 9; i++)
        assert_true(fabs(m[i / 3][i % 3] - from_ap1[i / 3][i % 3]) < 1e-12);
    wf_rgb_to_rgb(WF_PRIMARIES_709, WF_PRIMARIES_2020, m);
    for (int i = 0; i < 9; i++)
        assert_true(fabs(m[i / 3][i % 3] - to_2020[i / 3][i % 3]) < 6e-5);
}

static void matrices_keep_white_and_come_back(void **state) {
    (void)state;
    for (int a = 0; a < WF_PRIMARIES_COUNT; a++)
        for (int b = 0; b < WF_PRIMARIES_COUNT; b++) {
            double there[3][3], back[3][3];
            wf_rgb_to_rgb((wf_primaries)a, (wf_primaries)b, there);
            wf_rgb_to_rgb((wf_primaries)b, (wf_primaries)a, back);
            for (int i = 0; i < 3; i++) {
                assert_true(fabs(there[i][0] + there[i][1] + there[i][2] - 1) < 1e-14);
                for (int j = 0; j < 3; j++) {
                    double product = 0;
                    for (int k = 0; k < 3; k++) product += there[i][k] * back[k][j];
                    assert_true(fabs(product - (i == j)) < 1e-13);
                }
            }
        }
}

/* ---- Curves ---- */

/* A share of the signal; near PQ's black, where a tenth of the signal is a millionth of the
 * light, a share of 5 %. */
static double allowed(int output, double want) {
    return 2e-6 * (outputs[output].curve == pq ? fmax(want, 0.05) : want);
}

static const wf_curve *curve_of(int output) {
    for (size_t i = 0; wf_space_at(i); i++)
        if (!strcmp(wf_space_at(i)->name, outputs[output].name)) return wf_space_at(i)->curve;
    fail();
    return NULL;
}

static double worst_share; /* of what is allowed */

static void check_curve(size_t level, int output, const float *light, float *signal,
                        size_t count) {
    const wf_curve *curve = curve_of(output);
    memcpy(signal, light, count * sizeof *signal);
    wf_line_ops_at(level)->curve[curve->kind](curve, signal, count);
    for (size_t i = 0; i < count; i++) {
        double want = outputs[output].curve((double)light[i]),
               error = fabs((double)signal[i] - want);
        worst_share = fmax(worst_share, want > 0 ? error / allowed(output, want) : 0);
        if (!(error <= allowed(output, want)))
            fail_msg("%s, %s: %.9g gives %.9g, not %.9g", outputs[output].name,
                     wf_isa_name(level), (double)light[i], (double)signal[i], want);
    }
}

static void curves_of_all_halves(void **state) {
    (void)state;
    static float light[HALVES], signal[HALVES];
    for (int i = 0; i < HALVES; i++) light[i] = wf_half_value((uint16_t)i);
    for (size_t level = 0; level < wf_isa_levels(); level++)
        for (int o = 0; o < OUTPUTS; o++) {
            worst_share = 0;
            check_curve(level, o, light, signal, HALVES);
            if (!level)
                print_message("%-18s error %.2f of what is allowed\n", outputs[o].name,
                              worst_share);
            for (int i = 1; i < HALVES; i++)
                if (!(signal[i] > signal[i - 1]))
                    fail_msg("%s: not monotonic at %g", outputs[o].name, (double)light[i]);
        }
}

static void curves_of_random_light(void **state) {
    (void)state;
    enum { COUNT = 1 << 20 };
    float *light = malloc(COUNT * sizeof *light), *signal = malloc(COUNT * sizeof *signal);
    assert_non_null(light);
    assert_non_null(signal);
    uint64_t seed = 12345;
    for (int i = 0; i < COUNT; i++)
        light[i] = (float)(i % 2 ? random_unit(&seed) : exp2(-40 + 55.99 * random_unit(&seed)));
    for (int o = 0; o < OUTPUTS; o++) check_curve(wf_isa_levels() - 1, o, light, signal, COUNT);
    free(light);
    free(signal);
}

static float through(const wf_line_ops *ops, int output, float x) {
    const wf_curve *curve = curve_of(output);
    ops->curve[curve->kind](curve, &x, 1);
    return x;
}

static void what_is_not_light(void **state) {
    (void)state;
    const wf_line_ops *ops;
    for (size_t level = 0; (ops = wf_line_ops_at(level)); level++)
        for (int o = 0; o < OUTPUTS; o++) {
            float zero = through(ops, o, 0), most = through(ops, o, 65504);
            assert_true(fabs((double)zero) < 1e-6);
            assert_true(most > 1 && most < 1024);
            const float none[] = {NAN, -NAN, -0.0f};
            const float too_much[] = {INFINITY, FLT_MAX, 65505, 1e30f};
            const float any[] = {1e-30f, 1e-6f, 0.01f, 0.18f, 1, 2, 300};
            for (int i = 0; i < 3; i++) assert_true(through(ops, o, none[i]) == zero);
            for (int i = 0; i < 4; i++) {
                assert_true(through(ops, o, too_much[i]) == most);
                assert_true(through(ops, o, -too_much[i]) == -most);
            }
            for (int i = 0; i < 7; i++)
                assert_true(through(ops, o, -any[i]) == -through(ops, o, any[i]));
            assert_true(fabs((double)(through(ops, o, 1e-40f) - zero)) < 1e-6);
            assert_true(fabs((double)(through(ops, o, FLT_MIN) - zero)) < 1e-6);
        }
}

static void signals_by_the_book(void **state) {
    (void)state;
    const struct {
        const char *space;
        double light, signal;
    } cases[] = {
        {"rec709", 0.18, 0.489},         {"rec709-camera", 0.18, 0.409},
        {"rec2020-camera", 0.18, 0.409}, {"rec601-525", 0.18, 0.489},
        {"rec2100-pq", 1, 0.5807},       {"rec2100-hlg", 1, 0.75},
        {"rec2100-hlg", 0.18, 0.38},     {"rec2100-pq", 10000.0 / 203, 1},
    };
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        float rgb[3] = {(float)cases[n].light, (float)cases[n].light, (float)cases[n].light};
        wf_transform t = transform_of("lin_rec709", cases[n].space);
        t.apply(t.self, &rgb[0], &rgb[1], &rgb[2], 1);
        t.free(t.self);
        double tolerance = cases[n].signal == 0.38 ? 5e-3 : 5e-4;
        if (cases[n].signal >= 0.5) tolerance = 5e-5;
        assert_true(fabs((double)rgb[0] - cases[n].signal) < tolerance);
        assert_true(rgb[0] == rgb[1] && rgb[1] == rgb[2]);
    }
}

/* ---- Transforms ---- */

enum { PIXELS = 4099 };

/* Colors from 2^-20 to 2^13, some of them outside of every gamut, some neutral. */
static void random_colors(float rgb[3][PIXELS], uint64_t seed) {
    for (int i = 0; i < PIXELS; i++) {
        double level = i % 3 ? random_unit(&seed) : exp2(-20 + 33 * random_unit(&seed));
        for (int c = 0; c < 3; c++) {
            double value = level * (i % 5 ? random_unit(&seed) * 1.1 - 0.1 : 1);
            rgb[c][i] = (float)(i % 7 ? value : fabs(value));
        }
    }
}

static double mixed(double m[3][3], float rgb[3][PIXELS], int c, int i) {
    return m[c][0] * (double)rgb[0][i] + m[c][1] * (double)rgb[1][i] +
           m[c][2] * (double)rgb[2][i];
}

/* Where positive and negative light cancel, the sum is exact to so much of its parts. */
static double tiny(double m[3][3], float rgb[3][PIXELS], int c, int i, double want) {
    double parts = 0;
    for (int k = 0; k < 3; k++) parts += fabs(m[c][k] * (double)rgb[k][i]);
    return fabs(want) < 1e-2 ? pow(1e-15 * parts, 1 / 2.4) : 0;
}

static void check_pair(int input, int output) {
    static float in[3][PIXELS], out[3][PIXELS];
    double m[3][3];
    random_colors(in, (uint64_t)(1 + input * 100 + output));
    memcpy(out, in, sizeof in);
    wf_transform t = transform_of(inputs[input].name, outputs[output].name);
    t.apply(t.self, out[0], out[1], out[2], PIXELS);
    t.free(t.self);
    wf_rgb_to_rgb(inputs[input].primaries, outputs[output].primaries, m);
    for (int i = 0; i < PIXELS; i++)
        for (int c = 0; c < 3; c++) {
            double want = odd(outputs[output].curve, mixed(m, in, c, i));
            double error = fabs((double)out[c][i] - want);
            if (!(error <= allowed(output, fabs(want)) + tiny(m, in, c, i, want)))
                fail_msg("%s to %s: %.9g, not %.9g", inputs[input].name, outputs[output].name,
                         (double)out[c][i], want);
        }
}

static void every_pair(void **state) {
    (void)state;
    for (int i = 0; i < INPUTS; i++)
        for (int o = 0; o < OUTPUTS; o++) check_pair(i, o);
}

/* Linear to linear keeps what is negative and what is large; there and back is the same again.
 */
static void linear_round_trips(void **state) {
    (void)state;
    static float in[3][PIXELS], out[3][PIXELS];
    random_colors(in, 99);
    for (int a = 0; a < INPUTS; a++)
        for (int b = 0; b < INPUTS; b++) {
            memcpy(out, in, sizeof in);
            wf_transform there = transform_of(inputs[a].name, inputs[b].name);
            wf_transform back = transform_of(inputs[b].name, inputs[a].name);
            there.apply(there.self, out[0], out[1], out[2], PIXELS);
            back.apply(back.self, out[0], out[1], out[2], PIXELS);
            for (int i = 0; i < PIXELS; i++) {
                float largest = fmaxf(fmaxf(fabsf(in[0][i]), fabsf(in[1][i])), fabsf(in[2][i]));
                for (int c = 0; c < 3; c++)
                    assert_true(fabsf(out[c][i] - in[c][i]) <= 1e-6f * largest);
            }
            there.free(there.self);
            back.free(back.self);
        }
}

static void neutrals_stay_neutral(void **state) {
    (void)state;
    static float rgb[3][HALVES];
    for (int a = 0; a < INPUTS; a++)
        for (int o = 0; o < OUTPUTS; o++) {
            for (int i = 0; i < HALVES; i++)
                rgb[0][i] = rgb[1][i] = rgb[2][i] = wf_half_value((uint16_t)i);
            wf_transform t = transform_of(inputs[a].name, outputs[o].name);
            t.apply(t.self, rgb[0], rgb[1], rgb[2], HALVES);
            t.free(t.self);
            assert_memory_equal(rgb[0], rgb[1], sizeof rgb[0]);
            assert_memory_equal(rgb[0], rgb[2], sizeof rgb[0]);
        }
}

/* One channel that is not a number must not take the others with it. */
static void damaged_channels(void **state) {
    (void)state;
    const float bad[] = {NAN, INFINITY, -INFINITY, FLT_MAX, -FLT_MAX};
    for (int a = 0; a < INPUTS; a++)
        for (int o = 0; o < OUTPUTS; o++) {
            wf_transform t = transform_of(inputs[a].name, outputs[o].name);
            for (int n = 0; n < 5 * 7; n++) {
                float rgb[3];
                for (int c = 0; c < 3; c++) rgb[c] = (n / 5 + 1) >> c & 1 ? bad[n % 5] : 0.5f;
                t.apply(t.self, &rgb[0], &rgb[1], &rgb[2], 1);
                for (int c = 0; c < 3; c++) assert_true(fabsf(rgb[c]) <= 1024);
            }
            float one[3] = {NAN, 0.5f, 0.5f}, same[3] = {0, 0.5f, 0.5f};
            t.apply(t.self, &one[0], &one[1], &one[2], 1);
            t.apply(t.self, &same[0], &same[1], &same[2], 1);
            assert_memory_equal(one, same, sizeof one);
            t.free(t.self);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shipped_names),
        cmocka_unit_test(unknown_names),
        cmocka_unit_test(names_in_any_case),
        cmocka_unit_test(published_matrices),
        cmocka_unit_test(published_luminances),
        cmocka_unit_test(published_conversions),
        cmocka_unit_test(matrices_keep_white_and_come_back),
        cmocka_unit_test(curves_of_all_halves),
        cmocka_unit_test(curves_of_random_light),
        cmocka_unit_test(what_is_not_light),
        cmocka_unit_test(signals_by_the_book),
        cmocka_unit_test(every_pair),
        cmocka_unit_test(linear_round_trips),
        cmocka_unit_test(neutrals_stay_neutral),
        cmocka_unit_test(damaged_channels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
