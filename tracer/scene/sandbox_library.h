#ifndef WF_TRACER_SCENE_SANDBOX_LIBRARY_H
#define WF_TRACER_SCENE_SANDBOX_LIBRARY_H

#include <lua.h>

/* Opens base, table, string and math for a sandbox, without what does harm, each function
 * charged for what it does: a lua_CFunction. */
int wf_sandbox_open_libraries(lua_State *lua);

/* The functions of `table`, whose lengths are asked for once and charged as they are walked,
 * and a sort that is the same in every run (sandbox_table.c). Puts them into the table at the
 * top of the stack. */
void wf_sandbox_set_table(lua_State *lua);

int wf_sandbox_sort(lua_State *lua); /* table.sort */

/* `pairs`, which is the same in every run: numbers first, then texts, both ascending, then
 * what has no order (sandbox_pairs.c). */
void wf_sandbox_set_pairs(lua_State *lua);

/* Pushes a list of a table's keys in that order. */
void wf_sandbox_sort_keys(lua_State *lua, int table);

#endif
