#ifndef WF_COLOR_CODES_DISPLAY_H
#define WF_COLOR_CODES_DISPLAY_H

#include <stddef.h>

#include "color/line/luma.h"
#include "color/space/space.h"

/* What a display makes of a signal, 1 being reference white: gamma 2.4 with black at 0 (Rec.
 * ITU-R BT.1886 annex 1); PQ, white at 203 cd/m2, and HLG, white at 75 % of the signal with a
 * system gamma of 1.2 for each color by itself, which is exact for grays (BT.2100 tables 4 and
 * 5, Report BT.2408 table 1). */
typedef enum wf_transfer { WF_TRANSFER_BT1886, WF_TRANSFER_PQ, WF_TRANSFER_HLG } wf_transfer;

/* A display: its curve as a table from 0 to WF_DISPLAY_END, so fine that straight lines between
 * its points are off by less than 1e-8, and the weights of its primaries. Any number of threads
 * may use one that is initialized. */
#define WF_DISPLAY_STEPS 16384
#define WF_DISPLAY_END   1.25f

typedef struct wf_display {
    float light[WF_DISPLAY_STEPS + 2];
    wf_transfer transfer;
    float weight[3]; /* of red, green and blue light in luminance; they add up to 1 */
} wf_display;

void wf_display_init(wf_display *display, wf_primaries primaries, wf_transfer transfer);

/* The light of a signal, white being 1; *slope is its derivative. NaN counts as 0. */
float wf_display_light(const wf_display *display, float signal, float *slope);

/* The luminance of count pixels of R'G'B', white being 1. Signals below 0 are dark, and NaN
 * counts as 0. */
void wf_display_luminance(const wf_display *display, const float *const rgb[3], float *light,
                          size_t count);

#endif
