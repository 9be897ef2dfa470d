/* Lines of color and codes, for test_isa.c. */
#include <math.h>

#include "color/codes/upsample.h"
#include "color/line/line.h"
#include "tests/unit/support/levels.h"

static const wf_line_ops *at(const level_run *r) {
    return wf_line_ops_at(r->level);
}

static void keep_planes(level_run *r, float *const rgb[3]) {
    for (int c = 0; c < 3; c++) level_keep_floats(r, rgb[c], r->count);
}

static float plain_within(float x, float most) {
    return isnan(x) ? 0 : x > -most ? x < most ? x : most : -most;
}

static void mix(level_run *r) {
    const wf_mix w = {{0.3, 0.05}, {0.07, 0.012}, {0.016, 0.088}};
    float *rgb[3];
    for (int c = 0; c < 3; c++) rgb[c] = level_floats(r, r->count);
    if (!r->plain) at(r)->mix(&w, rgb[0], rgb[1], rgb[2], r->count);
    for (size_t i = 0; r->plain && i < r->count; i++) {
        double v[3];
        for (int c = 0; c < 3; c++) v[c] = (double)plain_within(rgb[c][i], WF_MOST_LINEAR);
        double gr = v[1] - v[0], br = v[2] - v[0], bg = v[2] - v[1];
        rgb[0][i] = (float)(v[0] + (w.of_red[0] * gr + w.of_red[1] * br));
        rgb[1][i] = (float)(v[1] + (w.of_green[1] * bg - w.of_green[0] * gr));
        rgb[2][i] = (float)(v[2] - (w.of_blue[0] * br + w.of_blue[1] * bg));
    }
    keep_planes(r, rgb);
}

/* Light over eighty octaves, since a curve's error is of its octave; and around black. */
static void curve(level_run *r, const wf_curve *c) {
    float *light = level_floats(r, r->count);
    for (size_t i = 0; i < r->count; i++) {
        float octave = (float)exp2(floor(level_uniform(r, -60, 20)));
        if (fabsf(light[i]) <= 2 && i % 3) light[i] *= octave;
    }
    at(r)->curve[c->kind](c, light, r->count);
    level_keep_floats(r, light, r->count);
}

static void power_curves(level_run *r) {
    const wf_curve *const curves[] = {&wf_curve_bt1886, &wf_curve_bt709, &wf_curve_bt2020};
    curve(r, curves[level_draw(r) % 3]);
}

static void pq_curve(level_run *r) {
    curve(r, &wf_curve_pq);
}

static void hlg_curve(level_run *r) {
    curve(r, &wf_curve_hlg);
}

static void decode(level_run *r, const wf_curve *c) {
    float *signal = level_floats(r, r->count);
    at(r)->decode[c->kind](c, signal, r->count);
    level_keep_floats(r, signal, r->count);
}

static void power_decode(level_run *r) {
    const wf_curve *const curves[] = {&wf_curve_bt1886, &wf_curve_srgb, &wf_curve_bt2020};
    decode(r, curves[level_draw(r) % 3]);
}

static void pq_decode(level_run *r) {
    decode(r, &wf_curve_pq);
}

static void hlg_decode(level_run *r) {
    decode(r, &wf_curve_hlg);
}

static void ycbcr(level_run *r) {
    const wf_ycbcr w = wf_ycbcr_of((wf_luma)(level_draw(r) % 3));
    float *rgb[3];
    for (int c = 0; c < 3; c++) rgb[c] = level_floats(r, r->count);
    if (!r->plain) at(r)->ycbcr(&w, rgb[0], rgb[1], rgb[2], r->count);
    for (size_t i = 0; r->plain && i < r->count; i++) {
        float v[3];
        for (int c = 0; c < 3; c++) v[c] = plain_within(rgb[c][i], WF_MOST_SIGNAL);
        float luma = v[1] + (w.kr * (v[0] - v[1]) + w.kb * (v[2] - v[1]));
        rgb[0][i] = luma;
        rgb[1][i] = w.cb_scale * (v[2] - luma);
        rgb[2][i] = w.cr_scale * (v[0] - luma);
    }
    keep_planes(r, rgb);
}

static void deinterleave(level_run *r) {
    float *line = level_floats(r, 2 * r->count);
    float *even = level_floats(r, r->count), *odd = level_floats(r, r->count);
    if (!r->plain) at(r)->deinterleave(even, odd, line, r->count);
    for (size_t i = 0; r->plain && i < r->count; i++)
        even[i] = line[2 * i], odd[i] = line[2 * i + 1];
    level_keep_floats(r, even, r->count);
    level_keep_floats(r, odd, r->count);
}

static void half_band(level_run *r) {
    size_t pairs = level_draw(r) % 12;
    float *pair = level_floats(r, pairs), *even = level_floats(r, r->count);
    float *all = level_floats(r, r->count + 2 * pairs), *odd = all + pairs;
    float *out = level_floats(r, r->count);
    if (!r->plain) at(r)->half_band(out, even, odd, pair, pairs, r->count);
    for (size_t i = 0; r->plain && i < r->count; i++) {
        out[i] = 0.5f * even[i];
        for (size_t j = 0; j < pairs; j++)
            out[i] += pair[j] * (all[pairs + i + j] + all[pairs + i - 1 - j]);
    }
    level_keep_floats(r, out, r->count);
}

