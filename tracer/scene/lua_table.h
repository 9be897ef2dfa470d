#ifndef WF_TRACER_SCENE_LUA_TABLE_H
#define WF_TRACER_SCENE_LUA_TABLE_H

#include <lauxlib.h>

#include "tracer/scene/scene.h"

/* Tables of a scene, read by lists of the fields that they may have: a wrong field, a wrong
 * type and a number out of range are Lua errors that name them. */

typedef enum wf_field_kind {
    WF_FIELD_NUMBER,   /* double, finite */
    WF_FIELD_POSITIVE, /* double > 0 */
    WF_FIELD_SHARE,    /* double, 0..1 */
    WF_FIELD_NOT_NEGATIVE,
    WF_FIELD_VECTOR,    /* wf_vec: {x, y, z} */
    WF_FIELD_DIRECTION, /* wf_vec, made 1 long; {0, 0, 0} is an error */
    WF_FIELD_POSITIVES, /* wf_vec of numbers > 0 */
    WF_FIELD_PAIR,      /* double[2] >= 0 */
    WF_FIELD_COLOR,     /* float[3]: {r, g, b} or a grey */
    WF_FIELD_BOOL,      /* bool */
    WF_FIELD_TEXT,      /* const char *, that lives as long as the table */
    WF_FIELD_OTHER      /* looked at by whoever asked */
} wf_field_kind;

/* A field and where its value goes in the caller's struct. One that may be left out keeps what
 * the struct had. */
typedef struct wf_field_row {
    const char *name; /* NULL ends a list */
    wf_field_kind kind;
    size_t offset;
    bool required;
} wf_field_row;

/* Reads the table at index of the stack into out. what: "sphere", for messages. Entries
 * t[1], t[2] .. are allowed up to `positions`. */
void wf_read_fields(lua_State *lua, int index, const char *what, const wf_field_row *rows,
                    int positions, void *out);

/* One value, at the top of the stack; name: of the field, for messages. */
double wf_read_number(lua_State *lua, const char *what, const char *name);
wf_vec wf_read_vector(lua_State *lua, const char *what, const char *name);

/* Raises "what: there is no 'name'", with the nearest of the names there are. */
int wf_scene_unknown(lua_State *lua, const char *what, const char *name, const luaL_Reg *names);

/* Raises "what: message" with file and line of the script. */
int wf_scene_error(lua_State *lua, const char *what, const char *format, ...);

#endif
