#ifndef WF_CONVERT_READ_EXR_DWA_H
#define WF_CONVERT_READ_EXR_DWA_H

#include "convert/read/exr/dwa_rules.h"

/* Inside DWA: what a chunk holds, and where it goes. */

/* The streams of a chunk, expanded. */
typedef struct wf_dwa_streams {
    const uint8_t *deflated;     /* channels of that way, plane after plane */
    const uint8_t *runs;         /* the same, each plane as planes of its bytes */
    const uint16_t *ac, *ac_end; /* coefficients and runs of zeros, block by block */
    const uint16_t *dc;          /* the first coefficients of blocks, plane after plane */
    const uint16_t *linear;      /* [65536]: light of the curve that was rounded, halves */
} wf_dwa_streams;

/* Where lines of channels lie in the chunk's samples. */
typedef struct wf_dwa_lines {
    uint8_t **line; /* of all channels, one channel after the other, from the top */
    size_t *first;  /* [channels]: the index of a channel's first one */
} wf_dwa_lines;

/* Blocks of 8x8 that cover so many samples or lines. */
static inline size_t wf_dwa_blocks(size_t samples) {
    return (samples + 7) / 8;
}

/* Decodes the rounded channels of the plan; streams->ac and dc move on. False where
 * coefficients are missing. */
bool wf_dwa_decode_lossy(const wf_exr_shape *shape, const wf_dwa_plan *plan,
                         wf_dwa_streams *streams, const wf_dwa_lines *lines);

/* Fills table[65536], of halves: light from what was rounded, the power 2.2 up to 1 and an
 * exponential above; what is not finite becomes 0. */
void wf_dwa_make_linear(uint16_t *table);

#endif
