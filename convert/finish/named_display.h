#ifndef WF_CONVERT_FINISH_NAMED_DISPLAY_H
#define WF_CONVERT_FINISH_NAMED_DISPLAY_H

#include "color/space/decode.h"

/* What a display of an OpenColorIO configuration makes of R'G'B', by the display's name: the
 * names of ACES's and Blender's configurations, and weft's own spaces. */
typedef struct wf_named_display {
    const wf_chromaticities *primaries;
    wf_decoding decoding;
    const char *hdr; /* the space of weft that it is, of PQ and HLG; else NULL */
} wf_named_display;

/* False for a name that tells nothing. */
bool wf_named_display_of(const char *display, wf_named_display *out);

#endif
