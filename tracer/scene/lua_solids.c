/* The forms of solids as functions of a script: one row of a table each, and two that take
 * lists. */
#include <string.h>

#include "tracer/scene/language.h"
#include "tracer/scene/lua_node.h"
#include "tracer/scene/lua_table.h"
#include "tracer/scene/motion.h"
#include "tracer/scene/polyhedron.h"
#include "tracer/scene/vec.h"

/* What the keys of any form are read into. */
typedef struct form {
    wf_vec center, radii, min, max, from, to, axis, normal;
    double radius, major, minor, offset, ends[2];
} form;

/* ---- Forms ---- */

/* y along a unit axis, x and z across it, each with its length (Duff et al., Building an
 * orthonormal basis, revisited, 2017). */
static wf_affine along_axis(wf_vec k, double across, double length, wf_vec center) {
    double sign = copysign(1, k.z), a = -1 / (sign + k.z), b = k.x * k.y * a;
    wf_vec u = {1 + sign * k.x * k.x * a, sign * b, -sign * k.x};
    wf_vec v = {b, sign + k.y * k.y * a, -k.y};
    return (wf_affine){.m = {{v.x * across, k.x * length, u.x * across},
                             {v.y * across, k.y * length, u.y * across},
                             {v.z * across, k.z * length, u.z * across}},
                       .d = center};
}

/* The frame of a solid that stands between two points: y from -1 to 1. */
static wf_affine between(lua_State *lua, const char *what, const form *f, double across) {
    wf_vec way = wf_vec_minus(f->to, f->from);
    wf_vec middle = {f->from.x / 2 + f->to.x / 2, f->from.y / 2 + f->to.y / 2,
                     f->from.z / 2 + f->to.z / 2};
    double far = wf_vec_largest(way);
    if (!(far > 0)) wf_scene_error(lua, what, "from and to must be two points, not one");
    wf_vec v = {way.x / far, way.y / far, way.z / far};
    double length = far * wf_vec_length(v);
    return along_axis(wf_vec_unit(way), across, length / 2, middle);
}

static void make_sphere(lua_State *lua, const form *f, wf_solid *s) {
    (void)lua;
    s->place = wf_scaling((wf_vec){f->radius, f->radius, f->radius}, f->center);
}

static void make_ellipsoid(lua_State *lua, const form *f, wf_solid *s) {
    (void)lua;
    s->kind = WF_SPHERE;
    s->place = wf_scaling(f->radii, f->center);
}

static void make_box(lua_State *lua, const form *f, wf_solid *s) {
    wf_vec size = wf_vec_minus(f->max, f->min);
    if (!(size.x > 0 && size.y > 0 && size.z > 0))
        wf_scene_error(lua, "box", "max must be beyond min in x, y and z");
    s->place = wf_scaling((wf_vec){size.x / 2, size.y / 2, size.z / 2},
                          (wf_vec){f->min.x / 2 + f->max.x / 2, f->min.y / 2 + f->max.y / 2,
                                   f->min.z / 2 + f->max.z / 2});
}

static void make_cylinder(lua_State *lua, const form *f, wf_solid *s) {
    s->place = between(lua, "cylinder", f, f->radius);
}

static void make_cone(lua_State *lua, const form *f, wf_solid *s) {
    double wide = fmax(f->ends[0], f->ends[1]);
    if (!(wide > 0)) wf_scene_error(lua, "cone", "one of its radii must be > 0");
    s->shape[0] = f->ends[0] / wide;
    s->shape[1] = f->ends[1] / wide;
    s->place = between(lua, "cone", f, wide);
}

static void make_torus(lua_State *lua, const form *f, wf_solid *s) {
    (void)lua;
    s->shape[0] = f->minor / f->major;
    s->place = along_axis(f->axis, f->major, f->major, f->center);
}

/* The direction of the normal has been brought to length 1: offset counts in the length that
 * it was written with. */
static void make_halfspace(lua_State *lua, const form *f, wf_solid *s) {
    (void)lua;
    double size = f->radius;
    wf_vec n = f->normal;
    double d = f->offset / size;
    s->place = along_axis(n, 1, 1, (wf_vec){n.x * d, n.y * d, n.z * d});
}

