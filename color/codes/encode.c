/* Display-encoded R'G'B' to code values. */
#include "color/codes/encoder.h"

#include <string.h>

#include "color/codes/adjust.h"
#include "color/codes/chroma.h"
#include "color/codes/legal.h"
#include "color/line/line.h"

/* Rec. ITU-R BT.601-7 item 2.5.1, BT.709-6 item 3.2, BT.2020-2 table 4. */
static const struct {
    double kr, kb;
} luma_weights[] = {
    [WF_LUMA_601] = {0.299, 0.114},
    [WF_LUMA_709] = {0.2126, 0.0722},
    [WF_LUMA_2020] = {0.2627, 0.0593},
};

/* Levels at 8 bits in narrow range: where signals of 0 and 1 (chroma: 1 from end to end) lie,
 * and what is legal. */
typedef struct levels {
    double zero, unit, legal_low, legal_high;
} levels;

static const levels narrow_luma = {16, 219, 16, 235}; /* R', G', B' as well */
static const levels narrow_chroma = {128, 224, 16, 240};

static wf_quantizer narrow_quantizer(const wf_encoding *e, levels at) {
    double step = (double)(1 << (e->bits - 8)); /* of one 8-bit code */
    bool clip = e->legalize == WF_LEGAL_CLIP;
    return (wf_quantizer){.scale = step * at.unit,
                          .offset = step * at.zero,
                          .low = step * (clip ? at.legal_low : 1),
                          /* above lie the codes that are kept for synchronisation */
                          .high = clip ? step * at.legal_high : step * 255 - 1};
}

static wf_quantizer full_quantizer(const wf_encoding *e, bool chroma) {
    double most = (double)((1 << e->bits) - 1);
    return (wf_quantizer){.scale = most,
                          .offset = chroma ? (double)(1 << (e->bits - 1)) : 0,
                          .low = 0,
                          .high = most};
}

static wf_quantizer quantizer_of(const wf_encoding *e, bool chroma) {
    if (e->full_range) return full_quantizer(e, chroma);
    return narrow_quantizer(e, chroma ? narrow_chroma : narrow_luma);
}

void wf_code_scale(const wf_encoding *encoding, int plane, double *zero, double *unit) {
    wf_quantizer q = quantizer_of(encoding, encoding->ycbcr && plane > 0);
    *zero = q.offset;
    *unit = q.scale;
}

void wf_decode_line(const wf_encoding *encoding, int plane, const uint16_t *code, float *signal,
                    size_t count) {
    double zero, unit;
    wf_code_scale(encoding, plane, &zero, &unit);
    for (size_t i = 0; i < count; i++) signal[i] = (float)((code[i] - zero) / unit);
}

wf_ycbcr wf_ycbcr_of(wf_luma luma) {
    double kr = luma_weights[luma].kr, kb = luma_weights[luma].kb;
    return (wf_ycbcr){.kr = (float)kr,
                      .kb = (float)kb,
                      .cb_scale = (float)(0.5 / (1 - kb)),
                      .cr_scale = (float)(0.5 / (1 - kr))};
}

static const wf_chroma_filter *filter_of(const wf_encoding *e) {
    return e->ycbcr ? wf_chroma_filter_of(e->chroma) : NULL;
}

/* A bijection of 32 bits that leaves no pattern (the finalizer of MurmurHash3). */
static uint32_t scramble(uint32_t h) {
    h = (h ^ h >> 16) * 0x85ebca6b;
    h = (h ^ h >> 13) * 0xc2b2ae35;
    return h ^ h >> 16;
}

/* The sum of two even distributions, each of one code's width, about 0. */
static void add_noise(const wf_encoding *e, int plane, double unit, float *signal,
                      size_t count) {
    uint32_t seed = scramble((uint32_t)e->line * 3 + (uint32_t)plane);
    for (size_t i = 0; i < count; i++) {
        uint32_t h = scramble(seed ^ (uint32_t)i * 0x9e3779b9);
        double noise = ((double)(h & 0xffff) + (double)(h >> 16) - 65535) / 65536;
        signal[i] += (float)(noise / unit);
    }
}

/* Scratch of the parts of wf_encode_line, which take turns, behind the line as it was, which
 * luma-adjust aims at. */
static size_t kept_samples(const wf_encoding *e) {
    return e->ycbcr && e->chroma == WF_CHROMA_LUMA_ADJUST ? 3 * (size_t)e->width_px : 0;
}

static size_t larger(size_t a, size_t b) {
    return a > b ? a : b;
}

size_t wf_encode_scratch(const wf_encoding *encoding) {
    size_t width = (size_t)encoding->width_px, kept = kept_samples(encoding);
    size_t most = filter_of(encoding) ? wf_chroma_scratch(width) : 0;
    if (kept) most = larger(most, wf_adjust_scratch(width));
    if (encoding->legalize == WF_LEGAL_R103) most = larger(most, wf_legal_scratch(width));
    return kept + most;
}

/* R'G'B' to Y'CbCr, in place. */
static void make_ycbcr(const wf_encoding *e, float *const rgb[3], float *scratch) {
    const wf_line_ops *ops = wf_line_ops_best();
    const wf_chroma_filter *filter = filter_of(e);
    size_t width = (size_t)e->width_px, kept = kept_samples(e);
    float *const was[3] = {scratch, scratch + width, scratch + 2 * width};
    wf_ycbcr weights = wf_ycbcr_of(e->luma);
    for (int c = 0; kept && c < 3; c++) memcpy(was[c], rgb[c], width * sizeof(float));
    ops->ycbcr(&weights, rgb[0], rgb[1], rgb[2], width);
    for (int c = 1; filter && c < 3; c++)
        wf_chroma_decimate(filter, rgb[c], width, scratch + kept);
    if (!kept) return;
    const float *const aim[3] = {was[0], was[1], was[2]};
    wf_adjust_luma(e, rgb, aim, scratch + kept);
}

static void legalize(const wf_encoding *e, float *const plane[3], float *scratch) {
    if (e->legalize != WF_LEGAL_R103) return;
    if (e->ycbcr)
        wf_legal_ycbcr(e, plane, scratch);
    else
        wf_legal_rgb(e, plane);
}

void wf_encode_line(const wf_encoding *encoding, float *const rgb[3], float *scratch,
                    uint16_t *const code[3]) {
    const wf_line_ops *ops = wf_line_ops_best();
    size_t width = (size_t)encoding->width_px;
    if (encoding->ycbcr) make_ycbcr(encoding, rgb, scratch);
    legalize(encoding, rgb, scratch);
    for (int c = 0; c < 3; c++) {
        bool chroma = encoding->ycbcr && c > 0;
        wf_quantizer quantizer = quantizer_of(encoding, chroma);
        size_t count = chroma && filter_of(encoding) ? width / 2 : width;
        if (encoding->dither) add_noise(encoding, c, quantizer.scale, rgb[c], count);
        ops->quantize(&quantizer, code[c], rgb[c], count);
    }
    if (encoding->legalize == WF_LEGAL_R103 && encoding->legal)
        wf_legal_count(encoding, code, scratch);
}
