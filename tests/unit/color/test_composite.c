/* Composite video's arithmetic: line numbers, the subcarrier's phase and its sequences, the V
 * switch, bursts, and what the filters pass. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "color/composite/coder.h"
#include "color/composite/subcarrier.h"
#include "filters/raster/raster.h"

/* A raster's picture lines and their numbers, worked out by hand from its map. */
typedef struct numbered {
    const char *raster;
    wf_tv_system system;
    int top[2], bottom[2]; /* numbers of the first two and of the last two picture lines */
} numbered;

static const numbered rasters[] = {
    {"525i", WF_NTSC, {283, 21}, {525, 263}},    {"525i-imx", WF_NTSC, {20, 283}, {262, 525}},
    {"525i-dv", WF_NTSC, {285, 23}, {524, 262}}, {"525i-rp202", WF_NTSC, {23, 286}, {262, 525}},
    {"625i", WF_PAL, {23, 336}, {310, 623}},     {"625i-dv", WF_PAL, {335, 23}, {622, 310}},
};
enum { RASTERS = sizeof rasters / sizeof *rasters };

static wf_composite *coder_of(const char *name, wf_tv_system system) {
    wf_raster r;
    char why[256];
    assert_true(wf_raster_parse(name, &r, why, sizeof why));
    assert_int_equal(r.total_lines, wf_tv_standard_of(system)->total_lines);
    wf_composite *c = wf_composite_new(&(wf_tv){.system = system,
                                                .width_px = r.width_px,
                                                .lines = r.lines,
                                                .line1 = r.line1,
                                                .line2 = r.line2,
                                                .top_first = r.top_first});
    assert_non_null(c);
    return c;
}

static int lines_of(const char *name) {
    wf_raster r;
    char why[256];
    assert_true(wf_raster_parse(name, &r, why, sizeof why));
    return r.lines;
}

/* ---- Lines and phases ---- */

static void lines_have_their_numbers(void **state) {
    (void)state;
    for (int i = 0; i < RASTERS; i++) {
        const numbered *r = &rasters[i];
        wf_composite *c = coder_of(r->raster, r->system);
        for (int k = 0; k < 2; k++) {
            int last = lines_of(r->raster) - 2 + k;
            assert_int_equal(wf_subcarrier_at(c, 5, k, 0).line_number, r->top[k]);
            assert_int_equal(wf_subcarrier_at(c, 5, last, 0).line_number, r->bottom[k]);
            assert_int_equal(wf_subcarrier_at(c, 5, 10 + k, 0).line_number, r->top[k] + 5);
        }
        wf_composite_free(c);
    }
}

/* Samples since 0H of line 1 of frame 0, and the cycles there are in them: 315/88 MHz and
 * 4433618.75 Hz at 13.5 MHz. */
static __int128 samples_since(const numbered *r, int64_t frame, int number, int sample) {
    if (r->system == WF_NTSC) return ((__int128)frame * 525 + number - 1) * 858 + 122 + sample;
    return ((__int128)frame * 625 + number - 1) * 864 + 132 + sample;
}

static void check_phase(const wf_composite *c, const numbered *r, int64_t frame, int line,
                        int sample) {
    wf_subcarrier at = wf_subcarrier_at(c, frame, line, sample);
    __int128 samples = samples_since(r, frame, at.line_number, sample);
    __int128 num = r->system == WF_NTSC ? 315000000 : 443361875;
    __int128 den = r->system == WF_NTSC ? (__int128)88 * 13500000 : 1350000000;
    __int128 part = samples * num % den;
    assert_true(at.num >= 0 && at.num < at.den);
    assert_true(part * at.den == at.num * den);
}

static void phase_follows_time(void **state) {
    (void)state;
    const int64_t frames[] = {0, 1, 2, 3, 4, 5, 29, 107892, 9999999999};
    for (int i = 0; i < RASTERS; i++) {
        wf_composite *c = coder_of(rasters[i].raster, rasters[i].system);
        for (size_t f = 0; f < sizeof frames / sizeof *frames; f++)
            for (int line = 0; line < lines_of(rasters[i].raster); line += 37)
                for (int sample = -12; sample < 732; sample += 31)
                    check_phase(c, &rasters[i], frames[f], line, sample);
        wf_composite_free(c);
    }
}

