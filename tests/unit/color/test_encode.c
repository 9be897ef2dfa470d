/* Codes against the formulas in long double for every depth, range and matrix, their limits,
 * and what becomes of NaN. */
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "color/codes/encode.h"
#include "color/line/line.h"
#include "color/space/builtin.h"
#include "filters/base/half.h"

enum { HALVES = 0x7c00 };
static const int depths[] = {8, 10, 12, 16};
static const double weights[3][2] = {
    {0.299, 0.114}, {0.2126, 0.0722}, {0.2627, 0.0593}}; /* Kr, Kb */

static uint64_t random_bits(uint64_t *state) {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return *state;
}

static double random_unit(uint64_t *state) {
    return (double)(random_bits(state) >> 11) * 0x1p-53;
}

/* What the formulas give before rounding. */
static long double level_of(const wf_encoding *e, bool chroma, long double signal) {
    long double step = (long double)(1 << (e->bits - 8)),
                most = (long double)((1 << e->bits) - 1);
    if (e->full_range) return most * signal + (chroma ? (long double)(1 << (e->bits - 1)) : 0);
    return chroma ? step * (128 + 224 * signal) : step * (16 + 219 * signal);
}

static void limits_of(const wf_encoding *e, bool chroma, long *low, long *high) {
    long step = 1 << (e->bits - 8);
    *low = e->full_range ? 0 : step;
    *high = e->full_range ? (1 << e->bits) - 1 : 255 * step - 1;
    if (e->legalize == WF_LEGAL_CLIP && !e->full_range) {
        *low = 16 * step;
        *high = (chroma ? 240 : 235) * step;
    }
}

static long code_of(const wf_encoding *e, bool chroma, long double signal) {
    long low, high, code = lroundl(level_of(e, chroma, signal));
    limits_of(e, chroma, &low, &high);
    return code < low ? low : code > high ? high : code;
}

/* The encodings there are, but for chroma; NULL past the last. */
static bool encoding_at(int index, wf_encoding *e) {
    *e = (wf_encoding){.luma = (wf_luma)(index % 3),
                       .chroma = WF_CHROMA_444,
                       .legalize = index / 3 % 2 ? WF_LEGAL_CLIP : WF_LEGAL_NONE,
                       .full_range = index / 6 % 2,
                       .ycbcr = index / 12 % 2,
                       .bits = depths[index / 24 % 4]};
    return index < 96;
}

static void encode(const wf_encoding *e, float *r, float *g, float *b, uint16_t *code) {
    size_t width = (size_t)e->width_px, capacity = wf_encode_scratch(e);
    float *scratch = malloc((capacity + 1) * sizeof *scratch);
    assert_non_null(scratch);
    float *const rgb[3] = {r, g, b};
    uint16_t *const out[3] = {code, code + width, code + 2 * width};
    scratch[capacity] = 42;
    wf_encode_line(e, rgb, scratch, out);
    assert_true(scratch[capacity] == 42);
    free(scratch);
}

/* ---- Formulas ---- */

/* Neutral signals of every kind: luma and R'G'B' exactly as the formula has them at every
 * depth, chroma exactly in the middle. */
static void neutrals_are_exact(void **state) {
    (void)state;
    enum { COUNT = 20000 };
    static float signal[COUNT], rgb[3][COUNT];
    static uint16_t code[3 * COUNT];
    wf_encoding e;
    uint64_t seed = 7;
    for (int n = 0; n < COUNT; n++) signal[n] = (float)(random_unit(&seed) * 1.4 - 0.2);
    for (int i = 0; encoding_at(i, &e); i++) {
        e.width_px = COUNT;
        for (int c = 0; c < 3; c++) memcpy(rgb[c], signal, sizeof signal);
        encode(&e, rgb[0], rgb[1], rgb[2], code);
        for (int n = 0; n < COUNT; n++)
            for (int c = 0; c < 3; c++) {
                bool chroma = e.ycbcr && c;
                long double value = chroma ? 0 : (long double)signal[n];
                assert_int_equal(code[c * COUNT + n], code_of(&e, chroma, value));
            }
    }
}

