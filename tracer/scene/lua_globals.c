/* The values that a script is given: param and raster; and globals that it asks for in vain. */
#include "tracer/scene/lua_globals.h"

#include <stdio.h>
#include <string.h>

#include <lauxlib.h>

#include "tracer/scene/advice.h"
#include "tracer/scene/guess.h"
#include "tracer/scene/sandbox_library.h"

/* In the registry: a table whose keys are the names of param that were asked for. */
static const char asked[] = "weft asked params";

/* ---- Parameters ---- */

static void push_value(lua_State *lua, const char *text) {
    if (!lua_stringtonumber(lua, text)) lua_pushstring(lua, text);
}

/* The name at an index has been asked for. */
static void mark_asked(lua_State *lua, int index) {
    lua_getfield(lua, LUA_REGISTRYINDEX, asked);
    lua_pushvalue(lua, index);
    lua_pushboolean(lua, true);
    lua_rawset(lua, -3);
    lua_pop(lua, 1);
}

/* Upvalue of these: the values by name. */
static int read_param(lua_State *lua) {
    lua_settop(lua, 2);
    if (!lua_isstring(lua, 2)) return 0;
    mark_asked(lua, 2);
    lua_rawget(lua, lua_upvalueindex(1));
    return 1;
}

/* Whoever walks through all reads all. Upvalues: the values by name, and `pairs`. */
static int walk_params(lua_State *lua) {
    lua_settop(lua, 0);
    for (lua_pushnil(lua); lua_next(lua, lua_upvalueindex(1)); lua_pop(lua, 1))
        mark_asked(lua, 1);
    lua_pushvalue(lua, lua_upvalueindex(2));
    lua_pushvalue(lua, lua_upvalueindex(1));
    lua_call(lua, 1, 3);
    return 3;
}

/* An empty table that looks its values up elsewhere, so that it is known which are. */
static void open_params(lua_State *lua, const wf_load_options *o) {
    lua_newtable(lua);
    lua_setfield(lua, LUA_REGISTRYINDEX, asked);
    lua_newtable(lua);
    lua_newtable(lua);
    lua_newtable(lua);
    for (size_t i = 0; i < o->param_count; i++) {
        push_value(lua, o->params[i].value);
        lua_setfield(lua, -2, o->params[i].name);
    }
    lua_pushvalue(lua, -1);
    lua_pushcclosure(lua, read_param, 1);
    lua_setfield(lua, -3, "__index");
    lua_getglobal(lua, "pairs");
    lua_pushcclosure(lua, walk_params, 2);
    lua_setfield(lua, -2, "__pairs");
    lua_pushboolean(lua, false);
    lua_setfield(lua, -2, "__metatable");
    lua_setmetatable(lua, -2);
    lua_setglobal(lua, "param");
}

/* The names that were asked for, and the one of them that is most like a name. Stack: the table
 * of them. */
static const char *list_asked(lua_State *lua, const char *name, char *list, size_t size) {
    wf_guess guess = wf_guess_of(name);
    size_t used = 0;
    *list = '\0';
    wf_sandbox_sort_keys(lua, -1);
    for (lua_Integer n = 1; lua_rawgeti(lua, -1, n) != LUA_TNIL; n++, lua_pop(lua, 1)) {
        if (lua_type(lua, -1) != LUA_TSTRING) continue;
        const char *other = lua_tostring(lua, -1);
        wf_guess_offer(&guess, other);
        if (used < size)
            used +=
                (size_t)snprintf(list + used, size - used, "%s%.40s", used ? ", " : "", other);
    }
    lua_pop(lua, 2);
    return wf_guess_found(&guess);
}

static void advise_param(lua_State *lua, wf_builder *b, const char *name) {
    char list[200];
    const char *meant = list_asked(lua, name, list, sizeof list);
    if (meant)
        wf_scene_warn_at(b, (wf_place){0}, "--set",
                         "the scene does not read param.%.60s; did you mean %.60s?", name,
                         meant);
    else
        wf_scene_warn_at(b, (wf_place){0}, "--set",
                         "the scene does not read param.%.60s; it reads %s", name,
                         *list ? list : "none");
}

