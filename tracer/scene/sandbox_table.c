/* Functions of tables for scripts: lengths, which a script may make up, are asked for once and
 * charged before they are walked. */
#include <limits.h>
#include <math.h>
#include <string.h>

#include <lauxlib.h>

#include "tracer/scene/sandbox.h"
#include "tracer/scene/sandbox_library.h"

static lua_Integer length_of(lua_State *lua) {
    luaL_checkany(lua, 1);
    return luaL_len(lua, 1);
}

/* Charges what is done to all from first to last. */
static void charge_span(lua_State *lua, double each, lua_Integer first, lua_Integer last) {
    if (last >= first) wf_sandbox_charge(lua, each * ((double)last - (double)first + 1));
}

/* Calls the library's own function, which is the upvalue, with what is on the stack. */
static int go_on(lua_State *lua) {
    lua_pushvalue(lua, lua_upvalueindex(1));
    lua_insert(lua, 1);
    lua_call(lua, lua_gettop(lua) - 1, LUA_MULTRET);
    return lua_gettop(lua);
}

/* ---- Walks from one place to another, which the library does once they are known ---- */

static void settle_span(lua_State *lua, int first_arg, double each) {
    lua_settop(lua, first_arg + 1);
    lua_Integer first = luaL_optinteger(lua, first_arg, 1);
    lua_Integer last = lua_isnoneornil(lua, first_arg + 1)
                           ? length_of(lua)
                           : luaL_checkinteger(lua, first_arg + 1);
    charge_span(lua, each, first, last);
    lua_pushinteger(lua, first);
    lua_replace(lua, first_arg);
    lua_pushinteger(lua, last);
    lua_replace(lua, first_arg + 1);
}

static int concat(lua_State *lua) {
    settle_span(lua, 3, 8);
    return go_on(lua);
}

static int unpack(lua_State *lua) {
    settle_span(lua, 2, 1);
    return go_on(lua);
}

static int move(lua_State *lua) {
    charge_span(lua, 4, luaL_checkinteger(lua, 2), luaL_checkinteger(lua, 3));
    return go_on(lua);
}

/* ---- Places within a list ---- */

static void copy_entry(lua_State *lua, lua_Integer from, lua_Integer to) {
    lua_geti(lua, 1, from);
    lua_seti(lua, 1, to);
}

/* Whether a position is from 1 to the first free one, counted so that no sum overflows. */
static void check_position(lua_State *lua, lua_Integer at, lua_Integer length) {
    luaL_argcheck(lua, at >= 1 && at - 1 <= length, 2, "position out of bounds");
}

static int insert(lua_State *lua) {
    lua_Integer length = length_of(lua), at = length;
    int args = lua_gettop(lua);
    if (args != 2 && args != 3) return luaL_error(lua, "wrong number of arguments to 'insert'");
    luaL_argcheck(lua, length < LUA_MAXINTEGER, 1, "too long");
    at++;
    if (args == 3) {
        at = luaL_checkinteger(lua, 2);
        check_position(lua, at, length);
        charge_span(lua, 4, at, length);
        for (lua_Integer n = length; n >= at; n--) copy_entry(lua, n, n + 1);
    }
    lua_seti(lua, 1, at);
    return 0;
}

static int remove_entry(lua_State *lua) {
    lua_Integer length = length_of(lua), at = length;
    luaL_argcheck(lua, length < LUA_MAXINTEGER, 1, "too long");
    if (lua_gettop(lua) > 1) {
        at = luaL_checkinteger(lua, 2);
        if (length || at) check_position(lua, at, length);
    }
    charge_span(lua, 4, at, length);
    lua_geti(lua, 1, at);
    for (; at < length; at++) copy_entry(lua, at + 1, at);
    lua_pushnil(lua);
    lua_seti(lua, 1, at);
    return 1;
}

/* ---- Sorting ---- */

/* Stack: 1 the table, 2 what compares or nil, 3 and 4 two tables of what is sorted. */
enum { COMPARE = 2, FROM = 3, TO = 4 };

/* Texts are compared letter by letter. */
static double cost_of_comparing(lua_State *lua) {
    bool texts = lua_type(lua, -1) == LUA_TSTRING && lua_type(lua, -2) == LUA_TSTRING;
    return texts ? 4 + (double)lua_rawlen(lua, -1) / 16 : 4;
}

/* Whether entry a of FROM must come before entry b. */
static bool comes_before(lua_State *lua, lua_Integer a, lua_Integer b) {
    bool given = !lua_isnil(lua, COMPARE);
    if (given) lua_pushvalue(lua, COMPARE);
    lua_rawgeti(lua, FROM, a);
    lua_rawgeti(lua, FROM, b);
    wf_sandbox_charge(lua, cost_of_comparing(lua));
    if (given) lua_call(lua, 2, 1);
    bool before = given ? lua_toboolean(lua, -1) : lua_compare(lua, -2, -1, LUA_OPLT);
    lua_pop(lua, given ? 1 : 2);
    return before;
}

/* Merges first .. middle - 1 and middle .. end - 1 of FROM, each sorted, into TO. */
static void merge(lua_State *lua, lua_Integer first, lua_Integer middle, lua_Integer end) {
    lua_Integer a = first, b = middle;
    for (lua_Integer n = first; n < end; n++) {
        bool second = a == middle || (b < end && comes_before(lua, b, a));
        lua_rawgeti(lua, FROM, second ? b++ : a++);
        lua_rawseti(lua, TO, n);
    }
}

static lua_Integer least(lua_Integer a, lua_Integer b) {
    return a < b ? a : b;
}

int wf_sandbox_sort(lua_State *lua) {
    lua_Integer length = length_of(lua);
    if (length < 2) return 0;
    luaL_argcheck(lua, length < INT_MAX, 1, "array too big");
    if (!lua_isnoneornil(lua, 2)) luaL_checktype(lua, 2, LUA_TFUNCTION);
    lua_settop(lua, 2);
    charge_span(lua, 8, 1, length);
    lua_createtable(lua, (int)length, 0);
    lua_createtable(lua, (int)length, 0);
    for (lua_Integer n = 1; n <= length; n++) {
        lua_geti(lua, 1, n);
        lua_rawseti(lua, FROM, n);
    }
    for (lua_Integer run = 1; run < length; run *= 2) {
        for (lua_Integer n = 1; n <= length; n += 2 * run)
            merge(lua, n, least(n + run, length + 1), least(n + 2 * run, length + 1));
        lua_insert(lua, FROM); /* what was merged is what is merged next */
    }
    for (lua_Integer n = 1; n <= length; n++) {
        lua_rawgeti(lua, FROM, n);
        lua_seti(lua, 1, n);
    }
    return 0;
}

void wf_sandbox_set_table(lua_State *lua) {
    static const luaL_Reg functions[] = {{"concat", concat},       {"unpack", unpack},
                                         {"move", move},           {"insert", insert},
                                         {"remove", remove_entry}, {"sort", wf_sandbox_sort}};
    for (size_t n = 0; n < sizeof functions / sizeof *functions; n++) {
        lua_getfield(lua, -1, functions[n].name);
        lua_pushcclosure(lua, functions[n].func, 1);
        lua_setfield(lua, -2, functions[n].name);
    }
}
