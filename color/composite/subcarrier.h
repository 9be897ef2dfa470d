#ifndef WF_COLOR_COMPOSITE_SUBCARRIER_H
#define WF_COLOR_COMPOSITE_SUBCARRIER_H

#include <stdint.h>

#include "color/composite/composite.h"

/* The subcarrier at a sample of a picture line of the frame (0: the top one), exactly. */
typedef struct wf_subcarrier {
    int64_t num, den;  /* its phase in cycles, 0 <= num / den < 1 */
    int v_sign;        /* the V switch: 1 or -1 */
    int burst_degrees; /* of this line's burst against +U */
    int line_number;   /* from 1 in the whole frame, as the raster's map counts */
} wf_subcarrier;

wf_subcarrier wf_subcarrier_at(const wf_composite *c, int64_t frame, int line, int sample);

/* Fills a row with sin a and cos a, which multiply U and V; the sign of cos a is that of the V
 * switch. */
void wf_subcarrier_row(const wf_composite *c, int64_t frame, int line, float *restrict sine,
                       float *restrict cosine);

#endif