static void phase_at_the_datum(void **state) {
    (void)state;
    wf_composite *ntsc = coder_of("525i", WF_NTSC), *pal = coder_of("625i", WF_PAL);
    /* Line 21 of color frame A starts with a whole cycle, as line 1 does, line 22 half way. */
    assert_int_equal(wf_subcarrier_at(ntsc, 0, 1, -122).num, 0);
    wf_subcarrier at = wf_subcarrier_at(ntsc, 0, 3, -122);
    assert_int_equal(2 * at.num, at.den);
    /* 22 lines of 283.7516 cycles are 6242.5352. */
    at = wf_subcarrier_at(pal, 0, 0, -132);
    assert_int_equal(at.line_number, 23);
    assert_int_equal(at.num * 10000, 5352 * at.den);
    wf_composite_free(ntsc);
    wf_composite_free(pal);
}

static double phase(const wf_composite *c, int64_t frame, int line, int sample) {
    wf_subcarrier at = wf_subcarrier_at(c, frame, line, sample);
    return (double)at.num / (double)at.den;
}

/* From one phase to another, 0 <= cycles < 1. */
static double advance(double from, double to) {
    return to - from - floor(to - from);
}

static void frames_form_sequences(void **state) {
    (void)state;
    wf_composite *ntsc = coder_of("525i", WF_NTSC), *pal = coder_of("625i", WF_PAL);
    for (int line = 0; line < 480; line += 7) {
        for (int frame = 0; frame < 9; frame++) {
            double turn = advance(phase(ntsc, 0, line, 5), phase(ntsc, frame, line, 5));
            assert_true(fabs(turn - (frame % 2 ? 0.5 : 0)) < 1e-12);
            turn = advance(phase(pal, 0, line, 5), phase(pal, frame, line, 5));
            assert_true(fabs(turn - 0.75 * frame + floor(0.75 * frame)) < 1e-12);
        }
    }
    wf_composite_free(ntsc);
    wf_composite_free(pal);
}

static void lines_of_a_field_follow(void **state) {
    (void)state;
    for (int i = 0; i < RASTERS; i++) {
        wf_composite *c = coder_of(rasters[i].raster, rasters[i].system);
        double line_turn = rasters[i].system == WF_NTSC ? 180 : 270.576;
        for (int line = 0; line + 2 < lines_of(rasters[i].raster); line++) {
            double turn = 360 * advance(phase(c, 1, line, 0), phase(c, 1, line + 2, 0));
            assert_true(fabs(turn - line_turn) < 1e-9);
        }
        wf_composite_free(c);
    }
}

static void v_switches_on_every_line(void **state) {
    (void)state;
    wf_composite *c = coder_of("625i", WF_PAL);
    for (int frame = 0; frame < 8; frame++)
        for (int line = 0; line < 576; line++) {
            wf_subcarrier at = wf_subcarrier_at(c, frame, line, 0);
            bool plus = (at.line_number % 2 == 1) == (frame % 2 == 0);
            assert_int_equal(at.v_sign, plus ? 1 : -1);
            assert_int_equal(at.burst_degrees, plus ? 135 : 225); /* -U + V, -U - V */
        }
    wf_composite_free(c);
    c = coder_of("525i", WF_NTSC);
    for (int line = 0; line < 486; line++) {
        assert_int_equal(wf_subcarrier_at(c, 1, line, 0).v_sign, 1);
        assert_int_equal(wf_subcarrier_at(c, 1, line, 0).burst_degrees, 180);
    }
    wf_composite_free(c);
}

