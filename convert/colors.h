#ifndef WF_CONVERT_COLORS_H
#define WF_CONVERT_COLORS_H

#include "color/space.h"
#include "filters/raster.h"

/* The colors of a raster: BT.601's two systems have primaries of their own. Static storage. */
typedef struct wf_colors {
    const char *space; /* its encoding, of color/weft.ocio */
    wf_luma luma;
    wf_primaries primaries;
} wf_colors;

const wf_colors *wf_colors_of(wf_matrix matrix);

#endif
