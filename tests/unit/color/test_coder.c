/* Pictures through the composite coder and its decoders. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "color/composite/coder.h"
#include "color/composite/decode.h"
#include "color/composite/encode.h"
#include "color/composite/subcarrier.h"

/* ---- A television at work ---- */

typedef struct set {
    wf_composite *c;
    int width, lines;
    float *in[3], *out[3]; /* [lines][width] */
    float *composite, *scratch;
} set;

static const wf_tv studio[] = {
    [WF_NTSC] = {.system = WF_NTSC, .width_px = 720, .lines = 40, .line1 = 21, .line2 = 283},
    [WF_PAL] = {.system = WF_PAL,
                .width_px = 720,
                .lines = 40,
                .line1 = 23,
                .line2 = 336,
                .top_first = true},
};

static wf_tv tv_of(wf_tv_system system, wf_tv_encoder encoder, wf_tv_decoder decoder) {
    wf_tv tv = studio[system];
    tv.encoder = encoder;
    tv.decoder = decoder;
    return tv;
}

static float *floats(size_t count) {
    float *made = calloc(count, sizeof *made);
    assert_non_null(made);
    return made;
}

static set set_up(wf_tv tv) {
    set s = {.c = wf_composite_new(&tv), .width = tv.width_px, .lines = tv.lines};
    assert_non_null(s.c);
    size_t area = (size_t)tv.width_px * (size_t)tv.lines;
    for (int p = 0; p < 3; p++) {
        s.in[p] = floats(area);
        s.out[p] = floats(area);
    }
    s.composite = floats(wf_composite_row(s.c) * (size_t)tv.lines);
    s.scratch = floats(wf_composite_scratch(s.c)); /* exactly: a sanitizer watches its ends */
    return s;
}

static void tear_down(set *s) {
    for (int p = 0; p < 3; p++) {
        free(s->in[p]);
        free(s->out[p]);
    }
    free(s->composite);
    free(s->scratch);
    wf_composite_free(s->c);
}

static void show(set *s, int64_t frame) {
    wf_composite_encode(s->c, frame, s->in, s->composite, s->scratch);
    wf_composite_decode(s->c, frame, s->composite, s->out, s->scratch);
}

static size_t at(const set *s, int line, int x) {
    return (size_t)line * (size_t)s->width + (size_t)x;
}

static double noise(unsigned *seed) {
    *seed = *seed * 1664525 + 1013904223;
    return (double)(*seed >> 8) * 0x1p-24;
}

static void fill_noise(set *s, unsigned seed) {
    size_t area = (size_t)s->width * (size_t)s->lines;
    for (int p = 0; p < 3; p++)
        for (size_t i = 0; i < area; i++) s->in[p][i] = (float)(noise(&seed) - (p ? 0.5 : 0));
}

static void fill_flat(set *s, const double color[3]) {
    size_t area = (size_t)s->width * (size_t)s->lines;
    for (int p = 0; p < 3; p++)
        for (size_t i = 0; i < area; i++) s->in[p][i] = (float)color[p];
}

/* Combination i of 12 of the systems, encoders and decoders. */
static wf_tv combination(int i) {
    return tv_of((wf_tv_system)(i % 2), (wf_tv_encoder)(i / 2 % 2), (wf_tv_decoder)(i / 4));
}
enum { COMBINATIONS = 12 };

/* ---- Against the definition, in double ---- */

static int mirrored(int x, int width) {
    int period = 2 * (width - 1), m = period ? abs(x) % period : 0;
    return m < width ? m : period - m;
}

static double angle(const set *s, int64_t frame, int line, int x) {
    wf_subcarrier sub = wf_subcarrier_at(s->c, frame, line, x);
    return 2 * M_PI * (double)sub.num / (double)sub.den;
}

static int v_sign(const set *s, int64_t frame, int line) {
    return wf_subcarrier_at(s->c, frame, line, 0).v_sign;
}

static double filtered(const set *s, const wf_fir *fir, const float *plane, int line, int x) {
    double sum = 0;
    for (int k = -fir->reach; k <= fir->reach; k++)
        sum += (double)fir->tap[abs(k)] *
               (double)plane[at(s, line, mirrored(abs(x + k), s->width))];
    return sum;
}

