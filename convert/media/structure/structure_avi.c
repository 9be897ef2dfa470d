/* AVI's structure (RIFF): chunks to the last byte, and the index. */
#include <inttypes.h>
#include <string.h>

#include "convert/media/structure/extent.h"

static uint32_t little(const uint8_t *b) {
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

/* Where the chunk at `at` ends, with the byte that makes it even; 0: it is not whole. */
static int64_t end_of(const wf_extent *x, int64_t at, uint8_t head[12]) {
    memset(head, 0, 12);
    if (!wf_extent_read(x, at, head, 8)) return 0;
    int64_t bytes = little(head + 4), end = at + 8 + bytes;
    (void)wf_extent_read(x, at, head, 12);
    if (end > x->bytes) return 0;
    return end + (bytes % 2 && end < x->bytes);
}

static bool has_index(const wf_extent *x, int64_t at, int64_t end) {
    uint8_t head[12];
    for (int64_t next; at < end && (next = end_of(x, at, head)); at = next)
        if (!memcmp(head, "idx1", 4)) return true;
    return false;
}

void wf_structure_avi(const wf_extent *x, wf_structure *s) {
    uint8_t head[12];
    bool first = true, index = false;
    s->ends = true;
    for (int64_t at = 0, next; at < x->bytes; at = next) {
        next = end_of(x, at, head);
        if (!next)
            return wf_missing(s, "it ends within the chunk that begins at byte %" PRId64, at);
        if (first) index = has_index(x, at + 12, next);
        first = false;
    }
    if (!index) wf_missing(s, "its index (idx1) is not there");
}
