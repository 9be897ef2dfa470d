/* Textures as functions of a script: a texture is a value that a material takes. */
#include <stdio.h>
#include <string.h>

#include "tracer/scene/advice.h"
#include "tracer/scene/builder.h"
#include "tracer/scene/language.h"
#include "tracer/scene/lua_table.h"

static int push_texture(lua_State *lua, const wf_texture *texture) {
    *(wf_texture *)lua_newuserdatauv(lua, sizeof *texture, 0) = *texture;
    luaL_setmetatable(lua, WF_LUA_TEXTURE);
    return 1;
}

/* The two colors that stand in the table without a name. */
static void read_colors(lua_State *lua, const char *what, wf_texture *t) {
    static const wf_lua_key only[] = {{"color", WF_KEY_COLOR, 0, true}, {0}};
    for (int k = 0; k < 2; k++) {
        lua_rawgeti(lua, 1, k + 1);
        if (lua_isnil(lua, -1)) {
            lua_pop(lua, 1);
            continue;
        }
        lua_newtable(lua);
        lua_insert(lua, -2);
        lua_setfield(lua, -2, "color");
        wf_read_keys(lua, -1, what, only, 0, t->color[k]);
        wf_advise_color(lua, what, t->color[k], false);
        lua_pop(lua, 1);
    }
}

static int call_checker(lua_State *lua) {
    static const wf_lua_key keys[] = {
        {"size", WF_KEY_POSITIVE, offsetof(wf_texture, size), false}, {0}};
    wf_texture t = {WF_TEXTURE_CHECKER, .color = {{1, 1, 1}, {0, 0, 0}}, .size = 1};
    wf_read_keys(lua, 1, "checker", keys, 2, &t);
    read_colors(lua, "checker", &t);
    return push_texture(lua, &t);
}

static int call_stripe(lua_State *lua) {
    static const wf_lua_key keys[] = {
        {"size", WF_KEY_POSITIVE, offsetof(wf_texture, size), false},
        {"axis", WF_KEY_DIRECTION, offsetof(wf_texture, axis), false},
        {0}};
    wf_texture t = {WF_TEXTURE_STRIPE, .color = {{1, 1, 1}, {0, 0, 0}}, .size = 1,
                    .axis = {1, 0, 0}};
    wf_read_keys(lua, 1, "stripe", keys, 2, &t);
    read_colors(lua, "stripe", &t);
    return push_texture(lua, &t);
}

static int call_zoneplate(lua_State *lua) {
    static const wf_lua_key keys[] = {
        {"height", WF_KEY_POSITIVE, offsetof(wf_texture, height), true},
        {"center", WF_KEY_VECTOR, offsetof(wf_texture, center), false},
        {"across", WF_KEY_DIRECTION, offsetof(wf_texture, across), false},
        {"down", WF_KEY_DIRECTION, offsetof(wf_texture, down), false},
        {0}};
    wf_texture t = {WF_TEXTURE_ZONEPLATE, .color = {{1, 1, 1}, {0, 0, 0}}, .across = {1, 0, 0},
                    .down = {0, -1, 0}};
    wf_read_keys(lua, 1, "zoneplate", keys, 2, &t);
    read_colors(lua, "zoneplate", &t);
    return push_texture(lua, &t);
}

typedef struct image_table {
    wf_texture texture;
    const char *file;
    bool srgb;
} image_table;

/* A file costs so many steps, whether it is a picture or not. */
#define FILE_STEPS 20000

static void load_image(lua_State *lua, const image_table *f, wf_texture *t) {
    wf_builder *b = wf_builder_of(lua);
    const wf_load_options *o = b->options;
    char path[4096], why[512];
    wf_image image;
    if (!o->load_image)
        wf_scene_error(lua, "image", "there is nothing here that reads pictures");
    int used = snprintf(path, sizeof path, "%s%s", *f->file == '/' ? "" : b->folder, f->file);
    if (used < 0 || used >= (int)sizeof path)
        wf_scene_error(lua, "image", "its path is too long");
    wf_sandbox_charge(lua, FILE_STEPS);
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
    static const wf_lua_key keys[] = {
        {"file", WF_KEY_TEXT, offsetof(image_table, file), true},
        {"corner", WF_KEY_VECTOR, offsetof(image_table, texture.center), false},
        {"across", WF_KEY_DIRECTION, offsetof(image_table, texture.across), false},
        {"down", WF_KEY_DIRECTION, offsetof(image_table, texture.down), false},
        {"width", WF_KEY_POSITIVE, offsetof(image_table, texture.width), false},
        {"height", WF_KEY_POSITIVE, offsetof(image_table, texture.height), false},
        {"repeats", WF_KEY_BOOL, offsetof(image_table, texture.repeat), false},
        {"srgb", WF_KEY_BOOL, offsetof(image_table, srgb), false},
        {0}};
    image_table f = {.texture = {WF_TEXTURE_IMAGE, .across = {1, 0, 0}, .down = {0, -1, 0}}};
    wf_read_keys(lua, 1, "image", keys, 2, &f);
    if (!wf_has_key(lua, 1, "srgb")) f.srgb = likely_srgb(f.file);
    read_colors(lua, "image", &f.texture);
    load_image(lua, &f, &f.texture);
    return push_texture(lua, &f.texture);
}

const luaL_Reg wf_lua_textures[] = {{"checker", call_checker},
                                    {"stripe", call_stripe},
                                    {"zoneplate", call_zoneplate},
                                    {"image", call_image},
                                    {NULL, NULL}};
