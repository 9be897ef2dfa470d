#ifndef WF_COLOR_CODES_DITHER_H
#define WF_COLOR_CODES_DITHER_H

#include <stddef.h>

/* tpdf: noise of triangular distribution, one code to each side, is added before rounding, so
 * that a gradient has no steps: the mean of the codes is the signal, whatever it is, and their
 * variance is a quarter of a code squared. */
typedef enum wf_dither { WF_DITHER_NONE, WF_DITHER_TPDF } wf_dither;

/* Adds that noise to count samples of a line. It is fixed to the pixels of the frame, so that a
 * still is the same in every field of one parity; no two lines or planes are alike. line counts
 * the frame's lines from the top; unit is the number of codes that a signal of 1 spans. */
void wf_dither_add(int line, int plane, double unit, float *signal, size_t count);

#endif
