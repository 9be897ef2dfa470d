/* Rays against solids in canonical form, a packet at a time. Tables are by kind.
 *
 * Nothing here has a tolerance of its own: lengths scale, and a solid a millionth of a unit
 * across is as round as one of a million. Quadratics are solved about the ray's closest
 * approach to the solid's middle, so that a far camera costs no digits: what is rounded there
 * is small beside the solid. */
#include <math.h>
#include <string.h>

#include "filters/base/isa_file.h"
#include "tracer/rays/double_double.h"
#include "tracer/rays/quartic.h"
#include "tracer/rays/solid.h"

static int padded(const wf_rays *r) {
    return wf_places(r->count);
}

static inline double least(double a, double b) {
    return a < b ? a : b;
}

static inline double most(double a, double b) {
    return a > b ? a : b;
}

/* A run is empty unless it has length: a ray that only touches misses. */
static inline void put(wf_runs *runs, int run, int i, double in, double out) {
    bool some = in < out;
    runs->in[run][i] = some ? in : HUGE_VAL;
    runs->out[run][i] = some ? out : -HUGE_VAL;
}

/* Where low <= o + s d <= high. A ray along the slab is inside always or never. */
static inline void slab(double o, double d, double low, double high, double *in, double *out) {
    double a = (low - o) / d, b = (high - o) / d;
    bool along = d == 0, inside = o >= low && o <= high;
    *in = along ? (inside ? -HUGE_VAL : HUGE_VAL) : least(a, b);
    *out = along ? (inside ? HUGE_VAL : -HUGE_VAL) : most(a, b);
}

/* ---- Tangents ---- */

/* x^2 + z^2 + round y^2 <= (a + b y)^2: a sphere, the sides of cylinders and cones. */
typedef struct round_side {
    double round, a, b;
} round_side;

/* Where doubles cannot tell whether a ray meets a side, seen from where it begins. */
static inline double doubt(const wf_rays *r, int i) {
    double size = 1 + fabs(r->ox[i]) + fabs(r->oy[i]) + fabs(r->oz[i]);
    return 0x1p-44 * size * size;
}

/* The product of o and d in the metric of the side, in twice the digits; less 1 times r(o)
 * r(d), the radius being a + b y at a point and b y along a direction. */
static wf_double_double metric(const round_side *s, const double o[3], const double d[3],
                               double ro, double rd) {
    wf_double_double sum =
        wf_double_double_product(wf_double_double_of(o[0]), wf_double_double_of(d[0]));
    sum = wf_double_double_sum(
        sum, wf_double_double_product(wf_double_double_of(o[2]), wf_double_double_of(d[2])));
    if (s->round != 0)
        sum = wf_double_double_sum(sum, wf_double_double_product(wf_double_double_of(o[1]),
                                                                 wf_double_double_of(d[1])));
    wf_double_double by = wf_double_double_of(s->b);
    wf_double_double at = wf_double_double_sum(
        wf_double_double_of(ro), wf_double_double_product(by, wf_double_double_of(o[1])));
    wf_double_double to = wf_double_double_sum(
        wf_double_double_of(rd), wf_double_double_product(by, wf_double_double_of(d[1])));
    return wf_double_double_sum(sum, wf_double_double_minus(wf_double_double_product(at, to)));
}

/* The run of a ray that all but touches a side, in double-double. */
static void touch(const round_side *s, const wf_rays *r, int i, wf_runs *runs) {
    const double o[3] = {r->ox[i], r->oy[i], r->oz[i]}, d[3] = {r->dx[i], r->dy[i], r->dz[i]};
    wf_double_double q2 = metric(s, d, d, 0, 0), q1 = metric(s, o, d, s->a, 0);
    wf_double_double q0 = metric(s, o, o, s->a, s->a);
    wf_double_double disc =
        wf_double_double_sum(wf_double_double_product(q1, q1),
                             wf_double_double_minus(wf_double_double_product(q2, q0)));
    double middle = -q1.high / q2.high, half = sqrt(most(disc.high, 0)) / q2.high;
    double in = -HUGE_VAL, out = HUGE_VAL;
    if (!(q2.high > 0)) return;
    if (s->round == 0) slab(o[1], d[1], -1, 1, &in, &out);
    put(runs, 0, i, most(in, middle - half), least(out, middle + half));
}

/* Once more the rays that doubles cannot tell about: off holds how far each is from touching
 * the side, less the doubt about that. */
static void touch_near(round_side s, const wf_rays *r, const double *off, wf_runs *runs) {
    int64_t near = 0;
    int n = padded(r);
    for (int i = 0; i < n; i++) near += off[i] < 0;
    for (int i = 0; near && i < n; i++)
        if (off[i] < 0) touch(&s, r, i, runs);
}

