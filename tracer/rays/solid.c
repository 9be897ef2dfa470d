/* Kinds of solids: their boxes, and which of their loops is used. */
#include "tracer/rays/solid.h"

#include <math.h>

WF_ISA_DISPATCH(wf_solid_ops)

/* ---- Boxes ---- */

#define SOLID const wf_solid *s, const wf_plane *planes

static wf_bounds cube(double x, double y, double z) {
    return (wf_bounds){{-x, -y, -z}, {x, y, z}};
}

static wf_bounds unit_bounds(SOLID) {
    (void)s, (void)planes;
    return cube(1, 1, 1);
}

static wf_bounds torus_bounds(SOLID) {
    (void)planes;
    return cube(1 + s->shape[0], s->shape[0], 1 + s->shape[0]);
}

static wf_bounds halfspace_bounds(SOLID) {
    (void)s, (void)planes;
    return (wf_bounds){{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, 0, HUGE_VAL}};
}

static wf_bounds endless_bounds(SOLID) {
    (void)s, (void)planes;
    return cube(HUGE_VAL, HUGE_VAL, HUGE_VAL);
}

static wf_bounds polyhedron_bounds(SOLID) {
    const double *b = s->shape;
    if (!(b[6] > 0)) return endless_bounds(s, planes);
    return (wf_bounds){{b[0], b[1], b[2]}, {b[3], b[4], b[5]}};
}

/* ---- The table ---- */

/* clang-format off */
static const wf_solid_type types[WF_SOLID_KINDS] = {
    /*                 name          runs  alike  bounds */
    [WF_SPHERE]     = {"sphere",     1,    true,  unit_bounds},
    [WF_BOX]        = {"box",        1,    true,  unit_bounds},
    [WF_CYLINDER]   = {"cylinder",   1,    true,  unit_bounds},
    [WF_CONE]       = {"cone",       1,    false, unit_bounds},
    [WF_TORUS]      = {"torus",      2,    false, torus_bounds},
    [WF_HALFSPACE]  = {"halfspace",  1,    true,  halfspace_bounds},
    [WF_QUADRIC]    = {"quadric",    2,    false, endless_bounds},
    [WF_POLYHEDRON] = {"polyhedron", 1,    false, polyhedron_bounds},
};
/* clang-format on */

const wf_solid_type *wf_solid_type_of(wf_solid_kind kind) {
    return &types[kind];
}
