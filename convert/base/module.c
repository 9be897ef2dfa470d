/* Finds and loads modules: parts of weft that are slow to load. */
#include "convert/base/module.h"

#include <dlfcn.h>
#include <errno.h>
#include <link.h>
#include <limits.h>
#include <pthread.h>
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

/* ---- Threads ---- */

/* Libraries that OpenImageIO 2.4 is linked with start threads as they are loaded, and end the
 * process where the system allows none. So many are tried first. */
#define THREADS_OF_LIBRARIES 8

static void *do_nothing(void *user) {
    return user;
}

/* Returns 0 or an errno. */
static int try_threads(void) {
    pthread_t thread[THREADS_OF_LIBRARIES];
    pthread_attr_t how;
    int started = 0, code = pthread_attr_init(&how);
    while (!code && started < THREADS_OF_LIBRARIES) {
        code = pthread_create(&thread[started], &how, do_nothing, NULL);
        started += !code;
    }
    for (int i = 0; i < started; i++) pthread_join(thread[i], NULL);
    return code;
}

static weft_status check_threads(const char *name, weft_error *err) {
    int code = strcmp(name, "oiio") ? 0 : try_threads();
    if (!code) return WEFT_OK;
    return wf_fail(err, code == ENOMEM ? WEFT_NO_MEMORY : WEFT_FAILED,
                   "OpenImageIO starts threads, and the system allows no more of them: %s; "
                   "raise the limit (ulimit -u), or write what needs no OpenImageIO",
                   strerror(code));
}

/* ---- What a module needs ---- */

/* The library that a module is for, and what brings it on Debian 12. */
typedef struct needed {
    const char *name, *library, *package, *to_build;
} needed;

static const needed *needed_by(const char *name) {
    static const needed rows[] = {
        {"oiio", "OpenImageIO", "libopenimageio2.4", "libopenimageio-dev"},
        {"ocio", "OpenColorIO", "libopencolorio2.1", "libopencolorio-dev"},
        {"plot", "Cairo", "libcairo2", "libcairo2-dev"},
        {"libav", "libav", "libavformat59 (and libavcodec59)",
         "libavformat-dev, libavcodec-dev and libswresample-dev"},
        {"deinterlace", "libavfilter", "libavfilter8", "libavfilter-dev"}};
    static const needed other = {"", "a module", "it was linked with", "what it is made of"};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (!strcmp(rows[i].name, name)) return &rows[i];
    return &other;
}

/* WF_MODULES is what was built: "weft-oiio weft-plot ". */
static bool was_built(const char *name) {
    char word[64];
    snprintf(word, sizeof word, "weft-%.40s ", name);
    return strstr(WF_MODULES, word);
}

/* An error where the module is not there; else path is where it is. */
static weft_status locate(const char *name, const char *what, char path[PATH_MAX],
                          weft_error *err) {
    const needed *n = needed_by(name);
    if (find_module(name, path)) return WEFT_OK;
    if (!was_built(name))
        return wf_fail(err, WEFT_FAILED,
                       "%.600s needs %s, which this weft was built without: install %s and "
                       "build it again",
                       what, n->library, n->to_build);
    return wf_fail(err, WEFT_FAILED,
                   "%.400s needs %s, and the module weft-%.40s.so for it is not there: it is "
                   "looked for in weft/ beside the library and in %s; install weft-plugins, or "
                   "weft whole",
                   what, n->library, name, WF_MODULE_DIR);
}

weft_status wf_module_check(const char *name, const char *what, weft_error *err) {
    char path[PATH_MAX];
    return locate(name, what, path, err);
}

/* ---- Loading ---- */

static const char *loader_says(void) {
    const char *says = dlerror();
    return says ? says : "the loader does not say why";
}

weft_status wf_module_symbol(const char *name, const char *symbol, const char *what,
                             void **symbol_out, weft_error *err) {
    char path[PATH_MAX];
    *symbol_out = NULL;
    weft_status status = locate(name, what, path, err);
    if (!status) status = check_threads(name, err);
    if (status) return status;
    /* Never closed: a library such as OpenImageIO leaves threads behind. Loading one again
     * costs microseconds, and the loader has the lock. */
    errno = 0;
    void *module = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!module && errno == ENOMEM)
        return wf_fail(err, WEFT_NO_MEMORY, "the module %.300s: no memory to load it", path);
    if (!module)
        return wf_fail(
            err, WEFT_FAILED,
            "%.200s needs the module %.200s, which cannot be loaded: %.300s; it needs "
            "the package %s",
            what, path, loader_says(), needed_by(name)->package);
    *symbol_out = dlsym(module, symbol);
    if (*symbol_out) return WEFT_OK;
    return wf_fail(
        err, WEFT_FAILED,
        "the module %.300s is of another version of weft: %.400s; install weft whole", path,
        loader_says());
}