/* ---- Solids ---- */

static void sphere(const wf_solid *solid, const wf_plane *planes, const wf_rays *r,
                   wf_runs *runs) {
    double off[WF_PACKET];
    (void)solid, (void)planes;
    for (int i = 0, n = padded(r); i < n; i++) {
        double dx = r->dx[i], dy = r->dy[i], dz = r->dz[i], dd = dx * dx + dy * dy + dz * dz;
        double near = -(r->ox[i] * dx + r->oy[i] * dy + r->oz[i] * dz) / dd;
        double x = r->ox[i] + near * dx, y = r->oy[i] + near * dy, z = r->oz[i] + near * dz;
        double rest = 1 - (x * x + y * y + z * z), half = sqrt(most(rest, 0) / dd);
        put(runs, 0, i, near - half, near + half);
        off[i] = fabs(rest) - doubt(r, i);
    }
    touch_near((round_side){1, 1, 0}, r, off, runs);
}

static void box(const wf_solid *solid, const wf_plane *planes, const wf_rays *r,
                wf_runs *runs) {
    (void)solid, (void)planes;
    for (int i = 0, n = padded(r); i < n; i++) {
        double in[3], out[3];
        slab(r->ox[i], r->dx[i], -1, 1, &in[0], &out[0]);
        slab(r->oy[i], r->dy[i], -1, 1, &in[1], &out[1]);
        slab(r->oz[i], r->dz[i], -1, 1, &in[2], &out[2]);
        put(runs, 0, i, most(in[0], most(in[1], in[2])), least(out[0], least(out[1], out[2])));
    }
}

static void cylinder(const wf_solid *solid, const wf_plane *planes, const wf_rays *r,
                     wf_runs *runs) {
    double off[WF_PACKET];
    (void)solid, (void)planes;
    for (int i = 0, n = padded(r); i < n; i++) {
        double dx = r->dx[i], dz = r->dz[i], dd = dx * dx + dz * dz, in, out;
        bool along = dd == 0;
        double near = along ? 0 : -(r->ox[i] * dx + r->oz[i] * dz) / dd;
        double x = r->ox[i] + near * dx, z = r->oz[i] + near * dz, rest = 1 - (x * x + z * z);
        double half = along ? (rest > 0 ? HUGE_VAL : 0) : sqrt(most(rest, 0) / dd);
        slab(r->oy[i], r->dy[i], -1, 1, &in, &out);
        put(runs, 0, i, most(in, near - half), least(out, near + half));
        off[i] = fabs(rest) - doubt(r, i);
    }
    touch_near((round_side){0, 1, 0}, r, off, runs);
}

/* One nappe of x^2 + z^2 <= (a + b y)^2, cut by |y| <= 1, is convex: one run. */
static void cone(const wf_solid *solid, const wf_plane *planes, const wf_rays *r,
                 wf_runs *runs) {
    double b = (solid->shape[1] - solid->shape[0]) / 2,
           a = (solid->shape[1] + solid->shape[0]) / 2;
    double off[WF_PACKET];
    (void)planes;
    for (int i = 0, n = padded(r); i < n; i++) {
        double dx = r->dx[i], dy = r->dy[i], dz = r->dz[i], dd = dx * dx + dy * dy + dz * dz;
        double near = -(r->ox[i] * dx + r->oy[i] * dy + r->oz[i] * dz) / dd, in, out;
        double x = r->ox[i] + near * dx, y = r->oy[i] + near * dy, z = r->oz[i] + near * dz;
        double radius = a + b * y, slope = b * dy;
        double q2 = dx * dx + dz * dz - slope * slope, q1 = x * dx + z * dz - radius * slope;
        double q0 = x * x + z * z - radius * radius, disc = q1 * q1 - q2 * q0;
        double root = sqrt(most(disc, 0)), q = -(q1 + (q1 < 0 ? -root : root));
        double s1 = q2 == 0 ? -q0 / (2 * q1) : q / q2, s2 = q2 == 0 ? s1 : q == 0 ? s1 : q0 / q;
        double low = least(s1, s2), high = most(s1, s2);
        bool up = slope > 0, shallow = q2 > 0;
        bool flat = q2 == 0 && q1 == 0, full = flat && q0 < 0;
        double from = shallow ? low
                      : up    ? high
                              : -HUGE_VAL,
               to = shallow ? high
                    : up    ? HUGE_VAL
                            : low;
        bool misses = (shallow && disc <= 0) || (flat && !full);
        from = full ? -HUGE_VAL : misses ? HUGE_VAL : from;
        to = full ? HUGE_VAL : misses ? -HUGE_VAL : to;
        slab(y, dy, -1, 1, &in, &out);
        put(runs, 0, i, near + most(in, from), near + least(out, to));
        off[i] = fabs(disc) - doubt(r, i) * dd;
    }
    touch_near((round_side){0, a, b}, r, off, runs);
}

