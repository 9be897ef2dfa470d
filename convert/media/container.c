/* Completes finished files: MXF here, QuickTime in container_mov.c, Matroska in
 * container_mkv.c. */
#include "convert/media/container.h"

#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "convert/base/big_endian.h"
#include "convert/media/container_mkv.h"
#include "convert/media/container_mov.h"
#include "convert/media/klv.h"

#define SET_MOST        8192 /* bytes of a descriptor that is completed; they have some hundred */
#define DOMINANCE_BYTES 5
#define SETS_MOST       (1 << 20)
#define UMID_BYTES      32
#define LONG_LENGTH     0x83 /* three bytes of length follow */

/* ---- MXF: picture descriptors ---- */

static void put_item(uint8_t *set, size_t bytes, unsigned tag, uint64_t value) {
    size_t length, at = wf_klv_item(set, bytes, tag, &length);
    if (length) wf_put_big_endian(set + at, value, length);
}

/* Frames that are whole keep the line map of libavformat, which counts their own lines. */
static void put_line_map(uint8_t *set, size_t bytes, const wf_raster *r) {
    size_t length, at = wf_klv_item(set, bytes, WF_MXF_LINE_MAP, &length);
    if (length != 16 || !r->total_lines || r->scan != WF_INTERLACED) return;
    wf_put_big_endian(set + at + 8, (uint64_t)r->line1, 4);
    wf_put_big_endian(set + at + 12, (uint64_t)r->line2, 4);
}

/* The picture of a 601 raster is called 4:3 or 16:9, though its pixels do not come to that
 * exactly. */
static void put_aspect(uint8_t *set, size_t bytes, const wf_raster *r) {
    size_t length, at = wf_klv_item(set, bytes, WF_MXF_ASPECT, &length);
    bool of_601 = r->matrix == WF_601_525 || r->matrix == WF_601_625;
    bool wide = wf_ratio_value(r->pixel_aspect) > 1.15;
    if (length != 8 || !of_601 || !r->total_lines) return;
    wf_put_big_endian(set + at, wide ? 16 : 4, 4);
    wf_put_big_endian(set + at + 4, wide ? 9 : 3, 4);
}

/* The field that is first in time is field 1 in all rasters. libavformat writes the item for
 * some codecs only; for the others it is appended to the set. */
static size_t put_dominance(uint8_t *set, size_t bytes, const wf_raster *r) {
    size_t length;
    (void)wf_klv_item(set, bytes, WF_MXF_DOMINANCE, &length);
    if (length || r->scan != WF_INTERLACED) return 0;
    wf_put_big_endian(set + bytes, WF_MXF_DOMINANCE, 2);
    wf_put_big_endian(set + bytes + 2, 1, 2);
    set[bytes + 4] = 1;
    return DOMINANCE_BYTES;
}

/* ---- MXF: identity ---- */

void wf_container_number(const uint8_t identity[16], unsigned n, uint8_t number[16]) {
    XXH128_hash_t hash = XXH3_128bits_withSeed(identity, 16, n);
    XXH128_canonicalFromHash((XXH128_canonical_t *)(void *)number, hash);
    number[6] = (uint8_t)((number[6] & 0x0f) | 0x50); /* RFC 4122: by name */
    number[8] = (uint8_t)((number[8] & 0x3f) | 0x80);
}

/* Writes numbers into the basic UMIDs (SMPTE ST 330) of a value: libavformat's are 0 but for
 * the last byte, which tells the packages apart. Returns whether there are any. */
static bool put_umids(uint8_t *value, size_t bytes, const uint8_t identity[16]) {
    static const uint8_t label[] = {6, 10, 0x2b, 0x34, 1, 1, 1, 5, 1, 1, 13, 0}, none[15];
    bool any = false;
    for (size_t at = 0; at + UMID_BYTES <= bytes; at++) {
        uint8_t *number = value + at + 16;
        if (memcmp(value + at, label, sizeof label) || memcmp(number, none, sizeof none))
            continue;
        wf_container_number(identity, number[15], number);
        any = true;
    }
    return any;
}

/* Writes the number of a package, which its set has in its UMID, into its name, which is in
 * UTF-16. */
static void put_name(uint8_t *set, size_t bytes) {
    static const char digits[] = "0123456789abcdef", name[] = WF_MXF_PACKAGE_NAME;
    size_t length, id_length;
    size_t at = wf_klv_item(set, bytes, WF_MXF_NAME, &length);
    size_t id = wf_klv_item(set, bytes, WF_MXF_PACKAGE_ID, &id_length);
    if (length < 2 * (sizeof name - 1) || id_length != UMID_BYTES) return;
    for (size_t i = 0; i < sizeof name - 1; i++)
        if (set[at + 2 * i] || set[at + 2 * i + 1] != name[i]) return;
    for (size_t i = 0; i < 32; i++) {
        uint8_t byte = set[id + 16 + i / 2];
        set[at + 2 * (5 + i) + 1] = (uint8_t)digits[i % 2 ? byte & 15 : byte >> 4];
    }
}

/* ---- The file ---- */

static weft_status put_bytes(wf_outfile *file, int64_t at, const uint8_t *bytes, size_t count,
                             weft_error *err) {
    weft_status status = wf_outfile_seek(file, at, err);
    return status ? status : wf_outfile_write(file, bytes, count, err);
}

