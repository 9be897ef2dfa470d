/* The registry of outputs. */
#include "convert/sink.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "convert/delivery.h"
#include "convert/sequence.h"
#include "convert/sink_kinds.h"

static const wf_sink_kind *const kinds[] = {
    &wf_sink_y4m,  &wf_sink_v210, &wf_sink_uyvy, &wf_sink_exr,  &wf_sink_dpx,
    &wf_sink_tiff, &wf_sink_png,  &wf_sink_hash, &wf_sink_null,
};

#define KINDS (sizeof kinds / sizeof *kinds)

const wf_sink_kind *wf_sink_at(size_t index) {
    if (index < KINDS) return kinds[index];
    const wf_delivery *delivery = wf_delivery_at(index - KINDS);
    return delivery ? &delivery->kind : NULL;
}

/* ---- Names ---- */

static bool is_scheme(const char *ending, size_t length) {
    return ending[length - 1] == ':';
}

/* One of a kind's endings: "-" is a whole name, "hash:" begins one, "y4m" follows its last dot.
 */
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

static const wf_sink_kind *find_kind(const char *output) {
    for (int scheme = 1; scheme >= 0; scheme--) /* hash:out.exr is a hash */
        for (size_t i = 0; i < KINDS; i++)
            if (ends_as_one(output, kinds[i]->endings, scheme)) return kinds[i];
    return NULL;
}

/* "out.y4m, out.v210, .., out.####.exr, .., hash:FILE, null:" */
static void list_outputs(char *text, size_t size) {
    size_t used = 0;
    for (size_t i = 0; i < KINDS && used < size; i++) {
        const char *ending = kinds[i]->endings;
        int length = (int)strcspn(ending, " ");
        bool scheme = is_scheme(ending, (size_t)length);
        used += (size_t)snprintf(text + used, size - used, "%s%s%.*s%s", used ? ", " : "",
                                 scheme               ? ""
                                 : kinds[i]->sequence ? "out.####."
                                                      : "out.",
                                 length, ending, kinds[i] == &wf_sink_hash ? "FILE" : "");
    }
}

const wf_sink_kind *wf_sink_for(const char *output, const char *codec, weft_error *err) {
    char there[256];
    bool container = false;
    const wf_sink_kind *kind = find_kind(output);
    const wf_delivery *delivery = kind ? NULL : wf_delivery_for(output, codec, &container, err);
    if (delivery) return &delivery->kind;
    if (kind && !codec) return kind;
    if (kind)
        wf_fail(err, WEFT_USAGE,
                "--codec %.100s: %.500s is %s, which has no codec; it is for .mov, .mxf and "
                ".mkv",
                codec, output, kind->name);
    if (kind || container) return NULL;
    list_outputs(there, sizeof there);
    wf_fail(err, WEFT_USAGE,
            "%.500s: the name of an output says what it is, and this one does not; there are "
            "%s, out.mov, out.mxf, out.mkv, and - for Y4M on standard output",
            output, there);
    return NULL;
}

/* ---- What is there ---- */

wf_sink_size wf_sink_size_of(const wf_sink_kind *kind, const wf_sink_options *options,
                             int64_t frames) {
    return kind->size ? kind->size(options, frames) : (wf_sink_size){0};
}

int wf_sink_files(const wf_sink_options *options) {
    return options->separate_fields ? 2 : 1;
}

bool wf_sink_present(const wf_sink_kind *kind, const char *output, int64_t frame) {
    char path[PATH_MAX];
    struct stat about;
    size_t scheme = strcspn(kind->endings, ":");
    if (!strcmp(output, "-")) return false;
    if (kind->endings[scheme] == ':') output += scheme + 1; /* hash:FILE, and null: has none */
    if (kind->sequence && wf_sequence_is_pattern(output)) {
        if (frame < 0 || !wf_sequence_output_path(output, frame, path, sizeof path))
            return false;
        output = path;
    }
    /* Outputs appear whole or not at all; what is empty is what somebody else has left. */
    return !stat(output, &about) && S_ISREG(about.st_mode) && about.st_size > 0;
}
