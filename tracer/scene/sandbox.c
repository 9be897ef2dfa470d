/* A Lua state without what does harm, with its budgets of steps and memory. */
#include "tracer/scene/sandbox.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <lauxlib.h>

#include "tracer/scene/lua_table.h"
#include "tracer/scene/sandbox_library.h"

/* How many instructions run between two looks at the budget where none of them can take long.
 */
#define STRIDE 1000

/* An instruction may go through all of the largest block once: strings are compared, and holes
 * of tables skipped, at about ten of these bytes a nanosecond. */
#define BYTES_A_STRIDE 0x1p29

/* Bytes that are copied, cleared or looked for in the time of one step. */
#define BYTES_A_STEP 64

/* A step takes 5 to 50 ns. Those that take longer than this count as more than one, so that
 * what nobody thought of ends, too. */
#define LONGEST_STEP_NS 200

/* ---- Steps ---- */

static int64_t now_ns(void) {
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (int64_t)t.tv_sec * 1000000000 + t.tv_nsec;
}

bool wf_sandbox_is_spent(const wf_sandbox *s) {
    return s->steps_ran_out || s->memory_spent;
}

static void look(lua_State *lua, lua_Debug *where);

/* Has the budget looked at every `stride` instructions from now on. */
static void look_every(wf_sandbox *s, int stride) {
    if (stride >= s->stride) return;
    s->stride = stride;
    if (s->running) lua_sethook(s->lua, look, LUA_MASKCOUNT, stride);
}

/* Once the budget is spent every further instruction says so again. */
void wf_sandbox_say_spent(lua_State *lua) {
    wf_sandbox *s = wf_sandbox_of(lua);
    look_every(s, 1);
    s->steps_ran_out = true;
    wf_scene_error(lua, "scene",
                   "it takes more than %lld steps; does a loop never end? --scene-steps allows "
                   "more",
                   (long long)s->steps);
}

static void look(lua_State *lua, lua_Debug *where) {
    wf_sandbox *s = wf_sandbox_of(lua);
    int64_t now = now_ns(), took = (now - s->looked_ns) / LONGEST_STEP_NS;
    (void)where;
    s->looked_ns = now;
    s->steps_left -= took > s->stride ? took : s->stride;
    if (s->steps_left <= 0) wf_sandbox_say_spent(lua);
}

/* Takes steps where nothing can be raised: the next instruction will. */
static void take_steps(wf_sandbox *s, size_t steps) {
    if (!s->running) return;
    s->steps_left -= (int64_t)steps;
    if (s->steps_left <= 0) look_every(s, 1);
}

void wf_sandbox_charge(lua_State *lua, double steps) {
    wf_sandbox *s = wf_sandbox_of(lua);
    s->steps_left -= steps < 1e15 ? (int64_t)steps : (int64_t)1e15;
    if (s->steps_left <= 0) wf_sandbox_say_spent(lua);
}

/* ---- Memory ---- */

/* The larger the largest block, the more often the budget is looked at. */
static void see_block(wf_sandbox *s, size_t size) {
    if (size <= s->largest) return;
    s->largest = size;
    double stride = BYTES_A_STRIDE / (double)size;
    if (stride < STRIDE) look_every(s, stride > 1 ? (int)stride : 1);
}

/* Lua collects all garbage when it is refused memory, and asks again. */
static void *refuse(wf_sandbox *s) {
    s->memory_ran_out = true;
    take_steps(s, (s->memory - s->memory_left) / BYTES_A_STEP);
    return NULL;
}

static void *allocate(void *user, void *old, size_t old_size, size_t size) {
    wf_sandbox *s = user;
    size_t had = old ? old_size : 0;
    if (size > had && size - had > s->memory_left) return refuse(s);
    void *grown = NULL;
    if (!size)
        free(old);
    else if (!(grown = realloc(old, size)))
        return NULL;
    s->memory_left += had;
    s->memory_left -= size;
    if (size > had) take_steps(s, size / BYTES_A_STEP);
    see_block(s, size);
    return grown;
}

wf_sandbox *wf_sandbox_of(lua_State *lua) {
    wf_sandbox *s;
    memcpy(&s, lua_getextraspace(lua), sizeof s);
    return s;
}

void wf_sandbox_no_memory(lua_State *lua) {
    wf_sandbox *s = wf_sandbox_of(lua);
    s->memory_ran_out = s->memory_spent = true;
    luaL_error(lua, "not enough memory");
}

void wf_sandbox_take(lua_State *lua, size_t bytes) {
    wf_sandbox *s = wf_sandbox_of(lua);
    if (bytes > s->memory_left) wf_sandbox_no_memory(lua);
    s->memory_left -= bytes;
}

/* ---- Life ---- */

bool wf_sandbox_open(wf_sandbox *s, int64_t steps, size_t memory_bytes) {
    *s = (wf_sandbox){.steps = steps,
                      .steps_left = steps,
                      .memory = memory_bytes,
                      .memory_left = memory_bytes,
                      .stride = STRIDE};
    s->lua = lua_newstate(allocate, s);
    if (!s->lua) return false;
    memcpy(lua_getextraspace(s->lua), &s, sizeof s);
    lua_pushcfunction(s->lua, wf_sandbox_open_libraries);
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
    s->running = true;
    s->looked_ns = now_ns();
    lua_sethook(s->lua, look, LUA_MASKCOUNT, s->stride);
    status = lua_pcall(s->lua, 0, results, 0);
    lua_sethook(s->lua, NULL, 0, 0);
    s->running = false;
    return status;
}
