/* Legal colors and the luma that keeps light: held against plain double arithmetic. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "color/codes/chroma.h"
#include "color/codes/encode.h"
#include "color/codes/legal.h"
#include "color/codes/levels.h"
#include "color/codes/r103.h"

#define WIDTH 720
#define LINES 40

static const double kr[] = {0.299, 0.2126, 0.2627}, kb[] = {0.114, 0.0722, 0.0593};

typedef struct line {
    float rgb[3][WIDTH];
} line;

typedef struct coded {
    double signal[3][WIDTH]; /* Y' Cb Cr of every pixel, as a receiver interpolates */
    uint16_t code[3][WIDTH];
} coded;

static uint32_t next(uint32_t *state) {
    *state = *state * 1664525 + 1013904223;
    return *state >> 8;
}

/* Wide patches of any color up to `most`, and noise of them every fourth line. */
static void fill(line *l, int number, double most) {
    uint32_t state = (uint32_t)number * 7919 + 1;
    for (int x = 0; x < WIDTH; x++)
        for (int c = 0; c < 3; c++)
            if (x % (number % 4 ? 45 : 6) == 0)
                l->rgb[c][x] = (float)(most * pow(next(&state) / 16777216.0, 2));
            else
                l->rgb[c][x] = l->rgb[c][x - 1];
}

static int reflected(int i, int last) {
    while (i < 0 || i > last) i = i < 0 ? -i : 2 * last - i;
    return i;
}

/* The half-band between samples, in double. */
static void interpolate(double *signal) {
    const wf_chroma_filter *f = wf_chroma_filter_of(WF_CHROMA_BT601);
    double half[WIDTH / 2];
    for (int i = 0; i < WIDTH / 2; i++) half[i] = signal[i];
    for (int x = 0; x < WIDTH; x++) {
        double sum = 0;
        for (int j = 0; j < (int)f->pairs; j++)
            sum += 2 * (double)f->pair[j] *
                   (half[reflected(x - 1 - 2 * j, WIDTH - 1) / 2] +
                    half[reflected(x + 1 + 2 * j, WIDTH - 1) / 2]);
        signal[x] = x % 2 ? sum : half[x / 2];
    }
}

static void encode(wf_encoding e, const line *in, coded *out) {
    line copy = *in;
    float *const rgb[3] = {copy.rgb[0], copy.rgb[1], copy.rgb[2]};
    uint16_t *const code[3] = {out->code[0], out->code[1], out->code[2]};
    e.width_px = WIDTH;
    float *scratch = malloc((1 + wf_encode_scratch(&e)) * sizeof *scratch);
    assert_non_null(scratch);
    wf_encode_line(&e, rgb, scratch, code);
    free(scratch);
    for (int p = 0; p < 3; p++) {
        bool halved = e.ycbcr && p && e.chroma != WF_CHROMA_444;
        double zero, unit;
        wf_code_scale(&e, p, &zero, &unit);
        for (int x = 0; x < WIDTH / (halved ? 2 : 1); x++)
            out->signal[p][x] = (code[p][x] - zero) / unit;
        if (halved) interpolate(out->signal[p]);
    }
}

static void to_rgb(wf_luma luma, const coded *c, int x, double rgb[3]) {
    double y = c->signal[0][x], r = kr[luma], b = kb[luma];
    rgb[0] = y + 2 * (1 - r) * c->signal[2][x];
    rgb[2] = y + 2 * (1 - b) * c->signal[1][x];
    rgb[1] = (y - r * rgb[0] - b * rgb[2]) / (1 - r - b);
}

static bool outside(const double rgb[3], double low, double high) {
    for (int c = 0; c < 3; c++)
        if (rgb[c] < low - 1e-6 || rgb[c] > high + 1e-6) return true;
    return false;
}

static double luma_of(wf_luma luma, const line *l, int x) {
    return kr[luma] * l->rgb[0][x] + kb[luma] * l->rgb[2][x] +
           (1 - kr[luma] - kb[luma]) * l->rgb[1][x];
}

