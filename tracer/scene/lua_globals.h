#ifndef WF_TRACER_SCENE_LUA_GLOBALS_H
#define WF_TRACER_SCENE_LUA_GLOBALS_H

#include "tracer/scene/builder.h"

/* The values that a script is given, and which of them it asks for. */

/* Defines param, raster, and what is said of names that nothing defines. */
void wf_lua_open_globals(lua_State *lua);

/* Warn of values of param that nobody asked for, and of globals that nothing defined. */
void wf_advise_params(lua_State *lua, wf_builder *builder);
void wf_advise_globals(lua_State *lua, wf_builder *builder);

/* Look among all globals, and among what Lua's libraries hold, for what was meant by a name;
 * the text lives as long as the state, or NULL. */
const char *wf_lua_meant_global(lua_State *lua, const char *name);
const char *wf_lua_meant_field(lua_State *lua, const char *name);

#endif
