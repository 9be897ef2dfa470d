/* Low passes down and across a picture, and what is seen of what they leave. */
#include "filters/seen/seen.h"

#include <stdint.h>
#include <string.h>

#include "filters/base/isa_file.h"

enum { BLOCK = 32 }; /* samples whose sums stay in registers */

static inline void down_block(float *restrict out, const float *const *row, const float *weight,
                              size_t rows, size_t x, size_t count) {
    float sum[BLOCK] = {0};
    for (size_t k = 0; k < rows; k++)
        for (size_t i = 0; i < count; i++) sum[i] += weight[k] * row[k][x + i];
    for (size_t i = 0; i < count; i++) out[x + i] = sum[i];
}

static void down(float *restrict out, const float *const *row, const float *weight, size_t rows,
                 size_t count) {
    size_t x = 0;
    for (; x + BLOCK <= count; x += BLOCK) down_block(out, row, weight, rows, x, BLOCK);
    down_block(out, row, weight, rows, x, count - x);
}

static inline void across_block(float *restrict out, const float *restrict in,
                                const float *weight, size_t reach, size_t count) {
    float sum[BLOCK];
    for (size_t i = 0; i < count; i++) sum[i] = weight[0] * in[i];
    for (size_t k = 1; k <= reach; k++)
        for (size_t i = 0; i < count; i++) {
            const float *at = in + i;
            sum[i] += weight[k] * (*(at - k) + at[k]);
        }
    for (size_t i = 0; i < count; i++) out[i] = sum[i];
}

static void across(float *restrict out, const float *restrict in, const float *weight,
                   size_t reach, size_t count) {
    size_t x = 0;
    for (; x + BLOCK <= count; x += BLOCK) across_block(out + x, in + x, weight, reach, BLOCK);
    across_block(out + x, in + x, weight, reach, count - x);
}

/* The two upper bits of a float's mantissa tell the quarter of its octave, and the others how
 * far it is from there to the next, for knots lie evenly between octaves. */
static inline float weight_at(const wf_eye *eye, int band, float cd_m2) {
    const float low = 0x1p-7f, high = 16383;
    uint32_t bits;
    cd_m2 = cd_m2 > low ? cd_m2 : low;
    cd_m2 = cd_m2 < high ? cd_m2 : high;
    memcpy(&bits, &cd_m2, sizeof bits);
    uint32_t knot = (bits >> 21) - ((127 + WF_EYE_LOW) << 2);
    float rest = (float)(bits & 0x1fffff) * 0x1p-21f;
    float a = eye->weight[knot][band], b = eye->weight[knot + 1][band];
    return a + rest * (b - a);
}

static void add_band(float *restrict sum, const float *restrict part,
                     const float *restrict local, const wf_eye *eye, int band, float white,
                     size_t count) {
    for (size_t x = 0; x < count; x++)
        sum[x] += weight_at(eye, band, white * local[x]) * part[x];
}

const wf_seen_ops WF_ISA_TABLE(wf_seen_ops) = {down, across, add_band};