/* A ray whose rise is within what rounding makes of 0 runs along the plane, and does not meet
 * it far away; as long as the half-space is scaled about evenly. */
static void halfspace(const wf_solid *solid, const wf_plane *planes, const wf_rays *r,
                      wf_runs *runs) {
    (void)solid, (void)planes;
    for (int i = 0, n = padded(r); i < n; i++) {
        double along = (fabs(r->dx[i]) + fabs(r->dz[i])) * 0x1p-51;
        double dy = r->dy[i], at = -r->oy[i] / dy;
        bool below = r->oy[i] <= 0;
        double in = dy < -along ? at : ((dy > along) | below) ? -HUGE_VAL : HUGE_VAL;
        double out = dy > along ? at : ((dy < -along) | below) ? HUGE_VAL : -HUGE_VAL;
        put(runs, 0, i, in, out);
    }
}

/* q2 s^2 + 2 q1 s + q0 <= 0 about the point of the ray nearest the origin. */
static void quadric(const wf_solid *solid, const wf_plane *planes, const wf_rays *r,
                    wf_runs *runs) {
    const double *q = solid->shape;
    (void)planes;
    for (int i = 0, n = padded(r); i < n; i++) {
        double dx = r->dx[i], dy = r->dy[i], dz = r->dz[i], dd = dx * dx + dy * dy + dz * dz;
        double near = -(r->ox[i] * dx + r->oy[i] * dy + r->oz[i] * dz) / dd;
        double x = r->ox[i] + near * dx, y = r->oy[i] + near * dy, z = r->oz[i] + near * dz;
        double gx = 2 * q[0] * x + q[3] * y + q[5] * z + q[6];
        double gy = 2 * q[1] * y + q[3] * x + q[4] * z + q[7];
        double gz = 2 * q[2] * z + q[4] * y + q[5] * x + q[8];
        double q2 = dx * (q[0] * dx + q[3] * dy) + dy * (q[1] * dy + q[4] * dz) +
                    dz * (q[2] * dz + q[5] * dx);
        double q1 = 0.5 * (gx * dx + gy * dy + gz * dz);
        double q0 = 0.5 * (gx * x + gy * y + gz * z + q[6] * x + q[7] * y + q[8] * z) + q[9];
        double disc = q1 * q1 - q2 * q0, root = sqrt(most(disc, 0));
        double t = -(q1 + (q1 < 0 ? -root : root));
        double s1 = t / q2, s2 = t == 0 ? s1 : q0 / t, low = least(s1, s2), high = most(s1, s2);
        double line = -q0 / (2 * q1);
        bool linear = q2 == 0, level = linear && q1 == 0;
        bool all = level ? q0 <= 0 : !linear && q2 < 0 && disc <= 0;
        bool none = level ? q0 > 0 : !linear && q2 > 0 && disc <= 0;
        bool outer = !linear && q2 < 0 && disc > 0;
        double in0 = linear ? (q1 > 0 ? -HUGE_VAL : line) : outer ? -HUGE_VAL : low;
        double out0 = linear ? (q1 > 0 ? line : HUGE_VAL) : outer ? low : high;
        put(runs, 0, i,
            none  ? HUGE_VAL
            : all ? -HUGE_VAL
                  : near + in0,
            none  ? -HUGE_VAL
            : all ? HUGE_VAL
                  : near + out0);
        put(runs, 1, i, outer ? near + high : HUGE_VAL, outer ? HUGE_VAL : -HUGE_VAL);
    }
}

static void polyhedron(const wf_solid *solid, const wf_plane *planes, const wf_rays *r,
                       wf_runs *runs) {
    int n = padded(r);
    for (int i = 0; i < n; i++) runs->in[0][i] = -HUGE_VAL, runs->out[0][i] = HUGE_VAL;
    for (int p = 0; p < solid->plane_count; p++) {
        const wf_plane *f = &planes[solid->first_plane + p];
        for (int i = 0; i < n; i++) {
            double over = f->n[0] * r->ox[i] + f->n[1] * r->oy[i] + f->n[2] * r->oz[i] - f->d;
            double x = f->n[0] * r->dx[i], y = f->n[1] * r->dy[i], z = f->n[2] * r->dz[i];
            double rise =
                fabs(x + y + z) > (fabs(x) + fabs(y) + fabs(z)) * 0x1p-50 ? x + y + z : 0;
            double at = -over / rise;
            double in = rise < 0 ? at : rise > 0 || over <= 0 ? -HUGE_VAL : HUGE_VAL;
            double out = rise > 0 ? at : rise < 0 || over <= 0 ? HUGE_VAL : -HUGE_VAL;
            runs->in[0][i] = most(runs->in[0][i], in);
            runs->out[0][i] = least(runs->out[0][i], out);
        }
    }
    for (int i = 0; i < n; i++) put(runs, 0, i, runs->in[0][i], runs->out[0][i]);
}

