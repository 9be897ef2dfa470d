#ifndef WF_COLOR_CODES_ENCODING_H
#define WF_COLOR_CODES_ENCODING_H

#include <stdbool.h>
#include <stdint.h>

#include "color/codes/chroma.h"
#include "color/codes/display.h"
#include "color/codes/dither.h"
#include "color/line/luma.h"

/* clip holds the codes of narrow range within 16..235 (chroma 16..240) of 8 bits; r103 holds
 * colors within the limits of EBU R 103 (color/codes/r103.h). */
typedef enum wf_legalize { WF_LEGAL_NONE, WF_LEGAL_CLIP, WF_LEGAL_R103 } wf_legalize;

/* What r103 has done, in pixels: those seen, those changed, and those still outside. */
typedef struct wf_legal_counts {
    int64_t pixels, touched, outside;
} wf_legal_counts;

/* How a line of display-encoded R'G'B' becomes codes. */
typedef struct wf_encoding {
    wf_luma luma;
    wf_chroma chroma; /* ignored for R'G'B' */
    wf_legalize legalize;
    wf_dither dither;
    int line;   /* of the frame, counted from the top: it chooses the noise */
    bool ycbcr; /* false: the codes are R'G'B' */
    bool full_range;
    int bits; /* 8, 10, 12 or 16 */
    int width_px;
    const wf_display
        *display;           /* luma-adjust keeps the luminance of this one; else NULL will do */
    wf_legal_counts *legal; /* r103 adds to it; NULL: nobody counts */
} wf_encoding;

#endif
