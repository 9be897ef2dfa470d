/* What a scene's script says besides solids: camera, lights, textures, other files. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "tracer/scene/builder.h"
#include "tracer/scene/lua_table.h"
#include "tracer/scene/script.h"

#define PI 3.14159265358979323846

static wf_vec minus(wf_vec a, wf_vec b) {
    return (wf_vec){a.x - b.x, a.y - b.y, a.z - b.z};
}

static wf_vec cross(wf_vec a, wf_vec b) {
    return (wf_vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static wf_vec unit(lua_State *lua, const char *what, wf_vec v, const char *message) {
    double far = fmax(fabs(v.x), fmax(fabs(v.y), fabs(v.z)));
    if (!(far > 0)) wf_scene_error(lua, what, "%s", message);
    v = (wf_vec){v.x / far, v.y / far, v.z / far};
    double size = sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    return (wf_vec){v.x / size, v.y / size, v.z / size};
}

/* ---- Camera ---- */

typedef struct camera_fields {
    wf_vec eye, look_at, up;
    double fov, ortho_height;
} camera_fields;

static int call_camera(lua_State *lua) {
    static const wf_field_row fields[] = {
        {"eye", WF_FIELD_VECTOR, offsetof(camera_fields, eye), true},
        {"look_at", WF_FIELD_VECTOR, offsetof(camera_fields, look_at), true},
        {"up", WF_FIELD_DIRECTION, offsetof(camera_fields, up), false},
        {"fov", WF_FIELD_POSITIVE, offsetof(camera_fields, fov), false},
        {"ortho_height", WF_FIELD_POSITIVE, offsetof(camera_fields, ortho_height), false},
        {0}};
    wf_builder *b = wf_builder_of(lua);
    camera_fields f = {.up = {0, 1, 0}};
    wf_read_fields(lua, 1, "camera", fields, 0, &f);
    if (f.fov > 0 && f.ortho_height > 0)
        wf_scene_error(lua, "camera", "it has fov= or ortho_height=, not both");
    if (f.fov >= 180)
        wf_scene_error(lua, "camera", "fov is the vertical angle in degrees, below 180, not %g",
                       f.fov);
    if (!(f.fov > 0)) f.fov = 42;
    wf_camera *c = &b->scene->camera;
    *c = (wf_camera){.eye = f.eye, .orthographic = f.ortho_height > 0, .op = -1};
    c->forward = unit(lua, "camera", minus(f.look_at, f.eye), "eye and look_at are one point");
    c->right = cross(c->forward, f.up);
    if (fmax(fabs(c->right.x), fmax(fabs(c->right.y), fabs(c->right.z))) < 1e-9)
        wf_scene_error(lua, "camera", "it looks along up=; give another up");
    c->right = unit(lua, "camera", c->right, "");
    c->up = cross(c->right, c->forward);
    c->half_height = c->orthographic ? f.ortho_height / 2 : tan(f.fov * PI / 360);
    b->camera_node = wf_node_new(lua, (wf_node){.kind = WF_NODE_CAMERA}, NULL);
    wf_push_node(lua, b->camera_node);
    return 1;
}

/* ---- Lights ---- */

typedef struct light_fields {
    wf_vec point, direction, look_at;
    float color[3];
    double fall_off, inner, outer;
    bool shadows;
} light_fields;

static bool has(lua_State *lua, const char *name) {
    lua_getfield(lua, 1, name);
    bool there = !lua_isnil(lua, -1);
    lua_pop(lua, 1);
    return there;
}

/* A point, a direction, or a point that looks somewhere within a cone. */
static void aim_light(lua_State *lua, const light_fields *f, wf_light *light) {
    bool point = has(lua, "point"), direction = has(lua, "direction");
    bool spot = has(lua, "look_at");
    if (point == direction || (spot && !point))
        wf_scene_error(lua, "light",
                       "it has point= (and look_at= for a spot), or direction=, the way it "
                       "shines");
    light->kind = spot ? WF_LIGHT_SPOT : point ? WF_LIGHT_POINT : WF_LIGHT_DIRECTION;
    if (direction) light->direction = f->direction;
    if (!spot) return;
    light->direction =
        unit(lua, "light", minus(f->look_at, f->point), "point and look_at are one point");
    if (!(f->inner <= f->outer && f->outer < 180))
        wf_scene_error(lua, "light", "a spot's cones need inner <= outer < 180 degrees");
    light->cos_inner = cos(f->inner * PI / 360);
    light->cos_outer = cos(f->outer * PI / 360);
}

