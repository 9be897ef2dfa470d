/* The two sides of an edge: which color is of which, and how each changes over its part of the
 * cell. */
#include "tracer/sample/adaptive_sides.h"

#include <math.h>
#include <string.h>

/* How far from its side's mean, of the distance of both, a color may be. */
#define SAME_COLOR 0.25

/* ---- Least squares ---- */

void wf_solve(double m[3][3], double *b) {
    for (int k = 0; k < 3; k++)
        for (int r = k + 1; r < 3; r++) {
            double f = m[r][k] / m[k][k];
            for (int c = k; c < 3; c++) m[r][c] -= f * m[k][c];
            b[r] -= f * b[k];
        }
    for (int k = 2; k >= 0; k--) {
        for (int c = k + 1; c < 3; c++) b[k] -= m[k][c] * b[c];
        b[k] /= m[k][k];
    }
}

/* ---- Two colors ---- */

double wf_distance(const double *a, const double *b) {
    double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return wf_dot(d, d);
}

/* Which side a color is of; -1: neither. */
int wf_side_of(const wf_seeker *e, const double rgb[3]) {
    double d0 = wf_distance(rgb, e->mean[0]), d1 = wf_distance(rgb, e->mean[1]);
    int side = d1 < d0;
    return (side ? d1 : d0) <= SAME_COLOR * SAME_COLOR * e->reach ? side : -1;
}

void wf_find_sides(wf_seeker *e) {
    for (wf_seen *v = e->first; v < e->end; v++) {
        v->side = wf_side_of(e, v->rgb);
        e->lost |= v->side < 0;
    }
}

/* The color seen that differs most from one. */
static const double *farthest(const wf_seeker *e, const double rgb[3]) {
    const wf_seen *found = e->first;
    for (const wf_seen *v = e->first; v < e->end; v++)
        if (wf_distance(v->rgb, rgb) > wf_distance(found->rgb, rgb)) found = v;
    return found->rgb;
}

/* Samples go to the nearer of two colors, and these become the means of what comes to them. */
static void find_means(wf_seeker *e) {
    double sum[2][3] = {{0}}, count[2] = {0};
    for (const wf_seen *v = e->first; v < e->end; v++) {
        int side = wf_distance(v->rgb, e->mean[1]) < wf_distance(v->rgb, e->mean[0]);
        for (int c = 0; c < 3; c++) sum[side][c] += v->rgb[c];
        count[side]++;
    }
    for (int side = 0; side < 2; side++)
        for (int c = 0; c < 3; c++) e->mean[side][c] = sum[side][c] / fmax(count[side], 1);
    e->reach = wf_distance(e->mean[0], e->mean[1]);
    e->lost |= !(count[0] > 0 && count[1] > 0);
}

void wf_find_colors(wf_seeker *e) {
    memcpy(e->mean[0], farthest(e, e->first->rgb), sizeof e->mean[0]);
    memcpy(e->mean[1], farthest(e, e->mean[0]), sizeof e->mean[1]);
    find_means(e);
    wf_find_sides(e);
}

/* ---- One side ---- */

void wf_sum_side(const wf_seeker *e, int side, wf_side_sums *f) {
    memset(f, 0, sizeof *f);
    for (const wf_seen *v = e->first; v < e->end; v++) {
        if (v->side != side) continue;
        f->count++;
        for (int k = 0; k < 3; k++) {
            f->p[k] += (v->p[k] - f->p[k]) / f->count;
            f->rgb[k] += (v->rgb[k] - f->rgb[k]) / f->count;
        }
    }
    for (const wf_seen *v = e->first; v < e->end; v++) {
        if (v->side != side) continue;
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 3; c++) {
                double share = (v->p[r] - f->p[r]) / f->count;
                f->pp[r][c] += share * (v->p[c] - f->p[c]);
                f->p_rgb[c][r] += share * (v->rgb[c] - f->rgb[c]);
            }
    }
}

/* A side's color as it changes evenly over the cell: least squares. Where nothing was seen of
 * it, it is what a neighbor saw. */
void wf_fit_color(const wf_side_sums *f, const double mean[3], double rgb[3][4]) {
    for (int c = 0; c < 3; c++) {
        double m[3][3], slope[3];
        if (!(f->count > 0)) {
            memcpy(rgb[c], (double[4]){mean[c]}, sizeof rgb[c]);
            continue;
        }
        memcpy(m, f->pp, sizeof m);
        memcpy(slope, f->p_rgb[c], sizeof slope);
        for (int k = 0; k < 3; k++) m[k][k] += WF_FLAT;
        wf_solve(m, slope);
        rgb[c][0] = f->rgb[c] - wf_dot(slope, f->p);
        memcpy(&rgb[c][1], slope, sizeof slope);
    }
}
