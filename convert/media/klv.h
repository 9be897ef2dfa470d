#ifndef WF_CONVERT_MEDIA_KLV_H
#define WF_CONVERT_MEDIA_KLV_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* MXF's coding, SMPTE ST 336 and ST 377-1: keys, lengths and values, and in header sets items
 * of two-byte tags. Nothing is read beyond the bytes that are given. */

#define WF_KLV_KEY_BYTES  16
#define WF_KLV_HEAD_BYTES 25 /* a key and the longest length */

typedef struct wf_klv {
    uint8_t key[WF_KLV_KEY_BYTES];
    int64_t value, next; /* offsets in the file */
} wf_klv;

/* Reads the head of a triplet at offset `at`, of which `count` bytes are there. False where
 * they are no head. */
bool wf_klv_parse(const uint8_t *head, size_t count, int64_t at, wf_klv *out);

/* A kind of header set (ST 377-1, annex): 0x28 a CDCI descriptor, 0x14 a timecode component ..;
 * -1: no set. */
int wf_klv_set_kind(const uint8_t key[WF_KLV_KEY_BYTES]);

/* Whether a kind of set describes pictures: CDCI, RGBA, MPEG-2 or generic. */
bool wf_klv_is_picture(int kind);

/* Whether it is a fill item, whose value says nothing. */
bool wf_klv_is_fill(const uint8_t key[WF_KLV_KEY_BYTES]);

/* Offset of the value of an item of a set of `bytes` bytes; 0, *length 0: it has none. */
size_t wf_klv_item(const uint8_t *set, size_t bytes, unsigned tag, size_t *length);

/* Values of FrameLayout: fields apart have their own heights stated, mixed ones are woven into
 * a picture whose height is stated. */
typedef enum wf_mxf_layout {
    WF_MXF_FULL_FRAME,
    WF_MXF_SEPARATE_FIELDS,
    WF_MXF_ONE_FIELD,
    WF_MXF_MIXED_FIELDS,
    WF_MXF_SEGMENTED_FRAME
} wf_mxf_layout;

/* Tags of ST 377-1. */
enum {
    WF_MXF_STORED_LINES = 0x3202,
    WF_MXF_FRAME_LAYOUT = 0x320c, /* wf_mxf_layout */
    WF_MXF_LINE_MAP = 0x320d,     /* batch of two: count, size, values */
    WF_MXF_ASPECT = 0x320e,       /* rational, of the picture */
    WF_MXF_DOMINANCE = 0x3212,    /* the field that is first in time: 1 or 2 */
    WF_MXF_SITING = 0x3303,       /* of chroma: 0 with the first luma sample of a pair */
    WF_MXF_NAME = 0x4402,         /* of a package, UTF-16 */
    WF_MXF_PACKAGE_ID = 0x4401,   /* its UMID */
    WF_MXF_START = 0x1501,
    WF_MXF_BASE = 0x1502,
    WF_MXF_DROP = 0x1503
};

#endif
