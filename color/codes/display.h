#ifndef WF_COLOR_CODES_DISPLAY_H
#define WF_COLOR_CODES_DISPLAY_H

#include <stddef.h>

#include "color/codes/encoder.h"
#include "color/space/space.h"

/* What a display makes of finished video. */

/* Y'CbCr to R'G'B', in place: the inverse of what wf_encode_line begins with. Samples of one
 * line, all three of count. */
void wf_rgb_of_ycbcr(wf_luma luma, float *y_to_r, float *cb_to_g, float *cr_to_b, size_t count);
void wf_ycbcr_of_rgb(wf_luma luma, float *r_to_y, float *g_to_cb, float *b_to_cr, size_t count);

/* What a display makes of a signal, 1 being reference white: gamma 2.4 with black at 0 (Rec.
 * ITU-R BT.1886 annex 1); PQ, white at 203 cd/m2, and HLG, white at 75 % of the signal with a
 * system gamma of 1.2 for each color by itself, which is exact for greys (BT.2100 tables 4 and
 * 5, Report BT.2408 table 1). */
typedef enum wf_transfer { WF_TRANSFER_BT1886, WF_TRANSFER_PQ, WF_TRANSFER_HLG } wf_transfer;

/* A display of these, with the primaries of a system, as a table of the curve from 0 to
 * WF_DISPLAY_END, so fine that lines between its points leave less than 1e-8. */
#define WF_DISPLAY_STEPS 16384
#define WF_DISPLAY_END   1.25f

typedef struct wf_display {
    float light[WF_DISPLAY_STEPS + 2];
    wf_transfer transfer;
    float weight[3]; /* of red, green and blue light in luminance */
} wf_display;

void wf_display_init(wf_display *display, wf_primaries primaries, wf_transfer transfer);

/* Light of a signal, and how fast it grows with it. NaN counts as 0. */
float wf_display_light(const wf_display *display, float signal, float *slope);

/* Luminance of R'G'B', white being 1. Signals below 0 are dark. NaN counts as 0. */
void wf_display_luminance(const wf_display *display, const float *const rgb[3], float *light,
                          size_t count);

#endif
