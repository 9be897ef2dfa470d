/* Reads the descriptors of MXF (SMPTE ST 377-1) for what libavformat does not hand out. */
#include <string.h>

#include "convert/base/big_endian.h"
#include "convert/media/klv.h"
#include "convert/media/metadata_mxf.h"

#define SET_MOST     8192
#define SETS_MOST    4096 /* triplets of a header before its essence */
#define TIMECODE_SET 0x14
#define PATTERN_AT   64 /* of the label in a partition pack's value */

static void read_picture(const uint8_t *set, size_t bytes, wf_metadata *metadata) {
    size_t length, at = wf_klv_item(set, bytes, WF_MXF_LINE_MAP, &length);
    if (length == 16) {
        metadata->has_line_map = true;
        metadata->line_map[0] = (int)wf_big_endian(set + at + 8, 4);
        metadata->line_map[1] = (int)wf_big_endian(set + at + 12, 4);
    }
    at = wf_klv_item(set, bytes, WF_MXF_FRAME_LAYOUT, &length);
    if (length == 1) metadata->frame_layout = set[at];
    at = wf_klv_item(set, bytes, WF_MXF_DOMINANCE, &length);
    if (length == 1) metadata->dominance = set[at];
    at = wf_klv_item(set, bytes, WF_MXF_SITING, &length);
    if (length == 1) metadata->siting = set[at];
    at = wf_klv_item(set, bytes, WF_MXF_ASPECT, &length);
    if (length == 8 && wf_big_endian(set + at + 4, 4))
        metadata->aspect = wf_ratio((int64_t)wf_big_endian(set + at, 4),
                                    (int64_t)wf_big_endian(set + at + 4, 4));
}

/* The first timecode component is the material package's, which is the one that plays. */
static void read_timecode(const uint8_t *set, size_t bytes, wf_metadata *metadata) {
    size_t length, at = wf_klv_item(set, bytes, WF_MXF_BASE, &length);
    if (length != 2 || metadata->timecode_base) return;
    metadata->timecode_base = (int)wf_big_endian(set + at, 2);
    at = wf_klv_item(set, bytes, WF_MXF_DROP, &length);
    metadata->timecode_drop = length == 1 && set[at];
}

/* The label's item complexity and package complexity: 1 and 1 are OP1a. */
static void read_pattern(const uint8_t *pack, size_t bytes, wf_metadata *metadata) {
    if (bytes < PATTERN_AT + WF_KLV_KEY_BYTES || *metadata->pattern) return;
    unsigned item = pack[PATTERN_AT + 12], package = pack[PATTERN_AT + 13];
    if (item == 0x10)
        strcpy(metadata->pattern, "OPAtom");
    else if (item >= 1 && item <= 3 && package >= 1 && package <= 3)
        snprintf(metadata->pattern, sizeof metadata->pattern, "OP%u%c", item,
                 (char)('a' + package - 1));
}

static bool is_partition(const uint8_t *key) {
    static const uint8_t pack[] = {0x06, 0x0e, 0x2b, 0x34, 0x02, 0x05, 0x01,
                                   0x01, 0x0d, 0x01, 0x02, 0x01, 0x01};
    return !memcmp(key, pack, sizeof pack) && key[13] >= 2 && key[13] <= 4;
}

static bool is_essence(const uint8_t *key) {
    static const uint8_t element[] = {0x06, 0x0e, 0x2b, 0x34, 0x01, 0x02, 0x01};
    return !memcmp(key, element, sizeof element) && key[8] == 0x0d && key[9] == 0x01 &&
           key[10] == 0x03;
}

static size_t read_value(FILE *file, const wf_klv *k, uint8_t value[SET_MOST]) {
    int64_t bytes = k->next - k->value;
    if (bytes > SET_MOST || fseeko(file, (off_t)k->value, SEEK_SET)) return 0;
    return fread(value, 1, (size_t)bytes, file) == (size_t)bytes ? (size_t)bytes : 0;
}

/* The lines of a picture alternate, and a field has about half of the system's lines: where the
 * sum of the two first lines is odd the first one of the picture belongs to field 1. */
void wf_metadata_mxf_scan(wf_metadata *m) {
    bool mapped = m->has_line_map && m->line_map[0] > 0 && m->line_map[1] > 0;
    if (m->scan_known || m->frame_layout != WF_MXF_MIXED_FIELDS || !mapped) return;
    bool field_1_above = (m->line_map[0] ^ m->line_map[1]) & 1;
    m->scan_known = m->interlaced = true;
    m->top_first = field_1_above == (m->dominance != 2);
}

void wf_metadata_mxf(FILE *file, wf_metadata *metadata) {
    wf_klv k = {{0}, 0, 0};
    for (int n = 0; n < SETS_MOST; n++) {
        uint8_t head[WF_KLV_HEAD_BYTES], value[SET_MOST];
        if (fseeko(file, (off_t)k.next, SEEK_SET)) return;
        size_t got = fread(head, 1, sizeof head, file);
        if (!wf_klv_parse(head, got, k.next, &k) || is_essence(k.key)) return;
        int kind = wf_klv_set_kind(k.key);
        bool pack = is_partition(k.key), picture = wf_klv_is_picture(kind);
        bool timecode = kind == TIMECODE_SET;
        size_t bytes = pack || picture || timecode ? read_value(file, &k, value) : 0;
        if (pack && bytes) read_pattern(value, bytes, metadata);
        if (picture && bytes) read_picture(value, bytes, metadata);
        if (timecode && bytes) read_timecode(value, bytes, metadata);
    }
}