static void quantize(level_run *r) {
    static const wf_quantizer depths[] = {
        {219, 16, 1, 254}, {876, 64, 4, 1019}, {896, 512, 4, 1019}, {56064, 4096, 256, 65279}};
    const wf_quantizer q = depths[level_draw(r) % 4];
    float *signal = level_floats(r, r->count);
    uint16_t *code = level_halves(r, r->count);
    for (size_t i = 0; i < r->count; i += 4) /* halves of codes */
        signal[i] = (float)((floor(level_uniform(r, 0, 1000)) + 0.5 - q.offset) / q.scale);
    if (!r->plain) at(r)->quantize(&q, code, signal, r->count);
    for (size_t i = 0; r->plain && i < r->count; i++) {
        double level = isnan(signal[i]) ? q.offset : q.scale * (double)signal[i] + q.offset;
        code[i] = (uint16_t)floor(fmin(fmax(level, q.low), q.high) + 0.5);
    }
    level_keep_codes(r, code, r->count);
}

/* ---- From codes to R'G'B' ---- */

static const wf_upsample_ops *upsample_at(const level_run *r) {
    return wf_upsample_ops_at(r->level);
}

static void signals(level_run *r, bool fine) {
    uint16_t *code = level_halves(r, r->count);
    float *out = level_floats(r, r->count);
    double zero = 512, per_code = level_draw(r) % 2 ? 1 : 1 / 896.0;
    const wf_upsample_ops *ops = upsample_at(r);
    if (!r->plain)
        (fine ? &ops->fine : &ops->quick)->signals(out, code, zero, per_code, r->count);
    for (size_t i = 0; r->plain && i < r->count; i++)
        out[i] = fine ? (float)((code[i] - zero) * per_code)
                      : ((float)code[i] - 512.0f) * (float)per_code;
    level_keep_floats(r, out, r->count);
}

static void quick_signals(level_run *r) {
    signals(r, false);
}

static void fine_signals(level_run *r) {
    signals(r, true);
}

static void of_bytes(level_run *r, bool fine) {
    uint8_t *code = (uint8_t *)level_halves(r, r->count);
    float *out = level_floats(r, r->count);
    double zero = 16, per_code = level_draw(r) % 2 ? 1 : 1 / 219.0;
    const wf_upsample_ops *ops = upsample_at(r);
    if (!r->plain)
        (fine ? &ops->fine : &ops->quick)->of_bytes(out, code, zero, per_code, r->count);
    for (size_t i = 0; r->plain && i < r->count; i++)
        out[i] = fine ? (float)((code[i] - zero) * per_code)
                      : ((float)code[i] - 16.0f) * (float)per_code;
    level_keep_floats(r, out, r->count);
}

static void quick_of_bytes(level_run *r) {
    of_bytes(r, false);
}

static void fine_of_bytes(level_run *r) {
    of_bytes(r, true);
}

/* Along a line, whose ends are memory's, or down columns. */
static void weigh(level_run *r, bool fine) {
    wf_upsampler u;
    int factor = 1 << level_draw(r) % 3;
    wf_upsampler_init(&u, factor, level_draw(r) % 2);
    const wf_upsample_phase *p = &u.phase[level_draw(r) % (uint32_t)factor];
    size_t beyond = (size_t)(p->count - 1), step = level_draw(r) % 2 ? 1 : 19;
    float *chroma = level_floats(r, r->count + beyond * step);
    float *out = level_floats(r, r->count);
    const float *from = chroma - p->first * (ptrdiff_t)step;
    const wf_upsample_ops *ops = upsample_at(r);
    if (!r->plain)
        (fine ? &ops->fine : &ops->quick)->weigh(out, from, (ptrdiff_t)step, p, r->count);
    for (size_t i = 0; r->plain && i < r->count; i++) {
        double sum = 0;
        for (size_t k = 0; k <= beyond; k++)
            sum += p->fine_tap[k] * (double)chroma[i + k * step];
        out[i] = (float)sum;
    }
    level_keep_floats(r, out, r->count);
}

static void quick_weigh(level_run *r) {
    weigh(r, false);
}

static void fine_weigh(level_run *r) {
    weigh(r, true);
}

/* As one by one. */
static void weigh_pair(level_run *r, bool fine) {
    wf_upsampler u;
    wf_upsampler_init(&u, 2, true);
    size_t beyond = (size_t)(u.phase->count - 1), step = level_draw(r) % 2 ? 1 : 19;
    float *chroma = level_floats(r, r->count + beyond * step);
    float *out[2] = {level_floats(r, r->count), level_floats(r, r->count)};
    const float *from = chroma - u.phase->first * (ptrdiff_t)step;
    const wf_upsample_ops *ops = wf_upsample_ops_at(r->plain ? 0 : r->level);
    const wf_signal_loops *loops = fine ? &ops->fine : &ops->quick;
    if (!r->plain) loops->weigh_pair(out, from, (ptrdiff_t)step, u.phase, r->count);
    for (int p = 0; r->plain && p < 2; p++)
        loops->weigh(out[p], from, (ptrdiff_t)step, &u.phase[p], r->count);
    for (int p = 0; p < 2; p++) level_keep_floats(r, out[p], r->count);
}

