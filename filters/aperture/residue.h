/* Responses of weights, which differ from those of apertures. */
#ifndef WF_FILTERS_APERTURE_RESIDUE_H
#define WF_FILTERS_APERTURE_RESIDUE_H

#include "filters/aperture/aperture.h"

/* What an aperture's weights do to a vertical grating of fy cycles a line, fx = ft = 0, when
 * input_lines lines are stretched over `lines` raster lines: the largest
 *
 *     |sum W(b) exp(2 pi i fy (y_b - y_j))| / sum W(b)
 *
 * of any raster line j, where y_b and y_j are the centers of input line b and of line j, and
 * W(b) is the aperture's integral over input line b. It is the response to a grating sampled at
 * the centers of the input lines, away from the edges of the picture. Where box, notch and
 * shaped are zero in closed form and 2 input_lines / lines is whole, so is this but for
 * rounding, which is returned as 0. input_lines and lines from 1 to 2^20. */
double wf_line_residue(const wf_aperture *a, int input_lines, int lines, double fy);

#endif
