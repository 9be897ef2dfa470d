#ifndef WF_COLOR_LINE_LINE_H
#define WF_COLOR_LINE_LINE_H

#include <stddef.h>
#include <stdint.h>

#include "color/line/curve.h"
#include "color/line/luma.h"
#include "filters/base/isa.h"

/* Light beyond this, and R'G'B' beyond +-WF_MOST_SIGNAL, is cut off: every code is saturated
 * there, and no difference of two such samples overflows. */
#define WF_MOST_LINEAR 1e30f
#define WF_MOST_SIGNAL 1024.0f

/* Three rows of a 3x3 matrix each of which adds up to 1: red gets r + of_red[0] (g - r) +
 * of_red[1] (b - r), and so on; neutrals come out as they went in, to the bit. */
typedef struct wf_mix {
    double of_red[2];   /* weights of g - r, b - r */
    double of_green[2]; /* of r - g, b - g */
    double of_blue[2];  /* of r - b, g - b */
} wf_mix;

/* Signal to code: scale * signal + offset, rounded, within low .. high (whole numbers >= 0). */
typedef struct wf_quantizer {
    double scale, offset, low, high;
} wf_quantizer;

/* The inner loops of color, one table for each instruction set they are compiled for. Every
 * table gives the same bits. */
typedef struct wf_line_ops {
    /* In place, planes of count samples; NaN counts as 0. */
    void (*mix)(const wf_mix *mix, float *r, float *g, float *b, size_t count);
    void (*curve[WF_CURVE_KINDS])(const wf_curve *curve, float *light, size_t count);
    void (*decode[WF_CURVE_KINDS])(const wf_curve *curve, float *signal, size_t count);
    void (*ycbcr)(const wf_ycbcr *weights, float *r_to_y, float *g_to_cb, float *b_to_cr,
                  size_t count);
    /* even[i] = line[2 i], odd[i] = line[2 i + 1] */
    void (*deinterleave)(float *even, float *odd, const float *line, size_t count);
    /* out[i] = even[i] / 2 + sum over j < pairs of pair[j] (odd[i + j] + odd[i - 1 - j]) */
    void (*half_band)(float *out, const float *even, const float *odd, const float *pair,
                      size_t pairs, size_t count);
    /* Halves are rounded away from zero; NaN counts as 0. */
    void (*quantize)(const wf_quantizer *q, uint16_t *code, const float *signal, size_t count);
} wf_line_ops;

WF_ISA_DECLARE(wf_line_ops);

#endif
