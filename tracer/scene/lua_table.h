#ifndef WF_TRACER_SCENE_LUA_TABLE_H
#define WF_TRACER_SCENE_LUA_TABLE_H

#include <lauxlib.h>

#include "tracer/scene/scene.h"

/* Tables of a script, read by lists of the keys that they may have. All functions raise Lua
 * errors with file and line of the script: for a key that is not in the list, one that is
 * missing, a value of the wrong type, a number that is out of range. */

typedef enum wf_lua_key_kind {
    WF_KEY_NUMBER,       /* double, finite */
    WF_KEY_POSITIVE,     /* double > 0 */
    WF_KEY_SHARE,        /* double, 0..1 */
    WF_KEY_NOT_NEGATIVE, /* double >= 0 */
    WF_KEY_VECTOR,       /* wf_vec: {x, y, z} */
    WF_KEY_DIRECTION,    /* wf_vec, made 1 long; {0, 0, 0} is an error */
    WF_KEY_POSITIVES,    /* wf_vec of numbers > 0 */
    WF_KEY_PAIR,         /* double[2] >= 0 */
    WF_KEY_COLOR,        /* float[3]: {r, g, b}, or one number for a gray */
    WF_KEY_BOOL,         /* bool */
    WF_KEY_TEXT,         /* const char *, which lives as long as the table */
    WF_KEY_OTHER         /* any value, which the caller looks at itself */
} wf_lua_key_kind;

/* A key, and where its value goes in the caller's struct. One that may be left out keeps what
 * the struct had. */
typedef struct wf_lua_key {
    const char *name; /* NULL ends a list */
    wf_lua_key_kind kind;
    size_t offset;
    bool required;
} wf_lua_key;

/* Reads the table at index of the stack into out. what: the function of the script, "sphere",
 * for messages. Besides keys the table may have values without a name, t[1] .. t[positions]. */
void wf_read_keys(lua_State *lua, int index, const char *what, const wf_lua_key *keys,
                  int positions, void *out);

/* Raises an error if the function, or the method whose solid is argument 1, was called with
 * more than one value, as background(0, 0, 1) is. last: where that value is. */
void wf_only_value(lua_State *lua, const char *what, int last);

/* Whether the table at index has a value for a key. */
bool wf_has_key(lua_State *lua, int index, const char *name);

/* The value at the top of the stack; name: its key, for messages. */
double wf_read_number(lua_State *lua, const char *what, const char *name);
wf_vec wf_read_vector(lua_State *lua, const char *what, const char *name);

/* The number t[at] of the table at the top of the stack. */
double wf_read_entry(lua_State *lua, const char *what, int at);

/* Raises "what: message" with file and line of the script. Does not return. */
int wf_scene_error(lua_State *lua, const char *what, const char *format, ...);

#endif
