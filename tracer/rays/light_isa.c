/* Light on packets: which way it falls, and what Lambert and Blinn make of it. */
#include <math.h>

#include "filters/base/isa_file.h"
#include "tracer/rays/light.h"

static void face(const wf_rays *restrict r, wf_points *restrict n) {
    for (int i = 0, places = wf_places(r->count); i < places; i++) {
        double x = n->x[i], y = n->y[i], z = n->z[i];
        double along = x * r->dx[i] + y * r->dy[i] + z * r->dz[i];
        double sign = along > 0 ? -1 : 1;
        n->x[i] = sign * x;
        n->y[i] = sign * y;
        n->z[i] = sign * z;
    }
}

static void choose(const int64_t *restrict hit, int64_t solid, const double *restrict from,
                   int count, double *restrict to) {
    for (int i = 0, places = wf_places(count); i < places; i++)
        to[i] = hit[i] == solid ? from[i] : to[i];
}

static inline double largest(double x, double y, double z) {
    double a = fabs(x), b = fabs(y), c = fabs(z);
    a = a > b ? a : b;
    return a > c ? a : c;
}

static void off_surface(const wf_rays *restrict r, const double *restrict s, double share,
                        double *restrict off) {
    for (int i = 0, places = wf_places(r->count); i < places; i++) {
        double o = largest(r->ox[i], r->oy[i], r->oz[i]);
        double d = largest(r->dx[i], r->dy[i], r->dz[i]);
        off[i] = (o + (s[i] < HUGE_VAL ? s[i] : 0) * d) * share;
    }
}

/* Twice divided, so that no size overflows. */
static inline void to_unit(double *x, double *y, double *z) {
    double far = largest(*x, *y, *z);
    far = far > 0 ? far : 1;
    *x /= far, *y /= far, *z /= far;
    double length = sqrt(*x * *x + *y * *y + *z * *z);
    length = length > 0 ? length : 1;
    *x /= length, *y /= length, *z /= length;
}

static void mirror(wf_points *restrict d, const wf_points *restrict n, int count,
                   double *restrict side) {
    for (int i = 0, places = wf_places(count); i < places; i++) {
        double x = d->x[i], y = d->y[i], z = d->z[i];
        to_unit(&x, &y, &z);
        double twice = -2 * (x * n->x[i] + y * n->y[i] + z * n->z[i]);
        d->x[i] = x + twice * n->x[i];
        d->y[i] = y + twice * n->y[i];
        d->z[i] = z + twice * n->z[i];
        side[i] = 1;
    }
}

/* Snell; where nothing comes through all is mirrored. */
static void bend(wf_points *restrict d, const wf_points *restrict n,
                 const double *restrict ratio, int count, double *restrict side) {
    for (int i = 0, places = wf_places(count); i < places; i++) {
        double x = d->x[i], y = d->y[i], z = d->z[i], r = ratio[i];
        to_unit(&x, &y, &z);
        double along = x * n->x[i] + y * n->y[i] + z * n->z[i], cosine = -along;
        double rest = 1 - r * r * (1 - cosine * cosine), root = sqrt(rest < 0 ? 0 : rest);
        bool all = rest < 0;
        double share = all ? 1 : r, toward = all ? -2 * along : r * cosine - root;
        d->x[i] = share * x + toward * n->x[i];
        d->y[i] = share * y + toward * n->y[i];
        d->z[i] = share * z + toward * n->z[i];
        side[i] = all ? 1 : -1;
    }
}

static void turn(wf_points *d, const wf_points *n, const double *ratio, int count,
                 double *side) {
    if (ratio)
        bend(d, n, ratio, count, side);
    else
        mirror(d, n, count, side);
}

static void ways(const wf_points *restrict p, const wf_points *restrict place, int count,
                 wf_points *restrict way) {
    for (int i = 0, places = wf_places(count); i < places; i++) {
        way->x[i] = place->x[i] - p->x[i];
        way->y[i] = place->y[i] - p->y[i];
        way->z[i] = place->z[i] - p->z[i];
    }
}