/* ---- EBU R 103 ---- */

/* A pixel counts once, whichever of R', G' and B' are outside; limits themselves are inside. */
static void outside_counts_pixels(void **unused) {
    (void)unused;
    const float low = (float)WF_R103_LOW, high = (float)WF_R103_HIGH, code = 1 / 876.0f;
    const float r[] = {low, low - code, 0, high, high + code, 1};
    const float g[] = {0, low - code, high + code, high, 0, 1};
    const float b[] = {high, 2, 0, low, 0, low - code};
    const float *const rgb[3] = {r, g, b};
    assert_int_equal(wf_r103_outside(rgb, 6), 4);
    assert_int_equal(wf_r103_outside(rgb, 1), 0);
    assert_int_equal(wf_r103_outside(rgb, 0), 0);
}

static double share_outside(wf_encoding e, double most, wf_legal_counts *counts) {
    static coded c;
    line l;
    double count = 0, rgb[3];
    *counts = (wf_legal_counts){0};
    e.legal = counts;
    for (int n = 0; n < LINES; n++) {
        fill(&l, n, most);
        encode(e, &l, &c);
        for (int x = 0; x < WIDTH; x++) {
            to_rgb(e.luma, &c, x, rgb);
            count += outside(rgb, WF_R103_LOW, WF_R103_HIGH);
        }
    }
    return count / (WIDTH * LINES);
}

static void little_is_left_outside(void **unused) {
    (void)unused;
    static const wf_chroma chromas[] = {WF_CHROMA_BT601, WF_CHROMA_121, WF_CHROMA_BOX,
                                        WF_CHROMA_444, WF_CHROMA_LUMA_ADJUST};
    static wf_display display;
    wf_display_init(&display, WF_PRIMARIES_709, WF_TRANSFER_BT1886);
    for (wf_luma luma = WF_LUMA_601; luma <= WF_LUMA_2020; luma++)
        for (size_t i = 0; i < sizeof chromas / sizeof *chromas; i++)
            for (int bits = 8; bits <= 12; bits += 2)
                for (int dither = 0; dither < 2; dither++) {
                    wf_legal_counts counts;
                    wf_encoding e = {.luma = luma,
                                     .chroma = chromas[i],
                                     .legalize = WF_LEGAL_R103,
                                     .dither = dither ? WF_DITHER_TPDF : WF_DITHER_NONE,
                                     .ycbcr = true,
                                     .bits = bits,
                                     .display = &display};
                    double left = share_outside(e, 2.5, &counts);
                    assert_true(left <= 0.005); /* half of what is allowed */
                    assert_int_equal(counts.pixels, WIDTH * LINES);
                    assert_true(fabs((double)counts.outside / (WIDTH * LINES) - left) < 2e-4);
                    e.legalize = WF_LEGAL_NONE;
                    assert_true(share_outside(e, 2.5, &counts) > 0.3);
                }
}

/* Patches of the primaries of ACEScg, their sums, white and black, as BT.1886 signals of Rec.
 * 709 (negative light is none), `gain` times as bright as white; every second line has pixels
 * of other colors strewn about, as NaN fixing leaves. The matrix: AP1 to BT.709, D60 to D65. */
static void fill_primaries(line *l, int number, double gain) {
    static const double m[3][3] = {{1.70505, -0.62179, -0.08326},
                                   {-0.13026, 1.14080, -0.01055},
                                   {-0.02400, -0.12897, 1.15297}};
    int patch = 2 + number % 12;
    uint32_t state = (uint32_t)number * 7919 + 1;
    for (int x = 0; x < WIDTH; x++) {
        uint32_t which = (uint32_t)(x / patch + number / 12), stray = next(&state);
        if (number % 2 && stray % 25 == 0) which = stray >> 8;
        for (int c = 0; c < 3; c++) {
            double light = 0;
            for (int p = 0; p < 3; p++) light += (which >> p & 1) * m[c][p];
            l->rgb[c][x] = (float)pow(gain * fmax(light, 0), 1 / 2.4);
        }
    }
}

