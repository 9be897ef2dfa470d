/* What is hard on the converter's numbers: light that is almost none, other rounding modes,
 * and codes that must not lean to one side. Prints how far each holds. */
#include <fenv.h>
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <cmocka.h>

#include "color/codes/encode.h"
#include "color/line/line.h"
#include "color/space/space.h"
#include "filters/base/half.h"
#include "filters/resample/resampler.h"

#define CELLS_X 720
#define CELLS_Y 240
#define WIDTH   360
#define LINES   120
#define FIELD   (3 * WIDTH * LINES / 2)

static uint32_t draw(uint32_t *state) {
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8;
}

/* ---- One field ---- */

static wf_resampler *make_resampler(const wf_raster *raster, const char *aperture) {
    wf_resample_desc d = {.raster = raster, .channels = 3, .band_rows = 16};
    wf_resampler *rs;
    char why[512];
    assert_true(wf_aperture_parse(aperture, &d.aperture, why, sizeof why));
    d.timing = (wf_timing_desc){.raster = raster,
                                .subframe_rate = {240, 1},
                                .subframes = 16,
                                .width = {1, 1},
                                .skew = {0, 1}};
    d.x = (wf_fitting){raster->width_px, CELLS_X, {1, 2}, false};
    d.y = (wf_fitting){raster->lines, CELLS_Y, {1, 2}, false};
    if (!wf_resampler_new(&d, &rs, why, sizeof why)) fail_msg("%s", why);
    return rs;
}

/* Field 1 of subframes that all are the same cells, whose values are half or float. */
static void add_field(const wf_resampler *rs, wf_field *field, wf_scratch *scratch,
                      const void *cells, bool half) {
    wf_window window = wf_resampler_window(rs, 1);
    size_t size = half ? sizeof(uint16_t) : sizeof(float);
    wf_field_begin_batch(field, true, false);
    for (int band = 0; band < wf_resampler_bands(rs); band++) {
        wf_span rows = wf_resampler_band_rows(rs, band);
        wf_cells here = {0, rows.first < 0 ? 0 : rows.first, CELLS_X,
                         rows.end > CELLS_Y ? CELLS_Y : rows.end};
        wf_band_open(field, band, scratch, 0);
        for (int64_t k = window.first; k < window.first + window.count; k++) {
            wf_band_input in = {.k = &k,
                                .k_count = 1,
                                .data = {0, 0, CELLS_X, CELLS_Y},
                                .here = here,
                                .line_stride = CELLS_X,
                                .channels = 3,
                                .half = half};
            for (int c = 0; c < 3; c++)
                in.plane[c] = (const char *)cells +
                              size * CELLS_X * ((size_t)c * CELLS_Y + (size_t)here.y0);
            if (here.y0 < here.y1) wf_band_add(field, band, scratch, 0, &in);
        }
        wf_band_close(field, band, scratch, 0, false);
    }
    wf_field_end_batch(field);
}

/* The field as [line][channel][pixel]. */
static void make_field(const wf_resampler *rs, const void *cells, bool half, float *out) {
    wf_scratch *scratch = wf_scratch_new(rs, 1);
    wf_field *field = wf_field_new(rs, 1);
    assert_true(scratch && field);
    add_field(rs, field, scratch, cells, half);
    for (int l = 0; l < LINES / 2; l++) {
        float *line = out + (size_t)l * 3 * WIDTH;
        wf_field_line(field, l, scratch, (float *[]){line, line + WIDTH, line + 2 * WIDTH});
    }
    wf_field_free(field);
    wf_scratch_free(scratch);
}

/* ---- Light that is almost none ---- */

#define ROUNDS      9
#define MOST_SLOWER 1.5

static double thread_s(void) {
    struct timespec used;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
    return (double)used.tv_sec + 1e-9 * (double)used.tv_nsec;
}

/* The least of several processor times for a field of these values, over that for ordinary
 * ones: they take turns. */
