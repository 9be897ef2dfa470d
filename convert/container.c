#include "convert/container.h"

#include <string.h>

/* ---- MXF: keys, lengths, values ---- */

#define KEY_BYTES 16
#define SET_MOST  8192 /* of a descriptor; they have some hundred bytes */

typedef struct klv {
    uint8_t key[KEY_BYTES];
    int64_t value, next; /* offsets */
} klv;

static uint64_t big_endian(const uint8_t *bytes, size_t count) {
    uint64_t value = 0;
    for (size_t i = 0; i < count; i++) value = value << 8 | bytes[i];
    return value;
}

static void put_big_endian(uint8_t *to, uint64_t value, size_t count) {
    for (size_t i = 0; i < count; i++) to[i] = (uint8_t)(value >> 8 * (count - 1 - i));
}

/* False at the end of the file. */
static weft_status read_klv(wf_outfile *file, int64_t at, klv *out, bool *more,
                            weft_error *err) {
    uint8_t head[KEY_BYTES + 9];
    size_t got;
    weft_status status = wf_outfile_read(file, at, head, sizeof head, &got, err);
    *more = !status && got > KEY_BYTES;
    if (!*more) return status;
    memcpy(out->key, head, KEY_BYTES);
    size_t longer = head[KEY_BYTES] & 0x80 ? head[KEY_BYTES] & 0x7f : 0;
    if (longer > 8 || KEY_BYTES + 1 + longer > got)
        return wf_fail(err, WEFT_FAILED,
                       "an MXF file that libavformat wrote is not well formed");
    uint64_t length = longer ? big_endian(head + KEY_BYTES + 1, longer) : head[KEY_BYTES];
    out->value = at + KEY_BYTES + 1 + (int64_t)longer;
    out->next = out->value + (int64_t)length;
    return WEFT_OK;
}

/* CDCI, RGBA, MPEG-2 and generic picture descriptors (ST 377-1, annexes D and E). */
static bool is_picture_descriptor(const uint8_t *key) {
    static const uint8_t set[] = {0x06, 0x0e, 0x2b, 0x34, 0x02, 0x53, 0x01,
                                  0x01, 0x0d, 0x01, 0x01, 0x01, 0x01, 0x01};
    static const uint8_t kinds[] = {0x27, 0x28, 0x29, 0x51};
    return !memcmp(key, set, sizeof set) && memchr(kinds, key[sizeof set], sizeof kinds);
}

/* ---- What is mended ---- */

/* Local tags of ST 377-1. */
#define TAG_LINE_MAP 0x320d /* batch: count, size, values */
#define TAG_ASPECT   0x320e /* rational */

static void put_line_map(uint8_t *value, size_t bytes, const wf_raster *r) {
    if (bytes != 16 || !r->total_lines) return;
    put_big_endian(value + 8, (uint64_t)r->line1, 4);
    put_big_endian(value + 12, (uint64_t)r->line2, 4);
}

/* The rasters of 601 are 4:3 or 16:9 pictures, whatever their pixels make of it exactly. */
static void put_aspect(uint8_t *value, size_t bytes, const wf_raster *r) {
    bool narrow = r->matrix == WF_601_525 || r->matrix == WF_601_625;
    bool wide = wf_ratio_value(r->pixel_aspect) > 1.15;
    if (bytes != 8 || !narrow || !r->total_lines) return;
    put_big_endian(value, wide ? 16 : 4, 4);
    put_big_endian(value + 4, wide ? 9 : 3, 4);
}

static void mend_set(uint8_t *set, size_t bytes, const wf_raster *r) {
    for (size_t at = 0; at + 4 <= bytes;) {
        unsigned tag = (unsigned)big_endian(set + at, 2);
        size_t length = (size_t)big_endian(set + at + 2, 2);
        uint8_t *value = set + at + 4;
        if (length > bytes - at - 4) return;
        if (tag == TAG_LINE_MAP) put_line_map(value, length, r);
        if (tag == TAG_ASPECT) put_aspect(value, length, r);
        at += 4 + length;
    }
}

static weft_status mend_descriptor(wf_outfile *file, const klv *k, const wf_raster *raster,
                                   weft_error *err) {
    uint8_t set[SET_MOST];
    size_t bytes = (size_t)(k->next - k->value), got;
    if (bytes > sizeof set) return WEFT_OK;
    weft_status status = wf_outfile_read(file, k->value, set, bytes, &got, err);
    if (status || got < bytes) return status;
    mend_set(set, bytes, raster);
    status = wf_outfile_seek(file, k->value, err);
    return status ? status : wf_outfile_write(file, set, bytes, err);
}

weft_status wf_container_mend(wf_outfile *file, const char *muxer, const wf_raster *raster,
                              weft_error *err) {
    bool more = !strncmp(muxer, "mxf", 3);
    weft_status status = WEFT_OK;
    for (int64_t at = 0; more && !status;) {
        klv k = {{0}, 0, 0};
        status = read_klv(file, at, &k, &more, err);
        if (!status && more && is_picture_descriptor(k.key))
            status = mend_descriptor(file, &k, raster, err);
        at = k.next;
    }
    return status;
}