typedef struct primaries_left {
    double outside, chroma; /* share of the pixels; mean saturation */
} primaries_left;

static primaries_left leave_primaries(wf_encoding e, double gain) {
    static coded c;
    line l;
    primaries_left left = {0};
    const double pixels = 2.0 * LINES * WIDTH;
    e.legalize = WF_LEGAL_R103;
    for (int n = 0; n < 2 * LINES; n++) {
        double rgb[3];
        fill_primaries(&l, n, gain);
        encode(e, &l, &c);
        for (int x = 0; x < WIDTH; x++) {
            to_rgb(e.luma, &c, x, rgb);
            left.outside += outside(rgb, WF_R103_LOW, WF_R103_HIGH) / pixels;
            left.chroma += hypot(c.signal[1][x], c.signal[2][x]) / pixels;
        }
    }
    return left;
}

/* Adjusting aims at light that no code holds: it must neither leave more outside nor cost more
 * saturation than plain decimation does. */
static void primaries_are_brought_within(void **unused) {
    (void)unused;
    static wf_display display;
    static const double gains[] = {0.6, 1, 3, 10};
    double most = 0, least_kept = 1;
    wf_display_init(&display, WF_PRIMARIES_709, WF_TRANSFER_BT1886);
    for (size_t i = 0; i < sizeof gains / sizeof *gains; i++)
        for (int bits = 8; bits <= 12; bits += 2) {
            wf_encoding e = {
                .luma = WF_LUMA_709, .ycbcr = true, .bits = bits, .display = &display};
            primaries_left plain = leave_primaries(e, gains[i]);
            e.chroma = WF_CHROMA_LUMA_ADJUST;
            primaries_left adjusted = leave_primaries(e, gains[i]);
            most = fmax(most, fmax(plain.outside, adjusted.outside));
            least_kept = fmin(least_kept, adjusted.chroma / plain.chroma);
        }
    print_message("primaries of ACEScg: at most %.5f outside; adjusted luma keeps %.3f of "
                  "their saturation\n",
                  most, least_kept);
    assert_true(most <= 0.0005);
    assert_true(least_kept > 0.95);
}

/* Codes of 4:2:2 that are within the limits already are the same codes with r103. */
static int count_kept_lines(wf_encoding e, double most, double margin) {
    static coded plain, legal;
    line l;
    int seen = 0;
    for (int n = 0; n < 4 * LINES; n++) {
        double rgb[3];
        int count = 0;
        fill(&l, n, most);
        e.legalize = WF_LEGAL_NONE;
        encode(e, &l, &plain);
        for (int x = 0; x < WIDTH; x++) {
            to_rgb(e.luma, &plain, x, rgb);
            count += outside(rgb, WF_R103_LOW + margin, WF_R103_HIGH - margin);
        }
        e.legalize = WF_LEGAL_R103;
        encode(e, &l, &legal);
        if (count) continue;
        seen++;
        for (int p = 0; p < 3; p++)
            assert_memory_equal(plain.code[p], legal.code[p],
                                (p ? WIDTH / 2 : WIDTH) * sizeof **plain.code);
    }
    return seen;
}

static void legal_lines_of_422_stay(void **unused) {
    (void)unused;
    wf_encoding e = {.luma = WF_LUMA_709, .ycbcr = true, .bits = 10};
    assert_true(count_kept_lines(e, 0.7, 0.002) > LINES / 2);
    e.dither = WF_DITHER_TPDF;
    assert_true(count_kept_lines(e, 0.4, 0.012) > LINES / 4);
}

