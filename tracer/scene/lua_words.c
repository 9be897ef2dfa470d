/* What else a script may say: what is in the picture, how long it lasts, other files. */
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tracer/scene/advice.h"
#include "tracer/scene/language.h"
#include "tracer/scene/lua_node.h"
#include "tracer/scene/lua_table.h"
#include "tracer/scene/script.h"

/* ---- The picture ---- */

static int call_add(lua_State *lua) {
    int count = lua_gettop(lua);
    if (!count) wf_scene_error(lua, "add", "it takes solids, and there are none");
    for (int k = 1; k <= count; k++) {
        int node = wf_check_node(lua, k, "add");
        wf_node_kind kind = (wf_node_kind)wf_node_at(wf_builder_of(lua), node)->kind;
        if (kind == WF_NODE_CAMERA || kind == WF_NODE_LIGHT)
            wf_scene_error(lua, "add", "cameras and lights need not be added");
        wf_unfold(lua, node);
    }
    return 0;
}

static int call_duration(lua_State *lua) {
    wf_only_value(lua, "duration", 1);
    double seconds = wf_read_number(lua, "duration", "its value");
    if (!(seconds > 0) || seconds > 1e9)
        wf_scene_error(lua, "duration", "it is in seconds, > 0, not %g", seconds);
    wf_builder_of(lua)->scene->duration_s = seconds;
    return 0;
}

/* Takes alpha out of the table that background was given, which may have no other name; whether
 * a color is left. */
static bool take_alpha(lua_State *lua) {
    static const wf_lua_key keys[] = {{"alpha", WF_KEY_SHARE, 0, false}, {0}};
    double alpha = 1;
    wf_read_keys(lua, 1, "background", keys, 3, &alpha);
    wf_builder_of(lua)->scene->background_clear = (float)(1 - alpha);
    return lua_rawlen(lua, 1) > 0 || !wf_has_key(lua, 1, "alpha");
}

static int call_background(lua_State *lua) {
    static const wf_lua_key only[] = {{"color", WF_KEY_COLOR, 0, true}, {0}};
    wf_only_value(lua, "background", 1);
    if (lua_istable(lua, 1) && !take_alpha(lua)) return 0;
    lua_newtable(lua);
    lua_insert(lua, 1);
    lua_setfield(lua, 1, "color");
    wf_read_keys(lua, 1, "background", only, 0, wf_builder_of(lua)->scene->background);
    wf_advise_color(lua, "background", wf_builder_of(lua)->scene->background, false);
    return 0;
}

static int call_color_space(lua_State *lua) {
    wf_scene *scene = wf_builder_of(lua)->scene;
    if (lua_type(lua, 1) != LUA_TSTRING || lua_rawlen(lua, 1) >= sizeof scene->color_space)
        wf_scene_error(lua, "color_space", "it takes the name of a color space");
    strcpy(scene->color_space, lua_tostring(lua, 1));
    return 0;
}

static int call_depth(lua_State *lua) {
    wf_only_value(lua, "depth", 1);
    double depth = wf_read_number(lua, "depth", "its value");
    if (depth < 0 || depth > 32 || depth != floor(depth))
        wf_scene_error(lua, "depth",
                       "it is how many mirrors and panes a ray may pass, from 0 to 32");
    wf_builder_of(lua)->scene->depth_limit = (int)depth;
    return 0;
}

/* ---- Other files ---- */

#define MOST_INCLUDES 16

/* Where a file below the scene's folder really is; symbolic links do not lead out of it. */
static void find_below(lua_State *lua, const char *name, char path[PATH_MAX]) {
    const wf_builder *b = wf_builder_of(lua);
    char joined[PATH_MAX];
    int used = snprintf(joined, sizeof joined, "%s%s", b->folder, name);
    if (*name == '/' || used < 0 || used >= (int)sizeof joined)
        wf_scene_error(lua, "include", "'%.200s' must lie below the scene's own folder", name);
    if (!realpath(joined, path))
        wf_scene_error(lua, "include", "%.300s: %s", joined, strerror(errno));
    if (strncmp(path, b->folder, strlen(b->folder)))
        wf_scene_error(lua, "include", "'%.200s' leads out of the scene's own folder", name);
}

static int call_include(lua_State *lua) {
    wf_builder *b = wf_builder_of(lua);
    char path[PATH_MAX], why[300];
    if (lua_type(lua, 1) != LUA_TSTRING)
        wf_scene_error(lua, "include", "it takes the name of a file");
    find_below(lua, lua_tostring(lua, 1), path);
    if (b->include_depth == MOST_INCLUDES)
        wf_scene_error(lua, "include", "files include each other more than %d deep",
                       MOST_INCLUDES);
    size_t size;
    char *text = wf_script_read(path, b->sandbox.memory_left, &size, why, sizeof why);
    if (!text) wf_scene_error(lua, "include", "%s", why);
    lua_pushfstring(lua, "@%s", path);
    int status = luaL_loadbufferx(lua, text, size, lua_tostring(lua, -1), "t");
    free(text);
    if (status != LUA_OK) return lua_error(lua);
    wf_sandbox_charge(lua, (double)size / 64);
    b->include_depth++;
    status = lua_pcall(lua, 0, 1, 0);
    b->include_depth--;
    return status == LUA_OK ? 1 : lua_error(lua);
}

const luaL_Reg wf_lua_words[] = {{"background", call_background},
                                 {"duration", call_duration},
                                 {"color_space", call_color_space},
                                 {"depth", call_depth},
                                 {"add", call_add},
                                 {"include", call_include},
                                 {NULL, NULL}};
