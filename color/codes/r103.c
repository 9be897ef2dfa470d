/* Which colors EBU R 103 finds outside. */
#include "color/codes/r103.h"

#define ROUNDING 1e-6f /* of floats is no offense */

static int is_outside(float v) {
    const float low = (float)WF_R103_LOW - ROUNDING, high = (float)WF_R103_HIGH + ROUNDING;
    return (v < low) | (v > high);
}

int wf_r103_outside(const float *const rgb[3], size_t count) {
    int outside = 0;
    for (size_t x = 0; x < count; x++)
        outside += is_outside(rgb[0][x]) | is_outside(rgb[1][x]) | is_outside(rgb[2][x]);
    return outside;
}
