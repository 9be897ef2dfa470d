/* Materials and temporal widths as methods of a script's solids. */
#include "tracer/scene/advice.h"
#include "tracer/scene/language.h"
#include "tracer/scene/lua_node.h"
#include "tracer/scene/lua_table.h"

static int call_temporal_width(lua_State *lua) {
    wf_builder *b = wf_builder_of(lua);
    wf_check_node(lua, 1, "temporal_width");
    wf_only_value(lua, "temporal_width", 2);
    double width = wf_read_number(lua, "temporal_width", "its value");
    if (width < 0 || width > 64)
        wf_scene_error(lua, "temporal_width", "it is from 0 to 64 field periods, not %g",
                       width);
    *(double *)wf_list_grow(lua, &b->widths, sizeof width, 1) = width;
    return wf_wrap_node(lua, WF_NODE_WIDTH, (int)b->widths.count - 1, "temporal_width");
}

typedef struct look {
    float color[3];
    double ambient, diffuse, specular, shininess, reflect, refract, index;
    bool unlit, holdout;
} look;

/* Keys that say nothing without another. */
static void advise_material(lua_State *lua, const wf_material *m) {
    wf_advise_color(lua, "material", m->color, !m->unlit);
    if (!(m->refract > 0) && wf_has_key(lua, 2, "index"))
        wf_scene_warn(lua, "material",
                      "index= bends what refract= lets through: write refract=1");
    if (!(m->specular > 0) && wf_has_key(lua, 2, "shininess"))
        wf_scene_warn(lua, "material", "shininess= is of the highlight that specular= gives");
}

static int call_material(lua_State *lua) {
    static const wf_lua_key keys[] = {
        {"color", WF_KEY_COLOR, offsetof(look, color), false},
        {"texture", WF_KEY_OTHER, 0, false},
        {"ambient", WF_KEY_NOT_NEGATIVE, offsetof(look, ambient), false},
        {"diffuse", WF_KEY_NOT_NEGATIVE, offsetof(look, diffuse), false},
        {"specular", WF_KEY_NOT_NEGATIVE, offsetof(look, specular), false},
        {"shininess", WF_KEY_NOT_NEGATIVE, offsetof(look, shininess), false},
        {"reflect", WF_KEY_SHARE, offsetof(look, reflect), false},
        {"refract", WF_KEY_SHARE, offsetof(look, refract), false},
        {"index", WF_KEY_POSITIVE, offsetof(look, index), false},
        {"unlit", WF_KEY_BOOL, offsetof(look, unlit), false},
        {"holdout", WF_KEY_BOOL, offsetof(look, holdout), false},
        {0}};
    look k = {{0.8f, 0.8f, 0.8f}, 0.1, 0.9, 0, 40, 0, 0, 1.5, false, false};
    wf_builder *b = wf_builder_of(lua);
    wf_check_node(lua, 1, "material");
    wf_read_keys(lua, 2, "material", keys, 0, &k);
    wf_material m = {.color = {k.color[0], k.color[1], k.color[2]},
                     .ambient = (float)k.ambient,
                     .diffuse = (float)k.diffuse,
                     .specular = (float)k.specular,
                     .shininess = (float)k.shininess,
                     .reflect = (float)k.reflect,
                     .refract = (float)k.refract,
                     .index = k.index,
                     .unlit = k.unlit,
                     .holdout = k.holdout};
    lua_getfield(lua, 2, "texture");
    if (!lua_isnil(lua, -1)) {
        const wf_texture *texture = luaL_testudata(lua, -1, WF_LUA_TEXTURE);
        if (!texture)
            wf_scene_error(
                lua, "material",
                "texture must be checker{..}, stripe{..}, zoneplate{..} or image{..}");
        m.texture = *texture;
    }
    advise_material(lua, &m);
    *(wf_material *)wf_list_grow(lua, &b->materials, sizeof m, 1) = m;
    return wf_wrap_node(lua, WF_NODE_MATERIAL, (int)b->materials.count - 1, "material");
}

const luaL_Reg wf_lua_looks[] = {
    {"temporal_width", call_temporal_width}, {"material", call_material}, {NULL, NULL}};
