/* Composite to Y'CbCr. Chroma is demodulated and low-passed, a line at a time, then combed as U
 * and V, where lines of every phase can be added: this is a comb of the band around the
 * subcarrier, without the error that PAL's 25 Hz would leave in a delay of whole samples. What
 * chroma there is, modulated again, is taken off the composite; without a comb that is a band
 * stop. */
#include <string.h>

#include "color/composite/composite_parts.h"

typedef struct desk {
    float *sine, *cosine; /* [row] */
    float *product;       /* [row] */
    float *combed;        /* [width] */
    float *kept[2];       /* [width], lines as they were before the comb */
} desk;

static desk desk_in(const wf_composite *c, float *scratch) {
    size_t room = wf_composite_line_room(c);
    return (desk){scratch,
                  scratch + room,
                  scratch + 2 * room,
                  scratch + 3 * room,
                  {scratch + 4 * room, scratch + 5 * room}};
}

/* ---- U and V ---- */

static void demodulate(const wf_composite *c, const float *row, const float *carrier,
                       float *out, desk d) {
    for (size_t i = 0; i < c->row; i++) d.product[i] = 2 * row[i] * carrier[i];
    wf_fir_apply(wf_fir_chroma(), out, d.product, (size_t)c->tv.width_px);
}

/* ---- The comb ---- */

/* Of the line a comb's distance before, of the line itself, of that after it. */
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

/* The lines of one parity of a plane, in place. */
static void comb_field(const wf_composite *c, float *plane, int parity, desk d) {
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

static void separate(const wf_composite *c, const float *row, float *const line[3], desk d) {
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
    desk d = desk_in(c, scratch);
    size_t width = (size_t)c->tv.width_px;
    for (int line = 0; line < c->tv.lines; line++) {
        const float *row = composite + (size_t)line * c->row;
        size_t at = (size_t)line * width;
        wf_composite_carriers(c, frame, line, d.sine, d.cosine);
        demodulate(c, row, d.sine, ycbcr[1] + at, d);
        demodulate(c, row, d.cosine, ycbcr[2] + at, d);
    }
    if (c->tv.decoder != WF_DECODER_NOTCH)
        for (int part = 0; part < 4; part++) comb_field(c, ycbcr[1 + part / 2], part % 2, d);
    for (int line = 0; line < c->tv.lines; line++) {
        size_t at = (size_t)line * width;
        float *lines[3] = {ycbcr[0] + at, ycbcr[1] + at, ycbcr[2] + at};
        wf_composite_carriers(c, frame, line, d.sine, d.cosine);
        separate(c, composite + (size_t)line * c->row, lines, d);
    }
}
