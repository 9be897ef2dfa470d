#ifndef WF_CONVERT_READ_EXR_HALF_H
#define WF_CONVERT_READ_EXR_HALF_H

#include <stdint.h>
#include <string.h>

/* Halves (IEEE 754 binary16) and floats, one at a time. */

static inline float wf_float_of_half(uint16_t half) {
    uint32_t magnitude = half & 0x7fffu;
    union {
        uint32_t bits;
        float value;
    } result = {.bits = magnitude << 13};
    if (magnitude < 0x7c00)
        result.value *= 0x1p112f;
    else
        result.bits += 0x70000000; /* Inf and NaN */
    result.bits |= (uint32_t)(half & 0x8000) << 16;
    return result.value;
}

/* The nearest half, of two the even one. */
static inline uint16_t wf_half_of_float(float value) {
    uint32_t bits, rounded;
    memcpy(&bits, &value, sizeof bits);
    uint32_t sign = bits >> 16 & 0x8000, magnitude = bits & 0x7fffffff;
    if (magnitude > 0x7f800000) return (uint16_t)(sign | 0x7e00 | (magnitude >> 13 & 0x3ff));
    if (magnitude >= 0x47800000) return (uint16_t)(sign | 0x7c00);
    if (magnitude < 0x38800000) { /* a multiple of 2^-24, which the sum is rounded to */
        float small;
        memcpy(&small, &magnitude, sizeof small);
        small += 0.5f;
        memcpy(&rounded, &small, sizeof rounded);
        return (uint16_t)(sign | (rounded & 0x7ff));
    }
    rounded = magnitude - 0x38000000 + 0xfff + (magnitude >> 13 & 1);
    return (uint16_t)(sign | rounded >> 13);
}

#endif