static const wf_lua_key sphere_keys[] = {
    {"center", WF_KEY_VECTOR, offsetof(form, center), false},
    {"radius", WF_KEY_POSITIVE, offsetof(form, radius), false},
    {0}};
static const wf_lua_key ellipsoid_keys[] = {
    {"center", WF_KEY_VECTOR, offsetof(form, center), false},
    {"radii", WF_KEY_POSITIVES, offsetof(form, radii), true},
    {0}};
static const wf_lua_key box_keys[] = {{"min", WF_KEY_VECTOR, offsetof(form, min), true},
                                      {"max", WF_KEY_VECTOR, offsetof(form, max), true},
                                      {0}};
static const wf_lua_key cylinder_keys[] = {
    {"from", WF_KEY_VECTOR, offsetof(form, from), true},
    {"to", WF_KEY_VECTOR, offsetof(form, to), true},
    {"radius", WF_KEY_POSITIVE, offsetof(form, radius), true},
    {0}};
static const wf_lua_key cone_keys[] = {{"from", WF_KEY_VECTOR, offsetof(form, from), true},
                                       {"to", WF_KEY_VECTOR, offsetof(form, to), true},
                                       {"radii", WF_KEY_PAIR, offsetof(form, ends), true},
                                       {0}};
static const wf_lua_key torus_keys[] = {
    {"center", WF_KEY_VECTOR, offsetof(form, center), false},
    {"axis", WF_KEY_DIRECTION, offsetof(form, axis), false},
    {"major", WF_KEY_POSITIVE, offsetof(form, major), true},
    {"minor", WF_KEY_POSITIVE, offsetof(form, minor), true},
    {0}};
static const wf_lua_key halfspace_keys[] = {
    {"normal", WF_KEY_DIRECTION, offsetof(form, normal), true},
    {"offset", WF_KEY_NUMBER, offsetof(form, offset), false},
    {0}};

static const struct {
    const char *name;
    wf_solid_kind kind;
    const wf_lua_key *keys;
    void (*make)(lua_State *lua, const form *form, wf_solid *solid);
} forms[] = {
    {"sphere", WF_SPHERE, sphere_keys, make_sphere},
    {"ellipsoid", WF_SPHERE, ellipsoid_keys, make_ellipsoid},
    {"box", WF_BOX, box_keys, make_box},
    {"cylinder", WF_CYLINDER, cylinder_keys, make_cylinder},
    {"cone", WF_CONE, cone_keys, make_cone},
    {"torus", WF_TORUS, torus_keys, make_torus},
    {"halfspace", WF_HALFSPACE, halfspace_keys, make_halfspace},
};

#define FORMS (sizeof forms / sizeof *forms)

static int new_solid(lua_State *lua, const char *what, const wf_solid *solid) {
    wf_builder *b = wf_builder_of(lua);
    wf_affine inverse;
    if (!wf_invert(&solid->place, &inverse))
        wf_scene_error(lua, what, "it is too small or too flat to be computed with");
    *(wf_solid *)wf_list_grow(lua, &b->solids, sizeof *solid, 1) = *solid;
    wf_push_node(
        lua,
        wf_node_new(lua, (wf_node){.kind = WF_NODE_SOLID, .index = (int)b->solids.count - 1},
                    NULL));
    return 1;
}

/* The length of a vector as it was written. */
static double written_length(lua_State *lua, const char *name) {
    lua_getfield(lua, 1, name);
    wf_vec v = lua_istable(lua, -1) ? wf_read_vector(lua, name, name) : (wf_vec){0, 1, 0};
    lua_pop(lua, 1);
    return wf_vec_length(v);
}

static int call_form(lua_State *lua) {
    size_t row = (size_t)lua_tointeger(lua, lua_upvalueindex(1));
    form f = {.radius = 1, .axis = {0, 1, 0}};
    wf_solid solid = {.kind = forms[row].kind};
    wf_read_keys(lua, 1, forms[row].name, forms[row].keys, 0, &f);
    if (forms[row].kind == WF_HALFSPACE) f.radius = written_length(lua, "normal");
    forms[row].make(lua, &f, &solid);
    return new_solid(lua, forms[row].name, &solid);
}

