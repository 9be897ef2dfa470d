/* The camera and the lights as functions of a script. */
#include <math.h>

#include "tracer/scene/advice.h"
#include "tracer/scene/language.h"
#include "tracer/scene/lua_node.h"
#include "tracer/scene/lua_table.h"
#include "tracer/scene/vec.h"

#define PI 3.14159265358979323846

/* The unit vector from one point to another; `message` is the error if they are one point. */
static wf_vec toward(lua_State *lua, const char *what, wf_vec from, wf_vec to,
                     const char *message) {
    wf_vec way = wf_vec_minus(to, from);
    if (!(wf_vec_largest(way) > 0)) wf_scene_error(lua, what, "%s", message);
    return wf_vec_unit(way);
}

/* ---- Camera ---- */

typedef struct camera_table {
    wf_vec eye, look_at, up;
    double fov, ortho_height;
} camera_table;

static int call_camera(lua_State *lua) {
    static const wf_lua_key keys[] = {
        {"eye", WF_KEY_VECTOR, offsetof(camera_table, eye), true},
        {"look_at", WF_KEY_VECTOR, offsetof(camera_table, look_at), true},
        {"up", WF_KEY_DIRECTION, offsetof(camera_table, up), false},
        {"fov", WF_KEY_POSITIVE, offsetof(camera_table, fov), false},
        {"ortho_height", WF_KEY_POSITIVE, offsetof(camera_table, ortho_height), false},
        {0}};
    wf_builder *b = wf_builder_of(lua);
    camera_table f = {.up = {0, 1, 0}};
    wf_read_keys(lua, 1, "camera", keys, 0, &f);
    if (f.fov > 0 && f.ortho_height > 0)
        wf_scene_error(lua, "camera", "it has fov= or ortho_height=, not both");
    if (f.fov >= 180)
        wf_scene_error(lua, "camera", "fov is the vertical angle in degrees, below 180, not %g",
                       f.fov);
    if (!(f.fov > 0)) f.fov = 42;
    if (b->camera_node >= 0)
        wf_scene_warn(lua, "camera", "there is one already, which this takes the place of");
    wf_camera *c = &b->scene->camera;
    *c = (wf_camera){.eye = f.eye, .orthographic = f.ortho_height > 0, .op = -1};
    c->forward = toward(lua, "camera", f.eye, f.look_at, "eye and look_at are one point");
    c->right = wf_vec_cross(c->forward, f.up);
    if (wf_vec_largest(c->right) < 1e-9)
        wf_scene_error(lua, "camera", "it looks along up=; give another up");
    c->right = wf_vec_unit(c->right);
    c->up = wf_vec_cross(c->right, c->forward);
    c->half_height = c->orthographic ? f.ortho_height / 2 : tan(f.fov * PI / 360);
    b->camera_node = wf_node_new(lua, (wf_node){.kind = WF_NODE_CAMERA}, NULL);
    wf_push_node(lua, b->camera_node);
    return 1;
}

/* ---- Lights ---- */

typedef struct light_table {
    wf_vec point, direction, look_at;
    float color[3];
    double fall_off, inner, outer;
    bool shadows;
} light_table;

/* A point, a direction, or a point that looks somewhere within a cone. */
static void aim_light(lua_State *lua, const light_table *f, wf_light *light) {
    bool point = wf_has_key(lua, 1, "point"), direction = wf_has_key(lua, 1, "direction");
    bool spot = wf_has_key(lua, 1, "look_at");
    if (point == direction || (spot && !point))
        wf_scene_error(lua, "light",
                       "it has point= (and look_at= for a spot), or direction=, the way it "
                       "shines");
    light->kind = spot ? WF_LIGHT_SPOT : point ? WF_LIGHT_POINT : WF_LIGHT_DIRECTION;
    if (direction) light->direction = f->direction;
    if (!spot) return;
    light->direction =
        toward(lua, "light", f->point, f->look_at, "point and look_at are one point");
    if (!(f->inner <= f->outer && f->outer < 180))
        wf_scene_error(lua, "light", "a spot's cones need inner <= outer < 180 degrees");
    light->cos_inner = cos(f->inner * PI / 360);
    light->cos_outer = cos(f->outer * PI / 360);
}

static int call_light(lua_State *lua) {
    static const wf_lua_key keys[] = {
        {"point", WF_KEY_VECTOR, offsetof(light_table, point), false},
        {"direction", WF_KEY_DIRECTION, offsetof(light_table, direction), false},
        {"look_at", WF_KEY_VECTOR, offsetof(light_table, look_at), false},
        {"color", WF_KEY_COLOR, offsetof(light_table, color), false},
        {"fall_off", WF_KEY_NOT_NEGATIVE, offsetof(light_table, fall_off), false},
        {"inner", WF_KEY_POSITIVE, offsetof(light_table, inner), false},
        {"outer", WF_KEY_POSITIVE, offsetof(light_table, outer), false},
        {"shadows", WF_KEY_BOOL, offsetof(light_table, shadows), false},
        {0}};
    wf_builder *b = wf_builder_of(lua);
    light_table f = {.color = {1, 1, 1}, .inner = 30, .outer = 45, .shadows = true};
    wf_read_keys(lua, 1, "light", keys, 0, &f);
    wf_light light = {.point = f.point,
                      .direction = {0, -1, 0},
                      .fall_off = f.fall_off,
                      .color = {f.color[0], f.color[1], f.color[2]},
                      .op = -1,
                      .shadows = f.shadows};
    aim_light(lua, &f, &light);
    if (light.kind != WF_LIGHT_SPOT &&
        (wf_has_key(lua, 1, "inner") || wf_has_key(lua, 1, "outer")))
        wf_scene_warn(lua, "light",
                      "inner= and outer= are of spots, which have point= and look_at=");
    wf_advise_color(lua, "light", f.color, false);
    *(wf_light *)wf_list_grow(lua, &b->lights, sizeof light, 1) = light;
    int node = wf_node_new(
        lua, (wf_node){.kind = WF_NODE_LIGHT, .index = (int)b->lights.count - 1}, NULL);
    *(int *)wf_list_grow(lua, &b->light_nodes, sizeof node, 1) = node;
    wf_push_node(lua, node);
    return 1;
}

const luaL_Reg wf_lua_views[] = {{"camera", call_camera}, {"light", call_light}, {NULL, NULL}};
