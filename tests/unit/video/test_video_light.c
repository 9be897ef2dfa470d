/* Light of video from its codes, held against the standards' formulas in float64, and chroma's
 * siting against waves that are known everywhere. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "color/codes/chroma.h"
#include "color/codes/upsample.h"
#include "convert/video/light.h"

enum { WIDTH = 64, LINES = 48, SAMPLES = WIDTH * LINES };

/* ---- Formulas ---- */

static double signal_of(int code, int bits, int full, int chroma) {
    double step = ldexp(1, bits - 8), most = ldexp(1, bits) - 1;
    if (full) return chroma ? (code - ldexp(1, bits - 1)) / most : code / most;
    return chroma ? (code - 128 * step) / (224 * step) : (code - 16 * step) / (219 * step);
}

static double decoded(int transfer, double v) {
    double x = fabs(v), light = x;
    if (transfer == 1) light = pow(x, 2.4);
    if (transfer == 16) {
        double t = pow(x, 32 / 2523.);
        light =
            pow(fmax(t - .8359375, 0) / (18.8515625 - 18.6875 * t), 16384 / 2610.) * 1e4 / 203;
    }
    if (transfer == 18) {
        const double a = 0.17883277, b = 1 - 4 * a, c = 0.5 - a * log(4 * a);
        light = x <= 0.5 ? x * x / 3 : (exp((x - c) / a) + b) / 12;
        light /= (exp((.75 - c) / a) + b) / 12;
    }
    if (transfer == 13) light = x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4);
    return v < 0 ? -light : light;
}

/* R, G, B of Rec. BT.709-6 item 3, solved for by Cramer's rule. */
static void rgb_of(double kr, double kb, const double ycc[3], double rgb[3]) {
    rgb[0] = ycc[0] + 2 * (1 - kr) * ycc[2];
    rgb[2] = ycc[0] + 2 * (1 - kb) * ycc[1];
    rgb[1] = (ycc[0] - kr * rgb[0] - kb * rgb[2]) / (1 - kr - kb);
}

/* ---- Every depth ---- */

static uint32_t draws = 1;

static int random_code(int bits) {
    draws = draws * 1664525u + 1013904223u;
    return (int)(draws >> (32 - bits));
}

static wf_light *make_light(wf_video_info *info, wf_meaning *meaning) {
    wf_light *light;
    assert_int_equal(wf_meaning_of(info, "x", meaning, NULL), WEFT_OK);
    assert_int_equal(wf_light_new(info, meaning, NULL, &light, NULL), WEFT_OK);
    return light;
}

static void check_depth(int bits, int full, int matrix, int transfer, int rgb) {
    static const double k[][2] = {
        [1] = {.2126, .0722}, [6] = {.299, .114}, [9] = {.2627, .0593}};
    wf_video_info info = {.width_px = WIDTH,
                          .lines = 1,
                          .layout = rgb ? WF_RGB : WF_YCBCR,
                          .bits = bits,
                          .full_range = full,
                          .planes = 3,
                          .across = 1,
                          .down = 1,
                          .tags = {matrix, transfer, matrix, true, WF_SITING_LEFT}};
    wf_meaning meaning;
    wf_light *light = make_light(&info, &meaning);
    uint16_t code[3][WIDTH];
    float out[3][WIDTH];
    double *scratch = malloc(wf_light_scratch(light)), worst = 0;
    for (int round = 0; round < 50; round++) {
        for (int p = 0; p < 3; p++)
            for (int x = 0; x < WIDTH; x++) code[p][x] = (uint16_t)random_code(bits);
        wf_light_row(light, (const uint16_t *[3]){code[0], code[1], code[2]}, 0, scratch,
                     (float *[3]){out[0], out[1], out[2]});
        for (int x = 0; x < WIDTH; x++) {
            double s[3], want[3];
            for (int p = 0; p < 3; p++) s[p] = signal_of(code[p][x], bits, full, !rgb && p);
            if (rgb)
                memcpy(want, s, sizeof want);
            else
                rgb_of(k[matrix][0], k[matrix][1], s, want);
            for (int c = 0; c < 3; c++) {
                double light_of = decoded(transfer, want[c]), size = fmax(1, fabs(light_of));
                if (transfer > 15 && fabs(want[c]) > 1.1) continue; /* no light is defined */
                worst = fmax(worst, fabs(out[c][x] - light_of) / size);
            }
        }
    }
    if (worst > 1e-6)
        fail_msg("%d bits, matrix %d, transfer %d: %g", bits, matrix, transfer, worst);
    free(scratch);
    wf_light_free(light);
}

static void every_depth(void **state) {
    (void)state;
    static const int matrices[] = {1, 6, 9}, transfers[] = {1, 13, 8, 16, 18};
    for (int bits = 8; bits <= 16; bits++)
        for (int full = 0; full < 2; full++)
            for (int m = 0; m < 3; m++)
                for (int t = 0; t < 5; t++) {
                    check_depth(bits, full, matrices[m], transfers[t], 0);
                    check_depth(bits, 1, matrices[m], transfers[t], 1);
                }
}

/* ---- Siting ---- */

/* A wave along an axis of `luma` samples, sampled where chroma lies, must be the same wave at
 * every luma sample. 0.12 cycles a chroma sample is within the half-band's passband. */
