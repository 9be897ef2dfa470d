#ifndef WF_CONVERT_READ_EXR_HUFFMAN_H
#define WF_CONVERT_READ_EXR_HUFFMAN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "filters/base/isa.h"

/* OpenEXR's Huffman codes, which PIZ packs samples with and DWA coefficients: words of 16 bits
 * by canonical codes, the longest of which are the lowest numbers, and one symbol more, the
 * highest, that is followed by 8 bits which say how many times the word before it comes again.
 */

#define WF_HUFFMAN_FAST    14 /* bits that the table of lengths is asked with */
#define WF_HUFFMAN_LONGEST 56 /* bits of a code; it would take 10^11 words to need more */
#define WF_HUFFMAN_SYMBOLS                                                                     \
    65537 /* words, and the symbol of runs where it is above them all                          \
           */

typedef struct wf_huffman_codes {
    /* Length in bits of the code that a word of WF_HUFFMAN_FAST bits begins with; 0: a longer
     * one, or none. */
    uint8_t length[1 << WF_HUFFMAN_FAST];
    uint32_t count[WF_HUFFMAN_LONGEST + 1];  /* of codes of a length */
    uint64_t first[WF_HUFFMAN_LONGEST + 1];  /* the least of them, from the top bit down */
    uint64_t offset[WF_HUFFMAN_LONGEST + 1]; /* a code + offset[its length]: its symbol's index,
                                                modulo 2^64 */
    uint16_t symbol[WF_HUFFMAN_SYMBOLS];     /* by length, then by themselves */
    uint32_t symbols, run;                   /* how many; the index of the symbol of runs */
    /* The symbols that have codes, in their order, and the lengths of these. */
    uint16_t coded[WF_HUFFMAN_SYMBOLS];
    uint8_t bits_of[WF_HUFFMAN_SYMBOLS];
} wf_huffman_codes;

/* Codes as bits, the top bit of a byte first, and the words that they become. */
typedef struct wf_huffman_stream {
    const wf_huffman_codes *codes;
    const uint8_t *packed;
    size_t bits;    /* of packed, all of which the words take */
    uint16_t *word; /* [words] */
    size_t words;
} wf_huffman_stream;

/* One table for each instruction set; all give the same words. */
typedef struct wf_huffman_ops {
    /* False where a code is none, where a run is of nothing, and where bits and words do not
     * end together. Words are written in any case, and never more than there are. */
    bool (*decode)(const wf_huffman_stream *stream);
} wf_huffman_ops;

WF_ISA_DECLARE(wf_huffman_ops);

/* Reads the header and the table of codes that stand in front of a packed stream of `bytes`
 * bytes; what follows them becomes stream->packed and stream->bits. Returns what is wrong with
 * them, or NULL. */
const char *wf_huffman_open(wf_huffman_codes *codes, const uint8_t *packed, size_t bytes,
                            wf_huffman_stream *stream);

#endif
