/* Where the cells of an input picture lie on the raster, exactly. */
#ifndef WF_FILTERS_RESAMPLE_LATTICE_H
#define WF_FILTERS_RESAMPLE_LATTICE_H

#include <stdbool.h>
#include <stdint.h>

#include "filters/base/rational.h"

/* How the display window of an input picture is laid on one axis of the raster. */
typedef struct wf_fitting {
    int pixels, cells; /* raster size, and display window size */
    wf_rational cell;  /* size of a cell in pixels */
    bool padded;       /* the raster beyond the display window is background, and exists */
} wf_fitting;

/* One axis of the lattice of cells: cell a spans [origin + a cell, origin + (a+1) cell] in
 * ticks of 1/unit pixel (or frame line), exactly. Cells 0 <= a < cells are the display
 * window's. */
typedef struct wf_axis {
    int64_t unit; /* even, so that pixel centers are whole ticks */
    int64_t cell, origin;
    int cells, pixels;
    bool padded;
} wf_axis;

/* Half-open range of cells, rows or columns. */
typedef struct wf_span {
    int first, end;
} wf_span;

/* The display window is centered on the raster. False if the ratio is too fine for 64-bit
 * ticks.
 */
bool wf_axis_init(wf_axis *axis, const wf_fitting *fitting);

/* Cells, of the display window or not, that an aperture reaching `reach` pixels (a multiple of
 * 1/2) each way meets about the center of pixel i. */
wf_span wf_axis_reach(const wf_axis *axis, double reach, int i);

/* Where cell a starts, in pixels from the center of pixel i. */
double wf_axis_edge(const wf_axis *axis, int a, int i);

/* The same, drawn in to the picture's edge where the axis is padded and a lies in the padding:
 * background exists inside the picture only. */
double wf_axis_edge_in_picture(const wf_axis *axis, int a, int i);

bool wf_axis_inside(const wf_axis *axis, int a);

/* Pixels i and i + phases lie alike in their cells and share weights. */
int wf_axis_phases(const wf_axis *axis);

#endif