static int call_light(lua_State *lua) {
    static const wf_field_row fields[] = {
        {"point", WF_FIELD_VECTOR, offsetof(light_fields, point), false},
        {"direction", WF_FIELD_DIRECTION, offsetof(light_fields, direction), false},
        {"look_at", WF_FIELD_VECTOR, offsetof(light_fields, look_at), false},
        {"color", WF_FIELD_COLOR, offsetof(light_fields, color), false},
        {"fall_off", WF_FIELD_NOT_NEGATIVE, offsetof(light_fields, fall_off), false},
        {"inner", WF_FIELD_POSITIVE, offsetof(light_fields, inner), false},
        {"outer", WF_FIELD_POSITIVE, offsetof(light_fields, outer), false},
        {"shadows", WF_FIELD_BOOL, offsetof(light_fields, shadows), false},
        {0}};
    wf_builder *b = wf_builder_of(lua);
    light_fields f = {.color = {1, 1, 1}, .inner = 30, .outer = 45, .shadows = true};
    wf_read_fields(lua, 1, "light", fields, 0, &f);
    wf_light light = {.point = f.point,
                      .direction = {0, -1, 0},
                      .fall_off = f.fall_off,
                      .color = {f.color[0], f.color[1], f.color[2]},
                      .op = -1,
                      .shadows = f.shadows};
    aim_light(lua, &f, &light);
    *(wf_light *)wf_list_grow(lua, &b->lights, sizeof light, 1) = light;
    int node = wf_node_new(
        lua, (wf_node){.kind = WF_NODE_LIGHT, .index = (int)b->lights.count - 1}, NULL);
    *(int *)wf_list_grow(lua, &b->light_nodes, sizeof node, 1) = node;
    wf_push_node(lua, node);
    return 1;
}

/* ---- Textures ---- */

static int push_texture(lua_State *lua, const wf_texture *texture) {
    *(wf_texture *)lua_newuserdatauv(lua, sizeof *texture, 0) = *texture;
    luaL_setmetatable(lua, WF_LUA_TEXTURE);
    return 1;
}

/* The two colors that stand in the table without a name. */
static void read_colors(lua_State *lua, const char *what, wf_texture *t) {
    static const wf_field_row only[] = {{"color", WF_FIELD_COLOR, 0, true}, {0}};
    for (int k = 0; k < 2; k++) {
        lua_rawgeti(lua, 1, k + 1);
        if (lua_isnil(lua, -1)) {
            lua_pop(lua, 1);
            continue;
        }
        lua_newtable(lua);
        lua_insert(lua, -2);
        lua_setfield(lua, -2, "color");
        wf_read_fields(lua, -1, what, only, 0, t->color[k]);
        lua_pop(lua, 1);
    }
}

static int call_checker(lua_State *lua) {
    static const wf_field_row fields[] = {
        {"size", WF_FIELD_POSITIVE, offsetof(wf_texture, size), false}, {0}};
    wf_texture t = {WF_TEXTURE_CHECKER, .color = {{1, 1, 1}, {0, 0, 0}}, .size = 1};
    wf_read_fields(lua, 1, "checker", fields, 2, &t);
    read_colors(lua, "checker", &t);
    return push_texture(lua, &t);
}

static int call_stripe(lua_State *lua) {
    static const wf_field_row fields[] = {
        {"size", WF_FIELD_POSITIVE, offsetof(wf_texture, size), false},
        {"axis", WF_FIELD_DIRECTION, offsetof(wf_texture, axis), false},
        {0}};
    wf_texture t = {WF_TEXTURE_STRIPE, .color = {{1, 1, 1}, {0, 0, 0}}, .size = 1,
                    .axis = {1, 0, 0}};
    wf_read_fields(lua, 1, "stripe", fields, 2, &t);
    read_colors(lua, "stripe", &t);
    return push_texture(lua, &t);
}