static void against(const wf_points *restrict d, int count, wf_points *restrict way) {
    for (int i = 0, places = wf_places(count); i < places; i++) {
        way->x[i] = -d->x[i];
        way->y[i] = -d->y[i];
        way->z[i] = -d->z[i];
    }
}

static void faces_light(const double *restrict lit, const wf_points *restrict n,
                        const wf_points *restrict way, int count, double *restrict share) {
    for (int i = 0, places = wf_places(count); i < places; i++) {
        double along = n->x[i] * way->x[i] + n->y[i] * way->y[i] + n->z[i] * way->z[i];
        share[i] = along > 0 ? lit[i] : 0;
    }
}

/* One over the length, whatever its size: the largest component is brought near 1 first. */
static inline double inverse_length(double x, double y, double z) {
    double far = largest(x, y, z), share = far > 0 ? 1 / far : 0;
    x *= share;
    y *= share;
    z *= share;
    double square = x * x + y * y + z * z;
    return square > 0 ? share / sqrt(square) : 0;
}

static void lambert(const wf_points *restrict n, const wf_points *restrict way,
                    const double *restrict share, const float color[3], int count,
                    wf_surfaces *restrict f) {
    double r = (double)color[0], g = (double)color[1], b = (double)color[2];
    for (int i = 0, places = wf_places(count); i < places; i++) {
        double x = way->x[i], y = way->y[i], z = way->z[i];
        double cosine = (n->x[i] * x + n->y[i] * y + n->z[i] * z) * inverse_length(x, y, z);
        double light = share[i] > 0 ? share[i] * f->diffuse[i] * cosine : 0;
        f->light[0][i] += light * r;
        f->light[1][i] += light * g;
        f->light[2][i] += light * b;
    }
}

/* The cosine between the normal and half way between eye and light. */
static void half_way(const wf_rays *restrict r, const wf_points *restrict n,
                     const wf_points *restrict way, double *restrict cosine) {
    for (int i = 0, places = wf_places(r->count); i < places; i++) {
        double x = way->x[i], y = way->y[i], z = way->z[i], to = inverse_length(x, y, z);
        double dx = r->dx[i], dy = r->dy[i], dz = r->dz[i], from = inverse_length(dx, dy, dz);
        double hx = x * to - dx * from, hy = y * to - dy * from, hz = z * to - dz * from;
        double along = n->x[i] * hx + n->y[i] * hy + n->z[i] * hz;
        cosine[i] = along * inverse_length(hx, hy, hz);
    }
}

static void highlight(const double *cosine, const double *share, const float color[3],
                      int count, wf_surfaces *f) {
    for (int i = 0; i < count; i++) {
        double part = share[i] * f->specular[i];
        if (!(part > 0) || !(cosine[i] > 0)) continue;
        double shine = part * pow(cosine[i], f->shininess[i]);
        for (int c = 0; c < 3; c++) f->shine[c][i] += shine * (double)color[c];
    }
}

static void add(const wf_rays *r, const wf_points *n, const wf_points *way, const double *share,
                const float color[3], bool shines, wf_surfaces *f) {
    double cosine[WF_PACKET];
    lambert(n, way, share, color, r->count, f);
    if (!shines) return;
    half_way(r, n, way, cosine);
    highlight(cosine, share, color, r->count, f);
}

static void sum(const wf_surfaces *restrict f, const double *restrict seen,
                const float background[3], int count, double rgb[3][WF_PACKET]) {
    for (int c = 0; c < 3; c++) {
        double behind = (double)background[c], *restrict out = rgb[c];
        const double *color = f->color[c], *light = f->light[c], *shine = f->shine[c];
        for (int i = 0, places = wf_places(count); i < places; i++) {
            double own = f->lit[i] > 0 ? color[i] * light[i] + shine[i] : color[i];
            out[i] = seen[i] < HUGE_VAL ? own : behind;
        }
    }
}

const wf_light_ops WF_ISA_TABLE(wf_light_ops) = {face,    choose,      off_surface, turn, ways,
                                                 against, faces_light, add,         sum};