static void legal_colors_stay(void **unused) {
    (void)unused;
    static coded plain, legal;
    line l;
    for (int n = 0; n < LINES; n++) {
        fill(&l, n * 4 + 1, 0.95);
        wf_legal_counts counts = {0};
        wf_encoding e = {.chroma = WF_CHROMA_444, .ycbcr = true, .bits = 10};
        encode(e, &l, &plain);
        e.legalize = WF_LEGAL_R103;
        e.legal = &counts;
        encode(e, &l, &legal);
        assert_memory_equal(plain.code, legal.code, sizeof plain.code);
        assert_int_equal(counts.touched, 0);
    }
}

/* Cb and Cr as they are decimated, before they are codes. */
static void decimated(wf_luma luma, const line *l, float cb[WIDTH], float cr[WIDTH]) {
    const wf_chroma_filter *f = wf_chroma_filter_of(WF_CHROMA_BT601);
    float scratch[2 * WIDTH];
    assert_true(wf_chroma_scratch(WIDTH) <= 2 * WIDTH);
    for (int x = 0; x < WIDTH; x++) {
        double y = luma_of(luma, l, x);
        cb[x] = (float)((l->rgb[2][x] - y) / (2 * (1 - kb[luma])));
        cr[x] = (float)((l->rgb[0][x] - y) / (2 * (1 - kr[luma])));
    }
    wf_chroma_decimate(f, cb, WIDTH, scratch);
    wf_chroma_decimate(f, cr, WIDTH, scratch);
}

/* Where luma is within the limits it stays within a code, and hue within a degree wherever
 * there is enough of it for a degree to be more than a code. */
static void luma_and_hue_are_kept(void **unused) {
    (void)unused;
    static coded c;
    line l;
    float cb[WIDTH], cr[WIDTH];
    double worst_luma = 0, worst_turn = 0;
    int seen = 0;
    for (int n = 0; n < LINES; n++) {
        wf_encoding e = {
            .luma = WF_LUMA_709, .legalize = WF_LEGAL_R103, .ycbcr = true, .bits = 12};
        fill(&l, n, 1.8);
        encode(e, &l, &c);
        decimated(WF_LUMA_709, &l, cb, cr);
        for (int x = 0; x < WIDTH; x += 2) {
            double y = luma_of(WF_LUMA_709, &l, x), off = (c.signal[0][x] - y) * 876;
            if (y < WF_R103_LOW || y > WF_R103_HIGH) continue;
            worst_luma = fmax(worst_luma, fabs(off));
            if (hypot(c.signal[1][x], c.signal[2][x]) < 0.02) continue;
            double turned = atan2(cr[x / 2], cb[x / 2]) - atan2(c.signal[2][x], c.signal[1][x]);
            worst_turn = fmax(worst_turn, fabs(remainder(turned, 2 * M_PI)) * 180 / M_PI);
            seen++;
        }
    }
    print_message("luma %.3f codes of 10 bits, hue %.3f degrees at most\n", worst_luma,
                  worst_turn);
    assert_true(worst_luma <= 1 + 0.125); /* half a code of 12 bits is a rounding */
    assert_true(worst_turn <= 1);
    assert_true(seen > 5000);
}

static void pictures_are_kept_in_hue(void **unused) {
    (void)unused;
    static coded c;
    line l;
    for (int n = 0; n < LINES; n++) {
        wf_encoding e = {
            .luma = WF_LUMA_709, .legalize = WF_LEGAL_R103, .full_range = true, .bits = 16};
        fill(&l, n, 1.6);
        encode(e, &l, &c);
        for (int x = 0; x < WIDTH; x++) {
            double y = luma_of(WF_LUMA_709, &l, x), made = 0;
            for (int p = 0; p < 3; p++)
                made += (p == 0 ? kr[1] : p == 2 ? kb[1] : 1 - kr[1] - kb[1]) * c.signal[p][x];
            assert_true(fabs(made - fmin(y, 1)) < 2e-5);
            double red = l.rgb[0][x] - y, blue = l.rgb[2][x] - y;
            double red_made = c.signal[0][x] - made, blue_made = c.signal[2][x] - made;
            assert_true(fabs(red * blue_made - blue * red_made) < 1e-4);
        }
    }
}