static double coded(const set *s, int64_t frame, int line, int x) {
    double a = angle(s, frame, line, x),
           y = s->c->tv.encoder == WF_ENCODER_FILTERED
                   ? filtered(s, &s->c->stop, s->in[0], line, x)
                   : (double)s->in[0][at(s, line, mirrored(abs(x), s->width))];
    /* 0.872021 and 1.229951: 2 (1 - Kb) 0.492111 and 2 (1 - Kr) 0.877283 */
    return y + 0.872020692 * filtered(s, wf_fir_chroma(), s->in[1], line, x) * sin(a) +
           1.229950766 * filtered(s, wf_fir_chroma(), s->in[2], line, x) * cos(a) *
               v_sign(s, frame, line);
}

/* U (part 1) or V (part 2) of a line before the comb. */
static double demodulated(const set *s, int64_t frame, int line, int x, int part) {
    const wf_fir *fir = wf_fir_chroma();
    const float *row =
        s->composite + (size_t)line * wf_composite_row(s->c) + wf_composite_margin(s->c);
    double sum = 0;
    for (int k = -fir->reach; k <= fir->reach; k++) {
        double a = angle(s, frame, line, x + k);
        double carrier = part == 1 ? sin(a) : cos(a) * v_sign(s, frame, line);
        sum += (double)fir->tap[abs(k)] * 2 * (double)row[x + k] * carrier;
    }
    return sum;
}

static double combed(const set *s, int64_t frame, int line, int x, int part) {
    int step = s->c->tv.system == WF_NTSC ? 2 : 4;
    double own = demodulated(s, frame, line, x, part);
    int before = line - step, after = line + step;
    if (s->c->tv.decoder == WF_DECODER_NOTCH) return own;
    if (before < 0) before = after;
    if (after >= s->lines) after = before;
    if (before >= s->lines) return own;
    double other = demodulated(s, frame, before, x, part);
    if (s->c->tv.decoder == WF_DECODER_COMB3)
        other = (other + demodulated(s, frame, after, x, part)) / 2;
    return (own + other) / 2;
}

static void check_by_definition(wf_tv tv, unsigned seed) {
    set s = set_up(tv);
    int64_t frame = seed % 7;
    int margin = (int)wf_composite_margin(s.c);
    fill_noise(&s, seed);
    show(&s, frame);
    for (int line = 0; line < s.lines; line++) {
        const float *row = s.composite + (size_t)line * wf_composite_row(s.c) + margin;
        for (int x = -margin; x < s.width + margin; x++)
            assert_true(fabs((double)row[x] - coded(&s, frame, line, x)) < 3e-6);
        for (int x = 0; x < s.width; x++) {
            double a = angle(&s, frame, line, x), u = combed(&s, frame, line, x, 1),
                   v = combed(&s, frame, line, x, 2);
            double y = (double)row[x] - u * sin(a) - v * cos(a) * v_sign(&s, frame, line);
            assert_true(fabs((double)s.out[0][at(&s, line, x)] - y) < 3e-6);
            assert_true(fabs((double)s.out[1][at(&s, line, x)] - u / 0.872020692) < 3e-6);
            assert_true(fabs((double)s.out[2][at(&s, line, x)] - v / 1.229950766) < 3e-6);
        }
    }
    tear_down(&s);
}

static void by_definition(void **state) {
    (void)state;
    const int sizes[][2] = {{1, 1}, {2, 3}, {7, 2}, {19, 5}, {64, 11}};
    for (int i = 0; i < COMBINATIONS; i++)
        for (int k = 0; k < 5; k++) {
            wf_tv tv = combination(i);
            tv.width_px = sizes[k][0];
            tv.lines = sizes[k][1];
            check_by_definition(tv, (unsigned)(i * 5 + k));
        }
}

/* ---- Colors ---- */

static void flat_colors_come_back(void **state) {
    (void)state;
    unsigned seed = 5;
    double worst = 0;
    for (int i = 0; i < COMBINATIONS; i++) {
        set s = set_up(combination(i));
        for (int frame = 0; frame < 5; frame++) {
            double color[3] = {noise(&seed), noise(&seed) - 0.5, noise(&seed) - 0.5};
            fill_flat(&s, color);
            show(&s, frame);
            for (int p = 0; p < 3; p++)
                for (size_t k = 0; k < (size_t)s.width * (size_t)s.lines; k++)
                    worst = fmax(worst, fabs((double)s.out[p][k] - color[p]));
        }
        tear_down(&s);
    }
    print_message("flat colors: off by %.2g at most\n", worst);
    assert_true(worst < 2e-6);
}

