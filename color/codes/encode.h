#ifndef WF_COLOR_CODES_ENCODE_H
#define WF_COLOR_CODES_ENCODE_H

#include <stddef.h>
#include <stdint.h>

#include "color/codes/encoding.h"

/* Samples of float scratch that wf_encode_line needs. */
size_t wf_encode_scratch(const wf_encoding *encoding);

/* One line of display-encoded R'G'B' planes (width_px samples each, overwritten) to codes: Y Cb
 * Cr or R G B. Cb and Cr are width_px / 2 samples, co-sited with even luma, unless chroma is
 * 444. NaN never reaches a code: it counts as 0. Threads that share nothing but the encoding
 * may run at once, if its legal counts are their own. */
void wf_encode_line(const wf_encoding *encoding, float *const rgb[3], float *scratch,
                    uint16_t *const code[3]);

#endif
