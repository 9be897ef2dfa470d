/* ZIP of OpenEXR: bytes are brought into an order that deflates well, and deflated. */
#include "convert/write/exr_zip.h"

#include <string.h>

/* Every second byte of `from`, as the difference from the one before it, around 128. */
static void put_differences(const uint8_t *from, size_t count, uint8_t before, uint8_t *to) {
    if (count) to[0] = (uint8_t)(from[0] - before + 128);
    for (size_t i = 1; i < count; i++) to[i] = (uint8_t)(from[2 * i] - from[2 * i - 2] + 128);
}

/* First the even bytes, then the odd ones; the very first stays itself. */
static void split(const uint8_t *from, size_t count, uint8_t *to) {
    size_t even = (count + 1) / 2;
    if (!count) return;
    put_differences(from, even, 128, to);
    put_differences(from + 1, count / 2, from[2 * (even - 1)], to + even);
}

size_t wf_exr_zip(struct libdeflate_compressor *how, const uint8_t *raw, size_t count,
                  uint8_t *merged, uint8_t *packed) {
    split(raw, count, merged);
    size_t bytes =
        count > 1 ? libdeflate_zlib_compress(how, merged, count, packed, count - 1) : 0;
    if (bytes) return bytes;
    memcpy(packed, raw, count);
    return count;
}
