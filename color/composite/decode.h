#ifndef WF_COLOR_COMPOSITE_DECODE_H
#define WF_COLOR_COMPOSITE_DECODE_H

#include <stdint.h>

#include "color/composite/composite.h"

/* The inverse of wf_composite_encode, as the coder's decoder does it. The planes do not overlap
 * composite. */
void wf_composite_decode(const wf_composite *c, int64_t frame, const float *composite,
                         float *const ycbcr[3], float *scratch);

#endif