static int call_zoneplate(lua_State *lua) {
    static const wf_field_row fields[] = {
        {"height", WF_FIELD_POSITIVE, offsetof(wf_texture, height), true},
        {"center", WF_FIELD_VECTOR, offsetof(wf_texture, center), false},
        {"across", WF_FIELD_DIRECTION, offsetof(wf_texture, across), false},
        {"down", WF_FIELD_DIRECTION, offsetof(wf_texture, down), false},
        {0}};
    wf_texture t = {WF_TEXTURE_ZONEPLATE, .color = {{1, 1, 1}, {0, 0, 0}}, .across = {1, 0, 0},
                    .down = {0, -1, 0}};
    wf_read_fields(lua, 1, "zoneplate", fields, 2, &t);
    read_colors(lua, "zoneplate", &t);
    return push_texture(lua, &t);
}

typedef struct image_fields {
    wf_texture texture;
    const char *file;
    bool srgb;
} image_fields;

static void load_image(lua_State *lua, const image_fields *f, wf_texture *t) {
    wf_builder *b = wf_builder_of(lua);
    const wf_load_options *o = b->options;
    char path[4096], why[512];
    wf_image image;
    if (!o->load_image)
        wf_scene_error(lua, "image", "there is nothing here that reads pictures");
    int used = snprintf(path, sizeof path, "%s%s", *f->file == '/' ? "" : b->folder, f->file);
    if (used < 0 || used >= (int)sizeof path)
        wf_scene_error(lua, "image", "its path is too long");
    /* Its place in the list first, so that an error after loading loses nothing. */
    wf_image *to = wf_list_grow(lua, &b->images, sizeof image, 1);
    if (!o->load_image(o->image_user, path, f->srgb, &image, why, sizeof why))
        wf_scene_error(lua, "image", "%s", why);
    *to = image;
    wf_sandbox_take(lua, 12 * (size_t)image.width_px * (size_t)image.height_px);
    t->image = (int)b->images.count - 1;
    if (!(t->width > 0) && !(t->height > 0)) t->width = 1;
    if (!(t->height > 0)) t->height = t->width * image.height_px / image.width_px;
    if (!(t->width > 0)) t->width = t->height * image.width_px / image.height_px;
}

/* Eight-bit pictures are sRGB unless they say otherwise. */
static bool likely_srgb(const char *file) {
    const char *dot = strrchr(file, '.');
    return !dot || (strcmp(dot, ".exr") && strcmp(dot, ".hdr"));
}

static int call_image(lua_State *lua) {
    static const wf_field_row fields[] = {
        {"file", WF_FIELD_TEXT, offsetof(image_fields, file), true},
        {"corner", WF_FIELD_VECTOR, offsetof(image_fields, texture.center), false},
        {"across", WF_FIELD_DIRECTION, offsetof(image_fields, texture.across), false},
        {"down", WF_FIELD_DIRECTION, offsetof(image_fields, texture.down), false},
        {"width", WF_FIELD_POSITIVE, offsetof(image_fields, texture.width), false},
        {"height", WF_FIELD_POSITIVE, offsetof(image_fields, texture.height), false},
        {"repeats", WF_FIELD_BOOL, offsetof(image_fields, texture.repeat), false},
        {"srgb", WF_FIELD_BOOL, offsetof(image_fields, srgb), false},
        {0}};
    image_fields f = {.texture = {WF_TEXTURE_IMAGE, .across = {1, 0, 0}, .down = {0, -1, 0}}};
    wf_read_fields(lua, 1, "image", fields, 2, &f);
    if (!has(lua, "srgb")) f.srgb = likely_srgb(f.file);
    read_colors(lua, "image", &f.texture);
    load_image(lua, &f, &f.texture);
    return push_texture(lua, &f.texture);
}

/* ---- The picture ---- */

static int call_add(lua_State *lua) {
    int count = lua_gettop(lua);
    if (!count) wf_scene_error(lua, "add", "it takes solids, and there are none");
    for (int k = 1; k <= count; k++) {
        int node = wf_check_node(lua, k, "add");
        wf_node_kind kind = (wf_node_kind)wf_node_at(wf_builder_of(lua), node)->kind;
        if (kind == WF_NODE_CAMERA || kind == WF_NODE_LIGHT)
            wf_scene_error(lua, "add", "cameras and lights need not be added");
        wf_unfold(lua, node);
    }
    return 0;
}

