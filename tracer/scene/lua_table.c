#include "tracer/scene/lua_table.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "filters/base/spelling.h"

/* Where the script is, whichever function of ours or of the library has been called. */
static void push_place(lua_State *lua) {
    lua_Debug at;
    for (int level = 0; lua_getstack(lua, level, &at); level++) {
        lua_getinfo(lua, "Sl", &at);
        if (at.currentline <= 0) continue;
        lua_pushfstring(lua, "%s:%d: ", at.short_src, at.currentline);
        return;
    }
    lua_pushliteral(lua, "");
}

int wf_scene_error(lua_State *lua, const char *what, const char *format, ...) {
    char text[512];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    push_place(lua);
    lua_pushfstring(lua, "%s: %s", what, text);
    lua_concat(lua, 2);
    return lua_error(lua);
}

int wf_scene_unknown(lua_State *lua, const char *what, const char *name,
                     const luaL_Reg *names) {
    wf_spelling spelling = {.text = name};
    for (; names->name; names++) wf_spelling_offer(&spelling, names->name);
    if (spelling.best)
        return wf_scene_error(lua, what, "there is no '%.60s'; did you mean %s?", name,
                              spelling.best);
    return wf_scene_error(lua, what, "there is no '%.60s'", name);
}

/* ---- Values ---- */

static int wrong(lua_State *lua, const char *what, const char *name, const char *should) {
    char seen[80];
    lua_Number number = lua_tonumber(lua, -1);
    if (lua_type(lua, -1) == LUA_TNUMBER)
        snprintf(seen, sizeof seen, "%.9g", number);
    else if (lua_type(lua, -1) == LUA_TSTRING)
        snprintf(seen, sizeof seen, "'%.40s'", lua_tostring(lua, -1));
    else
        snprintf(seen, sizeof seen, "%s", luaL_typename(lua, -1));
    return wf_scene_error(lua, what, "%s must be %s, not %s", name, should, seen);
}

/* Sizes beyond these would leave the range in which squares and products of them are numbers.
 */
#define LARGEST  0x1p200
#define SMALLEST 0x1p-200

double wf_read_number(lua_State *lua, const char *what, const char *name) {
    double v = lua_tonumber(lua, -1);
    if (lua_type(lua, -1) != LUA_TNUMBER || !isfinite(v) || fabs(v) > LARGEST)
        wrong(lua, what, name, "a finite number");
    return v;
}

static double positive(lua_State *lua, const char *what, const char *name) {
    double v = wf_read_number(lua, what, name);
    if (v < SMALLEST) wrong(lua, what, name, "a number > 0");
    return v;
}

wf_vec wf_read_vector(lua_State *lua, const char *what, const char *name) {
    double v[3];
    if (lua_type(lua, -1) != LUA_TTABLE || lua_rawlen(lua, -1) != 3)
        wrong(lua, what, name, "three numbers, {x, y, z}");
    for (int k = 0; k < 3; k++) {
        lua_rawgeti(lua, -1, k + 1);
        v[k] = wf_read_number(lua, what, name);
        lua_pop(lua, 1);
    }
    return (wf_vec){v[0], v[1], v[2]};
}

static void number(lua_State *lua, const char *what, const char *name, void *to) {
    *(double *)to = wf_read_number(lua, what, name);
}

static void read_positive(lua_State *lua, const char *what, const char *name, void *to) {
    *(double *)to = positive(lua, what, name);
}

static void share(lua_State *lua, const char *what, const char *name, void *to) {
    double v = wf_read_number(lua, what, name);
    if (v < 0 || v > 1) wrong(lua, what, name, "a number from 0 to 1");
    *(double *)to = v;
}

static void not_negative(lua_State *lua, const char *what, const char *name, void *to) {
    double v = wf_read_number(lua, what, name);
    if (v < 0) wrong(lua, what, name, "a number >= 0");
    *(double *)to = v;
}

static void vector(lua_State *lua, const char *what, const char *name, void *to) {
    *(wf_vec *)to = wf_read_vector(lua, what, name);
}

static void direction(lua_State *lua, const char *what, const char *name, void *to) {
    wf_vec v = wf_read_vector(lua, what, name);
    double far = fmax(fabs(v.x), fmax(fabs(v.y), fabs(v.z)));
    if (!(far >= SMALLEST))
        wf_scene_error(lua, what, "%s must be a direction, and {0, 0, 0} is none", name);
    v = (wf_vec){v.x / far, v.y / far, v.z / far};
    double size = sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    *(wf_vec *)to = (wf_vec){v.x / size, v.y / size, v.z / size};
}

static void positives(lua_State *lua, const char *what, const char *name, void *to) {
    wf_vec v = wf_read_vector(lua, what, name);
    if (!(v.x >= SMALLEST && v.y >= SMALLEST && v.z >= SMALLEST))
        wf_scene_error(lua, what, "%s must be three numbers > 0, not {%g, %g, %g}", name, v.x,
                       v.y, v.z);
    *(wf_vec *)to = v;
}

