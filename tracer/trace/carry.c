/* Rays into the spaces of operators, and normals out of them. */
#include "tracer/trace/carry.h"

#include <stdlib.h>
#include <string.h>

void wf_carry_times(const wf_tracer *t, const wf_packet *packet, const wf_op *op,
                    double *dt_s) {
    const wf_window_of_time *w = &t->window;
    double width =
        (op->own_width ? op->width_fields : w->width_fields) * t->view.field_period_s;
    for (int i = 0, n = wf_places(packet->rays.count); i < n; i++)
        dt_s[i] = packet->late_s + (packet->f[i] - w->anchor) * width;
}

/* ---- Keyframes: a map for each ray ---- */

static void put_ray(const wf_affine *map, const wf_rays *from, wf_rays *to, int i) {
    wf_vec o = wf_apply(map, (wf_vec){from->ox[i], from->oy[i], from->oz[i]});
    wf_vec d = wf_turn(map, (wf_vec){from->dx[i], from->dy[i], from->dz[i]});
    to->ox[i] = o.x, to->oy[i] = o.y, to->oz[i] = o.z;
    to->dx[i] = d.x, to->dy[i] = d.y, to->dz[i] = d.z;
}

static void keyed_in(const wf_ready_op *op, const double *dt_s, const wf_rays *from,
                     wf_rays *to) {
    wf_affine map = wf_op_inverse_at(op, dt_s[0]);
    to->count = from->count;
    for (int i = 0, n = wf_places(from->count); i < n; i++) {
        if (i && dt_s[i] != dt_s[i - 1]) map = wf_op_inverse_at(op, dt_s[i]);
        put_ray(&map, from, to, i);
    }
}

static void keyed_out(const wf_ready_op *op, const double *dt_s, int count, wf_points *n) {
    wf_affine map = wf_op_at(op, dt_s[0]);
    for (int i = 0, places = wf_places(count); i < places; i++) {
        if (i && dt_s[i] != dt_s[i - 1]) map = wf_op_at(op, dt_s[i]);
        wf_vec v = wf_turn(&map, (wf_vec){n->x[i], n->y[i], n->z[i]});
        n->x[i] = v.x, n->y[i] = v.y, n->z[i] = v.z;
    }
}

/* ---- Operators ---- */

static void enter(const wf_tracer *t, const wf_rays *outer, wf_carried *c) {
    const wf_ready_op *op = &t->ops[c->op];
    switch (op->op->kind) {
    case WF_OP_PLACE:
        t->packet->place(&op->inverse, outer, &c->rays);
        return;
    case WF_OP_VELOCITY:
        t->packet->drift_in(op, c->dt_s, outer, &c->rays);
        return;
    case WF_OP_SPIN:
        t->packet->find_sincos(op, c->dt_s, outer->count, &c->spin);
        t->packet->spin_in(op, &c->spin, outer, &c->rays);
        return;
    case WF_OP_KEYS:
        keyed_in(op, c->dt_s, outer, &c->rays);
        return;
    }
}

static void leave(const wf_tracer *t, const wf_carried *c, int count, wf_points *normals) {
    const wf_ready_op *op = &t->ops[c->op];
    if (op->op->kind == WF_OP_PLACE) t->packet->place_normals(&op->inverse, count, normals);
    if (op->op->kind == WF_OP_SPIN) t->packet->spin_out(op, &c->spin, count, normals);
    if (op->op->kind == WF_OP_KEYS) keyed_out(op, c->dt_s, count, normals);
}

/* ---- The spaces of a packet ---- */

void wf_carry_begin(wf_trace_scratch *s) {
    s->spaces->carried_count = 0;
}

static wf_carried *find_carried(const wf_trace_scratch *s, int op) {
    int at = s->spaces->carried_of[op];
    return at < s->spaces->carried_count && s->spaces->carried[at]->op == op
               ? s->spaces->carried[at]
               : NULL;
}

static wf_carried *new_carried(wf_trace_scratch *s, int op) {
    if (s->spaces->carried_count == s->spaces->carried_capacity) {
        int capacity = 2 * s->spaces->carried_capacity + 8;
        wf_carried **grown = realloc(s->spaces->carried, (size_t)capacity * sizeof *grown);
        if (!grown) return NULL;
        memset(grown + s->spaces->carried_capacity, 0,
               (size_t)(capacity - s->spaces->carried_capacity) * sizeof *grown);
        s->spaces->carried = grown;
        s->spaces->carried_capacity = capacity;
    }
    wf_carried **at = &s->spaces->carried[s->spaces->carried_count];
    if (!*at) *at = aligned_alloc(64, (sizeof **at + 63) / 64 * 64);
    if (!*at) return NULL;
    (*at)->op = op;
    (*at)->shaft.most = 0;
    s->spaces->carried_of[op] = s->spaces->carried_count++;
    return *at;
}

const wf_rays *wf_carry_rays(const wf_tracer *t, wf_trace_scratch *s, const wf_packet *packet,
                             int op) {
    if (op < 0) return &packet->rays;
    wf_carried *c = find_carried(s, op);
    if (c) return &c->rays;
    const wf_rays *outer = wf_carry_rays(t, s, packet, t->scene->ops[op].outer);
    if (!outer || !(c = new_carried(s, op))) return NULL;
    wf_carry_times(t, packet, &t->scene->ops[op], c->dt_s);
    enter(t, outer, c);
    return &c->rays;
}

const wf_shaft *wf_carry_shaft(const wf_tracer *t, wf_trace_scratch *s, const wf_packet *packet,
                               const wf_shaft *world, int op) {
    if (op < 0) return world;
    if (!wf_carry_rays(t, s, packet, op)) return NULL;
    wf_carried *c = find_carried(s, op);
    if (!(c->shaft.most > 0)) c->shaft = wf_shaft_of_rays(&c->rays, world->most);
    return &c->shaft;
}

void wf_carry_normals(const wf_tracer *t, const wf_trace_scratch *s, int op, int count,
                      wf_points *n) {
    for (; op >= 0; op = t->scene->ops[op].outer) leave(t, find_carried(s, op), count, n);
    t->packet->unit(count, n);
}
