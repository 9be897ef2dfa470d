/* Boxes of solids over a window of time, and shafts of rays. */
#include "tracer/trace/bounds.h"

#include <math.h>

#include "tracer/rays/packet.h"

#define PI 3.14159265358979323846

/* What is added to boxes and shafts, of the size of the numbers in them: far more than the
 * rounding of all that led to them, far less than can be seen. */
#define SLACK 0x1p-40

static double least(double a, double b) {
    return a < b ? a : b;
}

static double most(double a, double b) {
    return a > b ? a : b;
}

/* ---- Boxes ---- */

wf_bounds wf_bounds_none(void) {
    return (wf_bounds){{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
}

static wf_bounds all(void) {
    return (wf_bounds){{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, HUGE_VAL, HUGE_VAL}};
}

bool wf_bounds_empty(const wf_bounds *b) {
    return !(b->low[0] <= b->high[0] && b->low[1] <= b->high[1] && b->low[2] <= b->high[2]);
}

bool wf_bounds_finite(const wf_bounds *b) {
    for (int k = 0; k < 3; k++)
        if (!isfinite(b->low[k]) || !isfinite(b->high[k])) return false;
    return true;
}

wf_bounds wf_bounds_unite(wf_bounds a, wf_bounds b) {
    for (int k = 0; k < 3; k++) {
        a.low[k] = least(a.low[k], b.low[k]);
        a.high[k] = most(a.high[k], b.high[k]);
    }
    return a;
}

wf_bounds wf_bounds_intersect(wf_bounds a, wf_bounds b) {
    for (int k = 0; k < 3; k++) {
        a.low[k] = most(a.low[k], b.low[k]);
        a.high[k] = least(a.high[k], b.high[k]);
    }
    return wf_bounds_empty(&a) ? wf_bounds_none() : a;
}

wf_bounds wf_bounds_of_point(wf_vec p) {
    return (wf_bounds){{p.x, p.y, p.z}, {p.x, p.y, p.z}};
}

/* m * [low, high] added to *from, *to; nothing of an endless interval is still nothing. */
static void add_scaled(double m, double low, double high, double *from, double *to) {
    if (m == 0) return;
    *from += m > 0 ? m * low : m * high;
    *to += m > 0 ? m * high : m * low;
}

/* The box of what an affine map makes of a box. */
static wf_bounds place(const wf_affine *a, wf_bounds b) {
    double d[3] = {a->d.x, a->d.y, a->d.z};
    wf_bounds out;
    if (wf_bounds_empty(&b)) return b;
    for (int i = 0; i < 3; i++) {
        double low = d[i], high = d[i], size = fabs(d[i]);
        for (int j = 0; j < 3; j++) {
            add_scaled(a->m[i][j], b.low[j], b.high[j], &low, &high);
            size +=
                a->m[i][j] == 0 ? 0 : fabs(a->m[i][j]) * most(fabs(b.low[j]), fabs(b.high[j]));
        }
        out.low[i] = low - SLACK * size;
        out.high[i] = high + SLACK * size;
        if (isnan(out.low[i])) out.low[i] = -HUGE_VAL;
        if (isnan(out.high[i])) out.high[i] = HUGE_VAL;
    }
    return out;
}

/* ---- Motion ---- */

/* The farthest that a corner of the box is from the axis, and the box of the circles that its
 * corners run. */
static double radius_about(const wf_op *op, const wf_bounds *b) {
    double r2 = 0;
    for (int corner = 0; corner < 8; corner++) {
        double x = (corner & 1 ? b->high[0] : b->low[0]) - op->center.x;
        double y = (corner & 2 ? b->high[1] : b->low[1]) - op->center.y;
        double z = (corner & 4 ? b->high[2] : b->low[2]) - op->center.z;
        double along = x * op->axis.x + y * op->axis.y + z * op->axis.z;
        r2 = most(r2, x * x + y * y + z * z - along * along);
    }
    return sqrt(most(r2, 0));
}

/* At an instant, grown by how far a point can be from there: a chord of the arc, which has no
 * part along the axis. */
static wf_bounds spin(const wf_ready_op *r, double from, double to, wf_bounds b) {
    const wf_op *op = r->op;
    double half = fabs(r->turns_a_second) * PI * (to - from);
    double chord = radius_about(op, &b) * (half < PI ? 2 * sin(half / 2) : 2) * (1 + SLACK);
    double axis[3] = {op->axis.x, op->axis.y, op->axis.z};
    wf_affine middle = wf_op_at(r, (from + to) / 2);
    wf_bounds out = place(&middle, b);
    for (int k = 0; k < 3; k++) {
        double across = sqrt(most(1 - axis[k] * axis[k], 0)) + SLACK;
        if (chord == 0) break;
        out.low[k] -= chord * across;
        out.high[k] += chord * across;
    }
    return out;
}

/* Between keys a point is no farther from the straight way between its places than the turn
 * lets it be: the box of the places, grown by the sagitta of the half turn at most. */
static wf_bounds keyed(const wf_ready_op *r, double from, double to, wf_bounds b) {
    const wf_key *keys = r->keys + r->op->first_key;
    wf_affine at = wf_op_at(r, from);
    wf_bounds out = place(&at, b);
    double reach = 0;
    for (int k = 0; k < 3; k++) {
        double far = most(fabs(b.low[k]), fabs(b.high[k]));
        reach += far * far;
    }
    bool rotates = false;
    for (int k = 0; k < r->op->key_count; k++) {
        double t = keys[k].time_s - r->base_s;
        for (int q = 0; q < 4; q++) rotates |= keys[k].turn[q] != keys[0].turn[q];
        if (t <= from || t >= to) continue;
        at = wf_op_at(r, t);
        out = wf_bounds_unite(out, place(&at, b));
    }
    at = wf_op_at(r, to);
    out = wf_bounds_unite(out, place(&at, b));
    for (int k = 0; rotates && k < 3; k++) {
        out.low[k] -= 2 * sqrt(reach);
        out.high[k] += 2 * sqrt(reach);
    }
    return out;
}

static wf_bounds drift(const wf_ready_op *r, double from, double to, wf_bounds b) {
    wf_affine first = wf_op_at(r, from), last = wf_op_at(r, to);
    return wf_bounds_unite(place(&first, b), place(&last, b));
}

typedef wf_bounds move_fn(const wf_ready_op *op, double from, double to, wf_bounds b);

static move_fn *const move[] = {
    [WF_OP_PLACE] = drift, [WF_OP_VELOCITY] = drift, [WF_OP_SPIN] = spin, [WF_OP_KEYS] = keyed};

wf_bounds wf_bounds_move(const wf_ready_op *r, double from, double to, wf_bounds b) {
    if (wf_bounds_empty(&b)) return b;
    if (!wf_bounds_finite(&b) && r->op->kind != WF_OP_PLACE) return all();
    return move[r->op->kind](r, from, to, b);
}

wf_bounds wf_bounds_solid(const wf_scene *scene, const wf_ready_op *ops, int index, int within,
                          double from_s, double to_s) {
    const wf_solid *solid = &scene->solids[index];
    wf_bounds b = wf_solid_type_of(solid->kind)->bounds(solid, scene->planes);
    b = place(&solid->place, b);
    for (int op = solid->op; op >= 0 && op != within; op = scene->ops[op].outer)
        b = wf_bounds_move(&ops[op], from_s, to_s, b);
    return b;
}

/* ---- Shafts ---- */

static double size_of(const wf_bounds *b, int k) {
    return most(fabs(b->low[k]), fabs(b->high[k]));
}

wf_shaft wf_shaft_new(wf_bounds o, wf_bounds d, double most_s) {
    wf_shaft shaft = {.o = o, .d = d, .most = most_s};
    double far = most(size_of(&d, 0), most(size_of(&d, 1), size_of(&d, 2)));
    for (int k = 0; k < 3; k++) {
        shaft.o.low[k] -= SLACK * size_of(&o, k);
        shaft.o.high[k] += SLACK * size_of(&o, k);
        shaft.d.low[k] -= SLACK * far;
        shaft.d.high[k] += SLACK * far;
        shaft.rise[k] = 1 / shaft.d.high[k];
        shaft.fall[k] = 1 / shaft.d.low[k];
    }
    return shaft;
}

wf_shaft wf_shaft_of_rays(const wf_rays *r, double most_s) {
    wf_bounds o, d;
    wf_packet_ops_best()->box(r, &o, &d);
    return wf_shaft_new(o, d, most_s);
}

/* The box of m (c +- h) + d, by middle and half size. */
static void carry_box(const wf_affine *a, const double d[3], const wf_bounds *b,
                      wf_bounds *out) {
    double c[3], h[3];
    for (int k = 0; k < 3; k++) {
        c[k] = (b->low[k] + b->high[k]) / 2;
        h[k] = (b->high[k] - b->low[k]) / 2;
    }
    for (int i = 0; i < 3; i++) {
        const double *m = a->m[i];
        double x = m[0] * c[0], y = m[1] * c[1], z = m[2] * c[2];
        double half = fabs(m[0]) * h[0] + fabs(m[1]) * h[1] + fabs(m[2]) * h[2];
        double middle = x + y + z + d[i];
        half += (fabs(x) + fabs(y) + fabs(z) + fabs(d[i]) + half) * SLACK;
        out->low[i] = middle - half;
        out->high[i] = middle + half;
    }
}

wf_shaft wf_shaft_place(const wf_affine *map, const wf_shaft *f) {
    static const double none[3] = {0, 0, 0};
    const double d[3] = {map->d.x, map->d.y, map->d.z};
    wf_shaft out = {.most = f->most};
    carry_box(map, d, &f->o, &out.o);
    carry_box(map, none, &f->d, &out.d);
    for (int k = 0; k < 3; k++) {
        out.rise[k] = 1 / out.d.high[k];
        out.fall[k] = 1 / out.d.low[k];
    }
    return out;
}

/* Leaves of from..to those s at which over + s d >= 0. inverse: 1 / d. */
static void keep(double over, double d, double inverse, double *from, double *to) {
    double at = -over * inverse;
    if (d > 0) {
        if (over < 0) *from = most(*from, at);
    } else if (d < 0) {
        *to = over < 0 ? -1 : least(*to, at);
    } else if (over < 0) {
        *to = -1;
    }
}

bool wf_shaft_meets(const wf_shaft *f, const wf_bounds *b, wf_stretch *stretch) {
    double from = 0, to = f->most;
    for (int k = 0; k < 3 && from <= to; k++) {
        keep(f->o.high[k] - b->low[k], f->d.high[k], f->rise[k], &from, &to);
        keep(b->high[k] - f->o.low[k], -f->d.low[k], -f->fall[k], &from, &to);
    }
    *stretch = (wf_stretch){from * (1 - SLACK), to * (1 + SLACK)};
    return stretch->from <= stretch->to;
}
