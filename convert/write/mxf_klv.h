#ifndef WF_CONVERT_WRITE_MXF_KLV_H
#define WF_CONVERT_WRITE_MXF_KLV_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "filters/base/rational.h"

/* Bytes of an MXF file in memory: key, length and value (SMPTE ST 336), and the local sets of
 * ST 377-1 in which items have tags of two bytes. All numbers are big-endian. */

/* A zeroed one is empty; free data. After a failed allocation nothing more is added. */
typedef struct wf_bytes {
    uint8_t *data;
    size_t size, capacity;
    bool failed;
} wf_bytes;

void wf_bytes_put(wf_bytes *b, const void *data, size_t size);
void wf_bytes_number(wf_bytes *b, int size, uint64_t value);

/* A universal label or key: its first and its last eight bytes. */
typedef struct wf_ul {
    uint64_t high, low;
} wf_ul;

/* Labels by the version of the registry that has them; pack and local set keys of ST 377-1. */
#define WF_UL_LABEL(version, low)                                                              \
    { 0x060e2b3404010100 | (version), low }
#define WF_UL_PACK(low)                                                                        \
    { 0x060e2b3402050101, low }
#define WF_UL_SET(low)                                                                         \
    { 0x060e2b3402530101, low }

typedef struct wf_uid {
    uint8_t byte[16];
} wf_uid;

void wf_bytes_ul(wf_bytes *b, wf_ul ul);

/* Begins a KLV; the result goes to wf_klv_end, which writes its length (four bytes, at most
 * 16777215). */
size_t wf_klv_begin(wf_bytes *b, wf_ul key);
void wf_klv_end(wf_bytes *b, size_t begun);

/* Fills up to a multiple of `grid` bytes with a KLV fill item, if any are missing. */
#define WF_KLV_FILL_LEAST 20
void wf_klv_fill(wf_bytes *b, size_t grid);

/* Fills up to `end` bytes; WF_KLV_FILL_LEAST or more are missing. */
void wf_klv_fill_to(wf_bytes *b, size_t end);

/* ---- Items of a local set ---- */

void wf_item_number(wf_bytes *b, uint16_t tag, int size, uint64_t value);
void wf_item_rational(wf_bytes *b, uint16_t tag, wf_rational value);
void wf_item_ul(wf_bytes *b, uint16_t tag, wf_ul value);
void wf_item_uid(wf_bytes *b, uint16_t tag, wf_uid value);
void wf_item_text(wf_bytes *b, uint16_t tag, const char *ascii); /* as UTF-16 */
void wf_item_bytes(wf_bytes *b, uint16_t tag, const void *data, size_t size);

/* An array or batch of count elements; the elements follow it. */
void wf_item_array(wf_bytes *b, uint16_t tag, uint32_t count, uint32_t element_bytes);

/* The primer pack: what every tag that weft writes means. */
void wf_klv_primer(wf_bytes *b);

#endif
