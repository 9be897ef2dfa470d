#ifndef WF_COLOR_CODES_ADJUST_H
#define WF_COLOR_CODES_ADJUST_H

#include "color/codes/display.h"
#include "color/codes/encoder.h"

/* Samples of scratch for a line. */
size_t wf_adjust_scratch(size_t width_px);

/* Chooses the Y' of a line of Y' Cb Cr, the last two of width_px / 2 samples, so that the
 * luminance of the encoding's display, chroma being interpolated by the half-band, is that of
 * rgb, the line as it was before; in place. Pixels whose colors are what they were, but for a
 * twentieth of a code of 10 bits, keep their Y', and none leaves -1/16 to 1.09, which codes of
 * every range hold. With r103 Y' takes no color outside its limits that was inside. */
void wf_adjust_luma(const wf_encoding *encoding, float *const ycbcr[3],
                    const float *const rgb[3], float *scratch);

#endif