/* ---- Quadrics and polyhedra ---- */

static int call_quadric(lua_State *lua) {
    wf_solid solid = {.kind = WF_QUADRIC, .place = wf_identity()};
    double size = 0;
    if (lua_type(lua, 1) != LUA_TTABLE || lua_rawlen(lua, 1) != 10)
        wf_scene_error(lua, "quadric",
                       "it takes ten numbers, the coefficients of x^2, y^2, z^2, xy, yz, zx, "
                       "x, y, z and 1 of what is <= 0 inside");
    lua_settop(lua, 1);
    for (int k = 0; k < 10; k++) {
        solid.shape[k] = wf_read_entry(lua, "quadric", k + 1);
        if (k < 9) size = fmax(size, fabs(solid.shape[k]));
    }
    if (!(size > 0)) wf_scene_error(lua, "quadric", "all of its coefficients are 0");
    return new_solid(lua, "quadric", &solid);
}

static wf_plane read_plane(lua_State *lua) {
    wf_plane p;
    double size = 0;
    if (lua_type(lua, -1) != LUA_TTABLE || lua_rawlen(lua, -1) != 4)
        wf_scene_error(lua, "polyhedron", "each plane is four numbers, {nx, ny, nz, d}");
    for (int k = 0; k < 3; k++) {
        p.n[k] = wf_read_entry(lua, "polyhedron", k + 1);
        size = fmax(size, fabs(p.n[k]));
    }
    if (!(size > 0)) wf_scene_error(lua, "polyhedron", "the normal of a plane is {0, 0, 0}");
    p.d = wf_read_entry(lua, "polyhedron", 4) / size;
    for (int k = 0; k < 3; k++) p.n[k] /= size;
    size = sqrt(p.n[0] * p.n[0] + p.n[1] * p.n[1] + p.n[2] * p.n[2]);
    for (int k = 0; k < 3; k++) p.n[k] /= size;
    p.d /= size;
    return p;
}

static int call_polyhedron(lua_State *lua) {
    wf_builder *b = wf_builder_of(lua);
    static const wf_lua_key keys[] = {{"planes", WF_KEY_OTHER, 0, true}, {0}};
    wf_read_keys(lua, 1, "polyhedron", keys, 0, &(char){0});
    lua_getfield(lua, 1, "planes");
    if (lua_type(lua, -1) != LUA_TTABLE || !lua_rawlen(lua, -1))
        wf_scene_error(lua, "polyhedron", "planes must be a list of planes {nx, ny, nz, d}");
    size_t count = (size_t)lua_rawlen(lua, -1);
    wf_sandbox_charge(lua, 16 * (double)count + wf_polyhedron_cost((int)count));
    wf_solid solid = {.kind = WF_POLYHEDRON,
                      .place = wf_identity(),
                      .first_plane = (int)b->planes.count,
                      .plane_count = (int)count};
    for (size_t k = 0; k < count; k++) {
        lua_rawgeti(lua, -1, (lua_Integer)k + 1);
        wf_plane plane = read_plane(lua);
        *(wf_plane *)wf_list_grow(lua, &b->planes, sizeof plane, 1) = plane;
        lua_pop(lua, 1);
    }
    wf_polyhedron_bound(&solid, b->planes.items);
    return new_solid(lua, "polyhedron", &solid);
}

/* ---- The names ---- */

const luaL_Reg wf_lua_list_solids[] = {
    {"quadric", call_quadric}, {"polyhedron", call_polyhedron}, {NULL, NULL}};

void wf_lua_open_forms(lua_State *lua) {
    for (size_t row = 0; row < FORMS; row++) {
        lua_pushinteger(lua, (lua_Integer)row);
        lua_pushcclosure(lua, call_form, 1);
        lua_setglobal(lua, forms[row].name);
    }
}
