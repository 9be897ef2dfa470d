#ifndef WF_TRACER_SCENE_LUA_NODE_H
#define WF_TRACER_SCENE_LUA_NODE_H

#include "tracer/scene/builder.h"

/* Solids, cameras and lights as values of a script. Each is a node of the builder's graph; a
 * method makes a new node around the old one, which stays as it is. All raise Lua errors that
 * begin with `what`, the function of the script that was called. */

/* The name of their type among Lua's userdata: an int, the node's index. */
#define WF_LUA_NODE "weft solid"

void wf_push_node(lua_State *lua, int node);

/* The node that argument `arg` is. */
int wf_check_node(lua_State *lua, int arg, const char *what);

/* The same where only a solid will do; number: which value of the call it is, for messages. */
int wf_check_solid(lua_State *lua, int arg, int number, const char *what);

/* Pushes a node of one kind around that of argument 1; returns 1, as Lua's functions do. A
 * camera or a light that is moved is still the scene's camera, and that light. */
int wf_wrap_node(lua_State *lua, wf_node_kind kind, int index, const char *what);

#endif
