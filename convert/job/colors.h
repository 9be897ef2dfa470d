#ifndef WF_CONVERT_JOB_COLORS_H
#define WF_CONVERT_JOB_COLORS_H

#include "color/codes/display.h"
#include "color/line/luma.h"
#include "color/space/space.h"
#include "filters/raster/raster.h"

/* The colors of a raster: BT.601's two systems have primaries of their own. Static storage. */
typedef struct wf_colors {
    const char *space; /* its encoding, of color/weft.ocio */
    wf_luma luma;
    wf_primaries primaries;
} wf_colors;

const wf_colors *wf_colors_of(wf_matrix matrix);

/* What files call colors: code points of Rec. ITU-T H.273. */
typedef struct wf_color_tags {
    int primaries, transfer, matrix;
} wf_color_tags;

/* Whether a space is one that has code points. */
bool wf_color_has_tags(const char *space);

/* The Y'CbCr of codes that are in a space: Rec. ITU-R BT.2100 has that of BT.2020, whatever the
 * raster; in any other space codes have the raster's. */
wf_matrix wf_color_matrix_of(const char *space, wf_matrix of_raster);

/* The display that codes in a space are made for. */
wf_transfer wf_color_transfer_of(const char *space);

/* The tags of codes that are in a space of color/weft.ocio, with their Y'CbCr. For a
 * space that has no code points they are the raster's own. */
wf_color_tags wf_color_tags_of(const char *space, wf_matrix matrix);

#endif
