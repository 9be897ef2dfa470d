/* Opens subframes: EXR by chunks, everything else whole through the OpenImageIO module. */
#include "convert/read/source.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "convert/base/module.h"
#include "convert/media/formats.h"
#include "convert/media/oiio/oiio.h"
#include "convert/read/source_exr.h"

/* ---- Whole pictures ---- */

static weft_status module_entry(const wf_subframe *s, const char *name, void **entry,
                                weft_error *err) {
    weft_error why = {""};
    weft_status status = wf_module_symbol("oiio", name, entry, &why);
    return status ? wf_fail(err, status, "%s: %s", s->path, why.text) : WEFT_OK;
}

static weft_status read_whole(wf_subframe *s, const wf_pick *pick, const wf_source_options *o,
                              weft_error *err) {
    void *symbol;
    wf_box data = s->info.data;
    uint64_t samples =
        (uint64_t)(data.x1 - data.x0) * (uint64_t)(data.y1 - data.y0) * (uint64_t)pick->count;
    weft_status status = module_entry(s, "wf_oiio_read", &symbol, err);
    if (status) return status;
    if (samples * sizeof(float) > o->max_memory_bytes / 2)
        return wf_fail(err, WEFT_NO_MEMORY,
                       "%s: it must be read whole, which takes %" PRIu64
                       " MB; raise --max-memory or "
                       "write EXR with ZIP compression",
                       s->path, samples * sizeof(float) >> 20);
    s->whole = malloc((size_t)samples * sizeof *s->whole);
    if (!s->whole)
        return wf_fail(err, WEFT_NO_MEMORY, "%s: no memory for the picture", s->path);
    s->info.whole = true;
    s->info.band_lines = 32; /* nothing is read twice, whatever the bands */
    return ((wf_oiio_read_fn *)symbol)(s->path, s->part, pick->channel, pick->count, &data,
                                       s->whole, err);
}

static weft_status pick_from_names(const wf_subframe *s, const wf_source_options *o,
                                   const char *names, int count, wf_pick *pick,
                                   weft_error *err) {
    char why[512];
    const char **name = malloc((size_t)(count + 1) * sizeof *name);
    if (!name) return wf_fail(err, WEFT_NO_MEMORY, "%s: no memory for channel names", s->path);
    for (int i = 0; i < count; i++, names += strlen(names) + 1) name[i] = names;
    bool found = wf_pick_channels(name, count, s->layer, o->want_alpha, pick, why, sizeof why);
    free(name);
    return found ? WEFT_OK : wf_fail(err, WEFT_FAILED, "%s: %s", s->path, why);
}

/* Asks the module what the picture is. Its order of channels is not the file's. */
static weft_status probe(const wf_subframe *s, const wf_source_options *o, wf_image_info *info,
                         wf_pick *pick, weft_error *err) {
    void *symbol;
    char *names = NULL;
    int count = 0;
    weft_status status = module_entry(s, "wf_oiio_probe", &symbol, err);
    if (!status)
        status = ((wf_oiio_probe_fn *)symbol)(s->path, s->part, o->max_memory_bytes, info,
                                              &count, &names, err);
    if (!status) status = pick_from_names(s, o, names, count, pick, err);
    free(names);
    return status;
}

static weft_status open_whole(wf_subframe *s, const wf_source_options *o, int part,
                              weft_error *err) {
    wf_pick pick;
    s->layer = o->layer;
    s->part = part < 0 ? 0 : part;
    const char *format;
    weft_status status = wf_format_of(s->path, &format, err);
    if (!status) status = probe(s, o, &s->info, &pick, err);
    if (status) return status;
    s->layout.channels = pick.count;
    s->info.has_alpha = pick.count == 4;
    return read_whole(s, &pick, o, err);
}

/* ---- Opening ---- */

/* Opens an EXR. If its pixels cannot be decoded here, the module reads them; what the header
 * says stays. */
static weft_status open_exr(wf_subframe *s, const wf_source_options *o, int part,
                            weft_error *err) {
    bool needs_module;
    wf_image_info again;
    wf_pick pick;
    weft_status status = wf_exr_open(s, o, part, &needs_module, err);
    if (status || !needs_module) return status;
    exr_finish(&s->exr);
    s->exr = NULL;
    status = probe(s, o, &again, &pick, err);
    return status ? status : read_whole(s, &pick, o, err);
}

static weft_status check_file(const char *path, weft_error *err) {
    struct stat about;
    if (stat(path, &about)) return wf_fail(err, WEFT_FAILED, "%s: %s", path, strerror(errno));
    if (S_ISDIR(about.st_mode))
        return wf_fail(err, WEFT_FAILED, "%s: a directory where a picture should be", path);
    if (!S_ISREG(about.st_mode))
        return wf_fail(err, WEFT_FAILED, "%s: not a regular file; pictures are read from files",
                       path);
    if (!about.st_size) return wf_fail(err, WEFT_FAILED, "%s: the file is empty", path);
    return WEFT_OK;
}

static bool is_called_exr(const char *path) {
    const char *dot = strrchr(path, '.');
    return dot && !strcasecmp(dot, ".exr");
}

weft_status wf_subframe_open(const char *path, int part, const wf_source_options *options,
                             wf_subframe **out, weft_error *err) {
    *out = NULL;
    weft_status status = check_file(path, err);
    if (status) return status;
    wf_subframe *s = calloc(1, sizeof *s);
    if (s) s->path = strdup(path);
    if (!s || !s->path)
        status = wf_fail(err, WEFT_NO_MEMORY, "%s: no memory to open it", path);
    else if (wf_is_exr(path))
        status = open_exr(s, options, part, err);
    else if (is_called_exr(path))
        status =
            wf_fail(err, WEFT_FAILED, "%s: not an EXR file, though it is called one", path);
    else
        status = open_whole(s, options, part, err);
    if (!status)
        *out = s;
    else
        wf_subframe_close(s);
    return status;
}
