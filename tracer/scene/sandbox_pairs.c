/* `pairs` for scripts: in the same order in every run, which Lua's own is not where there are
 * texts among the keys. */
#include <string.h>

#include <lauxlib.h>

#include "tracer/scene/sandbox.h"
#include "tracer/scene/sandbox_library.h"

/* Numbers come before texts, texts before what has no order of its own. */
static int rank_of(int type) {
    return type == LUA_TNUMBER ? 0 : type == LUA_TSTRING ? 1 : type == LUA_TBOOLEAN ? 2 : 3;
}

static int key_before(lua_State *lua) {
    int a = rank_of(lua_type(lua, 1)), b = rank_of(lua_type(lua, 2));
    bool before = a < b;
    if (a == b && a < 2) before = lua_compare(lua, 1, 2, LUA_OPLT);
    if (a == b && a == 2) before = lua_toboolean(lua, 1) < lua_toboolean(lua, 2);
    lua_pushboolean(lua, before);
    return 1;
}

/* Whether a table has texts among its keys. */
static bool has_texts(lua_State *lua, int table) {
    bool texts = false;
    for (lua_pushnil(lua); lua_next(lua, table); lua_pop(lua, 1)) {
        wf_sandbox_charge(lua, 1);
        texts |= lua_type(lua, -2) == LUA_TSTRING;
    }
    return texts;
}

void wf_sandbox_sort_keys(lua_State *lua, int table) {
    lua_Integer count = 0;
    table = lua_absindex(lua, table);
    luaL_checkstack(lua, 6, "too many tables within each other");
    lua_pushcfunction(lua, wf_sandbox_sort);
    lua_newtable(lua);
    for (lua_pushnil(lua); lua_next(lua, table); lua_pop(lua, 1)) {
        wf_sandbox_charge(lua, 1);
        lua_pushvalue(lua, -2);
        lua_rawseti(lua, -4, ++count);
    }
    lua_pushvalue(lua, -1);
    lua_insert(lua, -3);
    lua_pushcfunction(lua, key_before);
    lua_call(lua, 2, 0);
}

/* Upvalues: sorted keys, and how many have been visited. What has been taken out of the table
 * since is left out. */
static int step(lua_State *lua) {
    lua_Integer at = lua_tointeger(lua, lua_upvalueindex(2));
    lua_settop(lua, 1);
    for (;;) {
        if (lua_rawgeti(lua, lua_upvalueindex(1), ++at) == LUA_TNIL) return 1;
        wf_sandbox_charge(lua, 1);
        lua_pushvalue(lua, -1);
        if (lua_rawget(lua, 1) != LUA_TNIL) break;
        lua_settop(lua, 1);
    }
    lua_pushinteger(lua, at);
    lua_replace(lua, lua_upvalueindex(2));
    return 2;
}

/* Upvalue: `next`. */
static int pairs(lua_State *lua) {
    luaL_checkany(lua, 1);
    lua_settop(lua, 1);
    if (luaL_getmetafield(lua, 1, "__pairs") != LUA_TNIL) {
        lua_insert(lua, 1);
        lua_call(lua, 1, 3);
        return 3;
    }
    luaL_checktype(lua, 1, LUA_TTABLE);
    if (has_texts(lua, 1)) {
        wf_sandbox_sort_keys(lua, 1);
        lua_pushinteger(lua, 0);
        lua_pushcclosure(lua, step, 2);
    } else
        lua_pushvalue(lua, lua_upvalueindex(1));
    lua_insert(lua, 1);
    lua_pushnil(lua);
    return 3;
}

void wf_sandbox_set_pairs(lua_State *lua) {
    lua_getglobal(lua, "next");
    lua_pushcclosure(lua, pairs, 1);
    lua_setglobal(lua, "pairs");
}
