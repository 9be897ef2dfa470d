#ifndef WF_COLOR_CODES_LEVELS_H
#define WF_COLOR_CODES_LEVELS_H

#include <stddef.h>
#include <stdint.h>

#include "color/codes/encoding.h"
#include "color/line/line.h"

/* How signals of plane `plane` become codes by Rec. ITU-R BT.601-7, BT.709-6 and
 * BT.2020-2; color/README.md has the formulas. */
wf_quantizer wf_quantizer_of(const wf_encoding *encoding, int plane);

/* What codes of plane `plane` mean: the signal is (code - zero) / unit, from 0 to 1, chroma
 * from -1/2 to 1/2. Of the encoding only ycbcr, full_range and bits are looked at. */
void wf_code_scale(const wf_encoding *encoding, int plane, double *zero, double *unit);

/* Those signals, of count codes. */
void wf_decode_line(const wf_encoding *encoding, int plane, const uint16_t *code, float *signal,
                    size_t count);

#endif
