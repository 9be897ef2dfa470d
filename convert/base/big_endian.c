/* Numbers as MXF, QuickTime, PNG and DPX have them. */
#include "convert/base/big_endian.h"

uint64_t wf_big_endian(const uint8_t *bytes, size_t count) {
    uint64_t value = 0;
    for (size_t i = 0; i < count; i++) value = value << 8 | bytes[i];
    return value;
}

void wf_put_big_endian(uint8_t *to, uint64_t value, size_t count) {
    for (size_t i = 0; i < count; i++) to[i] = (uint8_t)(value >> 8 * (count - 1 - i));
}