static void pair(lua_State *lua, const char *what, const char *name, void *to) {
    double v[2];
    if (lua_type(lua, -1) != LUA_TTABLE || lua_rawlen(lua, -1) != 2)
        wrong(lua, what, name, "two numbers");
    for (int k = 0; k < 2; k++) {
        lua_rawgeti(lua, -1, k + 1);
        not_negative(lua, what, name, &v[k]);
        lua_pop(lua, 1);
    }
    memcpy(to, v, sizeof v);
}

static void color(lua_State *lua, const char *what, const char *name, void *to) {
    double v[3];
    bool grey = lua_type(lua, -1) == LUA_TNUMBER;
    if (!grey && (lua_type(lua, -1) != LUA_TTABLE || lua_rawlen(lua, -1) != 3))
        wrong(lua, what, name, "a color, {r, g, b} or a grey");
    for (int k = 0; k < 3; k++) {
        if (!grey) lua_rawgeti(lua, -1, k + 1);
        v[k] = wf_read_number(lua, what, name);
        if (v[k] < 0 || v[k] > 65504) wrong(lua, what, name, "from 0 to 65504");
        if (!grey) lua_pop(lua, 1);
        ((float *)to)[k] = (float)v[k];
    }
}

static void boolean(lua_State *lua, const char *what, const char *name, void *to) {
    if (lua_type(lua, -1) != LUA_TBOOLEAN) wrong(lua, what, name, "true or false");
    *(bool *)to = lua_toboolean(lua, -1);
}

static void text(lua_State *lua, const char *what, const char *name, void *to) {
    if (lua_type(lua, -1) != LUA_TSTRING) wrong(lua, what, name, "a text");
    *(const char **)to = lua_tostring(lua, -1);
}

static void other(lua_State *lua, const char *what, const char *name, void *to) {
    (void)lua, (void)what, (void)name, (void)to;
}

typedef void read_fn(lua_State *lua, const char *what, const char *name, void *to);

static read_fn *const read[] = {
    [WF_FIELD_NUMBER] = number,       [WF_FIELD_POSITIVE] = read_positive,
    [WF_FIELD_SHARE] = share,         [WF_FIELD_NOT_NEGATIVE] = not_negative,
    [WF_FIELD_VECTOR] = vector,       [WF_FIELD_DIRECTION] = direction,
    [WF_FIELD_POSITIVES] = positives, [WF_FIELD_PAIR] = pair,
    [WF_FIELD_COLOR] = color,         [WF_FIELD_BOOL] = boolean,
    [WF_FIELD_TEXT] = text,           [WF_FIELD_OTHER] = other,
};

/* ---- Tables ---- */

static void unknown(lua_State *lua, const char *what, const wf_field_row *rows,
                    const char *name) {
    wf_spelling spelling = {.text = name};
    char list[256] = "";
    size_t used = 0;
    for (const wf_field_row *row = rows; row->name; row++) {
        wf_spelling_offer(&spelling, row->name);
        if (used < sizeof list - 1)
            used += (size_t)snprintf(list + used, sizeof list - used, "%s%s", used ? ", " : "",
                                     row->name);
    }
    if (spelling.best)
        wf_scene_error(lua, what, "there is no field '%.60s'; did you mean %s?", name,
                       spelling.best);
    wf_scene_error(lua, what, "there is no field '%.60s'; it takes %s", name,
                   *list ? list : "no named fields");
}

static void check_keys(lua_State *lua, int index, const char *what, const wf_field_row *rows,
                       int positions) {
    lua_pushnil(lua);
    while (lua_next(lua, index)) {
        lua_pop(lua, 1);
        if (lua_type(lua, -1) == LUA_TSTRING) {
            const char *name = lua_tostring(lua, -1);
            const wf_field_row *row = rows;
            while (row->name && strcmp(row->name, name)) row++;
            if (!row->name) unknown(lua, what, rows, name);
        } else {
            lua_Integer at = lua_isinteger(lua, -1) ? lua_tointeger(lua, -1) : 0;
            if (at < 1 || at > positions)
                wf_scene_error(lua, what,
                               positions ? "it takes at most %d values without a name"
                                         : "its values need names; %d may go without",
                               positions);
        }
    }
}

void wf_read_fields(lua_State *lua, int index, const char *what, const wf_field_row *rows,
                    int positions, void *out) {
    index = lua_absindex(lua, index);
    if (lua_type(lua, index) != LUA_TTABLE) {
        lua_pushvalue(lua, index);
        wf_scene_error(lua, what, "it takes a table, as in %s{%s%s}, not %s", what,
                       rows->name ? rows->name : "", rows->name ? "=.." : "..",
                       luaL_typename(lua, -1));
    }
    check_keys(lua, index, what, rows, positions);
    for (const wf_field_row *row = rows; row->name; row++) {
        lua_pushstring(lua, row->name);
        lua_rawget(lua, index);
        if (!lua_isnil(lua, -1))
            read[row->kind](lua, what, row->name, (char *)out + row->offset);
        else if (row->required)
            wf_scene_error(lua, what, "the field %s= is missing", row->name);
        lua_pop(lua, 1);
    }
}
