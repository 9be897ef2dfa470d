/* Completes Matroska files of libavformat's: writes the SegmentUID into the segment's
 * information, in place. */
#include "convert/media/container_mkv.h"

#include <libdeflate.h>
#include <string.h>

#include "convert/base/big_endian.h"
#include "convert/media/container.h"

#define INFO_MOST  4096 /* bytes of the information; it has some hundred */
#define HEAD_MOST  12   /* of an element: four of its name, eight of its size */
#define CRC_BYTES  6    /* of a checksum, which comes first */
#define PARTS_MOST 64   /* of a segment, before its information */
#define SEGMENT    0x18538067
#define INFO       0x1549a966
#define TITLE      0x7ba9
#define CHECKSUM   0xbf
#define UID_BYTES  16

typedef struct element {
    uint64_t id, bytes; /* of its value */
    size_t head;        /* bytes before that */
} element;

/* A number whose leading zeros say how long it is. Returns its bytes; 0: it is none. */
static size_t number(const uint8_t *at, size_t bytes, bool marked, uint64_t *value) {
    size_t length = bytes && at[0] ? (size_t)__builtin_clz(at[0]) - 23 : 0;
    if (!length || length > bytes) return 0;
    *value = wf_big_endian(at, length);
    if (!marked) *value &= ((uint64_t)1 << 7 * length) - 1;
    return length;
}

static bool parse(const uint8_t *at, size_t bytes, element *out) {
    size_t id = number(at, bytes, true, &out->id);
    size_t size = id ? number(at + id, bytes - id, false, &out->bytes) : 0;
    out->head = id + size;
    return size != 0;
}

static weft_status malformed(weft_error *err) {
    return wf_fail(err, WEFT_FAILED,
                   "the Matroska file that libavformat wrote is not well formed");
}

/* Finds the information, into which the segment is entered on the way. */
static weft_status find_info(wf_outfile *file, int64_t *at, element *info, weft_error *err) {
    *at = 0;
    for (int n = 0; n < PARTS_MOST; n++) {
        uint8_t head[HEAD_MOST];
        size_t got;
        weft_status status = wf_outfile_read(file, *at, head, sizeof head, &got, err);
        if (status) return status;
        if (!parse(head, got, info)) return malformed(err);
        *at += (int64_t)info->head;
        if (info->id == INFO) return WEFT_OK;
        if (info->id != SEGMENT) *at += (int64_t)info->bytes;
    }
    return malformed(err);
}

/* Writes the number over the title, which has its length. False where that is not as it was
 * given. */
static bool put_uid(uint8_t *info, size_t bytes, const uint8_t uid[UID_BYTES]) {
    static const uint8_t head[] = {0x73, 0xa4, 0x90};
    element e;
    for (size_t at = 0; at < bytes && parse(info + at, bytes - at, &e);
         at += e.head + e.bytes) {
        if (e.id != TITLE) continue;
        if (e.head != sizeof head || e.bytes != UID_BYTES || e.bytes > bytes - at - e.head ||
            memcmp(info + at + e.head, WF_MKV_TITLE, UID_BYTES))
            return false;
        memcpy(info + at, head, sizeof head);
        memcpy(info + at + sizeof head, uid, UID_BYTES);
        return true;
    }
    return false;
}

/* A checksum is of all that follows it, its low byte first. */
static void sum(uint8_t *info, size_t bytes) {
    if (bytes < CRC_BYTES || info[0] != CHECKSUM) return;
    uint32_t crc = libdeflate_crc32(0, info + CRC_BYTES, bytes - CRC_BYTES);
    for (int i = 0; i < 4; i++) info[2 + i] = (uint8_t)(crc >> 8 * i);
}

weft_status wf_container_complete_mkv(wf_outfile *file, const wf_container_facts *facts,
                                      weft_error *err) {
    uint8_t info[INFO_MOST], uid[UID_BYTES];
    int64_t at;
    element e = {0, 0, 0};
    size_t got = 0;
    weft_status status = find_info(file, &at, &e, err);
    if (!status && e.bytes > sizeof info) status = malformed(err);
    if (!status) status = wf_outfile_read(file, at, info, (size_t)e.bytes, &got, err);
    if (status) return status;
    wf_container_number(facts->identity, 0, uid);
    if (got < e.bytes || !put_uid(info, got, uid)) return malformed(err);
    sum(info, got);
    status = wf_outfile_seek(file, at, err);
    return status ? status : wf_outfile_write(file, info, got, err);
}
