/* Runs a scene file and takes over what it built. */
#include "tracer/scene/load.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tracer/scene/advice.h"
#include "tracer/scene/builder.h"
#include "tracer/scene/language.h"
#include "tracer/scene/lua_globals.h"
#include "tracer/scene/script.h"

/* ---- Files ---- */

/* The folder of a file as an absolute path that ends with a slash; free it. */
static char *folder_of(const char *path) {
    const char *slash = strrchr(path, '/');
    char *name = slash ? strndup(path, (size_t)(slash - path) + 1) : strdup(".");
    char *real = name ? realpath(name, NULL) : NULL;
    free(name);
    if (!real) return NULL;
    size_t size = strlen(real);
    char *folder = realloc(real, size + 2);
    if (!folder) {
        free(real);
        return NULL;
    }
    if (size && folder[size - 1] != '/') strcpy(folder + size, "/");
    return folder;
}

/* ---- What the script is given ---- */

/* How much a script may print, in bytes. */
#define MOST_PRINTED 65536

/* Prints within bounds: what follows is dropped, and that is said. */
static void print(void *user, const char *line, size_t bytes) {
    wf_builder *b = user;
    const wf_load_options *o = b->options;
    char text[1024];
    size_t size = bytes < sizeof text - 1 ? bytes : sizeof text - 1;
    if (!o->print || b->printed_bytes > MOST_PRINTED) return;
    for (size_t n = 0; n < size; n++)
        text[n] =
            (unsigned char)line[n] < ' ' && line[n] != '\t' && line[n] != '\n' ? '?' : line[n];
    text[size] = '\0';
    o->print(o->tell_user, text);
    b->printed_bytes += size + 16;
    if (b->printed_bytes > MOST_PRINTED)
        wf_scene_warn(b->sandbox.lua, "print", "that is enough; nothing more is printed");
}

static int open_scene(lua_State *lua) {
    wf_open_language(lua);
    wf_lua_open_globals(lua);
    return 0;
}

/* ---- What it left ---- */

/* Lists become the scene's arrays, which then own them. */
static void hand_over(wf_list *list, void *to, int *count) {
    memcpy(to, &list->items, sizeof list->items);
    *count = (int)list->count;
    *list = (wf_list){0};
}

static void finish_ops(lua_State *lua, wf_builder *b) {
    wf_light *lights = b->lights.items;
    b->scene->camera.op = wf_unfold_ops(lua, b->camera_node);
    for (size_t n = 0; n < b->lights.count; n++)
        lights[n].op = wf_unfold_ops(lua, ((const int *)b->light_nodes.items)[n]);
}

static int finish(lua_State *lua) {
    wf_builder *b = wf_builder_of(lua);
    if (b->camera_node < 0)
        return luaL_error(lua, "the scene has no camera; "
                               "camera{eye={0, 1, -5}, look_at={0, 0, 0}} makes one");
    finish_ops(lua, b);
    wf_advise(lua);
    return 0;
}

static void take_arrays(wf_builder *b) {
    wf_scene *s = b->scene;
    hand_over(&b->out_ops, &s->ops, &s->op_count);
    hand_over(&b->keys, &s->keys, &s->key_count);
    hand_over(&b->materials, &s->materials, &s->material_count);
    hand_over(&b->images, &s->images, &s->image_count);
    hand_over(&b->out_solids, &s->solids, &s->solid_count);
    hand_over(&b->planes, &s->planes, &s->plane_count);
    hand_over(&b->out_steps, &s->steps, &s->step_count);
    hand_over(&b->out_objects, &s->objects, &s->object_count);
    hand_over(&b->lights, &s->lights, &s->light_count);
}

static void free_lists(wf_builder *b) {
    wf_list *const lists[] = {&b->nodes,  &b->children,    &b->solids, &b->ops,
                              &b->widths, &b->light_nodes, &b->files};
    for (size_t n = 0; n < sizeof lists / sizeof *lists; n++) free(lists[n]->items);
}

/* ---- Messages ---- */

/* Looks for the name after `kind` in a message such as "attempt to call a nil value (global
 * 'spere')", which is what a typing error looks like. */
