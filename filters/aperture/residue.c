/* What an aperture's weights leave of a vertical grating. */
#include "filters/aperture/residue.h"

#include <math.h>

/* The error of a sum of a few weights. */
#define ROUNDING 1e-14

/* The upper edge of input line b, in lines from the center of raster line j: a quotient of
 * whole numbers. */
static double edge(int64_t b, int j, int input_lines, int lines) {
    int64_t half_ticks = 2 * b * lines - (2 * (int64_t)j + 1) * input_lines;
    return (double)half_ticks / (2.0 * input_lines);
}

static double line_response(const wf_aperture *a, int j, int input_lines, int lines,
                            double fy) {
    double cell = (double)lines / input_lines, reach = a->reach_v;
    int64_t first = (int64_t)floor((j + 0.5 - reach) / cell) - 1;
    double re = 0, im = 0, total = 0;
    for (int64_t b = first; edge(b, j, input_lines, lines) < reach; b++) {
        double v0 = edge(b, j, input_lines, lines), v1 = edge(b + 1, j, input_lines, lines);
        double weight = a->kind->cell_v(a, v0, v1), phase = M_PI * fy * (v0 + v1);
        re += weight * cos(phase);
        im += weight * sin(phase);
        total += weight;
    }
    return hypot(re, im) / total;
}

double wf_line_residue(const wf_aperture *a, int input_lines, int lines, double fy) {
    double worst = 0;
    wf_rational cell = wf_ratio(lines, input_lines);
    for (int j = 0; j < cell.num; j++) /* line j + cell.num lies in its cells as line j does */
        worst = fmax(worst, line_response(a, j, input_lines, lines, fy));
    return worst < ROUNDING ? 0 : worst;
}