/* White, yellow, cyan, green, magenta, red, blue, black, 90 samples each. */
static void bar(int index, double level, double color[3]) {
    double g = index < 4 ? level : 0, r = index % 4 < 2 ? level : 0,
           b = index % 2 == 0 ? level : 0;
    color[0] = 0.299 * r + 0.587 * g + 0.114 * b;
    color[1] = (b - color[0]) / 1.772;
    color[2] = (r - color[0]) / 1.402;
}

static void fill_bars(set *s, double level) {
    for (int line = 0; line < s->lines; line++)
        for (int x = 0; x < s->width; x++) {
            double color[3];
            bar(x / 90, level, color);
            for (int p = 0; p < 3; p++) s->in[p][at(s, line, x)] = (float)color[p];
        }
}

static double worst_in_bars(const set *s, double level, int edge) {
    double worst = 0;
    for (int line = 0; line < s->lines; line++)
        for (int x = 0; x < s->width; x++) {
            double color[3];
            bar(x / 90, level, color);
            if (x % 90 < edge || x % 90 >= 90 - edge) continue;
            for (int p = 0; p < 3; p++)
                worst = fmax(worst, fabs((double)s->out[p][at(s, line, x)] - color[p]));
        }
    return worst;
}

static void bars_come_back(void **state) {
    (void)state;
    for (int i = 0; i < COMBINATIONS; i++)
        for (int full = 0; full < 2; full++) {
            set s = set_up(combination(i));
            double level = full ? 1 : 0.75;
            fill_bars(&s, level);
            show(&s, i);
            /* nothing reaches further than both ends' filters; most ends long before */
            assert_true(worst_in_bars(&s, level, 31) < 2e-6);
            assert_true(worst_in_bars(&s, level, 20) < 0.01);
            assert_true(worst_in_bars(&s, level, 2) > 0.01);
            tear_down(&s);
        }
}

/* Horizontal stripes of color come back, but on the lines next to their edges, where combs mix
 * in the neighbors' color. */
static void stripes_come_back(void **state) {
    (void)state;
    const double colors[2][3] = {{0.3, -0.2, 0.3}, {0.6, 0.25, -0.1}};
    for (int i = 0; i < COMBINATIONS; i++) {
        set s = set_up(combination(i));
        fill_flat(&s, colors[0]);
        for (int p = 0; p < 3; p++)
            for (size_t k = at(&s, 20, 0); k < at(&s, 40, 0); k++)
                s.in[p][k] = (float)colors[1][p];
        show(&s, 1);
        for (int line = 0; line < 40; line++) {
            if (abs(2 * line - 39) < 8) continue;
            for (int p = 0; p < 3; p++)
                assert_true(fabs((double)s.out[p][at(&s, line, 300)] - colors[line >= 20][p]) <
                            2e-6);
        }
        tear_down(&s);
    }
}

/* ---- Gratings ---- */

static const double mhz[] = {[WF_NTSC] = 315.0 / 88, [WF_PAL] = 4.43361875};

static double grating_angle(double f_mhz, int x) {
    return 2 * M_PI * f_mhz / 13.5 * x + 0.7;
}

static void fill_grating(set *s, double f_mhz, double amplitude) {
    fill_flat(s, (const double[]){0.5, 0, 0});
    for (int line = 0; line < s->lines; line++)
        for (int x = 0; x < s->width; x++)
            s->in[0][at(s, line, x)] = (float)(0.5 + amplitude * cos(grating_angle(f_mhz, x)));
}

/* The most chroma, sqrt(U^2 + V^2), away from the edges, where the grating is reflected, and
 * `from` lines from top and bottom. */
static double most_chroma(const set *s, int from) {
    double most = 0;
    for (int line = from; line < s->lines - from; line++)
        for (int x = 50; x < s->width - 50; x++)
            most = fmax(most, hypot(0.872020692 * (double)s->out[1][at(s, line, x)],
                                    1.229950766 * (double)s->out[2][at(s, line, x)]));
    return most;
}

static double cross_color(wf_tv tv, double f_mhz, int from) {
    set s = set_up(tv);
    fill_grating(&s, f_mhz, 0.25);
    show(&s, 2);
    double most = most_chroma(&s, from) / 0.25;
    tear_down(&s);
    return most;
}