static int call_duration(lua_State *lua) {
    lua_settop(lua, 1);
    double seconds = wf_read_number(lua, "duration", "its value");
    if (!(seconds > 0) || seconds > 1e9)
        wf_scene_error(lua, "duration", "it is in seconds, > 0, not %g", seconds);
    wf_builder_of(lua)->scene->duration_s = seconds;
    return 0;
}

static int call_background(lua_State *lua) {
    static const wf_field_row only[] = {{"color", WF_FIELD_COLOR, 0, true}, {0}};
    lua_settop(lua, 1);
    lua_newtable(lua);
    lua_insert(lua, 1);
    lua_setfield(lua, 1, "color");
    wf_read_fields(lua, 1, "background", only, 0, wf_builder_of(lua)->scene->background);
    return 0;
}

static int call_color_space(lua_State *lua) {
    wf_scene *scene = wf_builder_of(lua)->scene;
    if (lua_type(lua, 1) != LUA_TSTRING || lua_rawlen(lua, 1) >= sizeof scene->color_space)
        wf_scene_error(lua, "color_space", "it takes the name of a color space");
    strcpy(scene->color_space, lua_tostring(lua, 1));
    return 0;
}

static int call_depth(lua_State *lua) {
    lua_settop(lua, 1);
    double depth = wf_read_number(lua, "depth", "its value");
    if (depth < 0 || depth > 32 || depth != floor(depth))
        wf_scene_error(lua, "depth",
                       "it is how many mirrors and panes a ray may pass, from 0 to 32");
    wf_builder_of(lua)->scene->depth_limit = (int)depth;
    return 0;
}

/* ---- Other files ---- */

#define MOST_INCLUDES 16

/* Where a file below the scene's folder really is; symbolic links do not lead out of it. */
static void find_below(lua_State *lua, const char *name, char path[PATH_MAX]) {
    const wf_builder *b = wf_builder_of(lua);
    char joined[PATH_MAX];
    int used = snprintf(joined, sizeof joined, "%s%s", b->folder, name);
    if (*name == '/' || used < 0 || used >= (int)sizeof joined)
        wf_scene_error(lua, "include", "'%.200s' must lie below the scene's own folder", name);
    if (!realpath(joined, path))
        wf_scene_error(lua, "include", "%.300s: %s", joined, strerror(errno));
    if (strncmp(path, b->folder, strlen(b->folder)))
        wf_scene_error(lua, "include", "'%.200s' leads out of the scene's own folder", name);
}

static int call_include(lua_State *lua) {
    wf_builder *b = wf_builder_of(lua);
    char path[PATH_MAX], why[300];
    if (lua_type(lua, 1) != LUA_TSTRING)
        wf_scene_error(lua, "include", "it takes the name of a file");
    find_below(lua, lua_tostring(lua, 1), path);
    if (b->include_depth == MOST_INCLUDES)
        wf_scene_error(lua, "include", "files include each other more than %d deep",
                       MOST_INCLUDES);
    size_t size;
    wf_sandbox_take(lua, 0);
    char *text = wf_script_read(path, b->sandbox.memory_left, &size, why, sizeof why);
    if (!text) wf_scene_error(lua, "include", "%s", why);
    lua_pushfstring(lua, "@%s", path);
    int status = luaL_loadbufferx(lua, text, size, lua_tostring(lua, -1), "t");
    free(text);
    if (status != LUA_OK) return lua_error(lua);
    b->include_depth++;
    lua_call(lua, 0, 1);
    b->include_depth--;
    return 1;
}

/* ---- The names ---- */

static const luaL_Reg words[] = {{"camera", call_camera},
                                 {"light", call_light},
                                 {"background", call_background},
                                 {"duration", call_duration},
                                 {"color_space", call_color_space},
                                 {"depth", call_depth},
                                 {"add", call_add},
                                 {"include", call_include},
                                 {"checker", call_checker},
                                 {"stripe", call_stripe},
                                 {"zoneplate", call_zoneplate},
                                 {"image", call_image},
                                 {NULL, NULL}};

void wf_open_words(lua_State *lua) {
    luaL_newmetatable(lua, WF_LUA_TEXTURE);
    lua_pushboolean(lua, false);
    lua_setfield(lua, -2, "__metatable");
    lua_pop(lua, 1);
    for (const luaL_Reg *word = words; word->name; word++)
        lua_register(lua, word->name, word->func);
}
