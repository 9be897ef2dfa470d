#ifndef WF_TRACER_SCENE_SANDBOX_H
#define WF_TRACER_SCENE_SANDBOX_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lua.h>

/* A Lua state that cannot do harm: base, table, string and math alone, without what loads code,
 * a budget of steps that nothing in the script can catch, a limit of memory, and no function of
 * the C library that runs unbounded. */
typedef struct wf_sandbox {
    lua_State *lua;
    int64_t steps_left; /* instructions; library functions are charged by what they do */
    size_t memory_left; /* bytes */
    bool steps_ran_out;
    bool memory_ran_out; /* Lua was refused memory, perhaps to get it after it had collected */
    bool memory_spent;   /* a script that asked for more was ended */
    int64_t steps;       /* as given, for messages */
    size_t memory;
    void *user; /* of whoever made it */
    /* Gets each line that the script prints; NULL: nobody does. */
    void (*print)(void *user, const char *line, size_t bytes);

    bool running;
    int stride;        /* instructions between two looks at the budget */
    size_t largest;    /* block so far, bytes */
    int64_t looked_ns; /* when the budget was last looked at, by the thread's own clock */
} wf_sandbox;

/* Makes the state; false: no memory. Its address must not change until wf_sandbox_close. */
bool wf_sandbox_open(wf_sandbox *sandbox, int64_t steps, size_t memory_bytes);
void wf_sandbox_close(wf_sandbox *sandbox);

wf_sandbox *wf_sandbox_of(lua_State *lua);

/* Takes steps from the budget; raises a Lua error when they are spent. */
void wf_sandbox_charge(lua_State *lua, double steps);

/* Whether steps or memory have ended the script: nothing in it may go on. */
bool wf_sandbox_is_spent(const wf_sandbox *sandbox);

/* Raise the errors of spent steps and of spent memory. */
void wf_sandbox_say_spent(lua_State *lua);
void wf_sandbox_no_memory(lua_State *lua);

/* Takes bytes of memory that is not Lua's own from the limit; raises a Lua error. */
void wf_sandbox_take(lua_State *lua, size_t bytes);

/* Loads text (never binary) and calls it: LUA_OK with its results on the stack (count results),
 * or an error with its message there. */
int wf_sandbox_run(wf_sandbox *sandbox, const char *text, size_t size, const char *name,
                   int results);

#endif
