/* Affine maps, and the operators that move solids, lights and cameras at instants. */
#include "tracer/scene/motion.h"

#include <math.h>

#include "filters/base/quad.h"

#define PI 3.14159265358979323846

/* ---- Affine maps ---- */

wf_vec wf_turn(const wf_affine *a, wf_vec v) {
    return (wf_vec){a->m[0][0] * v.x + a->m[0][1] * v.y + a->m[0][2] * v.z,
                    a->m[1][0] * v.x + a->m[1][1] * v.y + a->m[1][2] * v.z,
                    a->m[2][0] * v.x + a->m[2][1] * v.y + a->m[2][2] * v.z};
}

wf_vec wf_apply(const wf_affine *a, wf_vec p) {
    wf_vec q = wf_turn(a, p);
    return (wf_vec){q.x + a->d.x, q.y + a->d.y, q.z + a->d.z};
}

wf_affine wf_compose(const wf_affine *outer, const wf_affine *inner) {
    wf_affine c = {.d = wf_apply(outer, inner->d)};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            c.m[i][j] = outer->m[i][0] * inner->m[0][j] + outer->m[i][1] * inner->m[1][j] +
                        outer->m[i][2] * inner->m[2][j];
    return c;
}

/* a - b, or 0 where all but rounding cancels: an axis of a rotated solid stays square to what
 * it was square to. */
static double less(double a, double b) {
    double rest = a - b;
    return fabs(rest) > (fabs(a) + fabs(b)) * 0x1p-50 ? rest : 0;
}

bool wf_invert(const wf_affine *a, wf_affine *out) {
    double det = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            out->m[j][i] = less(a->m[i1][j1] * a->m[i2][j2], a->m[i1][j2] * a->m[i2][j1]);
        }
    for (int j = 0; j < 3; j++) det += a->m[0][j] * out->m[j][0];
    if (!(fabs(det) > 0) || !isfinite(1 / det)) return false;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) out->m[i][j] /= det;
    wf_vec back = wf_turn(out, a->d);
    out->d = (wf_vec){-back.x, -back.y, -back.z};
    return true;
}

wf_affine wf_identity(void) {
    return (wf_affine){.m = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
}

wf_affine wf_scaling(wf_vec size, wf_vec center) {
    return (wf_affine){.m = {{size.x, 0, 0}, {0, size.y, 0}, {0, 0, size.z}}, .d = center};
}

wf_affine wf_rotation(wf_vec k, wf_vec center, double c, double s) {
    double v = 1 - c;
    wf_affine a = {
        .m = {{c + k.x * k.x * v, k.x * k.y * v - k.z * s, k.x * k.z * v + k.y * s},
              {k.y * k.x * v + k.z * s, c + k.y * k.y * v, k.y * k.z * v - k.x * s},
              {k.z * k.x * v - k.y * s, k.z * k.y * v + k.x * s, c + k.z * k.z * v}}};
    wf_vec moved = wf_turn(&a, center);
    a.d = (wf_vec){center.x - moved.x, center.y - moved.y, center.z - moved.z};
    return a;
}

/* ---- Operators ---- */

static double rational(wf_rational r) {
    return (double)r.num / (double)r.den;
}

/* Turns at the base, without the whole ones: 10^7 frames are a million turns, of which only the
 * last counts. */
static double phase_of(const wf_op *op, wf_rational base_s) {
    wf_quad turns = (wf_quad)op->turns_a_second_num / (wf_quad)op->turns_a_second_den *
                    (wf_quad)base_s.num / (wf_quad)base_s.den;
    double whole = floor((double)turns);
    wf_quad rest = turns - (wf_quad)whole; /* whole is exact below 2^53 */
    return (double)(rest < 0 ? rest + 1 : rest);
}

wf_ready_op wf_op_ready(const wf_scene *scene, int index, wf_rational base_s) {
    const wf_op *op = &scene->ops[index];
    wf_ready_op ready = {
        .op = op, .place = op->place, .base_s = rational(base_s), .keys = scene->keys};
    double t = ready.base_s;
    if (op->kind == WF_OP_PLACE) wf_invert(&op->place, &ready.inverse);
    ready.offset = (wf_vec){op->velocity.x * t, op->velocity.y * t, op->velocity.z * t};
    if (op->kind == WF_OP_SPIN) {
        ready.phase = phase_of(op, base_s);
        ready.turns_a_second = op->turns_a_second_num / op->turns_a_second_den;
    }
    return ready;
}

static wf_affine moved_by(wf_vec offset) {
    return (wf_affine){.m = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, .d = offset};
}

static wf_affine turned(const wf_op *op, double angle) {
    return wf_rotation(op->axis, op->center, cos(angle), sin(angle));
}

static wf_affine by_quaternion(const double q[4], wf_vec position) {
    double w = q[0], x = q[1], y = q[2], z = q[3];
    return (wf_affine){
        .m = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
              {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
              {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}},
        .d = position};
}

/* Along the shorter arc at an even rate (Shoemake 1985). */
static void slerp(const double a[4], const double b[4], double f, double out[4]) {
    double dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3], sign = dot < 0 ? -1 : 1;
    double angle = acos(fmin(fabs(dot), 1)), s = sin(angle);
    double from = s > 1e-9 ? sin((1 - f) * angle) / s : 1 - f;
    double to = sign * (s > 1e-9 ? sin(f * angle) / s : f), size = 0;
    for (int i = 0; i < 4; i++) out[i] = from * a[i] + to * b[i], size += out[i] * out[i];
    for (int i = 0; i < 4; i++) out[i] /= sqrt(size);
}

