/* Opens subframes: EXR by chunks, everything else whole through the OpenImageIO module. */
#include "convert/read/source.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "convert/base/module.h"
#include "convert/media/color_tags.h"
#include "convert/media/formats.h"
#include "convert/media/kinds.h"
#include "convert/media/oiio/oiio.h"
#include "convert/read/source_exr.h"

/* ---- Whole pictures ---- */

static weft_status module_entry(const wf_subframe *s, const char *name, void **entry,
                                weft_error *err) {
    char what[600];
    snprintf(what, sizeof what, "%.500s: a picture that is no EXR", s->path);
    return wf_module_symbol("oiio", name, what, entry, err);
}

/* Memory for a picture that is read whole. */
static weft_status make_whole(wf_subframe *s, const wf_source_options *o, weft_error *err) {
    wf_box data = s->info.data;
    uint64_t samples =
        (uint64_t)(data.x1 - data.x0) * (uint64_t)(data.y1 - data.y0) * (uint64_t)s->pick.count;
    if (samples * sizeof(float) > o->max_memory_bytes / 2)
        return wf_fail(err, WEFT_NO_MEMORY,
                       "%s: it must be read whole, which takes %" PRIu64
                       " MB; raise --max-memory or "
                       "write EXR with ZIP compression",
                       s->path, samples * sizeof(float) >> 20);
    s->whole = malloc((size_t)samples * sizeof *s->whole);
    if (!s->whole)
        return wf_fail(err, WEFT_NO_MEMORY, "%s: no memory for the picture", s->path);
    s->layout.channels = s->pick.count;
    s->info.whole = true;
    s->info.band_lines = 32; /* nothing is read twice, whatever the bands */
    return WEFT_OK;
}

static weft_status read_whole(wf_subframe *s, const wf_source_options *o, weft_error *err) {
    void *symbol;
    weft_status status = module_entry(s, "wf_oiio_read", &symbol, err);
    if (!status) status = make_whole(s, o, err);
    if (status) return status;
    return ((wf_oiio_read_fn *)symbol)(s->path, s->part, s->pick.channel, s->pick.count,
                                       &s->info.data, s->whole, err);
}

/* ---- Pictures that are no EXR ---- */

/* The one part that a picture is, or a page of a TIFF. */
static weft_status number_of_part(const wf_subframe *s, const char *wanted, int *part,
                                  weft_error *err) {
    char *end = NULL;
    long number = wanted ? strtol(wanted, &end, 10) : 0;
    *part = (int)number;
    if (!wanted || (end != wanted && !*end && number >= 0 && number < 1 << 20)) return WEFT_OK;
    return wf_fail(err, WEFT_FAILED,
                   "%s: no part '%.80s': only parts of EXR have names; others are numbered "
                   "from 0",
                   s->path, wanted);
}

static weft_status pick_from_names(wf_subframe *s, const wf_source_options *o,
                                   const char *names, int count, weft_error *err) {
    char why[900];
    const wf_wish wish = {.layer = o->layer, .only_part = -1};
    wf_channel *channel = calloc((size_t)(count + 1), sizeof *channel);
    if (!channel)
        return wf_fail(err, WEFT_NO_MEMORY, "%s: no memory for channel names", s->path);
    for (int i = 0; i < count; i++, names += strlen(names) + 1)
        channel[i] = (wf_channel){.name = names};
    const wf_part part = {.name = "", .channel = channel, .count = count, .flat = true};
    bool found = wf_pick_picture(&part, 1, &wish, &s->pick, why, sizeof why);
    free(channel);
    return found ? WEFT_OK : wf_fail(err, WEFT_FAILED, "%s: %s", s->path, why);
}

/* Asks the module what the picture is. The channels' names follow each other, in its order,
 * which is not the file's; owned by the caller. */
static weft_status probe(const wf_subframe *s, const wf_source_options *o, wf_image_info *info,
                         int *count, char **names, weft_error *err) {
    void *symbol;
    weft_status status = module_entry(s, "wf_oiio_probe", &symbol, err);
    return status ? status
                  : ((wf_oiio_probe_fn *)symbol)(s->path, s->part, o->max_memory_bytes, info,
                                                 count, names, err);
}

static weft_status open_whole(wf_subframe *s, const wf_source_options *o, int part,
                              weft_error *err) {
    const char *format;
    char *names = NULL;
    int count = 0;
    s->part = part;
    weft_status status = part < 0 ? number_of_part(s, o->part, &s->part, err) : WEFT_OK;
    if (!status) status = wf_format_of(s->path, &format, err);
    if (!status) status = probe(s, o, &s->info, &count, &names, err);
    if (!status) status = pick_from_names(s, o, names, count, err);
    free(names);
    if (status) return status;
    if (part < 0 && o->part) s->pick.part_reason = WF_REASON_OPTION;
    status = wf_read_color_tags(s->path, format, &s->info.colors, err);
    if (!status) status = wf_subframe_settle_colors(s, o, err);
    if (status) return status;
    wf_subframe_settle_alpha(s, o);
    return read_whole(s, o, err);
}

/* ---- EXR ---- */

static weft_status read_subsampled(wf_subframe *s, const wf_source_options *o,
                                   weft_error *err) {
    weft_status status = make_whole(s, o, err);
    if (!status) status = wf_exr_read_subsampled(s, s->whole, err);
    wf_exr_stream_end(&s->stream);
    s->exr = NULL;
    return status;
}

static weft_status open_exr(wf_subframe *s, const wf_source_options *o, int part,
                            weft_error *err) {
    bool by_chunks;
    weft_status status = wf_exr_open(s, o, part, &by_chunks, err);
    return status || by_chunks ? status : read_subsampled(s, o, err);
}

/* ---- Opening ---- */

static weft_status check_file(const char *path, weft_error *err) {
    struct stat about;
    if (stat(path, &about)) return wf_fail(err, WEFT_FAILED, "%s: %s", path, strerror(errno));
    if (S_ISDIR(about.st_mode))
        return wf_fail(err, WEFT_FAILED, "%s: a directory where a picture should be", path);
    if (!S_ISREG(about.st_mode))
        return wf_fail(err, WEFT_FAILED, "%s: not a regular file; pictures are read from files",
                       path);
    if (!about.st_size)
        return wf_fail(err, WEFT_FAILED, "%s: the file is empty; it may still be being written",
                       path);
    return WEFT_OK;
}

static bool is_called_exr(const char *path) {
    const char *dot = strrchr(path, '.');
    return dot && !strcasecmp(dot, ".exr");
}

/* What is called EXR and is none is not taken for something else: the name may be right, and
 * the file what is left of it. */
static weft_status refuse_false_name(const char *path, weft_error *err) {
    bool other;
    weft_status status = wf_refuse_kind(path, err);
    if (!status) status = wf_begins_as_picture(path, &other, err);
    return status
               ? status
               : wf_fail(err, WEFT_FAILED, "%s: not an EXR file, though it is called one%s",
                         path, other ? ": it begins as a picture of another format does" : "");
}

static weft_status open_as_what_it_is(wf_subframe *s, const wf_source_options *options,
                                      int part, weft_error *err) {
    bool is_exr;
    weft_status status = wf_is_exr(s->path, &is_exr, err);
    if (status) return status;
    if (is_exr) return open_exr(s, options, part, err);
    return is_called_exr(s->path) ? refuse_false_name(s->path, err)
                                  : open_whole(s, options, part, err);
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
    else
        status = open_as_what_it_is(s, options, part, err);
    if (!status)
        *out = s;
    else
        wf_subframe_close(s);
    return status;
}
