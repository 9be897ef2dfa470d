#ifndef WF_TRACER_SCENE_ADVICE_H
#define WF_TRACER_SCENE_ADVICE_H

#include <lua.h>

#include "tracer/scene/builder.h"

/* What can be traced, and is likely not what was meant: warnings that say what to write
 * instead. */

/* Where the script is. */
wf_place wf_place_here(lua_State *lua);

/* Warns "file:line: what: message" of where the script is; of one place once, and of a few
 * places at most. */
void wf_scene_warn(lua_State *lua, const char *what, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* The same of a place that was kept; {0}: of the scene as a whole. */
void wf_scene_warn_at(wf_builder *builder, wf_place place, const char *what, const char *format,
                      ...) __attribute__((format(printf, 4, 5)));

/* Warns of a color that seems to count from 0 to 255. lit: it is the share of light that a
 * surface reflects; else it is light, which may be bright. */
void wf_advise_color(lua_State *lua, const char *what, const float rgb[3], bool lit);

/* Warns of what only shows when the script is done. */
void wf_advise(lua_State *lua);

#endif