static bool named(const char *message, const char *kind, char name[64]) {
    const char *at = strstr(message, kind);
    return at && strstr(message, "a nil value") &&
           sscanf(at + strlen(kind), "%63[^']", name) == 1;
}

static void add_hint(lua_State *lua, const char *message, char *why, size_t why_size) {
    const char *meant = NULL;
    size_t used = strlen(why);
    char name[64];
    if (named(message, "(global '", name))
        meant = wf_lua_meant_global(lua, name);
    else if (named(message, "(field '", name) || named(message, "(method '", name))
        meant = wf_lua_meant_field(lua, name);
    if (meant && used < why_size)
        snprintf(why + used, why_size - used, "; did you mean %s?", meant);
    lua_settop(lua, 0);
}

/* Whether a message says where in the script it arose: "name:12: ..". */
static bool has_line(const char *message) {
    for (const char *c = strchr(message, ':'); c; c = strchr(c + 1, ':')) {
        size_t digits = strspn(c + 1, "0123456789");
        if (digits && c[1 + digits] == ':') return true;
    }
    return false;
}

static void explain(const wf_builder *b, const char *path, char *why, size_t why_size) {
    lua_State *lua = b->sandbox.lua;
    bool is_text = lua_type(lua, -1) == LUA_TSTRING;
    const char *message =
        is_text ? lua_tostring(lua, -1) : "it raised an error that is no text";
    bool memory = b->sandbox.memory_ran_out && strstr(message, "not enough memory");
    int used = snprintf(why, why_size, "%s%s%s", has_line(message) ? "" : path,
                        has_line(message) ? "" : ": ", message);
    if (memory && used > 0 && (size_t)used < why_size)
        snprintf(why + used, why_size - (size_t)used, " (%zu MB; --scene-memory allows more)",
                 b->sandbox.memory >> 20);
    for (char *c = why; *c; c++)
        if ((unsigned char)*c < ' ') *c = *c == '\n' ? ' ' : '?';
    if (is_text) add_hint(lua, message, why, why_size);
}

/* ---- Loading ---- */

static bool run(wf_builder *b, const char *text, size_t size, const char *path) {
    lua_State *lua = b->sandbox.lua;
    char name[4096];
    snprintf(name, sizeof name, "@%s", path);
    lua_pushcfunction(lua, open_scene);
    if (lua_pcall(lua, 0, 0, 0) != LUA_OK) return false;
    if (wf_sandbox_run(&b->sandbox, text, size, name, 0) != LUA_OK) return false;
    lua_pushcfunction(lua, finish);
    return lua_pcall(lua, 0, 0, 0) == LUA_OK;
}

/* The material of what has none. */
static bool first_material(wf_builder *b) {
    wf_material *m = calloc(16, sizeof *m);
    if (!m) return false;
    *m = (wf_material){.color = {0.8f, 0.8f, 0.8f}, .ambient = 0.1f, .diffuse = 0.9f};
    m->shininess = 40;
    m->index = 1.5;
    b->materials = (wf_list){m, 1, 16};
    return true;
}

bool wf_scene_load_text(const char *text, size_t size, const char *path,
                        const wf_load_options *options, wf_scene *scene, char *why,
                        size_t why_size) {
    wf_builder b = {.options = options, .scene = scene, .camera_node = -1};
    *scene = (wf_scene){.depth_limit = 5};
    b.folder = folder_of(path);
    snprintf(why, why_size, "%s: no memory", path);
    bool good = b.folder && first_material(&b) &&
                wf_sandbox_open(&b.sandbox, options->steps, options->memory_bytes);
    b.sandbox.user = &b;
    b.sandbox.print = print;
    if (good) {
        good = run(&b, text, size, path);
        if (!good) explain(&b, path, why, why_size);
    }
    wf_sandbox_close(&b.sandbox);
    take_arrays(&b);
    free_lists(&b);
    free(b.folder);
    return good;
}

bool wf_scene_load(const char *path, const wf_load_options *options, wf_scene *scene, char *why,
                   size_t why_size) {
    size_t size;
    *scene = (wf_scene){0};
    char *text = wf_script_read(path, options->memory_bytes, &size, why, why_size);
    if (!text) return false;
    bool good = wf_scene_load_text(text, size, path, options, scene, why, why_size);
    free(text);
    return good;
}
