/* Runs of bytes, alone as a compression and within DWA. */
#include "convert/read/exr/rle.h"

#include <string.h>

#include "convert/base/reserve.h"
#include "convert/read/exr/decode.h"

bool wf_exr_expand_runs(const uint8_t *packed, size_t size, uint8_t *out, size_t count) {
    const uint8_t *end = packed + size;
    uint8_t *last = out + count;
    while (packed < end) {
        int n = (int8_t)*packed++;
        size_t bytes = (size_t)(n < 0 ? -n : n + 1), taken = n < 0 ? bytes : 1;
        if ((size_t)(end - packed) < taken || (size_t)(last - out) < bytes) return false;
        if (n < 0)
            memcpy(out, packed, bytes);
        else
            memset(out, *packed, bytes);
        packed += taken;
        out += bytes;
    }
    return out == last;
}

weft_status wf_exr_decode_rle(wf_exr_decoder *d, const wf_exr_shape *shape,
                              const uint8_t *packed, size_t size, uint8_t *out,
                              weft_error *err) {
    if (!wf_reserve(&d->inflated, &d->inflated_capacity, shape->bytes))
        return wf_exr_no_memory(err);
    if (!wf_exr_expand_runs(packed, size, d->inflated, shape->bytes))
        return wf_fail(err, WEFT_FAILED, "its runs do not expand to its size");
    d->suspect |= d->unzip->merge(out, d->inflated, shape->bytes);
    return WEFT_OK;
}