static weft_status read_head(wf_outfile *file, int64_t at, wf_klv *out, bool *end,
                             weft_error *err) {
    uint8_t head[WF_KLV_HEAD_BYTES];
    size_t got;
    weft_status status = wf_outfile_read(file, at, head, sizeof head, &got, err);
    *end = !status && !got;
    if (status || !got || wf_klv_parse(head, got, at, out)) return status;
    return wf_fail(err, WEFT_FAILED, "the MXF that libavformat wrote is not well formed");
}

static weft_status put_length(wf_outfile *file, int64_t value_at, size_t bytes,
                              weft_error *err) {
    uint8_t length[4] = {LONG_LENGTH};
    wf_put_big_endian(length + 1, bytes, 3);
    return put_bytes(file, value_at - 4, length, sizeof length, err);
}

/* Finds the fill item behind the sets of the header. *fits: its length and that of `set` can
 * be changed. */
static weft_status find_fill(wf_outfile *file, const wf_klv *set, wf_klv *fill, bool *fits,
                             weft_error *err) {
    bool end = false;
    weft_status status = WEFT_OK;
    for (*fill = *set; !status && !end && !wf_klv_is_fill(fill->key);)
        status = read_head(file, fill->next, fill, &end, err);
    uint8_t first[2] = {0};
    size_t got;
    if (!status) status = wf_outfile_read(file, set->value - 4, first, 1, &got, err);
    if (!status) status = wf_outfile_read(file, fill->value - 4, first + 1, 1, &got, err);
    *fits = !end && first[0] == LONG_LENGTH && first[1] == LONG_LENGTH &&
            fill->next - fill->value >= DOMINANCE_BYTES && fill->value - set->next < SETS_MOST;
    return status;
}

/* Makes the set longer by `more` bytes: what stands between it and the fill item moves on,
 * and the fill item becomes as much shorter. */
static weft_status move_sets(wf_outfile *file, const wf_klv *set, const wf_klv *fill,
                             size_t more, weft_error *err) {
    size_t between = (size_t)(fill->value - set->next), got = 0;
    uint8_t *bytes = malloc(between);
    if (!bytes) return wf_fail(err, WEFT_NO_MEMORY, "no memory for the sets of an MXF file");
    weft_status status = wf_outfile_read(file, set->next, bytes, between, &got, err);
    if (!status) status = put_bytes(file, set->next + (int64_t)more, bytes, between, err);
    free(bytes);
    if (!status)
        status = put_length(file, fill->value + (int64_t)more,
                            (size_t)(fill->next - fill->value) - more, err);
    size_t length = (size_t)(set->next - set->value) + more;
    return status ? status : put_length(file, set->value, length, err);
}

static weft_status complete_descriptor(wf_outfile *file, const wf_klv *k,
                                       const wf_raster *raster, weft_error *err) {
    uint8_t set[SET_MOST + DOMINANCE_BYTES];
    size_t bytes = (size_t)(k->next - k->value), got;
    if (bytes > SET_MOST) return WEFT_OK;
    weft_status status = wf_outfile_read(file, k->value, set, bytes, &got, err);
    if (status || got < bytes) return status;
    put_line_map(set, bytes, raster);
    put_aspect(set, bytes, raster);
    put_item(set, bytes, WF_MXF_SITING, 0);
    wf_klv fill;
    bool fits;
    status = find_fill(file, k, &fill, &fits, err);
    size_t more = fits ? put_dominance(set, bytes, raster) : 0;
    if (!status && more) status = move_sets(file, k, &fill, more, err);
    return status ? status : put_bytes(file, k->value, set, bytes + more, err);
}

/* Packages are named by sets of the header, and by the system items of D-10. */
static weft_status complete_identity(wf_outfile *file, const wf_klv *k,
                                     const uint8_t identity[16], weft_error *err) {
    uint8_t set[SET_MOST];
    size_t bytes = (size_t)(k->next - k->value), got;
    if (k->next - k->value > SET_MOST || wf_klv_is_fill(k->key)) return WEFT_OK;
    weft_status status = wf_outfile_read(file, k->value, set, bytes, &got, err);
    if (status || got < bytes || !put_umids(set, bytes, identity)) return status;
    put_name(set, bytes);
    return put_bytes(file, k->value, set, bytes, err);
}

static weft_status complete_mxf(wf_outfile *file, const wf_container_facts *facts,
                                weft_error *err) {
    wf_klv k = {{0}, 0, 0};
    bool end = false;
    weft_status status = WEFT_OK;
    while (!status) {
        int64_t at = k.next;
        status = read_head(file, at, &k, &end, err);
        if (status || end) break;
        status = complete_identity(file, &k, facts->identity, err);
        if (status) break;
        if (!wf_klv_is_picture(wf_klv_set_kind(k.key))) continue;
        status = complete_descriptor(file, &k, facts->raster, err);
        if (!status) status = read_head(file, at, &k, &end, err); /* it may be longer now */
    }
    return status;
}

weft_status wf_container_complete(wf_outfile *file, const wf_container_facts *facts,
                                  weft_error *err) {
    if (!strncmp(facts->muxer, "mxf", 3)) return complete_mxf(file, facts, err);
    if (!strcmp(facts->muxer, "mov") || !strcmp(facts->muxer, "mp4"))
        return wf_container_complete_mov(file, facts, err);
    if (!strcmp(facts->muxer, "matroska")) return wf_container_complete_mkv(file, facts, err);
    return WEFT_OK;
}
