#ifndef WF_COLOR_COMPOSITE_ENCODE_H
#define WF_COLOR_COMPOSITE_ENCODE_H

#include <stdint.h>

#include "color/composite/composite.h"

/* A frame of planes Y' (0..1), Cb, Cr (-0.5..0.5, by BT.601's weights), each [lines][width_px],
 * to composite [lines][wf_composite_row]. frame counts from 0 and sets the phase. Fields never
 * mix. Numbers must be finite; it never fails. */
void wf_composite_encode(const wf_composite *c, int64_t frame, float *const ycbcr[3],
                         float *composite, float *scratch);

#endif
