#ifndef WF_COLOR_CODES_ADJUST_H
#define WF_COLOR_CODES_ADJUST_H

#include <stddef.h>

#include "color/codes/encoding.h"

/* Samples of scratch that wf_adjust_luma needs for a line. */
size_t wf_adjust_scratch(size_t width_px);

/* Chooses the Y' of a line of Y' Cb Cr, in place; Cb and Cr are width_px / 2 samples. On the
 * encoding's display, with chroma interpolated by the half-band, the luminance of each pixel
 * becomes that of rgb, which is the line before decimation. Pixels whose R', G' and B' are
 * within 5e-5 of what they were (a twentieth of a 10-bit code) keep their Y', and none leaves
 * -1/16 to 1.09, which narrow range has codes for. With r103 no color that was within its
 * limits is taken out of them. */
void wf_adjust_luma(const wf_encoding *encoding, float *const ycbcr[3],
                    const float *const rgb[3], float *scratch);

#endif
