/* Half-precision numbers. */
#ifndef WF_FILTERS_BASE_HALF_H
#define WF_FILTERS_BASE_HALF_H

#include <stdint.h>
#include <string.h>

/* The value of an IEEE 754 binary16, exact; NaN and Inf included. */
static inline float wf_half_value(uint16_t half) {
    /* A half's exponent is moved up to a float's by the multiplication, which normalizes
     * subnormals on the way; Inf and NaN need the largest exponent again. */
    uint32_t bits = (uint32_t)(half & 0x7fff) << 13;
    float value;
    memcpy(&value, &bits, sizeof value);
    value *= 0x1p112f;
    memcpy(&bits, &value, sizeof bits);
    if ((half & 0x7c00) == 0x7c00) bits |= 0x7f800000;
    bits |= (uint32_t)(half & 0x8000) << 16;
    memcpy(&value, &bits, sizeof value);
    return value;
}

#endif