/* The carriers are sin a and +-cos a. */
static void carriers_by_the_phase(void **state) {
    (void)state;
    static float sine[1024], cosine[1024];
    for (int i = 0; i < RASTERS; i++) {
        wf_composite *c = coder_of(rasters[i].raster, rasters[i].system);
        int margin = (int)wf_composite_margin(c);
        for (int line = 0; line < 20; line++) {
            wf_subcarrier_row(c, 3, line, sine, cosine);
            for (int s = -margin; s < 720 + margin; s++) {
                double a = 2 * M_PI * phase(c, 3, line, s);
                int sign = wf_subcarrier_at(c, 3, line, s).v_sign;
                assert_true(fabs((double)sine[s + margin] - sin(a)) < 3e-7);
                assert_true(fabs((double)cosine[s + margin] - sign * cos(a)) < 3e-7);
            }
        }
        wf_composite_free(c);
    }
}

/* ---- Filters ---- */

static double response(const wf_fir *fir, double mhz) {
    double sum = (double)fir->tap[0];
    for (int k = 1; k <= fir->reach; k++)
        sum += 2 * (double)fir->tap[k] * cos(2 * M_PI * mhz / 13.5 * k);
    return sum;
}

static double decibels(double ratio) {
    return 20 * log10(fabs(ratio) + 1e-30);
}

static const double ntsc_mhz = 315.0 / 88, pal_mhz = 4.43361875;

static void filters_are_as_said(void **state) {
    (void)state;
    const wf_fir *chroma = wf_fir_chroma(), *luma = wf_fir_luma();
    const double zeros[] = {ntsc_mhz, pal_mhz, 2 * ntsc_mhz, 2 * pal_mhz};
    for (int i = 0; i < 4; i++) {
        assert_true(fabs(response(chroma, zeros[i])) < 1e-7);
        assert_true(fabs(response(luma, zeros[i])) < 1e-7);
    }
    assert_true(fabs(response(chroma, 0) - 1) < 1e-7 && fabs(response(luma, 0) - 1) < 1e-7);
    double worst = -1000, far = -1000;
    for (double f = 0; f <= 6.75; f += 0.01) {
        double r = decibels(response(chroma, f)), w = decibels(response(luma, f));
        if (f <= 1.3) assert_true(r >= -2 && r <= 0.1 && fabs(w) <= 0.1);
        if (f >= 2.4) worst = fmax(worst, fmax(r, w));
        if (f >= 3) far = fmax(far, fmax(r, w));
    }
    print_message("chroma %.2f dB at 1.3, %.1f dB at 3.6 MHz; %.1f dB from 2.4, %.1f from 3\n",
                  decibels(response(chroma, 1.3)), decibels(response(chroma, 3.6)), worst, far);
    assert_true(decibels(response(chroma, 3.6)) <= -20 && worst <= -42 && far <= -56);
    assert_true(fabs(response(chroma, 1.65) - 0.5) < 0.02);
    assert_true(fabs(response(luma, 1.9) - 0.5) < 0.02);
}

static void filtered_luma_loses_the_band(void **state) {
    (void)state;
    for (int system = WF_NTSC; system <= WF_PAL; system++) {
        wf_composite *c = coder_of(system == WF_NTSC ? "525i" : "625i", (wf_tv_system)system);
        double fsc = system == WF_NTSC ? ntsc_mhz : pal_mhz, loss = 0;
        assert_true(fabs(response(&c->stop, 0) - 1) < 1e-6);
        assert_true(fabs(response(&c->stop, fsc)) < 1e-6);
        for (double off = -1.3; off <= 1.3; off += 0.01)
            loss = fmax(loss, fabs(response(&c->stop, fsc + off)));
        assert_true(loss < 0.03);
        assert_true(decibels(response(&c->stop, fsc - 2.5)) > -0.2);
        wf_composite_free(c);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_have_their_numbers),
        cmocka_unit_test(phase_follows_time),
        cmocka_unit_test(phase_at_the_datum),
        cmocka_unit_test(frames_form_sequences),
        cmocka_unit_test(lines_of_a_field_follow),
        cmocka_unit_test(v_switches_on_every_line),
        cmocka_unit_test(carriers_by_the_phase),
        cmocka_unit_test(filters_are_as_said),
        cmocka_unit_test(filtered_luma_loses_the_band),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
