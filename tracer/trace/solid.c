/* Kinds of solids: which points they hold, their bounds, and which of their loops is used. */
#include "tracer/trace/solid.h"

#include <math.h>

WF_ISA_DISPATCH(wf_solid_ops)

/* ---- Points ---- */

#define SOLID const wf_solid *s, const wf_plane *planes

static double squared(wf_vec p) {
    return p.x * p.x + p.y * p.y + p.z * p.z;
}

static wf_bounds cube(double x, double y, double z) {
    return (wf_bounds){{-x, -y, -z}, {x, y, z}};
}

static bool in_sphere(SOLID, wf_vec p) {
    (void)s, (void)planes;
    return squared(p) <= 1;
}

static wf_bounds unit_bounds(SOLID) {
    (void)s, (void)planes;
    return cube(1, 1, 1);
}

static bool in_box(SOLID, wf_vec p) {
    (void)s, (void)planes;
    return fabs(p.x) <= 1 && fabs(p.y) <= 1 && fabs(p.z) <= 1;
}

static bool in_cylinder(SOLID, wf_vec p) {
    (void)s, (void)planes;
    return p.x * p.x + p.z * p.z <= 1 && fabs(p.y) <= 1;
}

static double cone_radius(const wf_solid *s, double y) {
    return (s->shape[1] + s->shape[0]) / 2 + (s->shape[1] - s->shape[0]) / 2 * y;
}

static bool in_cone(SOLID, wf_vec p) {
    double radius = cone_radius(s, p.y);
    (void)planes;
    return fabs(p.y) <= 1 && p.x * p.x + p.z * p.z <= radius * radius;
}

static bool in_torus(SOLID, wf_vec p) {
    double across = sqrt(p.x * p.x + p.z * p.z) - 1;
    (void)planes;
    return across * across + p.y * p.y <= s->shape[0] * s->shape[0];
}

static wf_bounds torus_bounds(SOLID) {
    (void)planes;
    return cube(1 + s->shape[0], s->shape[0], 1 + s->shape[0]);
}

static bool in_halfspace(SOLID, wf_vec p) {
    (void)s, (void)planes;
    return p.y <= 0;
}

static wf_bounds halfspace_bounds(SOLID) {
    (void)s, (void)planes;
    return (wf_bounds){{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, 0, HUGE_VAL}};
}

static bool in_quadric(SOLID, wf_vec p) {
    const double *q = s->shape;
    (void)planes;
    return q[0] * p.x * p.x + q[1] * p.y * p.y + q[2] * p.z * p.z + q[3] * p.x * p.y +
               q[4] * p.y * p.z + q[5] * p.z * p.x + q[6] * p.x + q[7] * p.y + q[8] * p.z +
               q[9] <=
           0;
}

static wf_bounds endless_bounds(SOLID) {
    (void)s, (void)planes;
    return cube(HUGE_VAL, HUGE_VAL, HUGE_VAL);
}

static double over_plane(const wf_plane *f, wf_vec p) {
    return f->n[0] * p.x + f->n[1] * p.y + f->n[2] * p.z - f->d;
}

static bool in_polyhedron(SOLID, wf_vec p) {
    for (int k = 0; k < s->plane_count; k++)
        if (over_plane(&planes[s->first_plane + k], p) > 0) return false;
    return true;
}

static wf_bounds polyhedron_bounds(SOLID) {
    const double *b = s->shape;
    if (!(b[6] > 0)) return endless_bounds(s, planes);
    return (wf_bounds){{b[0], b[1], b[2]}, {b[3], b[4], b[5]}};
}

/* ---- The table ---- */

static const wf_solid_type types[WF_SOLID_KINDS] = {
    [WF_SPHERE] = {"sphere", 1, in_sphere, unit_bounds},
    [WF_BOX] = {"box", 1, in_box, unit_bounds},
    [WF_CYLINDER] = {"cylinder", 1, in_cylinder, unit_bounds},
    [WF_CONE] = {"cone", 1, in_cone, unit_bounds},
    [WF_TORUS] = {"torus", 2, in_torus, torus_bounds},
    [WF_HALFSPACE] = {"halfspace", 1, in_halfspace, halfspace_bounds},
    [WF_QUADRIC] = {"quadric", 2, in_quadric, endless_bounds},
    [WF_POLYHEDRON] = {"polyhedron", 1, in_polyhedron, polyhedron_bounds},
};

const wf_solid_type *wf_solid_type_of(wf_solid_kind kind) {
    return &types[kind];
}