/* (|p|^2 + 1 - r^2)^2 <= 4 (x^2 + z^2) along p = c + t d, c the point nearest the middle: a
 * quartic between the ends of the slab |y| <= r and of the sphere of radius 1 + r. */
static int torus_runs(double tube, const double c[3], const double d[3], double from, double to,
                      double end[4]) {
    double dd = d[0] * d[0] + d[1] * d[1] + d[2] * d[2],
           cc = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
    double cd = c[0] * d[0] + c[1] * d[1] + c[2] * d[2], k = cc + (1 - tube) * (1 + tube);
    double quartic[5] = {
        k * k - 4 * (c[0] * c[0] + c[2] * c[2]),
        4 * k * cd - 8 * (c[0] * d[0] + c[2] * d[2]),
        4 * cd * cd + 2 * k * dd - 4 * (d[0] * d[0] + d[2] * d[2]),
        4 * cd * dd,
        dd * dd,
    };
    int runs = wf_quartic_runs(quartic, from, to, end);
    /* Where the tube meets itself about the axis, the quartic counts the middle as outside. */
    double mid = runs == 2 ? (end[1] + end[2]) / 2 : 0;
    double x = c[0] + mid * d[0], y = c[1] + mid * d[1], z = c[2] + mid * d[2];
    double across = sqrt(x * x + z * z) + 1;
    if (runs < 2 || across * across + y * y >= tube * tube) return runs;
    end[1] = end[3];
    return 1;
}

/* Whether all of a stretch is nearer to the axis than the tube: it is so between its ends if it
 * is so at both. */
static bool in_hole(const double c[3], const double d[3], double from, double to, double hole) {
    double x0 = c[0] + from * d[0], z0 = c[2] + from * d[2];
    double x1 = c[0] + to * d[0], z1 = c[2] + to * d[2], most2 = hole * hole * (1 - 0x1p-40);
    return hole > 0 && x0 * x0 + z0 * z0 < most2 && x1 * x1 + z1 * z1 < most2;
}

