/* Reads the tables and values of a script, with errors that say what was expected. */
#include "tracer/scene/lua_table.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "tracer/scene/guess.h"
#include "tracer/scene/vec.h"

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

double wf_read_entry(lua_State *lua, const char *what, int at) {
    char name[24];
    snprintf(name, sizeof name, "value %d", at);
    lua_rawgeti(lua, -1, at);
    double v = wf_read_number(lua, what, name);
    lua_pop(lua, 1);
    return v;
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
    if (!(wf_vec_largest(v) >= SMALLEST))
        wf_scene_error(lua, what, "%s must be a direction, and {0, 0, 0} is none", name);
    *(wf_vec *)to = wf_vec_unit(v);
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
    bool gray = lua_type(lua, -1) == LUA_TNUMBER;
    if (!gray && (lua_type(lua, -1) != LUA_TTABLE || lua_rawlen(lua, -1) != 3))
        wrong(lua, what, name, "a color, {r, g, b} or a gray");
    for (int k = 0; k < 3; k++) {
        if (!gray) lua_rawgeti(lua, -1, k + 1);
        v[k] = wf_read_number(lua, what, name);
        if (v[k] < 0 || v[k] > 65504) wrong(lua, what, name, "from 0 to 65504");
        if (!gray) lua_pop(lua, 1);
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
    [WF_KEY_NUMBER] = number,       [WF_KEY_POSITIVE] = read_positive,
    [WF_KEY_SHARE] = share,         [WF_KEY_NOT_NEGATIVE] = not_negative,
    [WF_KEY_VECTOR] = vector,       [WF_KEY_DIRECTION] = direction,
    [WF_KEY_POSITIVES] = positives, [WF_KEY_PAIR] = pair,
    [WF_KEY_COLOR] = color,         [WF_KEY_BOOL] = boolean,
    [WF_KEY_TEXT] = text,           [WF_KEY_OTHER] = other,
};

/* ---- Tables ---- */

static void unknown(lua_State *lua, const char *what, const wf_lua_key *keys,
                    const char *name) {
    wf_guess guess = wf_guess_of(name);
    char list[256] = "";
    size_t used = 0;
    for (const wf_lua_key *key = keys; key->name; key++) {
        wf_guess_offer(&guess, key->name);
        if (used < sizeof list - 1)
            used += (size_t)snprintf(list + used, sizeof list - used, "%s%s", used ? ", " : "",
                                     key->name);
    }
    const char *found = wf_guess_found(&guess);
    if (found)
        wf_scene_error(lua, what, "there is no key '%.60s'; did you mean %s?", name, found);
    wf_scene_error(lua, what, "there is no key '%.60s'; it takes %s", name,
                   *list ? list : "no keys");
}

static void check_keys(lua_State *lua, int index, const char *what, const wf_lua_key *keys,
                       int positions) {
    lua_pushnil(lua);
    while (lua_next(lua, index)) {
        lua_pop(lua, 1);
        if (lua_type(lua, -1) == LUA_TSTRING) {
            const char *name = lua_tostring(lua, -1);
            const wf_lua_key *key = keys;
            while (key->name && strcmp(key->name, name)) key++;
            if (!key->name) unknown(lua, what, keys, name);
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

bool wf_has_key(lua_State *lua, int index, const char *name) {
    lua_getfield(lua, index, name);
    bool there = !lua_isnil(lua, -1);
    lua_pop(lua, 1);
    return there;
}

void wf_only_value(lua_State *lua, const char *what, int last) {
    int first = last > 1 ? 2 : 1, given = lua_gettop(lua) - first + 1;
    if (given == 3 && lua_isnumber(lua, first) && lua_isnumber(lua, first + 2))
        wf_scene_error(lua, what, "write %s{%g, %g, %g}, with braces", what,
                       lua_tonumber(lua, first), lua_tonumber(lua, first + 1),
                       lua_tonumber(lua, first + 2));
    if (given > 1) wf_scene_error(lua, what, "it takes one value, not %d", given);
    lua_settop(lua, last);
}

void wf_read_keys(lua_State *lua, int index, const char *what, const wf_lua_key *keys,
                  int positions, void *out) {
    if (index > 0) wf_only_value(lua, what, index);
    index = lua_absindex(lua, index);
    if (lua_type(lua, index) != LUA_TTABLE) {
        lua_pushvalue(lua, index);
        wf_scene_error(lua, what, "it takes a table, as in %s{%s%s}, not %s", what,
                       keys->name ? keys->name : "", keys->name ? "=.." : "..",
                       luaL_typename(lua, -1));
    }
    check_keys(lua, index, what, keys, positions);
    for (const wf_lua_key *key = keys; key->name; key++) {
        lua_pushstring(lua, key->name);
        lua_rawget(lua, index);
        if (!lua_isnil(lua, -1))
            read[key->kind](lua, what, key->name, (char *)out + key->offset);
        else if (key->required)
            wf_scene_error(lua, what, "the key %s= is missing", key->name);
        lua_pop(lua, 1);
    }
}
