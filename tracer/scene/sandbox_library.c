/* The libraries that a script is given: what they do is charged, and what a budget has ended
 * stays ended. */
#include "tracer/scene/sandbox_library.h"

#include <math.h>
#include <string.h>

#include <lauxlib.h>
#include <lualib.h>

#include "tracer/scene/sandbox.h"

/* ---- Functions of strings, charged by what they will do before they do it ---- */

static double size_of(lua_State *lua, int arg) {
    return lua_isstring(lua, arg) ? (double)lua_rawlen(lua, arg) : 0;
}

/* As often as there are values, all of them may be gone through. */
static double cost_all(lua_State *lua) {
    double bytes = 0;
    for (int n = lua_gettop(lua); n > 0; n--) bytes += size_of(lua, n);
    return bytes / 16;
}

static double cost_repeat(lua_State *lua) {
    double n = luaL_checknumber(lua, 2);
    double each = size_of(lua, 1) + size_of(lua, 3);
    double bytes = n > 0 ? n * each : 0;
    if (bytes > (double)wf_sandbox_of(lua)->memory_left) wf_sandbox_no_memory(lua);
    return bytes / 16;
}

/* A pattern with q repetitions can look at a text of n letters n^(q + 1) times, each time at
 * all of itself. */
static double cost_pattern(lua_State *lua) {
    size_t text, length, repeats = 0;
    luaL_checklstring(lua, 1, &text);
    const char *pattern = luaL_checklstring(lua, 2, &length);
    for (size_t i = 0; i < length; i++)
        repeats += strchr("*+-?b", pattern[i]) != NULL && pattern[i] != '\0';
    for (size_t i = 1; i < length; i++)
        repeats += pattern[i - 1] == '%' && pattern[i] >= '1' && pattern[i] <= '9';
    double looks = pow((double)text + 1, 1 + (double)repeats);
    return looks * (1 + (double)length / 16) / 8 + (double)length;
}

/* Plain text is looked for without a pattern. */
static double cost_find(lua_State *lua) {
    return lua_toboolean(lua, 4) ? size_of(lua, 1) * (size_of(lua, 2) + 1) / 8
                                 : cost_pattern(lua);
}

typedef double cost_fn(lua_State *lua);

static const struct {
    const char *name;
    cost_fn *cost;
} charged[] = {
    {"rep", cost_repeat},     {"find", cost_find},    {"match", cost_pattern},
    {"gmatch", cost_pattern}, {"gsub", cost_pattern}, {"reverse", cost_all},
    {"upper", cost_all},      {"lower", cost_all},    {"byte", cost_all},
    {"format", cost_all},     {"pack", cost_all},     {"unpack", cost_all},
    {"packsize", cost_all},
};

#define CHARGED (sizeof charged / sizeof *charged)

/* Upvalues: which row; the library's own function. */
static int call_charged(lua_State *lua) {
    int args = lua_gettop(lua);
    wf_sandbox_charge(lua, charged[lua_tointeger(lua, lua_upvalueindex(1))].cost(lua));
    lua_pushvalue(lua, lua_upvalueindex(2));
    lua_insert(lua, 1);
    lua_call(lua, args, LUA_MULTRET);
    return lua_gettop(lua);
}

static void charge_strings(lua_State *lua) {
    lua_getglobal(lua, LUA_STRLIBNAME);
    for (size_t i = 0; i < CHARGED; i++) {
        lua_pushinteger(lua, (lua_Integer)i);
        lua_getfield(lua, -2, charged[i].name);
        lua_pushcclosure(lua, call_charged, 2);
        lua_setfield(lua, -2, charged[i].name);
    }
    lua_pop(lua, 1);
}

/* ---- Errors that a script may catch, which a spent budget is not ---- */

/* Calls what stands from place `first` on, and puts whether it went well before its results. */
static int call_protected(lua_State *lua, int first, int handler) {
    wf_sandbox *s = wf_sandbox_of(lua);
    int status = lua_pcall(lua, lua_gettop(lua) - first, LUA_MULTRET, handler);
    if (s->steps_ran_out && status != LUA_ERRRUN) wf_sandbox_say_spent(lua);
    if (status == LUA_ERRMEM || (status != LUA_OK && wf_sandbox_is_spent(s)))
        return lua_error(lua);
    lua_pushboolean(lua, status == LUA_OK);
    lua_insert(lua, first);
    return lua_gettop(lua) - first + 1;
}

static int protect(lua_State *lua) {
    luaL_checkany(lua, 1);
    return call_protected(lua, 1, 0);
}

