/* 4:2:2 decimation: the template by the taps' transform and by gratings through the encoder,
 * edges and widths against a plain convolution. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "color/codes/chroma_420.h"
#include "color/codes/encode.h"
#include "color/line/line.h"

/* Rec. ITU-R BT.601-7's template, MHz at 13.5 MHz, as shares of the luma sampling rate. */
#define PASS_END   (2.75 / 13.5)
#define HALF_AT    (3.375 / 13.5)
#define STOP_START (4.0 / 13.5)

static double decibels(double ratio) {
    return 20 * log10(ratio);
}

/* The tap `offset` samples from the middle one. */
static double tap(const wf_chroma_filter *filter, int offset) {
    if (offset == 0) return 0.5;
    size_t j = (size_t)(abs(offset) - 1) / 2;
    if (offset % 2 == 0 || j >= filter->pairs || (offset < 0 && !filter->symmetric)) return 0;
    return (double)filter->pair[j];
}

enum { REACH = 2 * WF_CHROMA_PAIRS - 1 };

/* Response at f cycles a luma sample; the phase is that of a filter around the middle tap. */
static double response(const wf_chroma_filter *filter, double f, double *imaginary) {
    double re = 0, im = 0;
    for (int n = -REACH; n <= REACH; n++) {
        re += tap(filter, n) * cos(2 * M_PI * f * n);
        im -= tap(filter, n) * sin(2 * M_PI * f * n);
    }
    if (imaginary) *imaginary = im;
    return re;
}

static void taps_add_up_to_one(void **state) {
    (void)state;
    const wf_chroma kinds[] = {WF_CHROMA_BT601, WF_CHROMA_121, WF_CHROMA_BOX};
    for (int k = 0; k < 3; k++) {
        const wf_chroma_filter *filter = wf_chroma_filter_of(kinds[k]);
        double sum = 0;
        for (int n = -REACH; n <= REACH; n++) sum += tap(filter, n);
        assert_true(sum == 1);
    }
    assert_null(wf_chroma_filter_of(WF_CHROMA_444));
}

static void template_by_transform(void **state) {
    (void)state;
    const wf_chroma_filter *filter = wf_chroma_filter_of(WF_CHROMA_BT601);
    double ripple = 0, leak = 0, im;
    for (int i = 0; i <= 100000; i++) {
        double f = 0.5 * i / 100000, r = response(filter, f, &im);
        assert_true(fabs(im) < 1e-15);
        if (f <= PASS_END) ripple = fmax(ripple, fabs(decibels(fabs(r))));
        if (f >= STOP_START) leak = fmax(leak, fabs(r));
        if (f > PASS_END && f < STOP_START) assert_true(r < 1 && r > 0);
    }
    print_message("bt601: ripple %.4f dB, stop band %.2f dB\n", ripple, decibels(leak));
    assert_true(ripple <= 0.0054);
    assert_true(decibels(leak) <= -64.3);
    assert_true(fabs(response(filter, HALF_AT, NULL) - 0.5) < 1e-15);
}

static void the_cheap_ones(void **state) {
    (void)state;
    for (double f = 0; f <= 0.5; f += 1.0 / 64) {
        double im, re = response(wf_chroma_filter_of(WF_CHROMA_BOX), f, &im);
        assert_true(fabs(hypot(re, im) - cos(M_PI * f)) < 1e-15);
        double cosine = cos(M_PI * f);
        re = response(wf_chroma_filter_of(WF_CHROMA_121), f, &im);
        assert_true(fabs(re - cosine * cosine) < 1e-15 && fabs(im) < 1e-15);
    }
}

/* ---- Gratings ---- */

enum { WIDTH = 1920 };

/* Amplitude of a grating of Cb = 0.25 cos(2 pi f n + phase) as the codes have it, as a share of
 * what went in; frequencies above 0.25 are looked for where they alias to. */
