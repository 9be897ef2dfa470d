/* Y'CbCr to composite. */
#include "color/composite/encode.h"

#include "color/composite/coder.h"
#include "color/composite/subcarrier.h"

/* The parts of the scratch. */
typedef struct scratch_lines {
    float *sine, *cosine; /* [row] */
    float *padded;        /* a line with all that its filter looks at */
    float *narrow;        /* [row], after the filter */
} scratch_lines;

static scratch_lines lay_out(const wf_composite *c, float *scratch) {
    size_t line = wf_composite_scratch_line(c);
    return (scratch_lines){scratch, scratch + line, scratch + 2 * line, scratch + 3 * line};
}

static void put_luma(const wf_composite *c, const float *luma, float *row, scratch_lines d) {
    int margin = (int)c->margin;
    if (c->tv.encoder == WF_ENCODER_CHEAP) {
        wf_fir_reflect(row, luma, c->tv.width_px, margin);
        return;
    }
    wf_fir_reflect(d.padded, luma, c->tv.width_px, margin + c->stop.reach);
    wf_fir_apply(&c->stop, row, d.padded, c->row);
}

static void add_chroma(const wf_composite *c, const float *chroma, const float *carrier,
                       float *row, scratch_lines d) {
    const wf_fir *fir = wf_fir_chroma();
    wf_fir_reflect(d.padded, chroma, c->tv.width_px, (int)c->margin + fir->reach);
    wf_fir_apply(fir, d.narrow, d.padded, c->row);
    for (size_t i = 0; i < c->row; i++) row[i] += d.narrow[i] * carrier[i];
}

static void scale(float *line, float by, size_t count) {
    for (size_t i = 0; i < count; i++) line[i] *= by;
}

void wf_composite_encode(const wf_composite *c, int64_t frame, float *const ycbcr[3],
                         float *composite, float *scratch) {
    scratch_lines d = lay_out(c, scratch);
    for (int line = 0; line < c->tv.lines; line++) {
        size_t at = (size_t)line * (size_t)c->tv.width_px;
        float *row = composite + (size_t)line * c->row;
        wf_subcarrier_row(c, frame, line, d.sine, d.cosine);
        scale(d.sine, (float)WF_U_OF_CB, c->row);
        scale(d.cosine, (float)WF_V_OF_CR, c->row);
        put_luma(c, ycbcr[0] + at, row, d);
        add_chroma(c, ycbcr[1] + at, d.sine, row, d);
        add_chroma(c, ycbcr[2] + at, d.cosine, row, d);
    }
}
