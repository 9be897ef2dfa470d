/* Display-encoded R'G'B' to code values: the stages of this folder in their order. */
#include "color/codes/encode.h"

#include <string.h>

#include "color/codes/adjust.h"
#include "color/codes/legal.h"
#include "color/codes/levels.h"
#include "color/line/line.h"

static const wf_chroma_filter *filter_of(const wf_encoding *e) {
    return e->ycbcr ? wf_chroma_filter_of(e->chroma) : NULL;
}

/* luma-adjust aims at the line as it was, which is kept at the start of the scratch. The stages
 * use what is behind it one after the other. */
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

static void quantize(const wf_encoding *e, int plane, float *signal, uint16_t *code) {
    wf_quantizer quantizer = wf_quantizer_of(e, plane);
    size_t width = (size_t)e->width_px, count = plane && filter_of(e) ? width / 2 : width;
    if (e->dither) wf_dither_add(e->line, plane, quantizer.scale, signal, count);
    wf_line_ops_best()->quantize(&quantizer, code, signal, count);
}

void wf_encode_line(const wf_encoding *encoding, float *const rgb[3], float *scratch,
                    uint16_t *const code[3]) {
    if (encoding->ycbcr) make_ycbcr(encoding, rgb, scratch);
    legalize(encoding, rgb, scratch);
    for (int p = 0; p < 3; p++) quantize(encoding, p, rgb[p], code[p]);
    if (encoding->legalize == WF_LEGAL_R103 && encoding->legal)
        wf_legal_count(encoding, code, scratch);
}
