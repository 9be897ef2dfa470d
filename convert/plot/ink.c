/* The colors of plots, and the ramp of heat maps. */
#include "convert/plot/ink.h"

#include <math.h>
#include <stddef.h>

/* Series are told apart by most color-blind readers: Okabe and Ito's set, darkened for thin
 * lines. */
/* clang-format off */
const wf_ink_row wf_inks[WF_INKS] = {
    [WF_INK_TEXT]    = {"ink",     {0.13, 0.15, 0.20}, "#212633", "#e4e3de"},
    [1]              = {"s1",      {0.00, 0.40, 0.66}, "#0066a8", "#6db3ee"},
    [2]              = {"s2",      {0.84, 0.37, 0.00}, "#d65e00", "#f2985a"},
    [3]              = {"s3",      {0.00, 0.56, 0.42}, "#008f6b", "#5ccfa6"},
    [4]              = {"s4",      {0.72, 0.40, 0.60}, "#b86699", "#e6a3cb"},
    [5]              = {"s5",      {0.55, 0.45, 0.05}, "#8c730d", "#e0bd4f"},
    [6]              = {"s6",      {0.25, 0.63, 0.85}, "#40a1d9", "#9ad7f7"},
    [7]              = {"s7",      {0.40, 0.27, 0.72}, "#6645b8", "#b7a1f2"},
    [8]              = {"s8",      {0.36, 0.38, 0.40}, "#5c6166", "#a9b1bd"},
    [WF_INK_FAINT]   = {"faint",   {0.45, 0.48, 0.54}, "#737a8a", "#a2a7b3"},
    [WF_INK_GRID]    = {"grid",    {0.90, 0.91, 0.93}, "#e6e8ed", "#343842"},
    [WF_INK_MARK]    = {"mark",    {0.80, 0.20, 0.25}, "#cc3340", "#f0936b"},
    [WF_INK_PAPER]   = {"paper",   {1.00, 1.00, 1.00}, "#ffffff", "#1c1f26"},
    [WF_INK_RING]    = {"ring",    {1.00, 1.00, 1.00}, "#ffffff", "#ffffff"},
    [WF_INK_CARRIER] = {"carrier", {0.44, 0.89, 1.00}, "#6fe3ff", "#6fe3ff"},
};
/* clang-format on */

wf_ink wf_ink_of_series(int series) {
    return series > 0 ? (wf_ink)(WF_INK_SERIES + (series - 1) % 8 + 1) : WF_INK_TEXT;
}

/* From black over violet, red and yellow to white: lightness grows all the way, so that it
 * reads without color as well. */
static const double ramp[][3] = {{0.00, 0.00, 0.02}, {0.16, 0.06, 0.38}, {0.48, 0.11, 0.50},
                                 {0.80, 0.22, 0.38}, {0.97, 0.47, 0.18}, {0.99, 0.78, 0.28},
                                 {1.00, 0.99, 0.86}};
#define RAMP_LAST (sizeof ramp / sizeof *ramp - 1)

uint32_t wf_heat_color(double share) {
    double at = fmin(fmax(share, 0), 1) * (double)RAMP_LAST;
    size_t low = at < (double)RAMP_LAST ? (size_t)at : RAMP_LAST - 1;
    uint32_t packed = 0;
    for (int c = 0; c < 3; c++) {
        double v = ramp[low][c] + (at - (double)low) * (ramp[low + 1][c] - ramp[low][c]);
        packed = packed << 8 | (uint32_t)lround(255 * v);
    }
    return packed;
}
