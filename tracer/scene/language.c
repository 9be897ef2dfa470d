/* Makes the functions and methods of the scene language known to a script. */
#include "tracer/scene/language.h"

#include "tracer/scene/lua_node.h"
#include "tracer/scene/lua_table.h"
#include "tracer/scene/guess.h"

static const luaL_Reg *const methods[] = {wf_lua_motions, wf_lua_looks};

#define METHODS (sizeof methods / sizeof *methods)

/* What a solid is asked for that it does not have. */
static int no_method(lua_State *lua) {
    const char *name = lua_tostring(lua, 2);
    wf_guess guess = wf_guess_of(name ? name : "");
    for (size_t list = 0; list < METHODS; list++)
        for (const luaL_Reg *method = methods[list]; method->name; method++)
            wf_guess_offer(&guess, method->name);
    const char *found = wf_guess_found(&guess);
    return wf_scene_error(lua, "solid", "there is no '%.60s'%s%s%s", name ? name : "",
                          found ? "; did you mean " : "", found ? found : "", found ? "?" : "");
}

/* Scripts cannot reach metatables, and thus not change what methods do. */
static void hide_metatable(lua_State *lua) {
    lua_pushboolean(lua, false);
    lua_setfield(lua, -2, "__metatable");
}

static void open_nodes(lua_State *lua) {
    luaL_newmetatable(lua, WF_LUA_NODE);
    luaL_setfuncs(lua, wf_lua_set_operators, 0);
    lua_newtable(lua);
    for (size_t list = 0; list < METHODS; list++) luaL_setfuncs(lua, methods[list], 0);
    lua_newtable(lua);
    lua_pushcfunction(lua, no_method);
    lua_setfield(lua, -2, "__index");
    lua_setmetatable(lua, -2);
    lua_setfield(lua, -2, "__index");
    hide_metatable(lua);
    lua_pop(lua, 1);
}

static void open_textures(lua_State *lua) {
    luaL_newmetatable(lua, WF_LUA_TEXTURE);
    hide_metatable(lua);
    lua_pop(lua, 1);
}

void wf_open_language(lua_State *lua) {
    static const luaL_Reg *const functions[] = {wf_lua_list_solids, wf_lua_sets, wf_lua_views,
                                                wf_lua_words, wf_lua_textures};
    open_nodes(lua);
    open_textures(lua);
    wf_lua_open_forms(lua);
    for (size_t list = 0; list < sizeof functions / sizeof *functions; list++)
        for (const luaL_Reg *function = functions[list]; function->name; function++)
            lua_register(lua, function->name, function->func);
}