static void quick_weigh_pair(level_run *r) {
    weigh_pair(r, false);
}

static void fine_weigh_pair(level_run *r) {
    weigh_pair(r, true);
}

static void rgb(level_run *r, bool fine) {
    const wf_rgb_of_chroma m = {1 / 876.0, 1.5748 / 896, 1.8556 / 896, 0.1873 / 896,
                                0.4681 / 896};
    float *ycc[3];
    for (int c = 0; c < 3; c++) ycc[c] = level_floats(r, r->count);
    const wf_upsample_ops *ops = upsample_at(r);
    if (!r->plain) (fine ? &ops->fine : &ops->quick)->rgb(&m, ycc[0], ycc[1], ycc[2], r->count);
    for (size_t i = 0; r->plain && i < r->count; i++) {
        double y = m.luma * (double)ycc[0][i], b = (double)ycc[1][i], red = (double)ycc[2][i];
        ycc[0][i] = (float)(y + m.of_cr * red);
        ycc[1][i] = (float)(y - (m.green_cb * b + m.green_cr * red));
        ycc[2][i] = (float)(y + m.of_cb * b);
    }
    keep_planes(r, ycc);
}

static void quick_rgb(level_run *r) {
    rgb(r, false);
}

static void fine_rgb(level_run *r) {
    rgb(r, true);
}

/* As codes to signals and these to R'G'B'. */
static void rgb_of_bytes(level_run *r, bool fine) {
    const wf_rgb_of_chroma m = {1 / 219.0, 1.5748 / 224, 1.8556 / 224, 0.1873 / 224,
                                0.4681 / 224};
    const uint8_t *code = (uint8_t *)level_halves(r, r->count);
    float *ycc[3];
    for (int c = 0; c < 3; c++) ycc[c] = level_floats(r, r->count);
    const wf_upsample_ops *ops = wf_upsample_ops_at(r->plain ? 0 : r->level);
    const wf_signal_loops *loops = fine ? &ops->fine : &ops->quick;
    if (!r->plain) loops->rgb_of_bytes(&m, code, 16, ycc[0], ycc[1], ycc[2], r->count);
    if (r->plain) loops->of_bytes(ycc[0], code, 16, 1, r->count);
    if (r->plain) loops->rgb(&m, ycc[0], ycc[1], ycc[2], r->count);
    keep_planes(r, ycc);
}

static void quick_rgb_of_bytes(level_run *r) {
    rgb_of_bytes(r, false);
}

static void fine_rgb_of_bytes(level_run *r) {
    rgb_of_bytes(r, true);
}

static void interleave(level_run *r) {
    float *even = level_floats(r, r->count), *odd = level_floats(r, r->count);
    float *out = level_floats(r, 2 * r->count);
    if (!r->plain) upsample_at(r)->interleave(out, even, odd, r->count);
    for (size_t i = 0; r->plain && i < r->count; i++)
        out[2 * i] = even[i], out[2 * i + 1] = odd[i];
    level_keep_floats(r, out, 2 * r->count);
}

static const level_row upsample_rows[] = {
    {"quick.signals", quick_signals, true, 0},
    {"quick.of_bytes", quick_of_bytes, true, 0},
    {"quick.weigh", quick_weigh, true, 4e-7},
    {"quick.weigh_pair", quick_weigh_pair, true, 0},
    {"fine.weigh_pair", fine_weigh_pair, true, 0},
    {"quick.rgb", quick_rgb, true, 3e-7},
    {"quick.rgb_of_bytes", quick_rgb_of_bytes, true, 0},
    {"fine.rgb_of_bytes", fine_rgb_of_bytes, true, 0},
    {"fine.signals", fine_signals, true, 0},
    {"fine.of_bytes", fine_of_bytes, true, 0},
    {"fine.weigh", fine_weigh, true, 0},
    {"fine.rgb", fine_rgb, true, 0},
    {"upsample.interleave", interleave, true, 0},
};

static const level_row rows[] = {
    {"line.mix", mix, true, 0},
    {"line.curve, powers", power_curves, false, 0},
    {"line.curve, PQ", pq_curve, false, 0},
    {"line.curve, HLG", hlg_curve, false, 0},
    {"line.decode, powers", power_decode, false, 0},
    {"line.decode, PQ", pq_decode, false, 0},
    {"line.decode, HLG", hlg_decode, false, 0},
    {"line.ycbcr", ycbcr, true, 0},
    {"line.deinterleave", deinterleave, true, 0},
    {"line.half_band", half_band, true, 0},
    {"line.quantize", quantize, true, 0},
};

const level_table level_color[] = {
    LEVEL_TABLE("color/line/line_isa.c", wf_line_ops, rows),
    LEVEL_TABLE("color/codes/upsample_isa.c", wf_upsample_ops, upsample_rows),
    {.file = NULL},
};
