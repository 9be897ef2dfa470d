#ifndef WF_CONVERT_READ_EXR_DCT_H
#define WF_CONVERT_READ_EXR_DCT_H

#include <stdint.h>

#include "filters/base/isa.h"

/* Blocks of 8x8 samples of DWA. Sums are made in the order in which OpenEXR makes them on
 * processors with AVX, whose results are thereby had to the last bit. */

/* One table for each instruction set; all give the same numbers. */
typedef struct wf_dct_ops {
    /* Coefficients [8][8], halves, of which only the first `rows` rows hold any, 1 to 8, become
     * samples [8][8]. */
    void (*inverse)(const uint16_t *coefficient, int rows, float *sample);
    /* Y', Cb and Cr of 64 samples each become R', G' and B' in their place, by the matrix of
     * Rec. ITU-R BT.709. */
    void (*rgb)(float *y, float *cb, float *cr);
    /* 64 floats to the nearest halves. */
    void (*halves)(uint16_t *to, const float *from);
} wf_dct_ops;

WF_ISA_DECLARE(wf_dct_ops);

#endif
