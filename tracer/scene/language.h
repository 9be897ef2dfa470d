#ifndef WF_TRACER_SCENE_LANGUAGE_H
#define WF_TRACER_SCENE_LANGUAGE_H

#include <lauxlib.h>

/* The scene language: what a script may call. Each list is defined by the file after it and
 * ends with {NULL, NULL}; to add a function is to add a row to one of them. */

/* Functions that make solids, cameras, lights and textures, and those that are said by
 * themselves. */
extern const luaL_Reg wf_lua_list_solids[]; /* lua_solids.c */
extern const luaL_Reg wf_lua_sets[];        /* lua_csg.c */
extern const luaL_Reg wf_lua_views[];       /* lua_views.c */
extern const luaL_Reg wf_lua_words[];       /* lua_words.c */
extern const luaL_Reg wf_lua_textures[];    /* lua_textures.c */

/* Makes functions of the solids that are made from a table with keys (lua_solids.c). */
void wf_lua_open_forms(lua_State *lua);

/* Methods of solids, cameras and lights, and operators between solids. */
extern const luaL_Reg wf_lua_motions[];       /* lua_motion.c */
extern const luaL_Reg wf_lua_looks[];         /* lua_looks.c */
extern const luaL_Reg wf_lua_set_operators[]; /* lua_csg.c */

/* The name of textures' type among Lua's userdata: a wf_texture. */
#define WF_LUA_TEXTURE "weft texture"

/* Makes all of this known to a sandbox. Raises Lua errors. */
void wf_open_language(lua_State *lua);

#endif
