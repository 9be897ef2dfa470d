/* Warnings of what is likely not what a scene's author meant. */
#include "tracer/scene/advice.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "tracer/scene/lua_globals.h"

/* ---- Places ---- */

typedef struct file_name {
    char text[LUA_IDSIZE];
} file_name;

static int file_number(lua_State *lua, wf_builder *b, const char *name) {
    for (int n = (int)b->files.count - 1; n >= 0; n--)
        if (!strcmp(((const file_name *)b->files.items)[n].text, name)) return n;
    file_name *added = wf_list_grow(lua, &b->files, sizeof *added, 1);
    snprintf(added->text, sizeof added->text, "%s", name);
    return (int)b->files.count - 1;
}

wf_place wf_place_here(lua_State *lua) {
    lua_Debug at;
    for (int level = 0; lua_getstack(lua, level, &at); level++) {
        lua_getinfo(lua, "Sl", &at);
        if (at.currentline > 0)
            return (wf_place){file_number(lua, wf_builder_of(lua), at.short_src),
                              at.currentline};
    }
    return (wf_place){-1, 0};
}

/* ---- Saying it ---- */

static bool said_before(wf_builder *b, wf_place place, const char *what) {
    for (int n = 0; n < b->advice_count && place.line > 0; n++)
        if (b->advice[n].place.file == place.file && b->advice[n].place.line == place.line &&
            !strcmp(b->advice[n].what, what))
            return true;
    if (b->advice_count == WF_MOST_ADVICE) return true;
    b->advice[b->advice_count].place = place;
    b->advice[b->advice_count++].what = what;
    return false;
}

static void say(wf_builder *b, wf_place place, const char *what, const char *message) {
    const wf_load_options *o = b->options;
    char text[700];
    if (!o->warn || said_before(b, place, what)) return;
    if (place.line > 0)
        snprintf(text, sizeof text, "%s:%d: %s: %s",
                 ((const file_name *)b->files.items)[place.file].text, place.line, what,
                 message);
    else
        snprintf(text, sizeof text, "%s: %s", what, message);
    o->warn(o->tell_user, text);
    if (b->advice_count == WF_MOST_ADVICE)
        o->warn(o->tell_user, "there may be more like this, of which nothing is said");
}

void wf_scene_warn(lua_State *lua, const char *what, const char *format, ...) {
    char message[512];
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    say(wf_builder_of(lua), wf_place_here(lua), what, message);
}

void wf_scene_warn_at(wf_builder *b, wf_place place, const char *what, const char *format,
                      ...) {
    char message[512];
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    say(b, place, what, message);
}

/* ---- Colors ---- */

/* Light may be as bright as it likes, but {255, 240, 200} is not what anybody computes with. */
static bool counts_to_255(const float rgb[3]) {
    float most = fmaxf(rgb[0], fmaxf(rgb[1], rgb[2]));
    bool whole = true;
    for (int c = 0; c < 3; c++) whole &= rgb[c] == floorf(rgb[c]);
    return whole && most > 200 && most < 256;
}

void wf_advise_color(lua_State *lua, const char *what, const float rgb[3], bool lit) {
    float most = fmaxf(rgb[0], fmaxf(rgb[1], rgb[2]));
    if (!(lit ? most > 1 : counts_to_255(rgb))) return;
    if (most > 2 && most < 256)
        wf_scene_warn(lua, what,
                      "colors count from 0 to 1, and {%g, %g, %g} has %g; if it counts to 255, "
                      "write {%.3g, %.3g, %.3g}",
                      (double)rgb[0], (double)rgb[1], (double)rgb[2], (double)most,
                      pow((double)rgb[0] / 255, 2.2), pow((double)rgb[1] / 255, 2.2),
                      pow((double)rgb[2] / 255, 2.2));
    else
        wf_scene_warn(lua, what, "a surface of color %g reflects more light than it gets",
                      (double)most);
}

/* ---- At the end ---- */

static bool is_solid(const wf_builder *b, const wf_node *node) {
    while (node->kind == WF_NODE_OP && node->child_count)
        node = wf_node_at(b, ((const int *)b->children.items)[node->first_child]);
    return node->kind != WF_NODE_CAMERA && node->kind != WF_NODE_LIGHT;
}

/* The method that made a node, or one like it; NULL: it was a function. */
static const char *method_of(const wf_builder *b, const wf_node *node) {
    static const char *const motions[] = {[WF_OP_PLACE] = "translate",
                                          [WF_OP_VELOCITY] = "velocity",
                                          [WF_OP_SPIN] = "spin",
                                          [WF_OP_KEYS] = "keyframes"};
    if (node->kind == WF_NODE_OP)
        return motions[((const wf_op *)b->ops.items)[node->index].kind];
    if (node->kind == WF_NODE_MATERIAL) return "material";
    return node->kind == WF_NODE_WIDTH ? "temporal_width" : NULL;
}

static void advise_unused(lua_State *lua, wf_builder *b) {
    (void)lua;
    for (size_t n = 0; n < b->nodes.count && b->advice_count < WF_MOST_ADVICE; n++) {
        const wf_node *node = wf_node_at(b, (int)n);
        if (node->used || !is_solid(b, node)) continue;
        const char *method = method_of(b, node);
        if (method)
            wf_scene_warn_at(
                b, node->place, "solid",
                "what a method returns is not in the picture, and the solid itself "
                "is as it was; write s = s:%s{..}, or add(s:%s{..})",
                method, method);
        else
            wf_scene_warn_at(b, node->place, "solid",
                             "it is not in the picture; add(..) puts it there");
    }
}

/* Whether a solid of the picture can be seen without light. */
static bool is_bright(const wf_material *m) {
    return m->unlit || m->ambient > 0.1f || m->reflect > 0 || m->refract > 0;
}

static void advise_dark(lua_State *lua, wf_builder *b) {
    const wf_solid *solids = b->out_solids.items;
    const wf_material *materials = b->materials.items;
    (void)lua;
    if (b->lights.count) return;
    for (size_t n = 0; n < b->out_solids.count; n++)
        if (is_bright(&materials[solids[n].material])) return;
    if (b->out_solids.count)
        say(b, (wf_place){0}, "light",
            "there is none, and nothing is unlit; light{point={4, 8, 5}} makes one");
}

static void advise_empty(lua_State *lua, wf_builder *b) {
    (void)lua;
    if (!b->out_solids.count)
        say(b, (wf_place){0}, "scene", "nothing is in the picture; add(sphere{}) adds a solid");
}

void wf_advise(lua_State *lua) {
    static void (*const all[])(lua_State *, wf_builder *) = {
        advise_unused, advise_empty, advise_dark, wf_advise_params, wf_advise_globals};
    for (size_t n = 0; n < sizeof all / sizeof *all; n++) all[n](lua, wf_builder_of(lua));
}
