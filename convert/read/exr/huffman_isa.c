/* Words from OpenEXR's Huffman codes.
 *
 * What limits the speed is the chain from one code to the next: its length must be known before
 * the next one can be looked at. So a table gives the length alone, in a byte, and is small
 * enough for the first cache; the symbol is looked up beside that chain. */
#include "convert/read/exr/huffman.h"

#include <string.h>

#include "filters/base/isa_file.h"

/* Where a stream is. */
typedef struct cursor {
    uint64_t bits;  /* not taken yet, from the top bit down */
    unsigned count; /* of these that are there; those below are 0, or what follows */
    const uint8_t *next, *end;
    uint16_t *word, *last; /* the next word, and the end of all */
    const uint16_t *first;
} cursor;

static cursor begin(const wf_huffman_stream *s) {
    return (cursor){.next = s->packed,
                    .end = s->packed + (s->bits + 7) / 8,
                    .word = s->word,
                    .last = s->word + s->words,
                    .first = s->word};
}

/* Whether `words` words and eight bytes of codes are left, so that nothing needs to be looked
 * at before it is read or written. */
static inline bool is_inside(const cursor *c, ptrdiff_t words) {
    return c->end - c->next >= 8 && c->last - c->word >= words;
}

/* At least 56 bits, of a cursor with eight bytes before its end. */
static inline void refill(cursor *c) {
    uint64_t more = 0;
    for (int i = 0; i < 8; i++) more = more << 8 | c->next[i];
    c->bits |= more >> c->count;
    c->next += (63 - c->count) >> 3;
    c->count |= 56;
}

static inline void refill_at_end(cursor *c) {
    while (c->count <= 56 && c->next < c->end) {
        c->bits |= (uint64_t)*c->next++ << (56 - c->count);
        c->count += 8;
    }
}

static inline void refill_anywhere(cursor *c) {
    if (c->end - c->next >= 8)
        refill(c);
    else
        refill_at_end(c);
}

static inline void skip(cursor *c, unsigned bits) {
    c->bits <<= bits;
    c->count -= bits;
}

/* A code of at most WF_HUFFMAN_FAST bits that is no run becomes a word. False, with nothing
 * taken, of any other. */
static inline bool take_word(const wf_huffman_codes *codes, cursor *c) {
    unsigned length = codes->length[c->bits >> (64 - WF_HUFFMAN_FAST)];
    uint64_t index = (c->bits >> (-length & 63)) + codes->offset[length];
    if (!length || index == codes->run) return false;
    *c->word++ = codes->symbol[index];
    skip(c, length);
    return true;
}

/* The length of any code; 0: it is none. */
static unsigned length_of(const wf_huffman_codes *codes, uint64_t bits) {
    unsigned length = codes->length[bits >> (64 - WF_HUFFMAN_FAST)];
    for (unsigned l = WF_HUFFMAN_FAST + 1; !length && l <= WF_HUFFMAN_LONGEST; l++)
        if (bits >= codes->first[l] && (bits - codes->first[l]) >> (64 - l) < codes->count[l])
            length = l;
    return length;
}

static bool repeat(cursor *c, unsigned times) {
    if (c->word == c->first || c->last - c->word < (ptrdiff_t)times) return false;
    for (uint16_t word = c->word[-1]; times; times--) *c->word++ = word;
    return true;
}

/* A code of any kind, wherever it is. */
static bool take_any(const wf_huffman_codes *codes, cursor *c) {
    refill_anywhere(c);
    unsigned length = length_of(codes, c->bits);
    if (!length || length > c->count) return false;
    uint64_t index = (c->bits >> (64 - length)) + codes->offset[length];
    skip(c, length);
    if (index != codes->run) {
        if (c->word == c->last) return false;
        *c->word++ = codes->symbol[index];
        return true;
    }
    refill_anywhere(c);
    if (c->count < 8) return false;
    unsigned times = (unsigned)(c->bits >> 56);
    skip(c, 8);
    return repeat(c, times);
}

static bool end(const wf_huffman_codes *codes, cursor *c, size_t bits) {
    while (c->word < c->last)
        if (!take_any(codes, c)) return false;
    refill_at_end(c);
    return c->next == c->end && c->count == (8 - bits % 8) % 8;
}

/* Four words, or one thing of another kind. */
static inline bool take_some(const wf_huffman_codes *codes, cursor *c) {
    refill(c);
    if (take_word(codes, c) && take_word(codes, c) && take_word(codes, c) &&
        take_word(codes, c))
        return true;
    return take_any(codes, c);
}

static bool decode(const wf_huffman_stream *s) {
    const wf_huffman_codes *codes = s->codes;
    cursor c = begin(s);
    while (is_inside(&c, 4))
        if (!take_some(codes, &c)) return false;
    return end(codes, &c, s->bits);
}

const wf_huffman_ops WF_ISA_TABLE(wf_huffman_ops) = {
    .decode = decode,
};