static double through_encoder(wf_chroma chroma, int bits, double f, double phase) {
    static float rgb[3][WIDTH], scratch[2 * WIDTH];
    static uint16_t code[3][WIDTH];
    wf_encoding e = {
        .luma = WF_LUMA_709, .chroma = chroma, .ycbcr = true, .bits = bits, .width_px = WIDTH};
    assert_true(wf_encode_scratch(&e) <= 2 * WIDTH);
    for (int n = 0; n < WIDTH; n++) { /* Y' = 0.5, Cr = 0 */
        double cb = 0.25 * cos(2 * M_PI * f * n + phase);
        rgb[0][n] = 0.5f;
        rgb[1][n] = (float)(0.5 - cb * 2 * (1 - 0.0722) * 0.0722 / 0.7152);
        rgb[2][n] = (float)(0.5 + cb * 2 * (1 - 0.0722));
    }
    float *const planes[3] = {rgb[0], rgb[1], rgb[2]};
    uint16_t *const codes[3] = {code[0], code[1], code[2]};
    wf_encode_line(&e, planes, scratch, codes);
    double re = 0, im = 0, weights = 0;
    for (int k = 0; k < WIDTH / 2; k++) { /* a Blackman-Harris window keeps the neighbors out */
        double u = 2 * M_PI * (k + 0.5) / (WIDTH / 2.0);
        double w = 0.35875 - 0.48829 * cos(u) + 0.14128 * cos(2 * u) - 0.01168 * cos(3 * u);
        double signal = (code[1][k] - 128.0 * (1 << (bits - 8))) / (224.0 * (1 << (bits - 8)));
        re += w * signal * cos(2 * M_PI * f * 2 * k + phase);
        im += w * signal * sin(2 * M_PI * f * 2 * k + phase);
        weights += w;
    }
    return 2 * hypot(re, im) / weights / 0.25;
}

static void gratings_at_16_bits(void **state) {
    (void)state;
    double ripple = 0, leak = 0;
    for (int i = 1; i < 480; i++) {
        double f = i / 960.0 + 1e-4, phase = 0.1 * i;
        /* next to 0 and to the output's own limit the grating and its mirror image overlap */
        if (f < 0.006 || fabs(f - 0.25) < 0.006 || f > 0.494) continue;
        double r = through_encoder(WF_CHROMA_BT601, 16, f, phase);
        assert_true(fabs(r - response(wf_chroma_filter_of(WF_CHROMA_BT601), f, NULL)) < 5e-5 ||
                    fabs(r + response(wf_chroma_filter_of(WF_CHROMA_BT601), f, NULL)) < 5e-5);
        if (f <= PASS_END) ripple = fmax(ripple, fabs(decibels(r)));
        if (f >= STOP_START) leak = fmax(leak, r);
    }
    print_message("gratings at 16 bits: ripple %.4f dB, stop band %.2f dB\n", ripple,
                  decibels(leak));
    assert_true(ripple <= 0.05);
    assert_true(decibels(leak) <= -55);
}

static void gratings_of_the_cheap_ones(void **state) {
    (void)state;
    for (int i = 8; i < 470; i += 7) {
        double f = i / 960.0, cosine = cos(M_PI * f);
        if (fabs(f - 0.25) < 0.006) continue;
        assert_true(fabs(through_encoder(WF_CHROMA_BOX, 16, f, 0.3) - cosine) < 1e-4);
        assert_true(fabs(through_encoder(WF_CHROMA_121, 16, f, 0.3) - cosine * cosine) < 1e-4);
    }
}

/* ---- Edges ---- */

/* The sample of a line that goes c b | a b c at its ends, by its period. */
static double endless(const float *line, int width, int n) {
    int period = 2 * (width - 1), m = n % period;
    if (m < 0) m += period;
    return (double)line[m < width ? m : period - m];
}

static void check_width(const wf_chroma_filter *filter, int width) {
    float line[256], kept[256], scratch[1024];
    unsigned seed = (unsigned)width;
    for (int n = 0; n < width; n++) {
        seed = seed * 1664525 + 1013904223;
        line[n] = kept[n] = (float)(seed >> 8) * 0x1p-24f - 0.5f;
    }
    size_t capacity = wf_chroma_scratch((size_t)width);
    assert_true(capacity < 1023);
    scratch[capacity] = 42;
    wf_chroma_decimate(filter, line, (size_t)width, scratch);
    assert_true(scratch[capacity] == 42);
    for (int k = 0; k < width / 2; k++) {
        double want = 0;
        for (int n = -REACH; n <= REACH; n++)
            want += tap(filter, n) * endless(kept, width, 2 * k + n);
        assert_true(fabs((double)line[k] - want) < 3e-7);
    }
}

