#ifndef WF_COLOR_CODES_YCBCR_H
#define WF_COLOR_CODES_YCBCR_H

#include <stddef.h>

#include "color/line/luma.h"

/* Three planes of count samples each, in place, of signals: R', G', B' and Y' from 0 to 1, Cb
 * and Cr from -1/2 to 1/2. Beyond that they are kept; on the way to Y'CbCr NaN counts as 0. */
void wf_ycbcr_of_rgb(wf_luma luma, float *r_to_y, float *g_to_cb, float *b_to_cr, size_t count);
void wf_rgb_of_ycbcr(wf_luma luma, float *y_to_r, float *cb_to_g, float *cr_to_b, size_t count);

#endif