void wf_advise_params(lua_State *lua, wf_builder *b) {
    const wf_load_options *o = b->options;
    lua_getfield(lua, LUA_REGISTRYINDEX, asked);
    for (size_t i = 0; i < o->param_count; i++) {
        bool read = lua_getfield(lua, -1, o->params[i].name) != LUA_TNIL;
        lua_pop(lua, 1);
        if (!read) advise_param(lua, b, o->params[i].name);
    }
    lua_pop(lua, 1);
}

/* ---- Globals that nothing defined ---- */

static int miss_global(lua_State *lua) {
    wf_builder *b = wf_builder_of(lua);
    if (lua_type(lua, 2) == LUA_TSTRING && b->missed_count < WF_MOST_MISSED) {
        wf_missed *missed = &b->missed[b->missed_count++];
        snprintf(missed->name, sizeof missed->name, "%s", lua_tostring(lua, 2));
        missed->place = wf_place_here(lua);
    }
    return 0;
}

static void open_missing(lua_State *lua) {
    lua_pushglobaltable(lua);
    lua_newtable(lua);
    lua_pushcfunction(lua, miss_global);
    lua_setfield(lua, -2, "__index");
    lua_setmetatable(lua, -2);
    lua_pop(lua, 1);
}

/* Offers all names of the table at the top of the stack, and takes it away. */
static void offer_names(lua_State *lua, wf_guess *guess) {
    for (lua_pushnil(lua); lua_next(lua, -2); lua_pop(lua, 1))
        if (lua_type(lua, -2) == LUA_TSTRING) wf_guess_offer(guess, lua_tostring(lua, -2));
    lua_pop(lua, 1);
}

const char *wf_lua_meant_global(lua_State *lua, const char *name) {
    wf_guess guess = wf_guess_of(name);
    lua_pushglobaltable(lua);
    offer_names(lua, &guess);
    return wf_guess_found(&guess);
}

const char *wf_lua_meant_field(lua_State *lua, const char *name) {
    static const char *const libraries[] = {"math", "string", "table"};
    wf_guess guess = wf_guess_of(name);
    for (size_t n = 0; n < sizeof libraries / sizeof *libraries; n++)
        if (lua_getglobal(lua, libraries[n]) == LUA_TTABLE)
            offer_names(lua, &guess);
        else
            lua_pop(lua, 1);
    return wf_guess_found(&guess);
}

static bool is_defined(lua_State *lua, const char *name) {
    lua_pushglobaltable(lua);
    lua_pushstring(lua, name);
    bool there = lua_rawget(lua, -2) != LUA_TNIL;
    lua_pop(lua, 2);
    return there;
}

void wf_advise_globals(lua_State *lua, wf_builder *b) {
    for (int n = 0; n < b->missed_count; n++) {
        const wf_missed *missed = &b->missed[n];
        if (is_defined(lua, missed->name)) continue;
        const char *meant = wf_lua_meant_global(lua, missed->name);
        wf_scene_warn_at(b, missed->place, "scene", "nothing is called %s%s%s%s", missed->name,
                         meant ? "; did you mean " : "", meant ? meant : "", meant ? "?" : "");
    }
}

/* ---- All of them ---- */

void wf_lua_open_globals(lua_State *lua) {
    const wf_load_options *o = wf_builder_of(lua)->options;
    const struct {
        const char *name;
        double value;
    } raster[] = {{"width", o->width_px},
                  {"lines", o->lines},
                  {"pixel_aspect", o->pixel_aspect},
                  {"frame_rate", o->frame_rate},
                  {"field_rate", o->field_rate}};
    lua_newtable(lua);
    for (size_t i = 0; i < sizeof raster / sizeof *raster; i++) {
        lua_pushnumber(lua, raster[i].value);
        lua_setfield(lua, -2, raster[i].name);
    }
    lua_setglobal(lua, "raster");
    open_params(lua, o);
    open_missing(lua);
}