static void edges_and_widths(void **state) {
    (void)state;
    const wf_chroma kinds[] = {WF_CHROMA_BT601, WF_CHROMA_121, WF_CHROMA_BOX};
    for (int k = 0; k < 3; k++)
        for (int width = 2; width <= 200; width += width < 44 ? 2 : 26)
            check_width(wf_chroma_filter_of(kinds[k]), width);
}

static void a_flat_line_stays_flat(void **state) {
    (void)state;
    float line[64], scratch[256];
    for (int i = 0; i < 100; i++) {
        float level = (float)i * 0.0101f - 0.5f;
        for (int n = 0; n < 64; n++) line[n] = level;
        wf_chroma_decimate(wf_chroma_filter_of(WF_CHROMA_BT601), line, 64, scratch);
        for (int n = 0; n < 32; n++) assert_true(fabsf(line[n] - level) <= 1.2e-7f);
    }
}

/* ---- 4:2:0 ---- */

enum { ROWS = 64, ACROSS = 3 };

/* Codes of a straight slope down the frame, 100 a line: a row of 4:2:0 is the slope at its
 * place, in lines of the frame, but near the edges. */
static void rows_of_420_lie_where_they_belong(void **state) {
    (void)state;
    static uint16_t code[ROWS][ACROSS];
    uint16_t row[ACROSS];
    for (int y = 0; y < ROWS; y++)
        for (int x = 0; x < ACROSS; x++) code[y][x] = (uint16_t)(20000 + 100 * y + 7 * x);
    for (int woven = 0; woven < 2; woven++)
        for (int k = 4; k < ROWS / 2 - 4; k++) {
            double place = 2 * k + 0.5; /* of a frame */
            if (woven) place = 4 * (k / 2) + (k % 2 ? 2.5 : 0.5);
            wf_chroma_420_row(code[0], ACROSS, ROWS, ACROSS, k, woven, 1, 65000, row);
            for (int x = 0; x < ACROSS; x++)
                assert_true(fabs(row[x] - (20000 + 100 * place + 7 * x)) <= 4);
        }
}

/* What alternates from line to line of its field is gone, what does not change stays, and
 * nothing leaves the range. */
static void rows_of_420_are_filtered(void **state) {
    (void)state;
    static uint16_t code[ROWS][ACROSS];
    uint16_t row[ACROSS];
    for (int woven = 0; woven < 2; woven++) {
        for (int y = 0; y < ROWS; y++)
            for (int x = 0; x < ACROSS; x++) {
                int line = woven ? y / 2 : y;
                code[y][x] = (uint16_t)(x == 0   ? 512
                                        : x == 1 ? 512 + (line % 2 ? -400 : 400)
                                        : y < 32 ? 4
                                                 : 1019);
            }
        for (int k = 0; k < ROWS / 2; k++) {
            wf_chroma_420_row(code[0], ACROSS, ROWS, ACROSS, k, woven, 4, 1019, row);
            assert_int_equal(row[0], 512);
            bool inner = k >= 8 && k < ROWS / 2 - 8;
            if (inner) assert_true(abs(row[1] - 512) <= 12);
            assert_in_range(row[2], 4, 1019);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(taps_add_up_to_one),
        cmocka_unit_test(template_by_transform),
        cmocka_unit_test(the_cheap_ones),
        cmocka_unit_test(gratings_at_16_bits),
        cmocka_unit_test(gratings_of_the_cheap_ones),
        cmocka_unit_test(edges_and_widths),
        cmocka_unit_test(a_flat_line_stays_flat),
        cmocka_unit_test(rows_of_420_lie_where_they_belong),
        cmocka_unit_test(rows_of_420_are_filtered),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
