/* PXR24: differences along lines, split into planes of bytes and deflated; floats without their
 * lowest eight bits. */
#include <libdeflate.h>
#include <string.h>

#include "convert/base/reserve.h"
#include "convert/read/exr/decode.h"

static size_t stored_bytes(const wf_exr_channel *c) {
    static const size_t bytes[] = {[WF_EXR_UINT] = 4, [WF_EXR_HALF] = 2, [WF_EXR_FLOAT] = 3};
    return bytes[c->type];
}

static void put_halves(uint8_t *to, const uint8_t *from, size_t width) {
    uint16_t sum = 0;
    for (size_t x = 0; x < width; x++) {
        sum = (uint16_t)(sum + (from[x] << 8 | from[width + x]));
        memcpy(to + 2 * x, &sum, sizeof sum);
    }
}

/* Of `stored` bytes a sample, which are its highest. */
static void put_words(uint8_t *to, const uint8_t *from, size_t width, size_t stored) {
    uint32_t sum = 0;
    for (size_t x = 0; x < width; x++) {
        uint32_t difference = (uint32_t)from[x] << 24 | (uint32_t)from[width + x] << 16 |
                              (uint32_t)from[2 * width + x] << 8;
        if (stored == 4) difference |= from[3 * width + x];
        sum += difference;
        memcpy(to + 4 * x, &sum, sizeof sum);
    }
}

weft_status wf_exr_decode_pxr24(wf_exr_decoder *d, const wf_exr_shape *shape,
                                const uint8_t *packed, size_t size, uint8_t *out,
                                weft_error *err) {
    size_t stored = 0;
    for (int i = 0; i < shape->channels; i++)
        stored += shape->channel[i].width * shape->channel[i].lines *
                  stored_bytes(&shape->channel[i]);
    if (!wf_reserve(&d->inflated, &d->inflated_capacity, stored)) return wf_exr_no_memory(err);
    if (libdeflate_zlib_decompress(d->inflate, packed, size, d->inflated, stored, NULL) !=
        LIBDEFLATE_SUCCESS)
        return wf_fail(err, WEFT_FAILED, "it does not inflate to its size");
    const uint8_t *from = d->inflated;
    for (int y = shape->y0; y < shape->y0 + shape->lines; y++)
        for (int i = 0; i < shape->channels; i++) {
            const wf_exr_channel *c = &shape->channel[i];
            if (!wf_exr_has_line(c, y)) continue;
            if (c->type == WF_EXR_HALF)
                put_halves(out, from, c->width);
            else
                put_words(out, from, c->width, stored_bytes(c));
            from += c->width * stored_bytes(c);
            out += c->line_bytes;
        }
    d->suspect = true;
    return WEFT_OK;
}
