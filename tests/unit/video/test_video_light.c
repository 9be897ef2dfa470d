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

enum { WIDTH = 64, LINES = 48, SAMPLES = WIDTH * LINES, MOST_CODES = 4096 };

/* wf_light_rows of planes of `codes` samples, which are kept in bytes where they have room. */
static void rows_of(const wf_light *light, const wf_video_info *info, uint16_t *const code[3],
                    size_t codes, int y0, int y1, void *scratch, float *const out[3]) {
    static uint8_t narrow[3][MOST_CODES];
    const void *plane[3] = {code[0], code[1], code[2]};
    assert_true(codes <= MOST_CODES);
    for (int p = 0; p < 3 && wf_video_code_bytes(info) == 1; p++) {
        for (size_t i = 0; i < codes; i++) narrow[p][i] = (uint8_t)code[p][i];
        plane[p] = narrow[p];
    }
    wf_light_rows(light, plane, y0, y1, scratch, out);
}

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
                          .tags = {matrix, transfer, matrix, true, WF_SITING_LEFT, false}};
    wf_meaning meaning;
    wf_light *light = make_light(&info, &meaning);
    uint16_t code[3][WIDTH];
    float out[3][WIDTH];
    void *scratch = malloc(wf_light_scratch(light));
    double worst = 0;
    for (int round = 0; round < 50; round++) {
        for (int p = 0; p < 3; p++)
            for (int x = 0; x < WIDTH; x++) code[p][x] = (uint16_t)random_code(bits);
        rows_of(light, &info, (uint16_t *[3]){code[0], code[1], code[2]}, WIDTH, 0, 1, scratch,
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
    float buffer[2 * WF_UPSAMPLE_MARGIN + 256], line[512], spare[512],
        *chroma = buffer + WF_UPSAMPLE_MARGIN;
    wf_upsampler_init(&u, factor, center);
    for (int i = 0; i < count; i++) chroma[i] = (float)cos(2 * M_PI * .12 * i);
    wf_upsample_line(&u, &wf_upsample_ops_best()->quick, chroma, count, spare, line, luma);
    for (int x = 24 * factor; x < luma - 24 * factor; x++)
        worst =
            fmax(worst, fabs((double)line[x] - cos(2 * M_PI * .12 * (x - offset) / factor)));
    if (worst > 2.5e-3) fail_msg("factor %d, center %d: %g", factor, center, worst);
    for (int i = 0; i < count; i++) chroma[i] = 0.25f;
    wf_upsample_line(&u, &wf_upsample_ops_best()->quick, chroma, count, spare, line, luma);
    for (int x = 0; x < luma; x++) assert_true(fabs((double)line[x] - .25) < 4e-8);
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
    float buffer[2 * WF_UPSAMPLE_MARGIN + WIDTH / 2], line[WIDTH], spare[WIDTH];
    float *chroma = buffer + WF_UPSAMPLE_MARGIN;
    wf_upsampler_init(&u, 2, false);
    for (int i = 0; i < WIDTH / 2; i++) chroma[i] = half[i] = (float)random_code(8) / 256;
    wf_chroma_interpolate(wf_chroma_filter_of(WF_CHROMA_BT601), half, WIDTH, want);
    wf_upsample_line(&u, &wf_upsample_ops_best()->quick, chroma, WIDTH / 2, spare, line, WIDTH);
    for (int x = 0; x < WIDTH; x++) assert_true(fabsf(line[x] - want[x]) < 5e-7f);
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
                          .tags = {1, 8, 1, true, siting, false}};
    wf_meaning meaning;
    wf_light *light = make_light(&info, &meaning);
    static uint16_t code[3][SAMPLES];
    float out[3][WIDTH];
    void *scratch = malloc(wf_light_scratch(light));
    double worst = 0;
    for (int i = 0; i < SAMPLES; i++) code[0][i] = 32768, code[2][i] = 32768;
    for (int y = 0; y < LINES / 2; y++)
        for (int x = 0; x < WIDTH / 2; x++)
            code[1][y * WIDTH / 2 + x] = (uint16_t)lrint(
                32768 + 14336 * cos(.3 * (2 * x + left)) * cos(.25 * (2 * y + top)));
    for (int y = 20; y < LINES - 20; y++) {
        rows_of(light, &info, (uint16_t *[3]){code[0], code[1], code[2]}, SAMPLES, y, y + 1,
                scratch, (float *[3]){out[0], out[1], out[2]});
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

/* ---- Every sampling of chroma, in float64 ---- */

enum { WIDE = 75, HIGH = 41 }; /* odd, so that both ends differ */

typedef struct plane_of_chroma {
    const uint16_t *code;
    int width_px, lines;
    double zero, unit;
} plane_of_chroma;

/* Sample `index` of an axis that is continued by reflection about its ends, or where `amid`,
 * about its edges; a last luma sample that has no chroma of its own has the edge, too. */
static int mirrored(int index, int count, int factor, int amid, int luma) {
    bool edge = amid || factor * (count - 1) != luma - 1;
    if (count == 1) return 0;
    while (index < 0 || index >= count) {
        if (index < 0) index = amid ? -1 - index : -index;
        if (index >= count) index = edge ? 2 * count - 1 - index : 2 * count - 2 - index;
    }
    return index;
}

/* The value `eighths` of a step after sample 0 by the half-band, applied as often as it takes.
 */
typedef double value_fn(const void *from, int index);

static double between(value_fn *value, const void *from, int eighths) {
    const wf_chroma_filter *filter = wf_chroma_filter_of(WF_CHROMA_BT601);
    int step = 8;
    double sum = 0;
    if (eighths % 8 == 0) return value(from, eighths / 8);
    while (eighths % step) step /= 2;
    for (int j = 0; j < 10; j++)
        sum += 2 * (double)filter->pair[j] *
               (between(value, from, eighths + step * (1 + 2 * j)) +
                between(value, from, eighths - step * (1 + 2 * j)));
    return sum;
}

typedef struct chroma_axis {
    const plane_of_chroma *plane;
    int down, amid_down, across, amid_across; /* of the sampling */
    int row, y;                               /* a line of chroma; a line of luma */
} chroma_axis;

static double sample_in_row(const void *from, int index) {
    const chroma_axis *a = from;
    const plane_of_chroma *c = a->plane;
    int x = mirrored(index, c->width_px, a->across, a->amid_across, WIDE);
    return (c->code[a->row * c->width_px + x] - c->zero) / c->unit;
}

static double at_luma(int x, int factor, int amid, value_fn *value, const void *from) {
    return between(value, from, 8 / factor * x - (amid ? 4 - 4 / factor : 0));
}

static double row_at(const chroma_axis *a, int row, int x) {
    chroma_axis there = *a;
    there.row = mirrored(row, a->plane->lines, a->down, a->amid_down, HIGH);
    return at_luma(x, a->across, a->amid_across, sample_in_row, &there);
}

/* row_at of every line of chroma at one column of luma. */
static double in_column(const void *from, int index) {
    const chroma_axis *a = from;
    return row_at(a, index, a->y);
}

static double chroma_at(const chroma_axis *a, int x, int y) {
    chroma_axis column = *a;
    column.y = x; /* in_column looks along lines */
    return at_luma(y, a->down, a->amid_down, in_column, &column);
}

static double chroma_value(const plane_of_chroma *plane, const wf_video_info *info, int x,
                           int y) {
    wf_siting siting = info->tags.siting;
    const chroma_axis axis = {plane,
                              info->down,
                              siting != WF_SITING_TOP_LEFT,
                              info->across,
                              siting == WF_SITING_CENTER,
                              0,
                              0};
    return chroma_at(&axis, x, y);
}

/* The largest error of row y, whose light is in out, in shares of full scale. */
static double row_error(const plane_of_chroma plane[3], const wf_video_info *info, int y,
                        float *const out[3]) {
    double worst = 0;
    for (int x = y % 5; x < WIDE; x += 5) {
        double s[3] = {(plane[0].code[y * WIDE + x] - plane[0].zero) / plane[0].unit}, want[3];
        for (int p = 1; p < 3; p++) s[p] = chroma_value(&plane[p], info, x, y);
        rgb_of(.2126, .0722, s, want);
        for (int c = 0; c < 3; c++) {
            int transfer = info->tags.transfer;
            double light = decoded(transfer, want[c]);
            if (transfer > 15 && fabs(want[c]) > 1) continue; /* no light is defined */
            double full = fmax(decoded(transfer, 1), fabs(light));
            worst = fmax(worst, fabs((double)out[c][x] - light) / full);
        }
    }
    return worst;
}

static double check_sampling(const wf_video_info *info) {
    static uint16_t code[3][WIDE * HIGH];
    static float out[3][7 * WIDE];
    wf_video_info copy = *info;
    wf_meaning meaning;
    wf_light *light = make_light(&copy, &meaning);
    void *scratch = malloc(wf_light_scratch(light));
    plane_of_chroma plane[3];
    double worst = 0;
    for (int p = 0; p < 3; p++) {
        int across = p ? info->across : 1, down = p ? info->down : 1;
        plane[p] = (plane_of_chroma){
            code[p], (WIDE + across - 1) / across, (HIGH + down - 1) / down,
            ldexp(p ? 128 : 16, info->bits - 8), ldexp(p ? 224 : 219, info->bits - 8)};
        for (int i = 0; i < WIDE * HIGH; i++) code[p][i] = (uint16_t)random_code(info->bits);
    }
    for (int y = 0; y < HIGH; y++) {
        int y0 = y - y % 7, y1 = y0 + 7 < HIGH ? y0 + 7 : HIGH;
        if (y == y0)
            rows_of(light, info, (uint16_t *[3]){code[0], code[1], code[2]}, WIDE * HIGH, y0,
                    y1, scratch, (float *[3]){out[0], out[1], out[2]});
        size_t at = (size_t)(y - y0) * WIDE;
        worst = fmax(worst, row_error(plane, info, y,
                                      (float *[3]){out[0] + at, out[1] + at, out[2] + at}));
    }
    free(scratch);
    wf_light_free(light);
    return worst;
}

static void check_transfer(int transfer, int across, int down) {
    double worst = 0;
    wf_siting last = transfer == 1 ? WF_SITING_TOP_LEFT : WF_SITING_LEFT;
    for (wf_siting siting = WF_SITING_LEFT; siting <= last; siting++)
        for (int bits = 8; bits <= 16; bits += 4)
            worst = fmax(worst, check_sampling(&(wf_video_info){
                                    .width_px = WIDE,
                                    .lines = HIGH,
                                    .layout = WF_YCBCR,
                                    .bits = bits,
                                    .planes = 3,
                                    .across = across,
                                    .down = down,
                                    .tags = {1, transfer, 1, true, siting, false}}));
    print_message("transfer %d, chroma 1/%d x 1/%d: %.2g of full scale\n", transfer, across,
                  down, worst);
    assert_true(worst <= 1e-6);
}

static void every_sampling(void **state) {
    (void)state;
    static const int transfers[] = {1, 8, 13, 16, 18};
    static const int samplings[][2] = {{1, 1}, {2, 1}, {2, 2}, {4, 1}};
    for (int t = 0; t < 5; t++)
        for (int i = 0; i < 4; i++)
            check_transfer(transfers[t], samplings[i][0], samplings[i][1]);
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
                              .tags = {t[0], t[1], t[2], false, WF_SITING_LEFT, false}};
        wf_meaning m;
        assert_int_equal(wf_meaning_of(&info, "x", &m, NULL), WEFT_OK);
        assert_int_equal(m.primaries, rows[i].primaries);
        assert_int_equal(m.transfer, rows[i].transfer);
        assert_int_equal(m.matrix, rows[i].matrix);
        assert_false(m.tagged);
    }
    weft_error err;
    wf_meaning m;
    wf_video_info odd = {
        .lines = 1080, .layout = WF_YCBCR, .tags = {9, 14, 10, true, 0, false}};
    assert_int_equal(wf_meaning_of(&odd, "x", &m, &err), WEFT_FAILED);
    assert_non_null(strstr(err.text, "matrix"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_depth),         cmocka_unit_test(waves_stay),
        cmocka_unit_test(halves_as_elsewhere), cmocka_unit_test(sitings_of_420),
        cmocka_unit_test(every_sampling),      cmocka_unit_test(what_is_not_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
