#ifndef WF_COLOR_ADJUST_H
#define WF_COLOR_ADJUST_H

#include "color/display.h"
#include "color/encoder.h"

/* Samples of scratch for a line. */
size_t wf_adjust_scratch(size_t width_px);

/* Chooses the Y' of a line of Y' Cb Cr, the last two of width_px / 2 samples, so that the
 * luminance of the encoding's display, chroma being interpolated by the half-band, is
 * light[width_px], white being 1; in place. Pixels whose chroma is what it was keep their Y',
 * and none leaves -1/16 to 1.09, which codes of every range hold. */
void wf_adjust_luma(const wf_encoding *encoding, float *const ycbcr[3], const float *light,
                    float *scratch);

#endif