/* cos(a + psi) = cos psi cos a - sin psi sin a: V cos psi, U -sin psi, and no luma. */
static void grating_at_the_subcarrier(void **state) {
    (void)state;
    for (int system = 0; system < 2; system++) {
        set s = set_up(tv_of((wf_tv_system)system, WF_ENCODER_CHEAP, WF_DECODER_NOTCH));
        fill_grating(&s, mhz[system], 0.3);
        show(&s, 3);
        for (int line = 0; line < s.lines; line++)
            for (int x = 50; x < 670; x++) {
                double psi = grating_angle(mhz[system], x) - angle(&s, 3, line, x);
                double u = -0.3 * sin(psi), v = 0.3 * cos(psi) * v_sign(&s, 3, line);
                assert_true(fabs((double)s.out[0][at(&s, line, x)] - 0.5) < 3e-6);
                assert_true(fabs(0.872020692 * (double)s.out[1][at(&s, line, x)] - u) < 3e-6);
                assert_true(fabs(1.229950766 * (double)s.out[2][at(&s, line, x)] - v) < 3e-6);
            }
        tear_down(&s);
        wf_tv filtered_tv = tv_of((wf_tv_system)system, WF_ENCODER_FILTERED, WF_DECODER_NOTCH);
        assert_true(cross_color(filtered_tv, mhz[system], 0) < 1e-5);
    }
}

static double fir_response(const wf_fir *fir, double f_mhz) {
    double sum = (double)fir->tap[0];
    for (int k = 1; k <= fir->reach; k++)
        sum += 2 * (double)fir->tap[k] * cos(2 * M_PI * f_mhz / 13.5 * k);
    return sum;
}

/* Off the subcarrier the notch takes for color what the low-pass of chroma passes (its mirror
 * image adds less than 1 %). After the filtered encoder little is left, half way down both
 * slopes. */
static void gratings_near_the_subcarrier(void **state) {
    (void)state;
    double most = 0;
    for (int system = 0; system < 2; system++)
        for (double off = -2.2; off <= 2.2; off += 0.2) {
            wf_tv tv = tv_of((wf_tv_system)system, WF_ENCODER_CHEAP, WF_DECODER_NOTCH);
            double through = cross_color(tv, mhz[system] + off, 0);
            assert_true(fabs(through - fabs(fir_response(wf_fir_chroma(), off))) < 0.01);
            tv.encoder = WF_ENCODER_FILTERED;
            double left = cross_color(tv, mhz[system] + off, 0);
            most = fmax(most, left);
            if (fabs(off) < 1.35) assert_true(left < 0.015);
        }
    print_message("filtered encoder: at most %.3f of a luma grating becomes color\n", most);
    assert_true(most < 0.14);
}

/* Upright gratings are the same on all lines, while the subcarrier turns by half a cycle, so
 * that combs take nothing of them for color but what PAL's 25 Hz offset (1.152 degrees in two
 * lines) leaves. */
static void combs_know_upright_gratings(void **state) {
    (void)state;
    const double off = 1.152 / 180 * M_PI, one_side = sin(off / 2), both = (1 - cos(off)) / 2;
    for (int system = 0; system < 2; system++) {
        wf_tv tv = tv_of((wf_tv_system)system, WF_ENCODER_CHEAP, WF_DECODER_COMB2);
        double share = system == WF_PAL;
        assert_true(fabs(cross_color(tv, mhz[system], 0) - share * one_side) < 1e-5);
        tv.decoder = WF_DECODER_COMB3;
        assert_true(fabs(cross_color(tv, mhz[system], 4) - share * both) < 1e-5);
        /* the first and last lines have a neighbor on one side only */
        assert_true(fabs(cross_color(tv, mhz[system], 0) - share * one_side) < 1e-5);
    }
}

