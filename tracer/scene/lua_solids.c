/* Solids, what combines and what moves them, as functions of a scene's script. */
#include <math.h>
#include <string.h>

#include "tracer/scene/builder.h"
#include "tracer/scene/lua_table.h"
#include "tracer/scene/motion.h"
#include "tracer/scene/polyhedron.h"

#define NODE "weft solid"

void wf_push_node(lua_State *lua, int node) {
    *(int *)lua_newuserdatauv(lua, sizeof(int), 0) = node;
    luaL_setmetatable(lua, NODE);
}

int wf_check_node(lua_State *lua, int arg, const char *what) {
    const int *node = luaL_testudata(lua, arg, NODE);
    if (!node)
        wf_scene_error(lua, what, "value %d must be a solid, not %s", arg,
                       luaL_typename(lua, arg));
    return node ? *node : -1;
}

/* ---- Forms ---- */

/* What the fields of any solid are read into. */
typedef struct form {
    wf_vec center, radii, min, max, from, to, axis, normal;
    double radius, major, minor, offset, ends[2];
} form;

static wf_vec minus(wf_vec a, wf_vec b) {
    return (wf_vec){a.x - b.x, a.y - b.y, a.z - b.z};
}

static wf_affine scaled(wf_vec size, wf_vec center) {
    return (wf_affine){.m = {{size.x, 0, 0}, {0, size.y, 0}, {0, 0, size.z}}, .d = center};
}

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
    wf_vec way = minus(f->to, f->from);
    wf_vec middle = {f->from.x / 2 + f->to.x / 2, f->from.y / 2 + f->to.y / 2,
                     f->from.z / 2 + f->to.z / 2};
    double far = fmax(fabs(way.x), fmax(fabs(way.y), fabs(way.z)));
    if (!(far > 0)) wf_scene_error(lua, what, "from and to must be two points, not one");
    wf_vec v = {way.x / far, way.y / far, way.z / far};
    double size = sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    v = (wf_vec){v.x / size, v.y / size, v.z / size};
    return along_axis(v, across, far * size / 2, middle);
}

static void make_sphere(lua_State *lua, const form *f, wf_solid *s) {
    (void)lua;
    s->place = scaled((wf_vec){f->radius, f->radius, f->radius}, f->center);
}

static void make_ellipsoid(lua_State *lua, const form *f, wf_solid *s) {
    (void)lua;
    s->kind = WF_SPHERE;
    s->place = scaled(f->radii, f->center);
}

