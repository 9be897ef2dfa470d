/* The registry of outputs. */
#include "convert/write/sink.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "convert/base/outfile.h"
#include "convert/base/pattern.h"
#include "convert/job/delivery.h"
#include "convert/write/sink_kinds.h"

static const wf_output *const outputs[] = {
    &wf_output_y4m,  &wf_output_v210, &wf_output_uyvy, &wf_output_exr,  &wf_output_dpx,
    &wf_output_tiff, &wf_output_png,  &wf_output_hash, &wf_output_null,
};

#define OUTPUTS (sizeof outputs / sizeof *outputs)

/* libavcodec and libavformat write all deliveries but uncompressed MXF. */
static wf_output delivery_output(const wf_delivery *d) {
    return (wf_output){&d->kind, d->encoder ? &wf_delivery_ops : &wf_mxf_sink_ops};
}

wf_output wf_output_at(size_t index) {
    if (index < OUTPUTS) return *outputs[index];
    const wf_delivery *delivery = wf_delivery_at(index - OUTPUTS);
    return delivery ? delivery_output(delivery) : (wf_output){0};
}

/* ---- Names ---- */

static bool is_scheme(const char *ending, size_t length) {
    return ending[length - 1] == ':';
}

/* Whether output is called so: "-" is a whole name, "hash:" begins one, "y4m" follows its
 * last dot. */
static bool ends_so(const char *output, const char *ending, size_t length) {
    if (is_scheme(ending, length)) return !strncmp(output, ending, length);
    if (ending[0] == '-') return !strcmp(output, "-");
    const char *slash = strrchr(output, '/'), *dot = strrchr(output, '.');
    if (!dot || (slash && dot < slash)) return false;
    return strlen(dot + 1) == length && !strncasecmp(dot + 1, ending, length);
}

static bool ends_as_one(const char *output, const char *endings, bool scheme) {
    for (const char *word = endings; *word; word += strspn(word, " ")) {
        size_t length = strcspn(word, " ");
        if (is_scheme(word, length) == scheme && ends_so(output, word, length)) return true;
        word += length;
    }
    return false;
}

static const wf_output *find_output(const char *name) {
    for (int scheme = 1; scheme >= 0; scheme--) /* hash:out.exr is a hash */
        for (size_t i = 0; i < OUTPUTS; i++)
            if (ends_as_one(name, outputs[i]->kind->endings, scheme)) return outputs[i];
    return NULL;
}

/* Writes "out.y4m, out.v210, .., out.####.exr, .., hash:FILE, null:". */
static void list_outputs(char *text, size_t size) {
    size_t used = 0;
    for (size_t i = 0; i < OUTPUTS && used < size; i++) {
        const wf_output_kind *kind = outputs[i]->kind;
        const char *ending = kind->endings;
        int length = (int)strcspn(ending, " ");
        bool scheme = is_scheme(ending, (size_t)length);
        used += (size_t)snprintf(text + used, size - used, "%s%s%.*s%s", used ? ", " : "",
                                 scheme           ? ""
                                 : kind->sequence ? "out.####."
                                                  : "out.",
                                 length, ending, outputs[i] == &wf_output_hash ? "FILE" : "");
    }
}

wf_output wf_output_for(const char *name, const char *codec, weft_error *err) {
    char there[256];
    bool container = false;
    const wf_output *output = find_output(name);
    const wf_delivery *delivery = output ? NULL : wf_delivery_for(name, codec, &container, err);
    if (delivery) return delivery_output(delivery);
    if (output && !codec) return *output;
    if (output)
        wf_fail(err, WEFT_USAGE,
                "--codec %.100s: %.500s is %s, which has no codec; it is for .mov, .mp4, .mxf "
                "and .mkv",
                codec, name, output->kind->name);
    if (output || container) return (wf_output){0};
    list_outputs(there, sizeof there);
    wf_fail(err, WEFT_USAGE,
            "%.500s: the name of an output says what it is, and this one does not; there are "
            "%s, out.mov, out.mp4, out.mxf, out.mkv, and - for Y4M on standard output",
            name, there);
    return (wf_output){0};
}

weft_status wf_output_open(wf_output output, const wf_output_options *options, wf_sink **out,
                           weft_error *err) {
    const char *file = wf_output_file(output.kind, options->output);
    weft_status status =
        output.kind->sequence && file ? wf_outfile_check(file, true, err) : WEFT_OK;
    return status ? status : output.ops->open(options, out, err);
}

/* ---- What is there ---- */

wf_sink_size wf_output_size(const wf_output *output, const wf_output_options *options,
                            int64_t frames) {
    return output->ops->size ? output->ops->size(options, frames) : (wf_sink_size){0};
}

/* hash:FILE has one, and null: has none. */
const char *wf_output_file(const wf_output_kind *kind, const char *name) {
    size_t scheme = strcspn(kind->endings, ":");
    if (kind->endings[scheme] == ':') name += scheme + 1;
    return *name && strcmp(name, "-") ? name : NULL;
}

bool wf_output_present(const wf_output_kind *kind, const char *name, int64_t frame) {
    char path[PATH_MAX];
    struct stat about;
    name = wf_output_file(kind, name);
    if (!name) return false;
    if (kind->sequence && wf_pattern_is(name)) {
        if (frame < 0 || !wf_pattern_path(name, frame, path, sizeof path)) return false;
        name = path;
    }
    /* Outputs of weft appear whole or not at all, so an empty file is not one of them. */
    return !stat(name, &about) && S_ISREG(about.st_mode) && about.st_size > 0;
}
