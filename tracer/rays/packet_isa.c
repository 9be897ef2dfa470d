/* Packets through operators and into hits. */
#include <math.h>
#include <string.h>

#include "filters/base/isa_file.h"
#include "tracer/rays/lanes.h"
#include "tracer/rays/packet.h"
#include "tracer/rays/sincos.h"

/* ---- Rays into spaces ---- */

static inline double row_of(const double m[3], double shift, double x, double y, double z) {
    return m[0] * x + m[1] * y + m[2] * z + shift;
}

/* What is left where all cancels is rounding, and none: a ray along a plane must not meet it
 * far away. */
static inline double row_along_of(const double m[3], double x, double y, double z) {
    double p = m[0] * x, q = m[1] * y, r = m[2] * z, sum = p + q + r;
    double size = fabs(p) + fabs(q) + fabs(r);
    return fabs(sum) > size * 0x1p-50 ? sum : 0;
}

/* One row of a matrix over x, y, z. */
static void row(const double m[3], double shift, int count, const double *restrict x,
                const double *restrict y, const double *restrict z, double *restrict to) {
    double a = m[0], b = m[1], c = m[2];
    for (int i = 0, n = wf_places(count); i < n; i++)
        to[i] = a * x[i] + b * y[i] + c * z[i] + shift;
}

/* The same of directions. */
static void row_along(const double m[3], int count, const double *restrict x,
                      const double *restrict y, const double *restrict z, double *restrict to) {
    const double r[3] = {m[0], m[1], m[2]};
    for (int i = 0, n = wf_places(count); i < n; i++) to[i] = row_along_of(r, x[i], y[i], z[i]);
}

static void place(const wf_affine *a, const wf_rays *from, wf_rays *to) {
    const double *m[3] = {a->m[0], a->m[1], a->m[2]};
    row(m[0], a->d.x, from->count, from->ox, from->oy, from->oz, to->ox);
    row(m[1], a->d.y, from->count, from->ox, from->oy, from->oz, to->oy);
    row(m[2], a->d.z, from->count, from->ox, from->oy, from->oz, to->oz);
    row_along(m[0], from->count, from->dx, from->dy, from->dz, to->dx);
    row_along(m[1], from->count, from->dx, from->dy, from->dz, to->dy);
    row_along(m[2], from->count, from->dx, from->dy, from->dz, to->dz);
    to->count = from->count;
}

static void place_each(const wf_affine *const *map, const wf_rays *from, const int *ray,
                       int count, wf_rays *to) {
    double *const o[3] = {to->ox, to->oy, to->oz}, *const d[3] = {to->dx, to->dy, to->dz};
    for (int i = 0; i < wf_places(count); i++) {
        const wf_affine *a = map[i < count ? i : count - 1];
        int at = ray[i < count ? i : count - 1];
        double ox = from->ox[at], oy = from->oy[at], oz = from->oz[at];
        double dx = from->dx[at], dy = from->dy[at], dz = from->dz[at];
        const double shift[3] = {a->d.x, a->d.y, a->d.z};
        for (int k = 0; k < 3; k++) {
            o[k][i] = row_of(a->m[k], shift[k], ox, oy, oz);
            d[k][i] = row_along_of(a->m[k], dx, dy, dz);
        }
    }
    to->count = count;
}

static void drift_in(const wf_ready_op *op, const double *dt_s, const wf_rays *from,
                     wf_rays *to) {
    wf_vec o = op->offset, v = op->op->velocity;
    to->count = from->count;
    for (int i = 0, n = wf_places(from->count); i < n; i++) {
        to->ox[i] = from->ox[i] - (o.x + v.x * dt_s[i]);
        to->oy[i] = from->oy[i] - (o.y + v.y * dt_s[i]);
        to->oz[i] = from->oz[i] - (o.z + v.z * dt_s[i]);
        to->dx[i] = from->dx[i];
        to->dy[i] = from->dy[i];
        to->dz[i] = from->dz[i];
    }
}

static void find_sincos(const wf_ready_op *op, const double *dt_s, int count, wf_sincos *spin) {
    for (int i = 0, n = wf_places(count); i < n; i++)
        wf_sincos_turns(op->phase + op->turns_a_second * dt_s[i], &spin->cos[i], &spin->sin[i]);
}

