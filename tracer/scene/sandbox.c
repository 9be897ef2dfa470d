/* A Lua state without what does harm, with its budgets of steps and memory. */
#include "tracer/scene/sandbox.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <lauxlib.h>
#include <lualib.h>

#include "tracer/scene/lua_table.h"

/* How many instructions run between two looks at the budget. */
#define STRIDE 1000

/* ---- Memory ---- */

static void *allocate(void *user, void *old, size_t old_size, size_t size) {
    wf_sandbox *s = user;
    size_t had = old ? old_size : 0;
    if (size > had && size - had > s->memory_left) {
        s->memory_ran_out = true;
        return NULL;
    }
    void *grown = NULL;
    if (!size)
        free(old);
    else if (!(grown = realloc(old, size)))
        return NULL;
    s->memory_left += had;
    s->memory_left -= size;
    return grown;
}

wf_sandbox *wf_sandbox_of(lua_State *lua) {
    wf_sandbox *s;
    memcpy(&s, lua_getextraspace(lua), sizeof s);
    return s;
}

void wf_sandbox_take(lua_State *lua, size_t bytes) {
    wf_sandbox *s = wf_sandbox_of(lua);
    if (bytes > s->memory_left) {
        s->memory_ran_out = true;
        luaL_error(lua, "not enough memory");
    }
    s->memory_left -= bytes;
}

/* ---- Steps ---- */

/* Once the budget is spent every further instruction says so again: a script that catches the
 * error gets no farther than the catching. */
static void spend(lua_State *lua, lua_Debug *where) {
    wf_sandbox *s = wf_sandbox_of(lua);
    (void)where;
    s->steps_left -= s->steps_ran_out ? 1 : STRIDE;
    if (s->steps_left > 0) return;
    if (!s->steps_ran_out) lua_sethook(lua, spend, LUA_MASKCOUNT, 1);
    s->steps_ran_out = true;
    wf_scene_error(lua, "scene",
                   "it takes more than %lld steps; does a loop never end? --scene-steps allows "
                   "more",
                   (long long)s->steps);
}

void wf_sandbox_charge(lua_State *lua, double steps) {
    wf_sandbox *s = wf_sandbox_of(lua);
    s->steps_left -= steps < 1e15 ? (int64_t)steps : (int64_t)1e15;
    if (s->steps_left <= 0) spend(lua, NULL);
}

/* ---- Library functions, charged by what they will do before they do it ---- */

static double size_of(lua_State *lua, int arg) {
    return lua_istable(lua, arg) || lua_isstring(lua, arg) ? (double)lua_rawlen(lua, arg) : 0;
}

static double cost_all(lua_State *lua) {
    return 2 * size_of(lua, 1);
}

static double cost_sort(lua_State *lua) {
    double n = size_of(lua, 1);
    return 4 * n * log2(n + 2);
}

static double cost_span(lua_State *lua, int first, int last, double most) {
    double from = luaL_optnumber(lua, first, 1), to = luaL_optnumber(lua, last, most);
    return to > from ? to - from : 0;
}

static double cost_concat(lua_State *lua) {
    return 8 * cost_span(lua, 3, 4, size_of(lua, 1));
}

static double cost_unpack(lua_State *lua) {
    return cost_span(lua, 2, 3, size_of(lua, 1));
}

static double cost_move(lua_State *lua) {
    return 4 * cost_span(lua, 2, 3, 0);
}

static double cost_repeat(lua_State *lua) {
    double n = luaL_checknumber(lua, 2);
    double each = size_of(lua, 1) + size_of(lua, 3);
    double bytes = n > 0 ? n * each : 0;
    if (bytes > (double)wf_sandbox_of(lua)->memory_left) {
        wf_sandbox_of(lua)->memory_ran_out = true;
        luaL_error(lua, "not enough memory");
    }
    return bytes / 16;
}

/* A pattern with q repetitions can look at a text of n letters n^(q + 1) times. */
static double cost_pattern(lua_State *lua) {
    size_t text, length, repeats = 0;
    luaL_checklstring(lua, 1, &text);
    const char *pattern = luaL_checklstring(lua, 2, &length);
    for (size_t i = 0; i < length; i++)
        repeats += strchr("*+-?b", pattern[i]) != NULL && pattern[i] != '\0';
    return pow((double)text + 1, 1 + (double)repeats) / 8 + (double)length;
}