static void torus(const wf_solid *solid, const wf_plane *planes, const wf_rays *r,
                  wf_runs *runs) {
    double tube = solid->shape[0], far = 1 + tube;
    (void)planes;
    for (int i = 0, n = padded(r); i < n; i++) {
        double d[3] = {r->dx[i], r->dy[i], r->dz[i]},
               dd = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        double near = -(r->ox[i] * d[0] + r->oy[i] * d[1] + r->oz[i] * d[2]) / dd, in, out;
        double c[3] = {r->ox[i] + near * d[0], r->oy[i] + near * d[1], r->oz[i] + near * d[2]};
        double rest = far * far - (c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
        double half = sqrt(most(rest, 0) / dd), end[4] = {0};
        slab(c[1], d[1], -tube, tube, &in, &out);
        double from = most(in, -half), to = least(out, half);
        bool near_ring = from < to && !in_hole(c, d, from, to, 1 - tube);
        int found = near_ring ? torus_runs(tube, c, d, from, to, end) : 0;
        put(runs, 0, i, found > 0 ? near + end[0] : HUGE_VAL,
            found > 0 ? near + end[1] : -HUGE_VAL);
        put(runs, 1, i, found > 1 ? near + end[2] : HUGE_VAL,
            found > 1 ? near + end[3] : -HUGE_VAL);
    }
}

/* ---- Normals ---- */

#define NORMALS                                                                                \
    const wf_solid *solid, const wf_plane *planes, const wf_points *restrict p, int count,     \
        wf_points *restrict n

static void sphere_normals(NORMALS) {
    size_t bytes = (size_t)wf_places(count) * sizeof *n->x;
    (void)solid, (void)planes;
    memcpy(n->x, p->x, bytes);
    memcpy(n->y, p->y, bytes);
    memcpy(n->z, p->z, bytes);
}

static void box_normals(NORMALS) {
    (void)solid, (void)planes;
    for (int i = 0, places = wf_places(count); i < places; i++) {
        double x = fabs(p->x[i]), y = fabs(p->y[i]), z = fabs(p->z[i]);
        double far = most(x, most(y, z)), px = p->x[i], py = p->y[i], pz = p->z[i];
        n->x[i] = x == far ? px : 0;
        n->y[i] = y == far && x != far ? py : 0;
        n->z[i] = z == far && x != far && y != far ? pz : 0;
    }
}

static void cylinder_normals(NORMALS) {
    (void)solid, (void)planes;
    for (int i = 0, places = wf_places(count); i < places; i++) {
        double x = p->x[i], y = p->y[i], z = p->z[i];
        double cap = y * y > x * x + z * z ? 1 : 0, side = 1 - cap;
        n->x[i] = side * x;
        n->y[i] = cap * y;
        n->z[i] = side * z;
    }
}

/* The side is where the distance to it is less than to the caps. */
static void cone_normals(NORMALS) {
    double slope = (solid->shape[1] - solid->shape[0]) / 2,
           middle = (solid->shape[1] + solid->shape[0]) / 2, tilt = 1 / sqrt(1 + slope * slope);
    (void)planes;
    for (int i = 0, places = wf_places(count); i < places; i++) {
        double x = p->x[i], y = p->y[i], z = p->z[i], across = sqrt(x * x + z * z);
        double to_side = fabs(across - (middle + slope * y)) * tilt;
        double cap = fabs(1 - fabs(y)) < to_side ? 1 : 0;
        cap = across == 0 ? 1 : cap;
        n->x[i] = (1 - cap) * x;
        n->y[i] = cap != 0 ? y : -slope * across;
        n->z[i] = (1 - cap) * z;
    }
}

static void torus_normals(NORMALS) {
    (void)solid, (void)planes;
    for (int i = 0, places = wf_places(count); i < places; i++) {
        double x = p->x[i], z = p->z[i], across = sqrt(x * x + z * z);
        double share = across > 0 ? 1 - 1 / across : 0;
        n->x[i] = x * share;
        n->y[i] = p->y[i];
        n->z[i] = z * share;
    }
}

static void halfspace_normals(NORMALS) {
    (void)solid, (void)planes, (void)p;
    for (int i = 0, places = wf_places(count); i < places; i++)
        n->x[i] = n->z[i] = 0, n->y[i] = 1;
}

static void quadric_normals(NORMALS) {
    const double *q = solid->shape;
    (void)planes;
    for (int i = 0, places = wf_places(count); i < places; i++) {
        double x = p->x[i], y = p->y[i], z = p->z[i];
        n->x[i] = 2 * q[0] * x + q[3] * y + q[5] * z + q[6];
        n->y[i] = 2 * q[1] * y + q[3] * x + q[4] * z + q[7];
        n->z[i] = 2 * q[2] * z + q[4] * y + q[5] * x + q[8];
    }
}

/* The normal of the face whose plane is nearest, seen from within. */
static void polyhedron_normals(NORMALS) {
    double best[WF_PACKET];
    for (int i = 0, places = wf_places(count); i < places; i++) best[i] = -HUGE_VAL;
    for (int k = 0; k < solid->plane_count; k++) {
        wf_plane f = planes[solid->first_plane + k];
        for (int i = 0, places = wf_places(count); i < places; i++) {
            double over = f.n[0] * p->x[i] + f.n[1] * p->y[i] + f.n[2] * p->z[i] - f.d;
            double was = best[i];
            best[i] = over > was ? over : was;
            n->x[i] = over > was ? f.n[0] : n->x[i];
            n->y[i] = over > was ? f.n[1] : n->y[i];
            n->z[i] = over > was ? f.n[2] : n->z[i];
        }
    }
}

const wf_solid_ops WF_ISA_TABLE(wf_solid_ops) = {
    .intersect =
        {
            [WF_SPHERE] = sphere,
            [WF_BOX] = box,
            [WF_CYLINDER] = cylinder,
            [WF_CONE] = cone,
            [WF_TORUS] = torus,
            [WF_HALFSPACE] = halfspace,
            [WF_QUADRIC] = quadric,
            [WF_POLYHEDRON] = polyhedron,
        },
    .normals =
        {
            [WF_SPHERE] = sphere_normals,
            [WF_BOX] = box_normals,
            [WF_CYLINDER] = cylinder_normals,
            [WF_CONE] = cone_normals,
            [WF_TORUS] = torus_normals,
            [WF_HALFSPACE] = halfspace_normals,
            [WF_QUADRIC] = quadric_normals,
            [WF_POLYHEDRON] = polyhedron_normals,
        },
};
