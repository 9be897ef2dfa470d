/* Placement and motion as methods of a script's solids, cameras and lights. */
#include "tracer/scene/language.h"
#include "tracer/scene/lua_node.h"
#include "tracer/scene/lua_table.h"
#include "tracer/scene/motion.h"
#include "tracer/scene/vec.h"

static int wrap_op(lua_State *lua, const wf_op *op, const char *what) {
    wf_builder *b = wf_builder_of(lua);
    wf_affine inverse;
    if (op->kind == WF_OP_PLACE && !wf_invert(&op->place, &inverse))
        wf_scene_error(lua, what, "it would make solids flat");
    *(wf_op *)wf_list_grow(lua, &b->ops, sizeof *op, 1) = *op;
    return wf_wrap_node(lua, WF_NODE_OP, (int)b->ops.count - 1, what);
}

static wf_vec only_vector(lua_State *lua, const char *what) {
    wf_check_node(lua, 1, what);
    wf_only_value(lua, what, 2);
    return wf_read_vector(lua, what, "its value");
}

static int call_translate(lua_State *lua) {
    wf_op op = {.kind = WF_OP_PLACE, .place = wf_identity()};
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
    wf_only_value(lua, "scale", 2);
    if (lua_istable(lua, 2) && lua_rawlen(lua, 2) == 1) lua_rawgeti(lua, 2, 1);
    if (lua_type(lua, -1) == LUA_TNUMBER) {
        double even = wf_read_number(lua, "scale", "its value");
        s = (wf_vec){even, even, even};
    } else {
        s = wf_read_vector(lua, "scale", "its value");
    }
    if (s.x == 0 || s.y == 0 || s.z == 0) wf_scene_error(lua, "scale", "it may not be 0");
    wf_op op = {.kind = WF_OP_PLACE, .place = wf_scaling(s, (wf_vec){0, 0, 0})};
    return wrap_op(lua, &op, "scale");
}

typedef struct turning {
    wf_vec axis, center;
    double degrees, rpm;
} turning;

/* The sine of an angle in degrees, exact at quarter turns. */
static double sine_degrees(double degrees) {
    double turn = degrees - 360 * floor(degrees / 360);
    double quarter = floor(turn / 90 + 0.5),
           rest = (turn - 90 * quarter) * 0x1.1df46a2529d39p-6;
    static const double sign[] = {0, 1, 0, -1, 0};
    int q = (int)quarter;
    return sign[q % 4] * cos(rest) + sign[(q + 1) % 4] * sin(rest);
}

static double cosine_degrees(double degrees) {
    return sine_degrees(degrees + 90);
}

static int call_rotate(lua_State *lua) {
    static const wf_lua_key keys[] = {
        {"axis", WF_KEY_DIRECTION, offsetof(turning, axis), false},
        {"degrees", WF_KEY_NUMBER, offsetof(turning, degrees), true},
        {"center", WF_KEY_VECTOR, offsetof(turning, center), false},
        {0}};
    turning t = {.axis = {0, 1, 0}};
    wf_check_node(lua, 1, "rotate");
    wf_read_keys(lua, 2, "rotate", keys, 0, &t);
    wf_op op = {.kind = WF_OP_PLACE,
                .place = wf_rotation(t.axis, t.center, cosine_degrees(t.degrees),
                                     sine_degrees(t.degrees))};
    return wrap_op(lua, &op, "rotate");
}

static int call_spin(lua_State *lua) {
    static const wf_lua_key keys[] = {
        {"axis", WF_KEY_DIRECTION, offsetof(turning, axis), false},
        {"rpm", WF_KEY_NUMBER, offsetof(turning, rpm), true},
        {"center", WF_KEY_VECTOR, offsetof(turning, center), false},
        {0}};
    turning t = {.axis = {0, 1, 0}};
    wf_check_node(lua, 1, "spin");
    wf_read_keys(lua, 2, "spin", keys, 0, &t);
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
    wf_only_value(lua, "matrix", 2);
    if (!lua_istable(lua, 2) || lua_rawlen(lua, 2) != 12)
        wf_scene_error(lua, "matrix",
                       "it takes twelve numbers, three rows of four, the fourth of "
                       "each row the translation");
    for (int k = 0; k < 12; k++) v[k] = wf_read_entry(lua, "matrix", k + 1);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) op.place.m[i][j] = v[4 * i + j];
    op.place.d = (wf_vec){v[3], v[7], v[11]};
    return wrap_op(lua, &op, "matrix");
}

/* ---- Keyframes ---- */

typedef struct key_table {
    double time, degrees;
    wf_vec translate, axis;
} key_table;

static wf_key read_key(lua_State *lua) {
    static const wf_lua_key keys[] = {
        {"time", WF_KEY_NUMBER, offsetof(key_table, time), true},
        {"translate", WF_KEY_VECTOR, offsetof(key_table, translate), false},
        {"axis", WF_KEY_DIRECTION, offsetof(key_table, axis), false},
        {"degrees", WF_KEY_NUMBER, offsetof(key_table, degrees), false},
        {0}};
    key_table k = {.axis = {0, 1, 0}};
    wf_read_keys(lua, -1, "keyframes", keys, 0, &k);
    double s = sine_degrees(k.degrees / 2), c = cosine_degrees(k.degrees / 2);
    return (wf_key){k.time, k.translate, {c, s * k.axis.x, s * k.axis.y, s * k.axis.z}};
}

static int call_keyframes(lua_State *lua) {
    wf_builder *b = wf_builder_of(lua);
    wf_check_node(lua, 1, "keyframes");
    wf_only_value(lua, "keyframes", 2);
    if (!lua_istable(lua, 2) || !lua_rawlen(lua, 2))
        wf_scene_error(lua, "keyframes",
                       "it takes a list of {time=, translate=, axis=, degrees=}");
    int count = (int)lua_rawlen(lua, 2);
    wf_sandbox_charge(lua, 16 * (double)count);
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

const luaL_Reg wf_lua_motions[] = {{"translate", call_translate}, {"rotate", call_rotate},
                                   {"scale", call_scale},         {"matrix", call_matrix},
                                   {"velocity", call_velocity},   {"spin", call_spin},
                                   {"keyframes", call_keyframes}, {NULL, NULL}};