/* A handler is called where the error is, which may be in the hook that counts steps, and there
 * nothing would count the handler's. */
static int handle(lua_State *lua) {
    if (wf_sandbox_is_spent(wf_sandbox_of(lua))) return 1;
    lua_pushvalue(lua, lua_upvalueindex(1));
    lua_insert(lua, 1);
    lua_call(lua, lua_gettop(lua) - 1, 1);
    return 1;
}

static int protect_and_handle(lua_State *lua) {
    luaL_checktype(lua, 2, LUA_TFUNCTION);
    lua_pushvalue(lua, 2);
    lua_pushcclosure(lua, handle, 1);
    lua_replace(lua, 2);
    lua_rotate(lua, 1, 1);
    return call_protected(lua, 2, 1);
}

/* ---- The rest ---- */

/* Finalizers run where no budget counts. */
static int set_metatable(lua_State *lua) {
    int type = lua_type(lua, 2);
    luaL_checktype(lua, 1, LUA_TTABLE);
    luaL_argcheck(lua, type == LUA_TNIL || type == LUA_TTABLE, 2, "nil or a table expected");
    if (luaL_getmetafield(lua, 1, "__metatable") != LUA_TNIL)
        return luaL_error(lua, "setmetatable: the table's metatable is protected");
    lua_settop(lua, 2);
    if (type == LUA_TTABLE) {
        lua_pushliteral(lua, "__gc");
        if (lua_rawget(lua, 2) != LUA_TNIL)
            return luaL_error(lua, "setmetatable: a scene has no finalizers (__gc)");
        lua_settop(lua, 2);
    }
    lua_setmetatable(lua, 1);
    return 1;
}

static int random_seed(lua_State *lua) {
    lua_Integer seed = luaL_checkinteger(lua, 1);
    lua_pushvalue(lua, lua_upvalueindex(1));
    lua_pushinteger(lua, seed);
    lua_pushinteger(lua, 0);
    lua_call(lua, 2, 0);
    return 0;
}

/* Numbers at random are the same in every run. */
static void settle_random(lua_State *lua) {
    lua_getglobal(lua, "math");
    lua_getfield(lua, -1, "randomseed");
    lua_pushcclosure(lua, random_seed, 1);
    lua_pushvalue(lua, -1);
    lua_setfield(lua, -3, "randomseed");
    lua_pushinteger(lua, 1);
    lua_call(lua, 1, 0);
    lua_pop(lua, 1);
}

static int print(lua_State *lua) {
    wf_sandbox *s = wf_sandbox_of(lua);
    luaL_Buffer line;
    int count = lua_gettop(lua);
    luaL_checkstack(lua, count + LUA_MINSTACK, "too many values to print");
    for (int n = 1; n <= count; n++) luaL_tolstring(lua, n, NULL);
    luaL_buffinit(lua, &line);
    for (int n = 1; n <= count; n++) {
        if (n > 1) luaL_addchar(&line, '\t');
        lua_pushvalue(lua, count + n);
        luaL_addvalue(&line);
    }
    luaL_pushresult(&line);
    if (s->print) s->print(s->user, lua_tostring(lua, -1), lua_rawlen(lua, -1));
    return 0;
}

int wf_sandbox_open_libraries(lua_State *lua) {
    static const luaL_Reg libraries[] = {{LUA_GNAME, luaopen_base},
                                         {LUA_TABLIBNAME, luaopen_table},
                                         {LUA_STRLIBNAME, luaopen_string},
                                         {LUA_MATHLIBNAME, luaopen_math}};
    static const char *const refused[] = {"load",    "loadfile",       "dofile",
                                          "require", "collectgarbage", "warn"};
    for (size_t i = 0; i < sizeof libraries / sizeof *libraries; i++) {
        luaL_requiref(lua, libraries[i].name, libraries[i].func, 1);
        lua_pop(lua, 1);
    }
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        lua_pushnil(lua);
        lua_setglobal(lua, refused[i]);
    }
    lua_getglobal(lua, LUA_STRLIBNAME);
    lua_pushnil(lua);
    lua_setfield(lua, -2, "dump");
    charge_strings(lua);
    lua_getglobal(lua, LUA_TABLIBNAME);
    wf_sandbox_set_table(lua);
    settle_random(lua);
    wf_sandbox_set_pairs(lua);
    lua_register(lua, "setmetatable", set_metatable);
    lua_register(lua, "pcall", protect);
    lua_register(lua, "xpcall", protect_and_handle);
    lua_register(lua, "print", print);
    return 0;
}