static void make_box(lua_State *lua, const form *f, wf_solid *s) {
    wf_vec size = minus(f->max, f->min);
    if (!(size.x > 0 && size.y > 0 && size.z > 0))
        wf_scene_error(lua, "box", "max must be beyond min in x, y and z");
    s->place = scaled((wf_vec){size.x / 2, size.y / 2, size.z / 2},
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

static const wf_field_row sphere_fields[] = {
    {"center", WF_FIELD_VECTOR, offsetof(form, center), false},
    {"radius", WF_FIELD_POSITIVE, offsetof(form, radius), false},
    {0}};
static const wf_field_row ellipsoid_fields[] = {
    {"center", WF_FIELD_VECTOR, offsetof(form, center), false},
    {"radii", WF_FIELD_POSITIVES, offsetof(form, radii), true},
    {0}};
static const wf_field_row box_fields[] = {{"min", WF_FIELD_VECTOR, offsetof(form, min), true},
                                          {"max", WF_FIELD_VECTOR, offsetof(form, max), true},
                                          {0}};
static const wf_field_row cylinder_fields[] = {
    {"from", WF_FIELD_VECTOR, offsetof(form, from), true},
    {"to", WF_FIELD_VECTOR, offsetof(form, to), true},
    {"radius", WF_FIELD_POSITIVE, offsetof(form, radius), true},
    {0}};
static const wf_field_row cone_fields[] = {
    {"from", WF_FIELD_VECTOR, offsetof(form, from), true},
    {"to", WF_FIELD_VECTOR, offsetof(form, to), true},
    {"radii", WF_FIELD_PAIR, offsetof(form, ends), true},
    {0}};
static const wf_field_row torus_fields[] = {
    {"center", WF_FIELD_VECTOR, offsetof(form, center), false},
    {"axis", WF_FIELD_DIRECTION, offsetof(form, axis), false},
    {"major", WF_FIELD_POSITIVE, offsetof(form, major), true},
    {"minor", WF_FIELD_POSITIVE, offsetof(form, minor), true},
    {0}};
static const wf_field_row halfspace_fields[] = {
    {"normal", WF_FIELD_DIRECTION, offsetof(form, normal), true},
    {"offset", WF_FIELD_NUMBER, offsetof(form, offset), false},
    {0}};

static const struct {
    const char *name;
    wf_solid_kind kind;
    const wf_field_row *fields;
    void (*make)(lua_State *lua, const form *form, wf_solid *solid);
} forms[] = {
    {"sphere", WF_SPHERE, sphere_fields, make_sphere},
    {"ellipsoid", WF_SPHERE, ellipsoid_fields, make_ellipsoid},
    {"box", WF_BOX, box_fields, make_box},
    {"cylinder", WF_CYLINDER, cylinder_fields, make_cylinder},
    {"cone", WF_CONE, cone_fields, make_cone},
    {"torus", WF_TORUS, torus_fields, make_torus},
    {"halfspace", WF_HALFSPACE, halfspace_fields, make_halfspace},
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

/* Length of the vector field as it was written. */
static double written_length(lua_State *lua, const char *name) {
    lua_getfield(lua, 1, name);
    wf_vec v = lua_istable(lua, -1) ? wf_read_vector(lua, name, name) : (wf_vec){0, 1, 0};
    lua_pop(lua, 1);
    return sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

static int call_form(lua_State *lua) {
    size_t row = (size_t)lua_tointeger(lua, lua_upvalueindex(1));
    form f = {.radius = 1, .axis = {0, 1, 0}};
    wf_solid solid = {.kind = forms[row].kind};
    wf_read_fields(lua, 1, forms[row].name, forms[row].fields, 0, &f);
    if (forms[row].kind == WF_HALFSPACE) f.radius = written_length(lua, "normal");
    forms[row].make(lua, &f, &solid);
    return new_solid(lua, forms[row].name, &solid);
}

/* ---- Quadrics and polyhedra ---- */

static const wf_affine as_written = {.m = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

static double entry(lua_State *lua, const char *what, int at) {
    char name[24];
    lua_rawgeti(lua, -1, at);
    lua_pushfstring(lua, "value %d", at);
    memset(name, 0, sizeof name);
    strncpy(name, lua_tostring(lua, -1), sizeof name - 1);
    lua_pop(lua, 1);
    double v = wf_read_number(lua, what, name);
    lua_pop(lua, 1);
    return v;
}

static int call_quadric(lua_State *lua) {
    wf_solid solid = {.kind = WF_QUADRIC, .place = as_written};
    double size = 0;
    if (lua_type(lua, 1) != LUA_TTABLE || lua_rawlen(lua, 1) != 10)
        wf_scene_error(lua, "quadric",
                       "it takes ten numbers, the coefficients of x^2, y^2, z^2, xy, yz, zx, "
                       "x, y, z and 1 of what is <= 0 inside");
    lua_settop(lua, 1);
    for (int k = 0; k < 10; k++) {
        solid.shape[k] = entry(lua, "quadric", k + 1);
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
        p.n[k] = entry(lua, "polyhedron", k + 1);
        size = fmax(size, fabs(p.n[k]));
    }
    if (!(size > 0)) wf_scene_error(lua, "polyhedron", "the normal of a plane is {0, 0, 0}");
    p.d = entry(lua, "polyhedron", 4) / size;
    for (int k = 0; k < 3; k++) p.n[k] /= size;
    size = sqrt(p.n[0] * p.n[0] + p.n[1] * p.n[1] + p.n[2] * p.n[2]);
    for (int k = 0; k < 3; k++) p.n[k] /= size;
    p.d /= size;
    return p;
}

static int call_polyhedron(lua_State *lua) {
    wf_builder *b = wf_builder_of(lua);
    static const wf_field_row fields[] = {{"planes", WF_FIELD_OTHER, 0, true}, {0}};
    wf_read_fields(lua, 1, "polyhedron", fields, 0, &(char){0});
    lua_getfield(lua, 1, "planes");
    if (lua_type(lua, -1) != LUA_TTABLE || !lua_rawlen(lua, -1))
        wf_scene_error(lua, "polyhedron", "planes must be a list of planes {nx, ny, nz, d}");
    size_t count = (size_t)lua_rawlen(lua, -1);
    wf_solid solid = {.kind = WF_POLYHEDRON,
                      .place = as_written,
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

/* ---- CSG ---- */

static int child_of(lua_State *lua, int arg, int number, const char *what) {
    const int *node = luaL_testudata(lua, arg, NODE);
    if (!node)
        wf_scene_error(lua, what, "value %d must be a solid, not %s", number,
                       luaL_typename(lua, arg));
    wf_node_kind kind = (wf_node_kind)wf_node_at(wf_builder_of(lua), *node)->kind;
    if (kind == WF_NODE_CAMERA || kind == WF_NODE_LIGHT)
        wf_scene_error(lua, what, "value %d must be a solid", number);
    return *node;
}

/* Of solids one by one, or of one list of them: lists may be longer than argument lists. */
static int combine(lua_State *lua, wf_step_kind step, const char *what) {
    wf_builder *b = wf_builder_of(lua);
    bool list = lua_gettop(lua) == 1 && lua_istable(lua, 1);
    int count = list ? (int)lua_rawlen(lua, 1) : lua_gettop(lua);
    if (!count) wf_scene_error(lua, what, "it takes solids, and there are none");
    wf_sandbox_charge(lua, count);
    wf_node node = {.kind = WF_NODE_CSG,
                    .step = (uint8_t)step,
                    .first_child = (int)b->children.count,
                    .child_count = count};
    for (int k = 1; k <= count; k++) {
        if (list) lua_rawgeti(lua, 1, k);
        int child = child_of(lua, list ? 2 : k, k, what);
        if (list) lua_pop(lua, 1);
        *(int *)wf_list_grow(lua, &b->children, sizeof(int), 1) = child;
    }
    *(wf_node *)wf_list_grow(lua, &b->nodes, sizeof node, 1) = node;
    wf_push_node(lua, (int)b->nodes.count - 1);
    return 1;
}

static int call_union(lua_State *lua) {
    return combine(lua, WF_STEP_UNION, "union");
}

static int call_intersection(lua_State *lua) {
    return combine(lua, WF_STEP_INTERSECTION, "intersection");
}

static int call_difference(lua_State *lua) {
    return combine(lua, WF_STEP_DIFFERENCE, "difference");
}

/* ---- What stands around a solid ---- */

/* A camera or a light that is moved is still the scene's camera, and that light. */
static int wrap(lua_State *lua, wf_node_kind kind, int index, const char *what) {
    wf_builder *b = wf_builder_of(lua);
    int child = wf_check_node(lua, 1, what), root = child;
    int node = wf_node_new(
        lua, (wf_node){.kind = (uint8_t)kind, .index = index, .child_count = 1}, &child);
    while (wf_node_at(b, root)->kind == WF_NODE_OP)
        root = ((const int *)b->children.items)[wf_node_at(b, root)->first_child];
    const wf_node *at = wf_node_at(b, root);
    bool fixed = at->kind == WF_NODE_CAMERA || at->kind == WF_NODE_LIGHT;
    if (fixed && kind != WF_NODE_OP) wf_scene_error(lua, what, "it is for solids");
    if (at->kind == WF_NODE_CAMERA) b->camera_node = node;
    if (at->kind == WF_NODE_LIGHT) ((int *)b->light_nodes.items)[at->index] = node;
    wf_push_node(lua, node);
    return 1;
}

static int wrap_op(lua_State *lua, const wf_op *op, const char *what) {
    wf_builder *b = wf_builder_of(lua);
    wf_affine inverse;
    if (op->kind == WF_OP_PLACE && !wf_invert(&op->place, &inverse))
        wf_scene_error(lua, what, "it would make solids flat");
    *(wf_op *)wf_list_grow(lua, &b->ops, sizeof *op, 1) = *op;
    return wrap(lua, WF_NODE_OP, (int)b->ops.count - 1, what);
}

static wf_vec only_vector(lua_State *lua, const char *what) {
    wf_check_node(lua, 1, what);
    lua_settop(lua, 2);
    return wf_read_vector(lua, what, "its value");
}

static int call_translate(lua_State *lua) {
    wf_op op = {.kind = WF_OP_PLACE, .place = as_written};
    op.place.d = only_vector(lua, "translate");
    return wrap_op(lua, &op, "translate");
}

static int call_velocity(lua_State *lua) {
    wf_op op = {.kind = WF_OP_VELOCITY, .velocity = only_vector(lua, "velocity")};
    return wrap_op(lua, &op, "velocity");
}

/* One number scales evenly. */
static int call_scale(lua_State *lua) {
    wf_vec s;
    wf_check_node(lua, 1, "scale");
    lua_settop(lua, 2);
    if (lua_istable(lua, 2) && lua_rawlen(lua, 2) == 1) lua_rawgeti(lua, 2, 1);
    if (lua_type(lua, -1) == LUA_TNUMBER) {
        double even = wf_read_number(lua, "scale", "its value");
        s = (wf_vec){even, even, even};
    } else {
        s = wf_read_vector(lua, "scale", "its value");
    }
    if (s.x == 0 || s.y == 0 || s.z == 0) wf_scene_error(lua, "scale", "it may not be 0");
    wf_op op = {.kind = WF_OP_PLACE, .place = scaled(s, (wf_vec){0, 0, 0})};
    return wrap_op(lua, &op, "scale");
}

typedef struct turning {
    wf_vec axis, center;
    double degrees, rpm;
} turning;

/* Degrees are exact at quarter turns. */
static double sine_degrees(double degrees) {
    double turn = degrees - 360 * floor(degrees / 360);
    double quarter = floor(turn / 90 + 0.5),
           rest = (turn - 90 * quarter) * 0x1.1df46a2529d39p-6;
    static const double sign[] = {0, 1, 0, -1, 0};
    int q = (int)quarter;
    return sign[q % 4] * cos(rest) + sign[(q + 1) % 4] * sin(rest);
}

static wf_affine turned(wf_vec k, wf_vec center, double degrees) {
    double c = sine_degrees(degrees + 90), s = sine_degrees(degrees), v = 1 - c;
    wf_affine a = {
        .m = {{c + k.x * k.x * v, k.x * k.y * v - k.z * s, k.x * k.z * v + k.y * s},
              {k.y * k.x * v + k.z * s, c + k.y * k.y * v, k.y * k.z * v - k.x * s},
              {k.z * k.x * v - k.y * s, k.z * k.y * v + k.x * s, c + k.z * k.z * v}}};
    wf_vec moved = wf_turn(&a, center);
    a.d = minus(center, moved);
    return a;
}

static int call_rotate(lua_State *lua) {
    static const wf_field_row fields[] = {
        {"axis", WF_FIELD_DIRECTION, offsetof(turning, axis), false},
        {"degrees", WF_FIELD_NUMBER, offsetof(turning, degrees), true},
        {"center", WF_FIELD_VECTOR, offsetof(turning, center), false},
        {0}};
    turning t = {.axis = {0, 1, 0}};
    wf_check_node(lua, 1, "rotate");
    wf_read_fields(lua, 2, "rotate", fields, 0, &t);
    wf_op op = {.kind = WF_OP_PLACE, .place = turned(t.axis, t.center, t.degrees)};
    return wrap_op(lua, &op, "rotate");
}

static int call_spin(lua_State *lua) {
    static const wf_field_row fields[] = {
        {"axis", WF_FIELD_DIRECTION, offsetof(turning, axis), false},
        {"rpm", WF_FIELD_NUMBER, offsetof(turning, rpm), true},
        {"center", WF_FIELD_VECTOR, offsetof(turning, center), false},
        {0}};
    turning t = {.axis = {0, 1, 0}};
    wf_check_node(lua, 1, "spin");
    wf_read_fields(lua, 2, "spin", fields, 0, &t);
    wf_op op = {.kind = WF_OP_SPIN,
                .axis = t.axis,
                .center = t.center,
                .turns_a_second_num = t.rpm,
                .turns_a_second_den = 60};
    return wrap_op(lua, &op, "spin");
}

/* Twelve numbers: three rows of a 3x4 matrix. */
static int call_matrix(lua_State *lua) {
    wf_op op = {.kind = WF_OP_PLACE};
    double v[12];
    wf_check_node(lua, 1, "matrix");
    lua_settop(lua, 2);
    if (!lua_istable(lua, 2) || lua_rawlen(lua, 2) != 12)
        wf_scene_error(lua, "matrix",
                       "it takes twelve numbers, three rows of four, the fourth of "
                       "each row the translation");
    for (int k = 0; k < 12; k++) v[k] = entry(lua, "matrix", k + 1);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) op.place.m[i][j] = v[4 * i + j];
    op.place.d = (wf_vec){v[3], v[7], v[11]};
    return wrap_op(lua, &op, "matrix");
}

/* ---- Keyframes ---- */

typedef struct key_fields {
    double time, degrees;
    wf_vec translate, axis;
} key_fields;

static wf_key read_key(lua_State *lua) {
    static const wf_field_row fields[] = {
        {"time", WF_FIELD_NUMBER, offsetof(key_fields, time), true},
        {"translate", WF_FIELD_VECTOR, offsetof(key_fields, translate), false},
        {"axis", WF_FIELD_DIRECTION, offsetof(key_fields, axis), false},
        {"degrees", WF_FIELD_NUMBER, offsetof(key_fields, degrees), false},
        {0}};
    key_fields k = {.axis = {0, 1, 0}};
    wf_read_fields(lua, -1, "keyframes", fields, 0, &k);
    double s = sine_degrees(k.degrees / 2), c = sine_degrees(k.degrees / 2 + 90);
    return (wf_key){k.time, k.translate, {c, s * k.axis.x, s * k.axis.y, s * k.axis.z}};
}

static int call_keyframes(lua_State *lua) {
    wf_builder *b = wf_builder_of(lua);
    wf_check_node(lua, 1, "keyframes");
    lua_settop(lua, 2);
    if (!lua_istable(lua, 2) || !lua_rawlen(lua, 2))
        wf_scene_error(lua, "keyframes",
                       "it takes a list of {time=, translate=, axis=, degrees=}");
    int count = (int)lua_rawlen(lua, 2);
    wf_op op = {.kind = WF_OP_KEYS, .first_key = (int)b->keys.count, .key_count = count};
    for (int k = 0; k < count; k++) {
        lua_rawgeti(lua, 2, k + 1);
        wf_key key = read_key(lua);
        if (k && !(((const wf_key *)b->keys.items)[b->keys.count - 1].time_s < key.time_s))
            wf_scene_error(lua, "keyframes", "key %d must be later than the one before it",
                           k + 1);
        *(wf_key *)wf_list_grow(lua, &b->keys, sizeof key, 1) = key;
        lua_pop(lua, 1);
    }
    return wrap_op(lua, &op, "keyframes");
}

/* ---- Looks ---- */

static int call_temporal_width(lua_State *lua) {
    wf_builder *b = wf_builder_of(lua);
    wf_check_node(lua, 1, "temporal_width");
    lua_settop(lua, 2);
    double width = wf_read_number(lua, "temporal_width", "its value");
    if (width < 0 || width > 64)
        wf_scene_error(lua, "temporal_width", "it is from 0 to 64 field periods, not %g",
                       width);
    *(double *)wf_list_grow(lua, &b->widths, sizeof width, 1) = width;
    return wrap(lua, WF_NODE_WIDTH, (int)b->widths.count - 1, "temporal_width");
}

typedef struct look {
    float color[3];
    double ambient, diffuse, specular, shininess, reflect, refract, index;
    bool unlit;
} look;

static int call_material(lua_State *lua) {
    static const wf_field_row fields[] = {
        {"color", WF_FIELD_COLOR, offsetof(look, color), false},
        {"texture", WF_FIELD_OTHER, 0, false},
        {"ambient", WF_FIELD_NOT_NEGATIVE, offsetof(look, ambient), false},
        {"diffuse", WF_FIELD_NOT_NEGATIVE, offsetof(look, diffuse), false},
        {"specular", WF_FIELD_NOT_NEGATIVE, offsetof(look, specular), false},
        {"shininess", WF_FIELD_NOT_NEGATIVE, offsetof(look, shininess), false},
        {"reflect", WF_FIELD_SHARE, offsetof(look, reflect), false},
        {"refract", WF_FIELD_SHARE, offsetof(look, refract), false},
        {"index", WF_FIELD_POSITIVE, offsetof(look, index), false},
        {"unlit", WF_FIELD_BOOL, offsetof(look, unlit), false},
        {0}};
    look k = {{0.8f, 0.8f, 0.8f}, 0.1, 0.9, 0, 40, 0, 0, 1.5, false};
    wf_builder *b = wf_builder_of(lua);
    wf_check_node(lua, 1, "material");
    wf_read_fields(lua, 2, "material", fields, 0, &k);
    wf_material m = {.color = {k.color[0], k.color[1], k.color[2]},
                     .ambient = (float)k.ambient,
                     .diffuse = (float)k.diffuse,
                     .specular = (float)k.specular,
                     .shininess = (float)k.shininess,
                     .reflect = (float)k.reflect,
                     .refract = (float)k.refract,
                     .index = (float)k.index,
                     .unlit = k.unlit};
    lua_getfield(lua, 2, "texture");
    if (!lua_isnil(lua, -1)) {
        const wf_texture *texture = luaL_testudata(lua, -1, WF_LUA_TEXTURE);
        if (!texture)
            wf_scene_error(
                lua, "material",
                "texture must be checker{..}, stripe{..}, zoneplate{..} or image{..}");
        m.texture = *texture;
    }
    *(wf_material *)wf_list_grow(lua, &b->materials, sizeof m, 1) = m;
    return wrap(lua, WF_NODE_MATERIAL, (int)b->materials.count - 1, "material");
}

/* ---- The names ---- */

static const luaL_Reg methods[] = {
    {"translate", call_translate}, {"rotate", call_rotate},
    {"scale", call_scale},         {"matrix", call_matrix},
    {"velocity", call_velocity},   {"spin", call_spin},
    {"keyframes", call_keyframes}, {"temporal_width", call_temporal_width},
    {"material", call_material},   {NULL, NULL}};

/* a + b, a * b, a - b. */
static const luaL_Reg operators[] = {{"__add", call_union},
                                     {"__mul", call_intersection},
                                     {"__sub", call_difference},
                                     {NULL, NULL}};

static int no_method(lua_State *lua) {
    const char *name = lua_tostring(lua, 2);
    return wf_scene_unknown(lua, "solid", name ? name : "", methods);
}

void wf_open_solids(lua_State *lua) {
    luaL_newmetatable(lua, NODE);
    luaL_setfuncs(lua, operators, 0);
    luaL_newlib(lua, methods);
    lua_newtable(lua);
    lua_pushcfunction(lua, no_method);
    lua_setfield(lua, -2, "__index");
    lua_setmetatable(lua, -2);
    lua_setfield(lua, -2, "__index");
    lua_pushboolean(lua, false);
    lua_setfield(lua, -2, "__metatable");
    lua_pop(lua, 1);
    for (size_t row = 0; row < FORMS; row++) {
        lua_pushinteger(lua, (lua_Integer)row);
        lua_pushcclosure(lua, call_form, 1);
        lua_setglobal(lua, forms[row].name);
    }
    lua_register(lua, "quadric", call_quadric);
    lua_register(lua, "polyhedron", call_polyhedron);
    lua_register(lua, "union", call_union);
    lua_register(lua, "intersection", call_intersection);
    lua_register(lua, "difference", call_difference);
}
