#ifndef WF_COLOR_CODES_LEGAL_H
#define WF_COLOR_CODES_LEGAL_H

#include <stddef.h>
#include <stdint.h>

#include "color/codes/encoding.h"

/* What r103 keeps R', G' and B' to: the limits of EBU R 103 less what rounding to codes may
 * add.
 */
typedef struct wf_legal_range {
    float low, high;
} wf_legal_range;

wf_legal_range wf_legal_range_of(const wf_encoding *encoding);

/* Samples of scratch that wf_legal_ycbcr and wf_legal_count need for a line. */
size_t wf_legal_scratch(size_t width_px);

/* Brings a line of Y' Cb Cr within the limits, in place. Cb and Cr are width_px samples in 444,
 * else width_px / 2, between which a receiver is taken to interpolate by the half-band.
 * Saturation is compressed at constant hue and luma, and how far changes smoothly along the
 * line. Y' that is outside by itself is clipped, softly over two and a half codes of 10 bits;
 * other Y' moves by less than a code. The pixels touched are counted into encoding->legal. */
void wf_legal_ycbcr(const wf_encoding *encoding, float *const ycbcr[3], float *scratch);

/* The same for R'G'B', pixel by pixel; codes of full range hold 0 to 1. */
void wf_legal_rgb(const wf_encoding *encoding, float *const rgb[3]);

/* Counts the pixels that the codes of a line of Y' Cb Cr or R'G'B' leave outside. */
void wf_legal_count(const wf_encoding *encoding, uint16_t *const code[3], float *scratch);

#endif
