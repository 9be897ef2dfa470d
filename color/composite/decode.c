/* Composite to Y'CbCr. Chroma is demodulated and low-passed a line at a time and then combed as
 * U and V, because lines of any phase can be added there: a comb that delays the composite by
 * whole samples would err by PAL's 25 Hz offset. The chroma found is modulated again and taken
 * off the composite, which leaves luma; without a comb that amounts to a band stop. */
#include "color/composite/decode.h"

#include <string.h>

#include "color/composite/coder.h"
#include "color/composite/subcarrier.h"

/* The parts of the scratch. */
typedef struct scratch_lines {
    float *sine, *cosine; /* [row] */
    float *product;       /* [row] */
    float *combed;        /* [width] */
    float *kept[2];       /* [width], lines as they were before the comb */
} scratch_lines;

static scratch_lines lay_out(const wf_composite *c, float *scratch) {
    size_t line = wf_composite_scratch_line(c);
    return (scratch_lines){scratch,
                           scratch + line,
                           scratch + 2 * line,
                           scratch + 3 * line,
                           {scratch + 4 * line, scratch + 5 * line}};
}

/* ---- U and V ---- */

static void demodulate(const wf_composite *c, const float *row, const float *carrier,
                       float *out, scratch_lines d) {
    for (size_t i = 0; i < c->row; i++) d.product[i] = 2 * row[i] * carrier[i];
    wf_fir_apply(wf_fir_chroma(), out, d.product, (size_t)c->tv.width_px);
}

/* ---- The comb ---- */

/* Weights of the line a comb's distance before, of the line itself and of the one after. */
static const struct {
    float before, own, after;
} combs[] = {
    [WF_DECODER_NOTCH] = {0, 1, 0},
    [WF_DECODER_COMB2] = {0.5f, 0.5f, 0},
    [WF_DECODER_COMB3] = {0.25f, 0.5f, 0.25f},
};

static void comb_line(const wf_composite *c, float *own, const float *before,
                      const float *after, float *combed) {
    size_t width = (size_t)c->tv.width_px;
    float by_before = combs[c->tv.decoder].before, by_own = combs[c->tv.decoder].own,
          by_after = combs[c->tv.decoder].after;
    if (!before && !after) before = own;
    if (!before) before = after;
    if (!after) after = before;
    for (size_t x = 0; x < width; x++)
        combed[x] = by_before * before[x] + by_own * own[x] + by_after * after[x];
}

/* Combs the lines of one parity of a plane in place. */
static void comb_field(const wf_composite *c, float *plane, int parity, scratch_lines d) {
    int distance = c->standard->comb_lines, count = (c->tv.lines + 1 - parity) / 2;
    size_t width = (size_t)c->tv.width_px, step = 2 * width;
    float *line = plane + (size_t)parity * width;
    for (int k = 0; k < count; k++, line += step) {
        float *kept = d.kept[k % distance];
        comb_line(c, line, k >= distance ? kept : NULL,
                  k + distance < count ? line + (size_t)distance * step : NULL, d.combed);
        memcpy(kept, line, width * sizeof *line);
        memcpy(line, d.combed, width * sizeof *line);
    }
}

/* ---- Luma ---- */

/* Y' is what is left of a row without its chroma; U and V become Cb and Cr. */
static void separate(const wf_composite *c, const float *row, float *const line[3],
                     scratch_lines d) {
    const float *sine = d.sine + c->margin, *cosine = d.cosine + c->margin;
    const float cb_of_u = (float)(1 / WF_U_OF_CB), cr_of_v = (float)(1 / WF_V_OF_CR);
    float *y = line[0], *cb = line[1], *cr = line[2];
    row += c->margin;
    for (int x = 0; x < c->tv.width_px; x++) {
        y[x] = row[x] - (cb[x] * sine[x] + cr[x] * cosine[x]);
        cb[x] *= cb_of_u;
        cr[x] *= cr_of_v;
    }
}

void wf_composite_decode(const wf_composite *c, int64_t frame, const float *composite,
                         float *const ycbcr[3], float *scratch) {
    scratch_lines d = lay_out(c, scratch);
    size_t width = (size_t)c->tv.width_px;
    for (int line = 0; line < c->tv.lines; line++) {
        const float *row = composite + (size_t)line * c->row;
        size_t at = (size_t)line * width;
        wf_subcarrier_row(c, frame, line, d.sine, d.cosine);
        demodulate(c, row, d.sine, ycbcr[1] + at, d);
        demodulate(c, row, d.cosine, ycbcr[2] + at, d);
    }
    if (c->tv.decoder != WF_DECODER_NOTCH)
        for (int part = 0; part < 4; part++) comb_field(c, ycbcr[1 + part / 2], part % 2, d);
    for (int line = 0; line < c->tv.lines; line++) {
        size_t at = (size_t)line * width;
        float *lines[3] = {ycbcr[0] + at, ycbcr[1] + at, ycbcr[2] + at};
        wf_subcarrier_row(c, frame, line, d.sine, d.cosine);
        separate(c, composite + (size_t)line * c->row, lines, d);
    }
}
