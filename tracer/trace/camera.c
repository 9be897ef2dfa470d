/* Rays and shafts of rays from a camera that may move. */
#include "tracer/trace/camera.h"

#include <math.h>

#include "tracer/trace/carry.h"

/* Picture coordinates: from the middle, in units of half the picture's height, y up. */
static double across(const wf_tracer *t, double x) {
    const wf_view *v = &t->view;
    return (2 * x - v->width_px) * v->pixel_aspect / v->lines;
}

static double up(const wf_tracer *t, double y) {
    return 1 - 2 * y / t->view.lines;
}

static void put(double *x, double *y, double *z, int i, wf_vec v) {
    x[i] = v.x, y[i] = v.y, z[i] = v.z;
}

/* The point of the view plane at a place of the picture, from the eye. */
static wf_vec in_plane(const wf_camera *c, double a, double b) {
    double h = c->half_height;
    return (wf_vec){h * (a * c->right.x + b * c->up.x), h * (a * c->right.y + b * c->up.y),
                    h * (a * c->right.z + b * c->up.z)};
}

static wf_vec add(wf_vec a, wf_vec b) {
    return (wf_vec){a.x + b.x, a.y + b.y, a.z + b.z};
}

static void local_rays(const wf_tracer *t, const double *x, const double *y, wf_rays *r) {
    const wf_camera *c = &t->scene->camera;
    for (int i = 0, n = wf_places(r->count); i < n; i++) {
        wf_vec p = in_plane(c, across(t, x[i]), up(t, y[i]));
        put(r->ox, r->oy, r->oz, i, c->orthographic ? add(c->eye, p) : c->eye);
        put(r->dx, r->dy, r->dz, i, c->orthographic ? c->forward : add(c->forward, p));
    }
}

/* ---- Motion of the camera ---- */

static void carry_out(const wf_ready_op *op, const double *dt_s, wf_rays *r) {
    wf_affine map = wf_op_at(op, dt_s[0]);
    for (int i = 0, n = wf_places(r->count); i < n; i++) {
        if (i && dt_s[i] != dt_s[i - 1]) map = wf_op_at(op, dt_s[i]);
        put(r->ox, r->oy, r->oz, i, wf_apply(&map, (wf_vec){r->ox[i], r->oy[i], r->oz[i]}));
        put(r->dx, r->dy, r->dz, i, wf_turn(&map, (wf_vec){r->dx[i], r->dy[i], r->dz[i]}));
    }
}

void wf_camera_rays(const wf_tracer *t, const double *x, const double *y, wf_packet *packet) {
    double dt_s[WF_PACKET];
    local_rays(t, x, y, &packet->rays);
    for (int op = t->scene->camera.op; op >= 0; op = t->scene->ops[op].outer) {
        wf_carry_times(t, packet, &t->scene->ops[op], dt_s);
        carry_out(&t->ops[op], dt_s, &packet->rays);
    }
}

/* ---- Shafts ---- */

/* Directions are carried as points about the origin: an operator's own middle is taken from
 * both. */
static wf_bounds move_directions(const wf_ready_op *op, double from_s, double to_s,
                                 wf_bounds d) {
    wf_op still = *op->op;
    wf_ready_op about = *op;
    if (op->op->kind == WF_OP_VELOCITY) return d;
    if (op->op->kind == WF_OP_KEYS) {
        double reach = 0;
        for (int k = 0; k < 3; k++) reach += fmax(d.low[k] * d.low[k], d.high[k] * d.high[k]);
        reach = sqrt(reach);
        return (wf_bounds){{-reach, -reach, -reach}, {reach, reach, reach}};
    }
    still.center = (wf_vec){0, 0, 0};
    still.place.d = still.center;
    about.op = &still;
    about.place.d = still.center;
    return wf_bounds_move(&about, from_s, to_s, d);
}

static void time_span(const wf_tracer *t, const wf_op *op, double *from_s, double *to_s) {
    wf_packet ends = {.rays.count = 2, .f = {0, 1}};
    double dt_s[WF_PACKET];
    wf_carry_times(t, &ends, op, dt_s);
    *from_s = dt_s[0];
    *to_s = dt_s[1] + t->window.late_s;
}

wf_shaft wf_camera_shaft(const wf_tracer *t, const double x[2], const double y[2]) {
    const wf_camera *c = &t->scene->camera;
    wf_bounds o = wf_bounds_none(), d = wf_bounds_none();
    for (int corner = 0; corner < 4; corner++) {
        wf_vec p = in_plane(c, across(t, x[corner & 1]), up(t, y[corner >> 1]));
        wf_vec from = c->orthographic ? add(c->eye, p) : c->eye;
        wf_vec along = c->orthographic ? c->forward : add(c->forward, p);
        o = wf_bounds_unite(o, wf_bounds_of_point(from));
        d = wf_bounds_unite(d, wf_bounds_of_point(along));
    }
    for (int op = c->op; op >= 0; op = t->scene->ops[op].outer) {
        double from_s, to_s;
        time_span(t, &t->scene->ops[op], &from_s, &to_s);
        o = wf_bounds_move(&t->ops[op], from_s, to_s, o);
        d = move_directions(&t->ops[op], from_s, to_s, d);
    }
    return wf_shaft_new(o, d, HUGE_VAL);
}
