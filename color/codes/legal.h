#ifndef WF_COLOR_CODES_LEGAL_H
#define WF_COLOR_CODES_LEGAL_H

#include "color/codes/chroma.h"
#include "color/codes/encoder.h"

/* EBU R 103 v3: R', G', B' and Y' each from -5 % to 105 %, 10-bit codes 20 to 984; up to 1 % of
 * the picture may be outside. */
#define WF_R103_LOW  ((20 - 64) / 876.0)
#define WF_R103_HIGH ((984 - 64) / 876.0)

/* What r103 keeps R', G' and B' to: the limits less what rounding to codes may take. */
typedef struct wf_legal_range {
    float low, high;
} wf_legal_range;

wf_legal_range wf_legal_range_of(const wf_encoding *encoding);

/* Samples of scratch that the two below need for a line. */
size_t wf_legal_scratch(size_t width_px);

/* Brings a line of Y' Cb Cr within the limits, in place. Cb and Cr are width_px / 2 samples
 * where subsampled, which a half-band interpolates between for whoever looks, or width_px.
 * Saturation is compressed at constant hue and luma; only Y' that is itself outside is changed,
 * by a clip that is soft for two and a half codes of 10 bits. How far saturation is compressed
 * changes smoothly along the line. Counts the pixels that it has touched into encoding->legal.
 */
void wf_legal_ycbcr(const wf_encoding *encoding, float *const ycbcr[3], float *scratch);

/* The same for R'G'B', pixel by pixel; codes of full range hold 0 to 1. */
void wf_legal_rgb(const wf_encoding *encoding, float *const rgb[3]);

/* Counts the pixels that the codes of a line of Y' Cb Cr or R'G'B' leave outside. */
void wf_legal_count(const wf_encoding *encoding, uint16_t *const code[3], float *scratch);

#endif