/* v about the unit axis k (Rodrigues): v c + (k x v) s + k (k.v) (1 - c). */
static inline void rotate(wf_vec k, double c, double s, double *x, double *y, double *z) {
    double vx = *x, vy = *y, vz = *z;
    double along = (k.x * vx + k.y * vy + k.z * vz) * (1 - c);
    *x = vx * c + (k.y * vz - k.z * vy) * s + k.x * along;
    *y = vy * c + (k.z * vx - k.x * vz) * s + k.y * along;
    *z = vz * c + (k.x * vy - k.y * vx) * s + k.z * along;
}

static void spin_in(const wf_ready_op *op, const wf_sincos *spin, const wf_rays *from,
                    wf_rays *to) {
    wf_vec k = op->op->axis, m = op->op->center;
    to->count = from->count;
    for (int i = 0, n = wf_places(from->count); i < n; i++) {
        double c = spin->cos[i], s = -spin->sin[i];
        double x = from->ox[i] - m.x, y = from->oy[i] - m.y, z = from->oz[i] - m.z;
        rotate(k, c, s, &x, &y, &z);
        to->ox[i] = x + m.x;
        to->oy[i] = y + m.y;
        to->oz[i] = z + m.z;
        x = from->dx[i], y = from->dy[i], z = from->dz[i];
        rotate(k, c, s, &x, &y, &z);
        to->dx[i] = x;
        to->dy[i] = y;
        to->dz[i] = z;
    }
}

/* ---- Directions out of them ---- */

static void spin_out(const wf_ready_op *op, const wf_sincos *spin, int count, wf_points *d) {
    wf_vec k = op->op->axis;
    for (int i = 0, n = wf_places(count); i < n; i++)
        rotate(k, spin->cos[i], spin->sin[i], &d->x[i], &d->y[i], &d->z[i]);
}

static void place_normals(const wf_affine *inverse, int count, wf_points *n) {
    wf_points from;
    size_t bytes = (size_t)wf_places(count) * sizeof *n->x;
    memcpy(from.x, n->x, bytes);
    memcpy(from.y, n->y, bytes);
    memcpy(from.z, n->z, bytes);
    double *const to[3] = {n->x, n->y, n->z};
    for (int k = 0; k < 3; k++) {
        const double turned[3] = {inverse->m[0][k], inverse->m[1][k], inverse->m[2][k]};
        row(turned, 0, count, from.x, from.y, from.z, to[k]);
    }
}

static void place_normals_each(const wf_affine *const *inverse, int count, wf_points *n) {
    for (int i = 0; i < wf_places(count); i++) {
        const wf_affine *a = inverse[i < count ? i : count - 1];
        double x = n->x[i], y = n->y[i], z = n->z[i];
        const double m[3][3] = {{a->m[0][0], a->m[1][0], a->m[2][0]},
                                {a->m[0][1], a->m[1][1], a->m[2][1]},
                                {a->m[0][2], a->m[1][2], a->m[2][2]}};
        n->x[i] = row_of(m[0], 0, x, y, z);
        n->y[i] = row_of(m[1], 0, x, y, z);
        n->z[i] = row_of(m[2], 0, x, y, z);
    }
}

/* The largest component is brought near 1 first, so that no size of scene overflows. */
static void unit(int count, wf_points *d) {
    for (int i = 0, n = wf_places(count); i < n; i++) {
        double x = fabs(d->x[i]), y = fabs(d->y[i]), z = fabs(d->z[i]);
        double far = x > y ? x : y;
        far = far > z ? far : z;
        double share = far > 0 ? 1 / far : 0;
        x = d->x[i] * share;
        y = d->y[i] * share;
        z = d->z[i] * share;
        double size = sqrt(x * x + y * y + z * z), inverse = size > 0 ? 1 / size : 0;
        d->x[i] = x * inverse;
        d->y[i] = y * inverse;
        d->z[i] = z * inverse;
    }
}

/* ---- Hits ---- */

static void reach(const wf_rays *r, const double *s, wf_points *p) {
    for (int i = 0, n = wf_places(r->count); i < n; i++) {
        double at = s[i] < HUGE_VAL ? s[i] : 0;
        p->x[i] = r->ox[i] + at * r->dx[i];
        p->y[i] = r->oy[i] + at * r->dy[i];
        p->z[i] = r->oz[i] + at * r->dz[i];
    }
}