/* ---- luma-adjust ---- */

static double light(double signal) {
    return signal > 0 ? pow(signal, 2.4) : 0;
}

static double luminance(const double rgb[3], const wf_display *d) {
    return (double)d->weight[0] * light(rgb[0]) + (double)d->weight[1] * light(rgb[1]) +
           (double)d->weight[2] * light(rgb[2]);
}

/* RMS error of luminance of bars of saturated color. */
static double light_error(wf_encoding e, const wf_display *display, wf_legal_counts *counts) {
    static const float bars[][3] = {{1, 0, 0}, {0, 1, 0},          {0, 0, 1},
                                    {1, 1, 0}, {0, 1, 1},          {1, 0, 1},
                                    {0, 0, 1}, {0.7f, 0.1f, 0.1f}, {0.1f, 0.6f, 0.1f}};
    static coded c;
    line l;
    double sum = 0, rgb[3];
    (void)counts;
    e.display = display;
    for (int shift = 0; shift < 8; shift++) {
        for (int x = 0; x < WIDTH; x++)
            for (int p = 0; p < 3; p++)
                l.rgb[p][x] = bars[(x + shift) / 24 % (int)(sizeof bars / sizeof *bars)][p];
        encode(e, &l, &c);
        for (int x = 0; x < WIDTH; x++) {
            const double want[3] = {l.rgb[0][x], l.rgb[1][x], l.rgb[2][x]};
            to_rgb(e.luma, &c, x, rgb);
            sum += pow(luminance(rgb, display) - luminance(want, display), 2);
        }
    }
    return sqrt(sum / (8 * WIDTH));
}

static void light_of_colored_edges_is_kept(void **unused) {
    (void)unused;
    static wf_display display;
    static const wf_primaries primaries[] = {WF_PRIMARIES_SMPTE_C, WF_PRIMARIES_709,
                                             WF_PRIMARIES_2020};
    for (wf_luma luma = WF_LUMA_601; luma <= WF_LUMA_2020; luma++) {
        wf_encoding e = {.luma = luma, .ycbcr = true, .bits = 10};
        wf_display_init(&display, primaries[luma], WF_TRANSFER_BT1886);
        double plain = light_error(e, &display, NULL);
        e.chroma = WF_CHROMA_LUMA_ADJUST;
        double adjusted = light_error(e, &display, NULL);
        print_message("luminance of saturated edges: RMS error %.5f, adjusted %.5f\n", plain,
                      adjusted);
        assert_true(adjusted <= plain / 4);
    }
}

static void grays_are_not_adjusted(void **unused) {
    (void)unused;
    static wf_display display;
    static coded plain, adjusted;
    line l;
    wf_display_init(&display, WF_PRIMARIES_709, WF_TRANSFER_BT1886);
    for (int x = 0; x < WIDTH; x++)
        for (int p = 0; p < 3; p++) l.rgb[p][x] = (float)(x * 37 % 700) / 650;
    wf_encoding e = {.luma = WF_LUMA_709, .ycbcr = true, .bits = 10, .display = &display};
    encode(e, &l, &plain);
    e.chroma = WF_CHROMA_LUMA_ADJUST;
    encode(e, &l, &adjusted);
    assert_memory_equal(plain.code, adjusted.code, sizeof plain.code);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(outside_counts_pixels),
        cmocka_unit_test(little_is_left_outside),
        cmocka_unit_test(primaries_are_brought_within),
        cmocka_unit_test(legal_colors_stay),
        cmocka_unit_test(legal_lines_of_422_stay),
        cmocka_unit_test(luma_and_hue_are_kept),
        cmocka_unit_test(pictures_are_kept_in_hue),
        cmocka_unit_test(light_of_colored_edges_is_kept),
        cmocka_unit_test(grays_are_not_adjusted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
