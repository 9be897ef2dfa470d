/* What is known of the cells of adaptive sampling: their errors, and the edges of those beside
 * them. */
#include "tracer/sample/adaptive_cells.h"

#include <math.h>

/* ---- Errors ---- */

double wf_display_steepness(double v) {
    return v < 0.018 ? 4.5 : 0.45 * 1.099 * pow(v, -0.55);
}

/* Of the square of a cell's error an output pixel keeps the integral of the aperture's square
 * over the square of its integral, and more where the aperture's edge cuts cells. */
double wf_adaptive_share(const wf_adaptive *a) {
    static const double shares[WF_PROFILES] = {
        [WF_PROFILE_LINE] = 1,      [WF_PROFILE_BOX] = 0.5,      [WF_PROFILE_NOTCH] = 0.384,
        [WF_PROFILE_SHAPED] = 0.35, [WF_PROFILE_DIAMOND] = 0.75, [WF_PROFILE_MITCHELL] = 1};
    const wf_aperture *aperture = &a->s->desc.gather.aperture;
    if (aperture->kind->profile == WF_PROFILE_DESIGN)
        return wf_stairs_power(&aperture->stairs) / (2 * aperture->half_u);
    return shares[aperture->kind->profile];
}

void wf_cell_find_mean(wf_adaptive_cell *c) {
    for (int k = 0; k < 3; k++) {
        double sum = c->expected[k];
        for (int quarter = 0; quarter < WF_QUARTERS; quarter++) sum += c->sum[quarter][k];
        c->mean[k] = sum / (WF_QUARTERS * c->each);
    }
}

void wf_edge_colors(const wf_adaptive_edge *edge, const double p[3], double rgb[3]) {
    int side = !(wf_dot(edge->n, p) < edge->d);
    for (int k = 0; k < 3; k++) rgb[k] = wf_edge_color(edge->rgb[side][k], p);
}

double wf_adaptive_target(const wf_adaptive *a) {
    double most = a->s->desc.error * a->caution;
    return most * most;
}

/* ---- Cells beside ---- */

const wf_adaptive_cell *wf_cell_beside(const wf_adaptive *a, int at, int right, int down) {
    int column = at % GRID_WIDTH + right, row = at / GRID_WIDTH + down * a->step;
    if (column < 0 || column >= GRID_WIDTH || row < 0 || row >= GRID_ROWS) return NULL;
    const wf_adaptive_cell *c = &a->cell[row * GRID_WIDTH + column];
    return c->there ? c : NULL;
}

/* ---- Apertures ---- */

/* The edges of these apertures cut cells. */
#define MANY_PIECES 8

int wf_edge_pieces(const wf_aperture *aperture) {
    bool wide = aperture->half_u != 0.5; /* its sides lie within cells */
    bool cuts = aperture->kind->couples_uv || aperture->kind->couples_vq || wide;
    return cuts ? MANY_PIECES : WF_FEW_PIECES;
}

bool wf_cuts_cells(const wf_sampling *s) {
    return wf_edge_pieces(&s->desc.gather.aperture) > WF_FEW_PIECES;
}

/* Where an aperture sees all of a window, its weight for a cell is that of all times. */
bool wf_cells_are_weighed(const wf_sampling *s) {
    return wf_cuts_cells(s) && !s->desc.gather.aperture.kind->couples_vq && !s->periods &&
           !(s->skew > 0);
}

/* ---- Edges ---- */

int wf_axis_across(const double n[3]) {
    int axis = fabs(n[1]) > fabs(n[0]);
    return fabs(n[2]) > fabs(n[axis]) ? 2 : axis;
}

/* Rows of a skewed field are a little later than those above, some thousandth of a window,
 * which is left out. */
bool wf_edge_passes_by(const wf_adaptive *a, const wf_adaptive_edge *edge, int right, int down,
                       double past) {
    double from[3] = {-right, -down * a->step, 0}, low = 0, high = 0;
    if (!edge->found) return false;
    for (int k = 0; k < 3; k++) {
        double one = edge->n[k] * from[k], other = edge->n[k] * (from[k] + 1);
        low += fmin(one, other);
        high += fmax(one, other);
    }
    past *= sqrt(wf_dot(edge->n, edge->n));
    return edge->d < low - past || edge->d > high + past;
}

const wf_adaptive_edge *wf_edge_coming(const wf_adaptive *a, int at, int right, int down) {
    const wf_adaptive_cell *c = wf_cell_beside(a, at, right, down);
    const wf_adaptive_edge *edge = c ? &a->edge[c - a->cell] : NULL;
    return edge && edge->found && !wf_edge_passes_by(a, edge, right, down, 0) ? edge : NULL;
}
