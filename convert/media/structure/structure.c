/* Reads the structure of a container: which reader a file gets, and what the readers share. */
#include "convert/media/structure/structure.h"

#include <stdarg.h>
#include <string.h>

#include "convert/base/infile.h"
#include "convert/media/structure/extent.h"

bool wf_extent_read(const wf_extent *x, int64_t at, void *to, size_t bytes) {
    if (at < 0 || at > x->bytes || (int64_t)bytes > x->bytes - at) return false;
    return !fseeko(x->file, (off_t)at, SEEK_SET) && fread(to, 1, bytes, x->file) == bytes;
}

void wf_missing(wf_structure *s, const char *format, ...) {
    va_list args;
    if (*s->missing) return;
    va_start(args, format);
    vsnprintf(s->missing, sizeof s->missing, format, args);
    va_end(args);
}

void wf_state(wf_structure *s, const char *of, double seconds, double tick_s, bool of_all) {
    if (!(seconds > 0) || s->stated_count == WF_STATED_MOST) return;
    wf_stated *stated = &s->stated[s->stated_count++];
    snprintf(stated->of, sizeof stated->of, "%s", of);
    stated->seconds = seconds;
    stated->tick_s = tick_s;
    stated->of_all = of_all;
}

static const struct {
    const char *container;
    void (*read)(const wf_extent *x, wf_structure *s);
} readers[] = {
    {"mxf", wf_structure_mxf}, {"mov", wf_structure_mov},   {"matroska", wf_structure_mkv},
    {"avi", wf_structure_avi}, {"mpegts", wf_structure_ts}, {"mpeg", wf_structure_ps},
};

void wf_structure_of(FILE *file, const char *container, wf_structure *out) {
    wf_extent x = {.file = file};
    *out = (wf_structure){.known = false};
    if (!fseeko(file, 0, SEEK_END)) x.bytes = (int64_t)ftello(file);
    for (size_t i = 0; i < sizeof readers / sizeof *readers; i++) {
        if (strcmp(readers[i].container, container)) continue;
        out->known = true;
        readers[i].read(&x, out);
    }
}

weft_status wf_structure_read(const char *path, const char *container, wf_structure *out,
                              weft_error *err) {
    FILE *file;
    weft_status status = wf_infile_open(path, &file, err);
    if (status) return status;
    wf_structure_of(file, container, out);
    return wf_infile_close(file, path, WEFT_OK, err);
}