/* Chroma's response, once through the coder and once through the decoder. */
static void chroma_is_narrow(void **state) {
    (void)state;
    for (int system = 0; system < 2; system++)
        for (double f = 0.1; f < 3.7; f += f < 1.25 ? 0.4 : 2.3) {
            set s = set_up(tv_of((wf_tv_system)system, WF_ENCODER_CHEAP, WF_DECODER_COMB3));
            double most = 0;
            fill_flat(&s, (const double[]){0.5, 0, 0});
            for (int line = 0; line < s.lines; line++)
                for (int x = 0; x < 720; x++)
                    s.in[1][at(&s, line, x)] = (float)(0.4 * cos(2 * M_PI * f / 13.5 * x));
            show(&s, 1);
            for (int x = 50; x < 670; x++)
                most = fmax(most, fabs((double)s.out[1][at(&s, 20, x)]));
            double want = fir_response(wf_fir_chroma(), f);
            assert_true(fabs(most / 0.4 - want * want) < 0.01);
            tear_down(&s);
        }
}

/* ---- Time and space ---- */

/* False colors shimmer: those of a still are their opposites in the next frame (NTSC) or in the
 * one after it (PAL). */
static void false_colors_alternate(void **state) {
    (void)state;
    for (int system = 0; system < 2; system++) {
        int half = system == WF_NTSC ? 1 : 2;
        set s = set_up(tv_of((wf_tv_system)system, WF_ENCODER_CHEAP, WF_DECODER_NOTCH));
        size_t area = (size_t)s.width * (size_t)s.lines;
        fill_noise(&s, 9);
        memset(s.in[1], 0, area * sizeof(float));
        memset(s.in[2], 0, area * sizeof(float));
        float *first = floats(area);
        show(&s, 0);
        memcpy(first, s.out[1], area * sizeof(float));
        assert_true(most_chroma(&s, 0) > 0.1);
        show(&s, half);
        for (size_t i = 0; i < area; i++)
            assert_true(fabs((double)first[i] + (double)s.out[1][i]) < 3e-6);
        show(&s, 2 * half);
        assert_memory_equal(first, s.out[1], area * sizeof(float));
        free(first);
        tear_down(&s);
    }
}

static void all_is_linear(void **state) {
    (void)state;
    for (int i = 0; i < COMBINATIONS; i++) {
        set s[3] = {set_up(combination(i)), set_up(combination(i)), set_up(combination(i))};
        size_t area = (size_t)s[0].width * (size_t)s[0].lines;
        fill_noise(&s[0], 1);
        fill_noise(&s[1], 2);
        for (int p = 0; p < 3; p++)
            for (size_t k = 0; k < area; k++)
                s[2].in[p][k] = 0.75f * s[0].in[p][k] - 0.5f * s[1].in[p][k];
        for (int k = 0; k < 3; k++) show(&s[k], 1);
        for (int p = 0; p < 3; p++)
            for (size_t k = 0; k < area; k++)
                assert_true(fabsf(s[2].out[p][k] - 0.75f * s[0].out[p][k] +
                                  0.5f * s[1].out[p][k]) < 3e-6f);
        for (int k = 0; k < 3; k++) tear_down(&s[k]);
    }
}

static void fields_do_not_mix(void **state) {
    (void)state;
    for (int i = 0; i < COMBINATIONS; i++) {
        set s = set_up(combination(i));
        size_t line_bytes = (size_t)s.width * sizeof(float);
        float *before = floats((size_t)s.width * (size_t)s.lines);
        fill_noise(&s, 3);
        show(&s, 0);
        memcpy(before, s.out[0], line_bytes * (size_t)s.lines);
        for (int line = 1; line < s.lines; line += 2)
            for (int p = 0; p < 3; p++) memset(&s.in[p][at(&s, line, 0)], 0, line_bytes);
        show(&s, 0);
        for (int line = 0; line < s.lines; line += 2)
            assert_memory_equal(&before[at(&s, line, 0)], &s.out[0][at(&s, line, 0)],
                                line_bytes);
        assert_memory_not_equal(&before[at(&s, 1, 0)], &s.out[0][at(&s, 1, 0)], line_bytes);
        free(before);
        tear_down(&s);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(by_definition),
        cmocka_unit_test(flat_colors_come_back),
        cmocka_unit_test(bars_come_back),
        cmocka_unit_test(stripes_come_back),
        cmocka_unit_test(grating_at_the_subcarrier),
        cmocka_unit_test(gratings_near_the_subcarrier),
        cmocka_unit_test(combs_know_upright_gratings),
        cmocka_unit_test(chroma_is_narrow),
        cmocka_unit_test(false_colors_alternate),
        cmocka_unit_test(all_is_linear),
        cmocka_unit_test(fields_do_not_mix),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