/* Signals that lie on a code, a half from it, and next to both. */
static void halves_are_rounded_away_from_zero(void **state) {
    (void)state;
    wf_encoding e;
    for (int i = 0; encoding_at(i, &e); i++) {
        enum { MOST = 4 * 65536 };
        static float signal[MOST], copy[3][MOST];
        static uint16_t code[3 * MOST];
        int codes = 1 << e.bits, count = 0;
        for (int k = 0; k<codes; k += codes> 4096 ? 3 : 1) {
            double zero = e.full_range ? 0 : 16.0 * (codes / 256),
                   unit = e.full_range ? codes - 1 : 219.0 * (codes / 256);
            float at = (float)((k + 0.5 - zero) / unit);
            signal[count++] = nextafterf(at, -9);
            signal[count++] = at;
            signal[count++] = nextafterf(at, 9);
        }
        e.width_px = count;
        for (int c = 0; c < 3; c++) memcpy(copy[c], signal, (size_t)count * sizeof *signal);
        encode(&e, copy[0], copy[1], copy[2], code);
        for (int n = 0; n < count; n++)
            assert_int_equal(code[n], code_of(&e, false, (long double)signal[n]));
    }
}

/* Colors: within one code of the formula, and nearly always the same. */
static void colors_follow_the_formula(void **state) {
    (void)state;
    enum { COUNT = 20000 };
    static float in[3][COUNT], rgb[3][COUNT];
    static uint16_t code[3 * COUNT];
    uint64_t seed = 11;
    for (int n = 0; n < COUNT; n++)
        for (int c = 0; c < 3; c++) in[c][n] = (float)(random_unit(&seed) * 1.2 - 0.1);
    wf_encoding e;
    for (int i = 0; encoding_at(i, &e); i++) {
        if (!e.ycbcr) continue;
        e.width_px = COUNT;
        memcpy(rgb, in, sizeof in);
        encode(&e, rgb[0], rgb[1], rgb[2], code);
        long double kr = weights[e.luma][0], kb = weights[e.luma][1];
        int different = 0;
        for (int n = 0; n < COUNT; n++) {
            long double r = (long double)in[0][n], g = (long double)in[1][n],
                        b = (long double)in[2][n];
            long double y = kr * r + (1 - kr - kb) * g + kb * b;
            long double want[3] = {y, (b - y) / (2 * (1 - kb)), (r - y) / (2 * (1 - kr))};
            for (int c = 0; c < 3; c++) {
                long off = labs(code[c * COUNT + n] - code_of(&e, c > 0, want[c]));
                assert_true(off <= 1);
                different += off > 0;
            }
        }
        assert_true(different <= (e.bits == 16 ? 600 : 40));
    }
}

/* From light to code: 10-bit luma of neutrals, random and all that a half can be. */
static void neutral_light_to_luma(void **state) {
    (void)state;
    enum { COUNT = 1000000 };
    const char *spaces[] = {"rec601-525", "rec601-625", "rec709", "rec2020"};
    const wf_luma luma[] = {WF_LUMA_601, WF_LUMA_601, WF_LUMA_709, WF_LUMA_2020};
    float *light = malloc((COUNT + HALVES) * sizeof *light),
          *rgb = malloc(3 * (COUNT + HALVES) * sizeof *rgb);
    uint16_t *code = malloc(3 * (COUNT + HALVES) * sizeof *code);
    assert_true(light && rgb && code);
    uint64_t seed = 3;
    for (int i = 0; i < HALVES; i++) light[i] = wf_half_value((uint16_t)i);
    for (int i = 0; i < COUNT; i++) light[HALVES + i] = (float)random_unit(&seed);
    for (int s = 0; s < 4; s++) {
        wf_encoding e = {.luma = luma[s],
                         .chroma = WF_CHROMA_BT601,
                         .ycbcr = true,
                         .bits = 10,
                         .width_px = COUNT + HALVES};
        float *plane[3];
        char why[900];
        wf_transform t;
        if (!wf_builtin_transform("lin_rec709", spaces[s], &t, why, sizeof why))
            fail_msg("%s", why);
        for (int c = 0; c < 3; c++) {
            plane[c] = rgb + c * (COUNT + HALVES);
            memcpy(plane[c], light, (COUNT + HALVES) * sizeof *light);
        }
        t.apply(t.self, plane[0], plane[1], plane[2], COUNT + HALVES);
        t.free(t.self);
        encode(&e, plane[0], plane[1], plane[2], code);
        int different = 0;
        for (int i = 0; i < COUNT + HALVES; i++) {
            long double signal = powl((long double)light[i], 1 / 2.4L);
            long off = labs(code[i] - code_of(&e, false, signal));
            assert_true(off <= 1);
            different += off > 0;
        }
        print_message("%s: %d of %d lumas are not the formula's\n", spaces[s], different,
                      COUNT + HALVES);
        assert_true(different <= (COUNT + HALVES) / 1000);
        for (int i = 0; i < (COUNT + HALVES) / 2; i++)
            assert_true(code[COUNT + HALVES + i] == 512 &&
                        code[2 * (COUNT + HALVES) + i] == 512);
    }
    free(light);
    free(rgb);
    free(code);
}

