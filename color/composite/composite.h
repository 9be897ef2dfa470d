#ifndef WF_COLOR_COMPOSITE_COMPOSITE_H
#define WF_COLOR_COMPOSITE_COMPOSITE_H

#include <stdbool.h>
#include <stddef.h>

#include "color/composite/standard.h"

/* A coder from whole frames of Y'CbCr 4:4:4 to the composite signal, and the decoders that
 * televisions have. */

/* cheap adds chroma to the luma as it is; filtered first takes out of the luma what lies around
 * the subcarrier, by a filter along the line. */
typedef enum wf_tv_encoder { WF_ENCODER_CHEAP, WF_ENCODER_FILTERED } wf_tv_encoder;

/* notch takes all that lies around the subcarrier for chroma. comb2 and comb3 take the part of
 * it that changes sign, as the subcarrier does, between a line and one or both of its neighbors
 * half a cycle off: the next lines of its field (NTSC), those after the next (PAL). What is not
 * chroma is luma. At the first and last lines the neighbor on the other side serves. */
typedef enum wf_tv_decoder {
    WF_DECODER_NOTCH,
    WF_DECODER_COMB2,
    WF_DECODER_COMB3
} wf_tv_decoder;

typedef struct wf_tv {
    wf_tv_system system;
    wf_tv_encoder encoder;
    wf_tv_decoder decoder;
    int width_px, lines; /* of the frame, both fields woven; 13.5 MHz samples */
    int line1, line2; /* number of the first picture line of field 1 (first in time), field 2 */
    bool top_first;   /* field 1 owns the top picture line */
} wf_tv;

/* Unchanging once made: any number of threads may use it, each with buffers of its own. */
typedef struct wf_composite wf_composite;

/* NULL: no memory. The picture is from 1x1 up to what fits in the system's lines. */
wf_composite *wf_composite_new(const wf_tv *tv);
void wf_composite_free(wf_composite *c);

/* Samples of a row of composite: those of the picture, and a margin on both sides that decoders
 * look at. The margins are coded from the picture reflected about its first and last samples (c
 * b | a b c). Picture sample x is row[x + wf_composite_margin(c)]. */
size_t wf_composite_row(const wf_composite *c);
size_t wf_composite_margin(const wf_composite *c);

/* Floats of scratch that encoding and decoding need: WF_COMPOSITE_SCRATCH_LINES parts, each of
 * which holds a row that is about to be filtered. */
#define WF_COMPOSITE_SCRATCH_LINES 6
size_t wf_composite_scratch(const wf_composite *c);
size_t wf_composite_scratch_line(const wf_composite *c);

#endif
