/* Lines of color, for test_isa.c. */
#include <math.h>

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
    {.file = NULL},
};
