#include "convert/sink.h"

#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "convert/sequence.h"

extern const wf_sink_kind wf_sink_y4m, wf_sink_v210, wf_sink_uyvy, wf_sink_exr, wf_sink_dpx,
    wf_sink_tiff, wf_sink_png, wf_sink_null, wf_sink_hash;

static const wf_sink_kind *const kinds[] = {&wf_sink_y4m, &wf_sink_v210, &wf_sink_uyvy,
                                            &wf_sink_exr, &wf_sink_dpx,  &wf_sink_tiff,
                                            &wf_sink_png, &wf_sink_null, &wf_sink_hash};

const wf_sink_kind *wf_sink_at(size_t index) {
    return index < sizeof kinds / sizeof *kinds ? kinds[index] : NULL;
}

/* Whether word is one of the blank-separated words. */
static bool is_among(const char *words, const char *word, size_t length) {
    while (*words) {
        size_t next = strcspn(words, " ");
        if (next == length && !strncasecmp(words, word, length)) return true;
        words += next + (words[next] == ' ');
    }
    return false;
}

/* "-", "hash:" of hash:FILE, or what follows the last dot of the name. */
static const char *ending_of(const char *output, size_t *length) {
    const char *slash = strrchr(output, '/'), *name = slash ? slash + 1 : output;
    const char *colon = strchr(output, ':'), *dot = strrchr(name, '.');
    if (!strcmp(output, "-"))
        dot = NULL;
    else if (colon && (is_among("null: hash:", output, (size_t)(colon - output) + 1))) {
        *length = (size_t)(colon - output) + 1;
        return output;
    }
    const char *ending = dot ? dot + 1 : !strcmp(output, "-") ? output : "";
    *length = strlen(ending);
    return ending;
}

const wf_sink_kind *wf_sink_for(const char *output, weft_error *err) {
    size_t length;
    const char *ending = ending_of(output, &length);
    for (size_t i = 0; length && i < sizeof kinds / sizeof *kinds; i++)
        if (is_among(kinds[i]->endings, ending, length)) return kinds[i];
    if (length && is_among("mov mxf mkv mp4 avi mpg", ending, length))
        wf_fail(err, WEFT_USAGE,
                "%s: this build writes no .%s; write .v210, .y4m or an image sequence such as "
                "out.####.dpx and wrap it with another program",
                output, ending);
    else
        wf_fail(
            err, WEFT_USAGE,
            "%s: the output's name must end in .y4m, .v210 or .uyvy, or be a sequence such as "
            "out.####.exr (dpx, tif, png), - for Y4M on standard output, null: or hash:FILE",
            output);
    return NULL;
}

bool wf_sink_present(const wf_sink_kind *kind, const char *output, int64_t frame) {
    char path[4096];
    struct stat about;
    if (kind->sequence && frame >= 0 && wf_sequence_is_pattern(output)) {
        if (!wf_sequence_output_path(output, frame, path, sizeof path)) return false;
        output = path;
    }
    return !stat(output, &about) && S_ISREG(about.st_mode) && about.st_size > 0;
}