/* The next end of a run along a ray; the arithmetic is done on all, and chosen from, so that
 * loops are those of vectors. */
static inline void next_end(double in, double out, double rounding, int64_t solid, double *s,
                            int64_t *hit, int64_t *entering) {
    int64_t enters = in > 0 ? 1 : 0;
    double end = in > 0 ? in : out, best = *s;
    double apart = rounding + end * WF_ROUNDING;
    double limit = solid < *hit ? best + apart : best - apart;
    end = end > 0 ? end : HUGE_VAL;
    int64_t take = end <= limit && end < HUGE_VAL ? 1 : 0;
    *s = take ? end : best;
    *hit = take ? solid : *hit;
    *entering = take ? enters : *entering;
}

static void nearer_end(const double *restrict in, const double *restrict out,
                       const double *restrict rounding, int64_t solid, int count,
                       wf_hits *restrict hits) {
    for (int i = 0, n = wf_places(count); i < n; i++)
        next_end(in[i], out[i], rounding[i], solid, &hits->s[i], &hits->solid[i],
                 &hits->entering[i]);
}

static void nearer(const wf_runs *runs, int most_runs, const double *rounding, int solid,
                   int count, wf_hits *hits) {
    for (int k = 0; k < most_runs; k++)
        nearer_end(runs->in[k], runs->out[k], rounding, solid, count, hits);
}

static void nearer_each(const wf_runs *runs, int most_runs, const double *rounding,
                        const int *solid, const int *ray, int count, wf_hits *hits) {
    for (int i = 0; i < count; i++)
        for (int k = 0; k < most_runs; k++)
            next_end(runs->in[k][i], runs->out[k][i], rounding[ray[i]], solid[i],
                     &hits->s[ray[i]], &hits->solid[ray[i]], &hits->entering[ray[i]]);
}

/* ---- Boxes ---- */

static void span(const double *v, int count, double *low, double *high) {
    lanes least = *(const lanes *)v, most = least;
    for (int i = 8; i < count; i += 8) {
        lanes next = *(const lanes *)(v + i);
        least = smaller(next, least);
        most = larger(next, most);
    }
    *low = least[0];
    *high = most[0];
    for (int k = 1; k < 8; k++) {
        *low = least[k] < *low ? least[k] : *low;
        *high = most[k] > *high ? most[k] : *high;
    }
}

static void box(const wf_rays *r, wf_bounds *o, wf_bounds *d) {
    span(r->ox, r->count, &o->low[0], &o->high[0]);
    span(r->oy, r->count, &o->low[1], &o->high[1]);
    span(r->oz, r->count, &o->low[2], &o->high[2]);
    span(r->dx, r->count, &d->low[0], &d->high[0]);
    span(r->dy, r->count, &d->low[1], &d->high[1]);
    span(r->dz, r->count, &d->low[2], &d->high[2]);
}

/* ---- Bounds along rays ---- */

static inline double largest(double x, double y, double z) {
    double a = fabs(x), b = fabs(y), c = fabs(z);
    a = a > b ? a : b;
    return a > c ? a : c;
}

static void rounding(const wf_rays *restrict r, double share, double *restrict out) {
    for (int i = 0, n = wf_places(r->count); i < n; i++)
        out[i] = largest(r->ox[i], r->oy[i], r->oz[i]) / largest(r->dx[i], r->dy[i], r->dz[i]) *
                 share;
}

static double farthest(const double *s, int count) {
    double low, high;
    span(s, count, &low, &high);
    return high;
}

static void no_second_run(wf_runs *runs, int count) {
    for (int i = 0, n = wf_places(count); i < n; i++) {
        runs->in[1][i] = HUGE_VAL;
        runs->out[1][i] = -HUGE_VAL;
    }
}

const wf_packet_ops WF_ISA_TABLE(wf_packet_ops) = {
    place,         place_each,         drift_in,      spin_in, find_sincos, spin_out,
    place_normals, place_normals_each, reach,         nearer,  nearer_each, unit,
    rounding,      farthest,           no_second_run, box};
