/* Finds and loads modules: parts of weft that are slow to load. */
#include "convert/base/module.h"

#include <dlfcn.h>
#include <link.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define PLACES_FROM_HERE 3

/* ---- Where modules are ---- */

/* Writes the directory of the object that this code is part of: a shared library, or the
 * program. The loader knows the program by the name it was called with, which may be no path.
 */
static bool own_directory(char path[PATH_MAX]) {
    static const char anchor = 0;
    Dl_info info;
    struct link_map *map = NULL;
    if (!dladdr1(&anchor, &info, (void **)&map, RTLD_DL_LINKMAP) || !map) return false;
    const char *object = *map->l_name ? map->l_name : "/proc/self/exe";
    if (!realpath(object, path)) return false;
    *strrchr(path, '/') = '\0';
    return true;
}

/* The place of weft-NAME.so that place number `index` is; false past the last one. */
static bool place_at(int index, const char *directory, const char *name, char path[PATH_MAX]) {
    /* Beside the library; beside a program in the build tree; from an installed bin. */
    static const char *const from_here[PLACES_FROM_HERE] = {
        "/weft/", "/" WF_MODULE_LIBDIR "/weft/", "/../" WF_MODULE_LIBDIR "/weft/"};
    if (index > PLACES_FROM_HERE) return false;
    bool here = index < PLACES_FROM_HERE;
    int length = snprintf(path, PATH_MAX, "%s%sweft-%s.so", here ? directory : WF_MODULE_DIR,
                          here ? from_here[index] : "/", name);
    if (length >= PATH_MAX) *path = '\0';
    return true;
}

static bool find_module(const char *name, char path[PATH_MAX]) {
    char directory[PATH_MAX];
    bool known = own_directory(directory);
    for (int i = known ? 0 : PLACES_FROM_HERE; place_at(i, directory, name, path); i++)
        if (!access(path, F_OK)) return true;
    return false;
}

/* ---- Loading ---- */

/* What a module needs of the system, as Debian 12 calls it. */
static const char *package_of(const char *name) {
    static const struct {
        const char *name, *package;
    } packages[] = {{"oiio", "libopenimageio2.4"},
                    {"ocio", "libopencolorio2.1"},
                    {"plot", "libcairo2"},
                    {"libav", "libavformat59 (and libavcodec59)"},
                    {"deinterlace", "libavfilter8"}};
    for (size_t i = 0; i < sizeof packages / sizeof *packages; i++)
        if (!strcmp(packages[i].name, name)) return packages[i].package;
    return "it was linked with";
}

static const char *loader_says(void) {
    const char *says = dlerror();
    return says ? says : "the loader does not say why";
}

bool wf_module_built(const char *name) {
    char path[PATH_MAX];
    return find_module(name, path);
}

weft_status wf_module_symbol(const char *name, const char *symbol, void **symbol_out,
                             weft_error *err) {
    char path[PATH_MAX];
    *symbol_out = NULL;
    if (!find_module(name, path))
        return wf_fail(
            err, WEFT_FAILED,
            "the module weft-%s.so is not there: it is looked for in weft/ beside the "
            "library and in %s; install weft whole",
            name, WF_MODULE_DIR);
    /* Never closed: a library such as OpenImageIO leaves threads behind. Loading one again
     * costs microseconds, and the loader has the lock. */
    void *module = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!module)
        return wf_fail(err, WEFT_FAILED,
                       "the module %.300s cannot be loaded: %.400s; it needs the package %s",
                       path, loader_says(), package_of(name));
    *symbol_out = dlsym(module, symbol);
    if (*symbol_out) return WEFT_OK;
    return wf_fail(
        err, WEFT_FAILED,
        "the module %.300s is of another version of weft: %.400s; install weft whole", path,
        loader_says());
}
