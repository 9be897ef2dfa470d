/* Corners of polyhedra, and the boxes around them. */
#include "tracer/scene/polyhedron.h"

#include <math.h>
#include <stdbool.h>

/* Beyond this many planes, looking at all triples takes too long. */
#define MOST_CORNERED 64

static void cross(const double a[3], const double b[3], double out[3]) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static double along(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Whether one can go on for ever in direction d (of about length 1). */
static bool is_open(const wf_plane *f, int count, const double d[3], double sign) {
    for (int k = 0; k < count; k++)
        if (sign * along(f[k].n, d) > 1e-9) return false;
    return true;
}

/* An endless polyhedron has an edge that goes on for ever, unless it has no corner at all. */
static bool is_endless(const wf_plane *f, int count) {
    for (int i = 0; i < count; i++)
        for (int j = i + 1; j < count; j++) {
            double d[3];
            cross(f[i].n, f[j].n, d);
            double size = sqrt(along(d, d));
            if (size < 1e-6) continue;
            for (int k = 0; k < 3; k++) d[k] /= size;
            if (is_open(f, count, d, 1) || is_open(f, count, d, -1)) return true;
        }
    return false;
}

static bool meet(const wf_plane *a, const wf_plane *b, const wf_plane *c, double p[3]) {
    double bc[3], ca[3], ab[3];
    cross(b->n, c->n, bc);
    cross(c->n, a->n, ca);
    cross(a->n, b->n, ab);
    double det = along(a->n, bc);
    if (fabs(det) < 1e-12) return false;
    for (int k = 0; k < 3; k++) p[k] = (a->d * bc[k] + b->d * ca[k] + c->d * ab[k]) / det;
    return true;
}

static bool is_corner(const wf_plane *f, int count, const double p[3]) {
    double size = fabs(p[0]) + fabs(p[1]) + fabs(p[2]);
    for (int k = 0; k < count; k++)
        if (along(f[k].n, p) - f[k].d > 1e-6 * (size + fabs(f[k].d))) return false;
    return true;
}

static void hold_corner(double box[7], const double p[3]) {
    for (int k = 0; k < 3; k++) {
        box[k] = box[6] > 0 ? fmin(box[k], p[k]) : p[k];
        box[3 + k] = box[6] > 0 ? fmax(box[3 + k], p[k]) : p[k];
    }
    box[6] = 1;
}

double wf_polyhedron_cost(int planes) {
    double n = planes;
    return planes > MOST_CORNERED ? 0 : n * n * n / 6;
}

void wf_polyhedron_bound(wf_solid *solid, const wf_plane *planes) {
    const wf_plane *f = planes + solid->first_plane;
    int n = solid->plane_count;
    double p[3];
    solid->shape[6] = 0;
    if (n < 4 || n > MOST_CORNERED || is_endless(f, n)) return;
    for (int i = 0; i < n; i++)
        for (int j = i + 1; j < n; j++)
            for (int k = j + 1; k < n; k++)
                if (meet(&f[i], &f[j], &f[k], p) && is_corner(f, n, p))
                    hold_corner(solid->shape, p);
}
