/* Tables of OpenEXR's Huffman codes, from the lengths that a chunk begins with. */
#include "convert/read/exr/huffman.h"

#include <string.h>

#include "convert/read/exr/little.h"

WF_ISA_DISPATCH(wf_huffman_ops)

#define HEADER_BYTES 20

/* Lengths are stored in six bits each. These values stand for symbols without a code. */
enum { SHORT_RUN = 59, LONG_RUN = 63, SHORTEST_LONG_RUN = 6, SHORTEST_SHORT_RUN = 2 };

/* ---- Lengths ---- */

typedef struct bit_reader {
    const uint8_t *next, *end;
    uint64_t bits; /* the lowest `count` are not taken yet */
    unsigned count;
} bit_reader;

/* False at the end of the bytes. */
static bool take(bit_reader *r, unsigned count, unsigned *value) {
    while (r->count < count) {
        if (r->next == r->end) return false;
        r->bits = r->bits << 8 | *r->next++;
        r->count += 8;
    }
    r->count -= count;
    *value = (unsigned)(r->bits >> r->count) & ((1u << count) - 1);
    return true;
}

/* How many symbols a length stands for that are without a code; 0: it is a length. */
static bool take_gap(bit_reader *r, unsigned length, uint32_t *gap) {
    unsigned more = 0;
    *gap = length < SHORT_RUN ? 0 : length - SHORT_RUN + SHORTEST_SHORT_RUN;
    if (length < LONG_RUN) return true;
    if (!take(r, 8, &more)) return false;
    *gap = more + SHORTEST_LONG_RUN;
    return true;
}

/* Lengths of symbols least .. most; the others have none. *runs: the last of them has one. */
static const char *read_lengths(wf_huffman_codes *c, bit_reader *r, uint32_t least,
                                uint32_t most, bool *runs) {
    unsigned length = 0;
    memset(c->count, 0, sizeof c->count);
    c->symbols = 0;
    for (uint32_t s = least, gap; s <= most; s += gap) {
        if (!take(r, 6, &length) || !take_gap(r, length, &gap))
            return "its table of codes is cut off";
        if (gap > most + 1 - s) return "its table of codes runs over its end";
        if (!gap && length > WF_HUFFMAN_LONGEST) return "a code is longer than any can be";
        *runs = !gap && length && s == most;
        if (!gap && length) {
            c->coded[c->symbols] = (uint16_t)s;
            c->bits_of[c->symbols++] = (uint8_t)length;
            c->count[length]++;
        }
        gap += !gap;
    }
    return NULL;
}

/* ---- Codes ---- */

/* Codes of a length follow each other, and where they end the codes that are one bit shorter
 * begin, whose prefixes they are not. False where two codes begin alike. */
static bool number_codes(wf_huffman_codes *c) {
    uint64_t code = 0;
    uint32_t before = c->symbols;
    memset(c->length, 0, sizeof c->length);
    for (unsigned l = WF_HUFFMAN_LONGEST; l; l--) {
        uint64_t end = code + c->count[l];
        before -= c->count[l];
        if (end > 1ull << l || (l > 1 && end % 2)) return false;
        c->first[l] = code << (64 - l);
        c->offset[l] = before - code;
        if (l <= WF_HUFFMAN_FAST)
            memset(c->length + (code << (WF_HUFFMAN_FAST - l)), (int)l,
                   (size_t)c->count[l] << (WF_HUFFMAN_FAST - l));
        code = end / 2;
    }
    return true;
}

static void sort_symbols(wf_huffman_codes *c, bool runs) {
    uint32_t next[WF_HUFFMAN_LONGEST + 2] = {0};
    for (unsigned l = 1; l <= WF_HUFFMAN_LONGEST; l++) next[l + 1] = next[l] + c->count[l];
    c->run = UINT32_MAX;
    for (uint32_t i = 0; i < c->symbols; i++) {
        uint32_t at = next[c->bits_of[i]]++;
        c->symbol[at] = c->coded[i];
        if (runs && i == c->symbols - 1) c->run = at;
    }
}

const char *wf_huffman_open(wf_huffman_codes *codes, const uint8_t *packed, size_t bytes,
                            wf_huffman_stream *stream) {
    if (bytes < HEADER_BYTES) return "its Huffman header is cut off";
    uint32_t least = wf_little32(packed), most = wf_little32(packed + 4);
    uint32_t bits = wf_little32(packed + 12);
    if (least >= WF_HUFFMAN_SYMBOLS || most >= WF_HUFFMAN_SYMBOLS || least > most)
        return "its Huffman header names symbols that there are not";
    bit_reader r = {.next = packed + HEADER_BYTES, .end = packed + bytes};
    bool runs = false;
    const char *wrong = read_lengths(codes, &r, least, most, &runs);
    if (!wrong && !number_codes(codes)) wrong = "two of its codes begin alike";
    if (wrong) return wrong;
    sort_symbols(codes, runs);
    stream->codes = codes;
    stream->packed = r.next;
    stream->bits = bits;
    return bits > 8 * (size_t)(r.end - r.next) ? "its codes are cut off" : NULL;
}