/* Plain text is looked for without a pattern. */
static double cost_find(lua_State *lua) {
    return lua_toboolean(lua, 4) ? size_of(lua, 1) * (size_of(lua, 2) + 1) / 8
                                 : cost_pattern(lua);
}

typedef double cost_fn(lua_State *lua);

static const struct {
    const char *library, *name;
    cost_fn *cost;
} charged[] = {
    {"table", "concat", cost_concat},  {"table", "insert", cost_all},
    {"table", "remove", cost_all},     {"table", "move", cost_move},
    {"table", "sort", cost_sort},      {"table", "unpack", cost_unpack},
    {"string", "rep", cost_repeat},    {"string", "find", cost_find},
    {"string", "match", cost_pattern}, {"string", "gmatch", cost_pattern},
    {"string", "gsub", cost_pattern},  {"string", "reverse", cost_all},
    {"string", "upper", cost_all},     {"string", "lower", cost_all},
    {"string", "byte", cost_all},
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

static void charge_libraries(lua_State *lua) {
    for (size_t i = 0; i < CHARGED; i++) {
        lua_getglobal(lua, charged[i].library);
        lua_pushinteger(lua, (lua_Integer)i);
        lua_getfield(lua, -2, charged[i].name);
        lua_pushcclosure(lua, call_charged, 2);
        lua_setfield(lua, -2, charged[i].name);
        lua_pop(lua, 1);
    }
}

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

static void forget(lua_State *lua, const char *library, const char *name) {
    lua_getglobal(lua, library);
    lua_pushnil(lua);
    lua_setfield(lua, -2, name);
    lua_pop(lua, 1);
}

static int open_libraries(lua_State *lua) {
    static const luaL_Reg libraries[] = {{LUA_GNAME, luaopen_base},
                                         {LUA_TABLIBNAME, luaopen_table},
                                         {LUA_STRLIBNAME, luaopen_string},
                                         {LUA_MATHLIBNAME, luaopen_math}};
    static const char *const refused[] = {"load",           "loadfile", "dofile", "require",
                                          "collectgarbage", "print",    "warn"};
    for (size_t i = 0; i < sizeof libraries / sizeof *libraries; i++) {
        luaL_requiref(lua, libraries[i].name, libraries[i].func, 1);
        lua_pop(lua, 1);
    }
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        lua_pushnil(lua);
        lua_setglobal(lua, refused[i]);
    }
    forget(lua, "string", "dump");
    charge_libraries(lua);
    settle_random(lua);
    lua_pushcfunction(lua, set_metatable);
    lua_setglobal(lua, "setmetatable");
    return 0;
}

/* ---- Life ---- */

bool wf_sandbox_open(wf_sandbox *s, int64_t steps, size_t memory_bytes) {
    *s = (wf_sandbox){.steps = steps,
                      .steps_left = steps,
                      .memory = memory_bytes,
                      .memory_left = memory_bytes};
    s->lua = lua_newstate(allocate, s);
    if (!s->lua) return false;
    memcpy(lua_getextraspace(s->lua), &s, sizeof s);
    lua_pushcfunction(s->lua, open_libraries);
    if (lua_pcall(s->lua, 0, 0, 0) == LUA_OK) return true;
    wf_sandbox_close(s);
    return false;
}

void wf_sandbox_close(wf_sandbox *s) {
    if (s->lua) lua_close(s->lua);
    s->lua = NULL;
}

int wf_sandbox_run(wf_sandbox *s, const char *text, size_t size, const char *name,
                   int results) {
    int status = luaL_loadbufferx(s->lua, text, size, name, "t");
    if (status != LUA_OK) return status;
    lua_sethook(s->lua, spend, LUA_MASKCOUNT, STRIDE);
    status = lua_pcall(s->lua, 0, results, 0);
    lua_sethook(s->lua, NULL, 0, 0);
    return status;
}