static void check_siting(int factor, int center, int luma) {
    wf_upsampler u;
    int count = (luma + factor - 1) / factor;
    double offset = center ? (factor - 1) / 2.0 : 0, worst = 0;
    double buffer[2 * WF_UPSAMPLE_MARGIN + 256], line[512],
        *chroma = buffer + WF_UPSAMPLE_MARGIN;
    wf_upsampler_init(&u, factor, center);
    for (int i = 0; i < count; i++) chroma[i] = cos(2 * M_PI * .12 * i);
    wf_upsample_line(&u, chroma, count, line, luma);
    for (int x = 24 * factor; x < luma - 24 * factor; x++)
        worst = fmax(worst, fabs(line[x] - cos(2 * M_PI * .12 * (x - offset) / factor)));
    if (worst > 2.5e-3) fail_msg("factor %d, center %d: %g", factor, center, worst);
    for (int i = 0; i < count; i++) chroma[i] = 0.25;
    wf_upsample_line(&u, chroma, count, line, luma);
    for (int x = 0; x < luma; x++) assert_true(fabs(line[x] - .25) < 1e-12);
}

static void waves_stay(void **state) {
    (void)state;
    for (int factor = 1; factor <= 4; factor *= 2)
        for (int center = 0; center < 2; center++)
            for (int luma = 200; luma < 206; luma++) check_siting(factor, center, luma);
}

/* Co-sited halves are what measuring and the composite coder see. */
static void halves_as_elsewhere(void **state) {
    (void)state;
    wf_upsampler u;
    float half[WIDTH / 2], want[WIDTH];
    double buffer[2 * WF_UPSAMPLE_MARGIN + WIDTH / 2], line[WIDTH];
    double *chroma = buffer + WF_UPSAMPLE_MARGIN;
    wf_upsampler_init(&u, 2, false);
    for (int i = 0; i < WIDTH / 2; i++) chroma[i] = half[i] = (float)random_code(8) / 256;
    wf_chroma_interpolate(wf_chroma_filter_of(WF_CHROMA_BT601), half, WIDTH, want);
    wf_upsample_line(&u, chroma, WIDTH / 2, line, WIDTH);
    for (int x = 0; x < WIDTH; x++) assert_true(fabs(line[x] - (double)want[x]) < 1e-6);
}

/* A plane of waves in 4:2:0: chroma that rises along both axes is found where its siting says.
 */
static void check_420(wf_siting siting, double left, double top) {
    wf_video_info info = {.width_px = WIDTH,
                          .lines = LINES,
                          .layout = WF_YCBCR,
                          .bits = 16,
                          .planes = 3,
                          .across = 2,
                          .down = 2,
                          .tags = {1, 8, 1, true, siting}};
    wf_meaning meaning;
    wf_light *light = make_light(&info, &meaning);
    static uint16_t code[3][SAMPLES];
    float out[3][WIDTH];
    double *scratch = malloc(wf_light_scratch(light)), worst = 0;
    for (int i = 0; i < SAMPLES; i++) code[0][i] = 32768, code[2][i] = 32768;
    for (int y = 0; y < LINES / 2; y++)
        for (int x = 0; x < WIDTH / 2; x++)
            code[1][y * WIDTH / 2 + x] = (uint16_t)lrint(
                32768 + 14336 * cos(.3 * (2 * x + left)) * cos(.25 * (2 * y + top)));
    for (int y = 20; y < LINES - 20; y++) {
        wf_light_row(light, (const uint16_t *[3]){code[0], code[1], code[2]}, y, scratch,
                     (float *[3]){out[0], out[1], out[2]});
        for (int x = 24; x < WIDTH - 24; x++) {
            double cb = .25 * cos(.3 * x) * cos(.25 * y);
            double want = (32768 - 4096) / 56064. + 2 * (1 - .0722) * cb;
            worst = fmax(worst, fabs(out[2][x] - want));
        }
    }
    if (worst > 3e-3) fail_msg("siting %d: %g", siting, worst);
    free(scratch);
    wf_light_free(light);
}

static void sitings_of_420(void **state) {
    (void)state;
    check_420(WF_SITING_LEFT, 0, .5);
    check_420(WF_SITING_CENTER, .5, .5);
    check_420(WF_SITING_TOP_LEFT, 0, 0);
}

/* ---- Tags ---- */

static void what_is_not_said(void **state) {
    (void)state;
    static const struct {
        int lines, tags[3], primaries, transfer, matrix;
    } rows[] = {
        {1080, {2, 2, 2}, 1, 1, 1},   {720, {2, 2, 2}, 1, 1, 1}, {576, {2, 2, 2}, 5, 1, 6},
        {480, {2, 2, 2}, 6, 1, 6},    {486, {2, 2, 2}, 6, 1, 6}, {1080, {2, 2, 9}, 9, 1, 9},
        {1080, {2, 18, 9}, 9, 18, 9}, {576, {2, 2, 6}, 5, 1, 6}, {480, {2, 2, 6}, 6, 1, 6},
        {1080, {2, 2, 5}, 5, 1, 5},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const int *t = rows[i].tags;
        wf_video_info info = {.lines = rows[i].lines,
                              .layout = WF_YCBCR,
                              .tags = {t[0], t[1], t[2], false, WF_SITING_LEFT}};
        wf_meaning m;
        assert_int_equal(wf_meaning_of(&info, "x", &m, NULL), WEFT_OK);
        assert_int_equal(m.primaries, rows[i].primaries);
        assert_int_equal(m.transfer, rows[i].transfer);
        assert_int_equal(m.matrix, rows[i].matrix);
        assert_false(m.tagged);
    }
    weft_error err;
    wf_meaning m;
    wf_video_info odd = {.lines = 1080, .layout = WF_YCBCR, .tags = {9, 14, 10, true, 0}};
    assert_int_equal(wf_meaning_of(&odd, "x", &m, &err), WEFT_FAILED);
    assert_non_null(strstr(err.text, "matrix"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_depth),         cmocka_unit_test(waves_stay),
        cmocka_unit_test(halves_as_elsewhere), cmocka_unit_test(sitings_of_420),
        cmocka_unit_test(what_is_not_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