static wf_affine keyed(const wf_ready_op *r, double dt_s) {
    const wf_key *key = r->keys + r->op->first_key, *last = key + r->op->key_count - 1;
    double t = r->base_s + dt_s, turn[4];
    if (t <= key->time_s) return by_quaternion(key->turn, key->position);
    if (t >= last->time_s) return by_quaternion(last->turn, last->position);
    while (key[1].time_s < t) key++;
    double f = (t - key->time_s) / (key[1].time_s - key->time_s);
    wf_vec a = key->position, b = key[1].position;
    slerp(key->turn, key[1].turn, f, turn);
    return by_quaternion(
        turn, (wf_vec){a.x + f * (b.x - a.x), a.y + f * (b.y - a.y), a.z + f * (b.z - a.z)});
}

static wf_vec drifted(const wf_ready_op *r, double dt_s, double sign) {
    wf_vec v = r->op->velocity;
    return (wf_vec){sign * (r->offset.x + v.x * dt_s), sign * (r->offset.y + v.y * dt_s),
                    sign * (r->offset.z + v.z * dt_s)};
}

static double angle_at(const wf_ready_op *r, double dt_s) {
    return 2 * PI * (r->phase + r->turns_a_second * dt_s);
}

wf_affine wf_op_at(const wf_ready_op *r, double dt_s) {
    switch (r->op->kind) {
    case WF_OP_VELOCITY:
        return moved_by(drifted(r, dt_s, 1));
    case WF_OP_SPIN:
        return turned(r->op, angle_at(r, dt_s));
    case WF_OP_KEYS:
        return keyed(r, dt_s);
    default:
        return r->place;
    }
}

wf_affine wf_op_inverse_at(const wf_ready_op *r, double dt_s) {
    wf_affine place, inverse = {0};
    switch (r->op->kind) {
    case WF_OP_VELOCITY:
        return moved_by(drifted(r, dt_s, -1));
    case WF_OP_SPIN:
        return turned(r->op, -angle_at(r, dt_s));
    case WF_OP_KEYS:
        place = keyed(r, dt_s);
        wf_invert(&place, &inverse);
        return inverse;
    default:
        return r->inverse;
    }
}

bool wf_op_moves(const wf_scene *scene, int op) {
    for (; op >= 0; op = scene->ops[op].outer)
        if (scene->ops[op].kind != WF_OP_PLACE) return true;
    return false;
}
