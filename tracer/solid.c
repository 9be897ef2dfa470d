#include "tracer/solid.h"

#include <math.h>

#include "filters/isa.h"

/* ---- Dispatch ---- */

extern wf_intersect_fn *const wf_intersect_v1[WF_SOLID_KINDS];
#if defined(__x86_64__)
extern wf_intersect_fn *const wf_intersect_v3[WF_SOLID_KINDS];
extern wf_intersect_fn *const wf_intersect_v4[WF_SOLID_KINDS];
static wf_intersect_fn *const *const levels[] = {wf_intersect_v1, wf_intersect_v3,
                                                 wf_intersect_v4};
#else
static wf_intersect_fn *const *const levels[] = {wf_intersect_v1};
#endif

wf_intersect_fn *const *wf_intersect_at(size_t level) {
    return level < (size_t)wf_isa_levels() ? levels[level] : NULL;
}

wf_intersect_fn *const *wf_intersect_best(void) {
    return levels[wf_isa_levels() - 1];
}

/* ---- Points and normals ---- */

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

static wf_vec sphere_normal(SOLID, wf_vec p) {
    (void)s, (void)planes;
    return p;
}

static wf_bounds unit_bounds(SOLID) {
    (void)s, (void)planes;
    return cube(1, 1, 1);
}

static bool in_box(SOLID, wf_vec p) {
    (void)s, (void)planes;
    return fabs(p.x) <= 1 && fabs(p.y) <= 1 && fabs(p.z) <= 1;
}

static wf_vec box_normal(SOLID, wf_vec p) {
    double x = fabs(p.x), y = fabs(p.y), z = fabs(p.z);
    (void)s, (void)planes;
    if (x >= y && x >= z) return (wf_vec){p.x, 0, 0};
    return y >= z ? (wf_vec){0, p.y, 0} : (wf_vec){0, 0, p.z};
}

static bool in_cylinder(SOLID, wf_vec p) {
    (void)s, (void)planes;
    return p.x * p.x + p.z * p.z <= 1 && fabs(p.y) <= 1;
}

static wf_vec cylinder_normal(SOLID, wf_vec p) {
    (void)s, (void)planes;
    bool cap = fabs(p.y) * fabs(p.y) > p.x * p.x + p.z * p.z;
    return cap ? (wf_vec){0, p.y, 0} : (wf_vec){p.x, 0, p.z};
}

static double cone_radius(const wf_solid *s, double y) {
    return (s->shape[1] + s->shape[0]) / 2 + (s->shape[1] - s->shape[0]) / 2 * y;
}

static bool in_cone(SOLID, wf_vec p) {
    double radius = cone_radius(s, p.y);
    (void)planes;
    return fabs(p.y) <= 1 && p.x * p.x + p.z * p.z <= radius * radius;
}

/* The side is where the distance to it is less than to the caps. */
static wf_vec cone_normal(SOLID, wf_vec p) {
    double across = sqrt(p.x * p.x + p.z * p.z), slope = (s->shape[1] - s->shape[0]) / 2;
    double to_side = fabs(across - cone_radius(s, p.y)) / sqrt(1 + slope * slope);
    (void)planes;
    if (fabs(1 - fabs(p.y)) < to_side || across == 0) return (wf_vec){0, p.y, 0};
    return (wf_vec){p.x, -slope * across, p.z};
}

static bool in_torus(SOLID, wf_vec p) {
    double across = sqrt(p.x * p.x + p.z * p.z) - 1;
    (void)planes;
    return across * across + p.y * p.y <= s->shape[0] * s->shape[0];
}

static wf_vec torus_normal(SOLID, wf_vec p) {
    double across = sqrt(p.x * p.x + p.z * p.z), share = across > 0 ? 1 - 1 / across : 0;
    (void)s, (void)planes;
    return (wf_vec){p.x * share, p.y, p.z * share};
}

static wf_bounds torus_bounds(SOLID) {
    (void)planes;
    return cube(1 + s->shape[0], s->shape[0], 1 + s->shape[0]);
}

static bool in_halfspace(SOLID, wf_vec p) {
    (void)s, (void)planes;
    return p.y <= 0;
}

static wf_vec halfspace_normal(SOLID, wf_vec p) {
    (void)s, (void)planes, (void)p;
    return (wf_vec){0, 1, 0};
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

static wf_vec quadric_normal(SOLID, wf_vec p) {
    const double *q = s->shape;
    (void)planes;
    return (wf_vec){2 * q[0] * p.x + q[3] * p.y + q[5] * p.z + q[6],
                    2 * q[1] * p.y + q[3] * p.x + q[4] * p.z + q[7],
                    2 * q[2] * p.z + q[4] * p.y + q[5] * p.x + q[8]};
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

static wf_vec polyhedron_normal(SOLID, wf_vec p) {
    const wf_plane *nearest = &planes[s->first_plane];
    for (int k = 1; k < s->plane_count; k++) {
        const wf_plane *f = &planes[s->first_plane + k];
        if (over_plane(f, p) > over_plane(nearest, p)) nearest = f;
    }
    return (wf_vec){nearest->n[0], nearest->n[1], nearest->n[2]};
}

/* ---- The table ---- */

static const wf_solid_type types[WF_SOLID_KINDS] = {
    [WF_SPHERE] = {"sphere", 1, sphere_normal, in_sphere, unit_bounds},
    [WF_BOX] = {"box", 1, box_normal, in_box, unit_bounds},
    [WF_CYLINDER] = {"cylinder", 1, cylinder_normal, in_cylinder, unit_bounds},
    [WF_CONE] = {"cone", 1, cone_normal, in_cone, unit_bounds},
    [WF_TORUS] = {"torus", 2, torus_normal, in_torus, torus_bounds},
    [WF_HALFSPACE] = {"halfspace", 1, halfspace_normal, in_halfspace, halfspace_bounds},
    [WF_QUADRIC] = {"quadric", 2, quadric_normal, in_quadric, endless_bounds},
    [WF_POLYHEDRON] = {"polyhedron", 1, polyhedron_normal, in_polyhedron, endless_bounds},
};

const wf_solid_type *wf_solid_type_of(wf_solid_kind kind) {
    return &types[kind];
}