/* ---- Limits ---- */

/* No input makes a reserved or an illegal code; NaN counts as 0. */
static void nothing_gets_past_the_limits(void **state) {
    (void)state;
    const float bad[] = {NAN,   -NAN, INFINITY, -INFINITY, FLT_MAX, -FLT_MAX,
                         1e30f, -5,   5,        0,         1,       0.5f};
    enum { BAD = sizeof bad / sizeof *bad, COUNT = BAD * BAD * BAD + 2 };
    static float rgb[3][COUNT];
    static uint16_t code[3 * COUNT];
    wf_encoding e;
    for (int i = 0; encoding_at(i, &e); i++)
        for (int chroma = WF_CHROMA_BT601; chroma <= WF_CHROMA_444; chroma++) {
            e.chroma = (wf_chroma)chroma;
            e.width_px = COUNT;
            for (int n = 0; n < COUNT; n++) {
                rgb[0][n] = bad[n % BAD];
                rgb[1][n] = bad[n / BAD % BAD];
                rgb[2][n] = bad[n / BAD / BAD % BAD];
            }
            encode(&e, rgb[0], rgb[1], rgb[2], code);
            bool halved = e.ycbcr && e.chroma != WF_CHROMA_444;
            for (int c = 0; c < 3; c++) {
                long low, high;
                limits_of(&e, e.ycbcr && c, &low, &high);
                for (int n = 0; n < (c && halved ? COUNT / 2 : COUNT); n++)
                    assert_true(code[c * COUNT + n] >= low && code[c * COUNT + n] <= high);
            }
        }
}

static void no_number_is_nought(void **state) {
    (void)state;
    wf_encoding e;
    for (int i = 0; encoding_at(i, &e); i++)
        for (int n = 1; n < 8; n++) {
            float rgb[2][3];
            uint16_t code[2][3];
            e.width_px = 1;
            for (int c = 0; c < 3; c++) {
                rgb[0][c] = n >> c & 1 ? NAN : 0.25f;
                rgb[1][c] = n >> c & 1 ? 0 : 0.25f;
            }
            for (int k = 0; k < 2; k++) encode(&e, &rgb[k][0], &rgb[k][1], &rgb[k][2], code[k]);
            assert_memory_equal(code[0], code[1], sizeof code[0]);
        }
}

static void codes_by_the_book(void **state) {
    (void)state;
    const struct {
        bool ycbcr, full;
        int bits;
        float rgb[3];
        uint16_t code[3];
    } cases[] = {
        {true, false, 10, {0, 0, 0}, {64, 512, 512}},
        {true, false, 10, {1, 1, 1}, {940, 512, 512}},
        {true, false, 8, {1, 1, 1}, {235, 128, 128}},
        {true, false, 10, {0, 0, 1}, {127, 960, 471}}, /* 100 % bars of BT.709: blue */
        {true, false, 10, {1, 0, 0}, {250, 409, 960}}, /* red */
        {true, false, 10, {1, 1, 0}, {877, 64, 553}},  /* yellow */
        {true, false, 10, {9, 9, 9}, {1019, 512, 512}},
        {true, false, 10, {-9, -9, -9}, {4, 512, 512}},
        {true, true, 10, {1, 1, 1}, {1023, 512, 512}},
        {true, true, 10, {0, 0, 1}, {74, 1023, 465}},
        {true, true, 8, {0, 0, 0}, {0, 128, 128}},
        {false, true, 10, {0, 0.5f, 1}, {0, 512, 1023}}, /* 511.5 goes up */
        {false, true, 16, {0, 1, 2}, {0, 65535, 65535}},
        {false, false, 10, {0, 1, 2}, {64, 940, 1019}},
        {false, false, 12, {-1, 0.5f, 1}, {16, 2008, 3760}},
    };
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        wf_encoding e = {.luma = WF_LUMA_709,
                         .chroma = WF_CHROMA_444,
                         .ycbcr = cases[n].ycbcr,
                         .full_range = cases[n].full,
                         .bits = cases[n].bits,
                         .width_px = 1};
        float rgb[3];
        uint16_t code[3];
        memcpy(rgb, cases[n].rgb, sizeof rgb);
        encode(&e, &rgb[0], &rgb[1], &rgb[2], code);
        for (int c = 0; c < 3; c++)
            if (code[c] != cases[n].code[c])
                fail_msg("case %zu: %u, not %u", n, (unsigned)code[c],
                         (unsigned)cases[n].code[c]);
    }
}

