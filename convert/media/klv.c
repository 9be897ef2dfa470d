/* Reads MXF: keys, lengths and values, and the items of header sets. */
#include "convert/media/klv.h"

#include <string.h>

#include "convert/base/big_endian.h"

bool wf_klv_parse(const uint8_t *head, size_t count, int64_t at, wf_klv *out) {
    if (count <= WF_KLV_KEY_BYTES) return false;
    memcpy(out->key, head, WF_KLV_KEY_BYTES);
    uint8_t first = head[WF_KLV_KEY_BYTES];
    size_t more = first & 0x80 ? first & 0x7f : 0;
    if (more > 8 || WF_KLV_KEY_BYTES + 1 + more > count) return false;
    uint64_t length = more ? wf_big_endian(head + WF_KLV_KEY_BYTES + 1, more) : first;
    out->value = at + WF_KLV_KEY_BYTES + 1 + (int64_t)more;
    if (length > (uint64_t)(INT64_MAX - out->value)) return false;
    out->next = out->value + (int64_t)length;
    return true;
}

int wf_klv_set_kind(const uint8_t key[WF_KLV_KEY_BYTES]) {
    static const uint8_t set[] = {0x06, 0x0e, 0x2b, 0x34, 0x02, 0x53, 0x01,
                                  0x01, 0x0d, 0x01, 0x01, 0x01, 0x01, 0x01};
    return memcmp(key, set, sizeof set) ? -1 : key[sizeof set];
}

bool wf_klv_is_picture(int kind) {
    return kind == 0x27 || kind == 0x28 || kind == 0x29 || kind == 0x51;
}

/* Byte 7 of the key is the version of the registry, and either is a fill item. */
bool wf_klv_is_fill(const uint8_t key[WF_KLV_KEY_BYTES]) {
    static const uint8_t begins[] = {0x06, 0x0e, 0x2b, 0x34, 0x01, 0x01, 0x01},
                         ends[] = {0x03, 0x01, 0x02, 0x10, 0x01, 0x00, 0x00, 0x00};
    return !memcmp(key, begins, sizeof begins) && !memcmp(key + 8, ends, sizeof ends);
}

size_t wf_klv_item(const uint8_t *set, size_t bytes, unsigned tag, size_t *length) {
    for (size_t at = 0; at + 4 <= bytes; at += 4 + *length) {
        *length = (size_t)wf_big_endian(set + at + 2, 2);
        if (*length > bytes - at - 4) break;
        if (wf_big_endian(set + at, 2) == tag) return at + 4;
    }
    *length = 0;
    return 0;
}
