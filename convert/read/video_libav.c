/* Hands video of any container to the libav module. */
#include <stdio.h>
#include <string.h>

#include "convert/base/infile.h"
#include "convert/base/module.h"
#include "convert/media/libav/libav.h"
#include "convert/media/metadata_mxf.h"
#include "convert/media/structure/structure.h"
#include "convert/read/video_kinds.h"

/* Whether it begins as files of QuickTime and MP4 do. */
static bool begins_with_brand(const char *path) {
    char head[8] = "";
    size_t got;
    return !wf_infile_head(path, head, sizeof head, &got, NULL) && got == sizeof head &&
           !memcmp(head + 4, "ftyp", 4);
}

/* libav opens no QuickTime and MP4 without their index, which most programs write last. */
static weft_status tell_cut_off(const wf_video *v, weft_status status, weft_error *err) {
    wf_structure structure = {0};
    if (v->pipe || !begins_with_brand(v->path) ||
        wf_structure_read(v->path, "mov", &structure, NULL) || !*structure.missing)
        return status;
    return wf_fail(err, WEFT_FAILED, "%s: it was cut off or is still being written: %s",
                   v->path, structure.missing);
}

/* libav has no order of the fields that MXF calls mixed. */
static weft_status label_mixed_fields(const wf_video *v, wf_video_label *label,
                                      weft_error *err) {
    wf_metadata metadata = {.frame_layout = -1, .dominance = -1, .siting = -1};
    if (label->scan_known || v->pipe || strncmp(v->info.format, "mxf ", 4)) return WEFT_OK;
    FILE *file;
    weft_status status = wf_infile_open(v->path, &file, err);
    if (status) return status;
    wf_metadata_mxf(file, &metadata);
    status = wf_infile_close(file, v->path, WEFT_OK, err);
    wf_metadata_mxf_scan(&metadata);
    label->scan_known = label->interlaced = metadata.scan_known;
    label->top_first = metadata.top_first;
    return status;
}

/* The module's kind replaces this one, and has the video from here on. */
static weft_status libav_open(wf_video *v, wf_video_label *label, weft_error *err) {
    void *symbol;
    wf_libav_kind_fn *kind;
    char what[700];
    snprintf(
        what, sizeof what,
        "%.500s: it is neither Y4M nor a picture, and not named .v210 or .uyvy; other video",
        v->path);
    weft_status status = wf_module_symbol("libav", "wf_libav_kind", what, &symbol, err);
    if (status) return status;
    memcpy(&kind, &symbol, sizeof kind);
    v->kind = kind();
    status = v->kind->open(v, label, err);
    if (!status) status = label_mixed_fields(v, label, err);
    return status == WEFT_FAILED ? tell_cut_off(v, status, err) : status;
}

static weft_status libav_next(wf_video *v, bool *more, weft_error *err) {
    (void)v, (void)err;
    *more = false;
    return WEFT_OK;
}

static void libav_close(wf_video *v) {
    (void)v;
}

const wf_video_kind wf_video_libav = {libav_open, libav_next, NULL, libav_close};