static double slower(const wf_resampler *rs, const void *odd, const void *plain, bool half) {
    static float out[FIELD];
    double least[2] = {1e9, 1e9};
    for (int round = 0; round < ROUNDS; round++)
        for (int which = 0; which < 2; which++) {
            double start = thread_s();
            make_field(rs, which ? plain : odd, half, out);
            least[which] = fmin(least[which], thread_s() - start);
        }
    return least[0] / least[1];
}

/* Other programs blur times, but a processor that is slow over some values is slow every time.
 */
static double slower_every_time(const wf_resampler *rs, const void *odd, const void *plain,
                                bool half) {
    double ratio = slower(rs, odd, plain, half);
    for (int again = 0; again < 5 && ratio >= MOST_SLOWER; again++)
        ratio = slower(rs, odd, plain, half);
    return ratio;
}

/* Processors take many times longer over subnormal floats, unless nothing is done to them in
 * float that would show it. Sanitizers blur times: a half more is let pass here. */
static void subnormal_input(void **state) {
    static uint16_t halves[2][3 * CELLS_X * CELLS_Y];
    static float floats[2][3 * CELLS_X * CELLS_Y];
    static const char *const apertures[] = {"box", "shaped", "diamond"};
    wf_raster raster;
    char why[256];
    uint32_t seed = 1;
    (void)state;
    assert_true(wf_raster_parse("360x120@30i", &raster, why, sizeof why));
    for (int i = 0; i < 3 * CELLS_X * CELLS_Y; i++) {
        halves[0][i] = (uint16_t)(1 + draw(&seed) % 0x3ff);
        halves[1][i] = (uint16_t)(0x3800 + draw(&seed) % 0x3ff);
        floats[0][i] = (float)(1 + draw(&seed) % 0x7fffff) * FLT_TRUE_MIN;
        floats[1][i] = 0.5f + (float)draw(&seed) * 0x1p-25f;
    }
    for (int n = 0; n < 3; n++) {
        wf_resampler *rs = make_resampler(&raster, apertures[n]);
        double half = slower_every_time(rs, halves[0], halves[1], true);
        double single = slower_every_time(rs, floats[0], floats[1], false);
        print_message("%-8s subnormal halves take %.2f, floats %.2f times as long\n",
                      apertures[n], half, single);
        assert_true(half < MOST_SLOWER);
        assert_true(single < MOST_SLOWER);
        wf_resampler_free(rs);
    }
}

/* ---- Rounding modes ---- */

/* Whoever calls the library may have left another mode behind: errors stay errors of rounding.
 */
