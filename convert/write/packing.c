/* Packs 4:2:2 frames into the bytes of v210 and uyvy. */
#include "convert/write/packing.h"

#include <string.h>

/* ---- v210: six pixels in four little-endian words of three 10-bit codes ---- */

static size_t v210_line_bytes(const wf_output_options *o) {
    return ((size_t)o->raster->width_px + 47) / 48 * 128;
}

size_t wf_v210_bytes(const wf_output_options *o) {
    return v210_line_bytes(o) * (size_t)o->raster->lines;
}

static void put_word(uint8_t *to, unsigned a, unsigned b, unsigned c) {
    uint32_t word = a | b << 10 | c << 20;
    for (int i = 0; i < 4; i++) to[i] = (uint8_t)(word >> 8 * i);
}

static void put_six(uint8_t *to, const uint16_t *y, const uint16_t *cb, const uint16_t *cr) {
    put_word(to, cb[0], y[0], cr[0]);
    put_word(to + 4, y[1], cb[1], y[2]);
    put_word(to + 8, cr[1], y[3], cb[2]);
    put_word(to + 12, y[4], cr[2], y[5]);
}

/* Packs the last pixels of a line whose width six does not divide; the missing codes are 0. */
static void put_rest(uint8_t *to, const uint16_t *y, const uint16_t *cb, const uint16_t *cr,
                     int count) {
    uint16_t l[6] = {0}, b[3] = {0}, r[3] = {0};
    memcpy(l, y, (size_t)count * sizeof *l);
    memcpy(b, cb, (size_t)count / 2 * sizeof *b);
    memcpy(r, cr, (size_t)count / 2 * sizeof *r);
    put_six(to, l, b, r);
}

size_t wf_v210_pack(const wf_output_options *o, const wf_frame *frame, uint8_t *to) {
    size_t line_bytes = v210_line_bytes(o);
    int width = o->raster->width_px, whole = width / 6 * 6;
    for (int j = 0; j < o->raster->lines; j++, to += line_bytes) {
        const uint16_t *y = wf_frame_codes(frame, 0, j), *cb = wf_frame_codes(frame, 1, j),
                       *cr = wf_frame_codes(frame, 2, j);
        size_t used = ((size_t)width + 5) / 6 * 16;
        for (int x = 0; x < whole; x += 6)
            put_six(to + x / 6 * 16, y + x, cb + x / 2, cr + x / 2);
        if (whole < width)
            put_rest(to + whole / 6 * 16, y + whole, cb + whole / 2, cr + whole / 2,
                     width - whole);
        memset(to + used, 0, line_bytes - used);
    }
    return wf_v210_bytes(o);
}

/* ---- uyvy: 8 bits, Cb Y Cr Y ---- */

size_t wf_uyvy_bytes(const wf_output_options *o) {
    return 2 * (size_t)o->raster->width_px * (size_t)o->raster->lines;
}

size_t wf_uyvy_pack(const wf_output_options *o, const wf_frame *frame, uint8_t *to) {
    for (int j = 0; j < o->raster->lines; j++) {
        const uint16_t *y = wf_frame_codes(frame, 0, j), *cb = wf_frame_codes(frame, 1, j),
                       *cr = wf_frame_codes(frame, 2, j);
        for (int x = 0; x < o->raster->width_px; x += 2, to += 4) {
            to[0] = (uint8_t)cb[x / 2];
            to[1] = (uint8_t)y[x];
            to[2] = (uint8_t)cr[x / 2];
            to[3] = (uint8_t)y[x + 1];
        }
    }
    return wf_uyvy_bytes(o);
}