/* With TPDF noise the mean of the codes is the signal, wherever it lies between two of them,
 * and their variance is a quarter (Lipshitz, Wannamaker and Vanderkooy 1992). A line has the
 * same noise in every frame, and every line and plane its own. */
static void dither_has_no_steps(void **state) {
    (void)state;
    enum { COUNT = 40000 };
    static float rgb[3][COUNT];
    static uint16_t code[3 * COUNT], again[3 * COUNT];
    wf_encoding e = {.chroma = WF_CHROMA_444,
                     .bits = 10,
                     .width_px = COUNT,
                     .dither = WF_DITHER_TPDF,
                     .line = 7};
    double worst = 0, ramp = 0;
    for (int step = 0; step < 20; step++) {
        double level = 400 + step / 20.0, mean = 0, square = 0;
        for (int c = 0; c < 3; c++)
            for (int n = 0; n < COUNT; n++) rgb[c][n] = (float)((level - 64) / 876);
        encode(&e, rgb[0], rgb[1], rgb[2], code);
        for (int n = 0; n < COUNT; n++)
            mean += code[n] - level, square += pow(code[n] - level, 2);
        mean /= COUNT, square /= COUNT;
        worst = fmax(worst, fabs(mean));
        ramp += mean / 20;
        assert_true(fabs(square - mean * mean - 0.25) < 0.01);
    }
    print_message("mean error %.4f of a code at most, %.4f over the ramp\n", worst, ramp);
    assert_true(worst < 0.02 && fabs(ramp) < 0.01);
    for (int c = 0; c < 3; c++)
        for (int n = 0; n < COUNT; n++) rgb[c][n] = (float)((400 + 19 / 20.0 - 64) / 876);
    encode(&e, rgb[0], rgb[1], rgb[2], again);
    assert_memory_equal(code, again, sizeof code);
    int alike = 0, planes_alike = 0;
    e.line = 8;
    for (int c = 0; c < 3; c++)
        for (int n = 0; n < COUNT; n++) rgb[c][n] = (float)((400.5 - 64) / 876);
    encode(&e, rgb[0], rgb[1], rgb[2], code);
    e.line = 9;
    for (int c = 0; c < 3; c++)
        for (int n = 0; n < COUNT; n++) rgb[c][n] = (float)((400.5 - 64) / 876);
    encode(&e, rgb[0], rgb[1], rgb[2], again);
    for (int n = 0; n < COUNT; n++) {
        alike += code[n] == again[n];
        planes_alike += code[n] == code[COUNT + n];
    }
    double expected = COUNT / 2.0; /* half way between two codes, they share the noise evenly */
    assert_true(fabs(alike - expected) < 600 && fabs(planes_alike - expected) < 600);
}

/* Dither keeps what is legal and what is reserved. */
static void dither_stays_within(void **state) {
    (void)state;
    enum { COUNT = 4000 };
    static float rgb[3][COUNT];
    static uint16_t code[3 * COUNT];
    for (int ends = 0; ends < 2; ends++) {
        wf_encoding e = {.chroma = WF_CHROMA_444,
                         .bits = 10,
                         .width_px = COUNT,
                         .legalize = WF_LEGAL_CLIP,
                         .dither = WF_DITHER_TPDF};
        for (int c = 0; c < 3; c++)
            for (int n = 0; n < COUNT; n++) rgb[c][n] = (float)ends;
        encode(&e, rgb[0], rgb[1], rgb[2], code);
        for (int n = 0; n < 3 * COUNT; n++) assert_true(code[n] >= 64 && code[n] <= 940);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(neutrals_are_exact),
        cmocka_unit_test(halves_are_rounded_away_from_zero),
        cmocka_unit_test(colors_follow_the_formula),
        cmocka_unit_test(neutral_light_to_luma),
        cmocka_unit_test(nothing_gets_past_the_limits),
        cmocka_unit_test(no_number_is_nought),
        cmocka_unit_test(codes_by_the_book),
        cmocka_unit_test(dither_has_no_steps),
        cmocka_unit_test(dither_stays_within),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