static void rounding_modes(void **state) {
    static float cells[3 * CELLS_X * CELLS_Y], out[2][FIELD];
    static const int modes[] = {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
    wf_raster raster;
    char why[256];
    uint32_t seed = 2;
    double worst = 0;
    (void)state;
    assert_true(wf_raster_parse("360x120@30i", &raster, why, sizeof why));
    for (int i = 0; i < 3 * CELLS_X * CELLS_Y; i++)
        cells[i] = draw(&seed) % 50 ? (float)draw(&seed) * 0x1p-24f : 65504;
    for (int m = 0; m < 3; m++) {
        wf_resampler *rs = make_resampler(&raster, "shaped");
        make_field(rs, cells, false, out[0]);
        fesetround(modes[m]);
        wf_resampler *other = make_resampler(&raster, "shaped");
        make_field(other, cells, false, out[1]);
        fesetround(FE_TONEAREST);
        for (int i = 0; i < FIELD; i++)
            worst = fmax(worst, fabs((double)out[1][i] - (double)out[0][i]) /
                                    fmax(1, fabs((double)out[0][i])));
        wf_resampler_free(rs);
        wf_resampler_free(other);
    }
    print_message("up, down, to zero: results differ by %.2g of their size\n", worst);
    assert_true(worst <= 2e-6);
}

static const wf_curve *curve_of(const char *space) {
    for (size_t i = 0; wf_space_at(i); i++)
        if (!strcmp(wf_space_at(i)->name, space)) return wf_space_at(i)->curve;
    fail();
    return NULL;
}

/* Light of all halves up to 1 to codes under each mode: the same, or the next. */
static void rounding_modes_of_codes(void **state) {
    enum { COUNT = 0x3c01 };
    static float light[3][COUNT + 1];
    static uint16_t code[4][3 * (COUNT + 1)];
    static const int modes[] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
    wf_encoding e = {.luma = WF_LUMA_709,
                     .chroma = WF_CHROMA_444,
                     .ycbcr = true,
                     .bits = 10,
                     .width_px = COUNT + 1};
    int most = 0, other = 0;
    (void)state;
    for (int m = 0; m < 4; m++) {
        float *scratch = malloc((wf_encode_scratch(&e) + 1) * sizeof *scratch);
        assert_non_null(scratch);
        for (int c = 0; c < 3; c++)
            for (int i = 0; i <= COUNT; i++) light[c][i] = wf_half_value((uint16_t)i);
        fesetround(modes[m]);
        const wf_curve *curve = curve_of("rec709");
        for (int c = 0; c < 3; c++)
            wf_line_ops_best()->curve[curve->kind](curve, light[c], COUNT + 1);
        wf_encode_line(&e, (float *[]){light[0], light[1], light[2]}, scratch,
                       (uint16_t *[]){code[m], code[m] + COUNT + 1, code[m] + 2 * (COUNT + 1)});
        fesetround(FE_TONEAREST);
        free(scratch);
        for (int i = 0; i < 3 * (COUNT + 1); i++) {
            int apart = abs(code[m][i] - code[0][i]);
            most = apart > most ? apart : most;
            other += apart > 0;
        }
    }
    print_message("%d of %d codes differ, by %d at most\n", other, 9 * (COUNT + 1), most);
    assert_true(most <= 1);
}

/* ---- Codes ---- */

/* Over a ramp, and over noise, what rounding adds averages out. */
static void quantizer_bias(void **state) {
    enum { COUNT = 1 << 20 };
    static const int depths[] = {8, 10, 12, 16};
    float *signal = malloc(3 * sizeof(float) * COUNT),
          *copy = malloc(3 * sizeof(float) * COUNT);
    uint16_t *code = malloc(3 * sizeof(uint16_t) * COUNT);
    uint32_t seed = 6;
    (void)state;
    assert_true(signal && copy && code);
    for (int kind = 0; kind < 2; kind++)
        for (int d = 0; d < 4; d++) {
            wf_encoding e = {.luma = WF_LUMA_709, .bits = depths[d], .width_px = COUNT};
            float *scratch = malloc((wf_encode_scratch(&e) + 1) * sizeof *scratch);
            double sum = 0, unit = 219 * ldexp(1, depths[d] - 8),
                   zero = ldexp(16, depths[d] - 8);
            assert_non_null(scratch);
            for (int i = 0; i < 3 * COUNT; i++)
                signal[i] =
                    kind ? (float)draw(&seed) * 0x1p-24f : (float)(i % COUNT) / (COUNT - 1);
            memcpy(copy, signal, 3 * sizeof(float) * COUNT);
            wf_encode_line(&e, (float *[]){copy, copy + COUNT, copy + 2 * COUNT}, scratch,
                           (uint16_t *[]){code, code + COUNT, code + 2 * COUNT});
            for (int i = 0; i < 3 * COUNT; i++)
                sum += code[i] - (zero + unit * (double)signal[i]);
            double bias = sum / (3 * COUNT);
            print_message("%2d bits, %s: mean error %+.5f code\n", depths[d],
                          kind ? "noise" : "ramp", bias);
            assert_true(fabs(bias) < 1e-3);
            free(scratch);
        }
    free(signal);
    free(copy);
    free(code);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(subnormal_input),
        cmocka_unit_test(rounding_modes),
        cmocka_unit_test(rounding_modes_of_codes),
        cmocka_unit_test(quantizer_bias),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
