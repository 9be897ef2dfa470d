/* Whether a subframe is of the same kind as the first of its sequence. */
#include "convert/run/source/subframe_check.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

wf_first_subframe wf_first_subframe_of(const wf_subframe *subframe) {
    wf_first_subframe first = {.info = *wf_subframe_info(subframe),
                               .pick = *wf_subframe_pick(subframe),
                               .colors = *wf_subframe_colors(subframe)};
    snprintf(first.part_name, sizeof first.part_name, "%s", wf_subframe_part_name(subframe));
    return first;
}

static weft_status check_size(const wf_image_info *first, const char *path,
                              const wf_image_info *info, weft_error *err) {
    wf_box a = first->display, b = info->display;
    if (a.x1 - a.x0 == b.x1 - b.x0 && a.y1 - a.y0 == b.y1 - b.y0) return WEFT_OK;
    return wf_fail(
        err, WEFT_FAILED,
        "%s: its display window is %dx%d, the sequence began with %dx%d; all subframes "
        "must have one size",
        path, b.x1 - b.x0, b.y1 - b.y0, a.x1 - a.x0, a.y1 - a.y0);
}

static weft_status check_aspect(const weft_job *job, const wf_image_info *first,
                                const char *path, const wf_image_info *info, weft_error *err) {
    double a = first->pixel_aspect, b = info->pixel_aspect;
    if (wf_ratio_given(job->input_par) || fabs(a - b) <= 1e-6 * a) return WEFT_OK;
    return wf_fail(err, WEFT_FAILED,
                   "%s: its pixels are %.6g times as wide as high, the sequence began with "
                   "%.6g; all subframes must have one shape, which --input-par may state",
                   path, b, a);
}

static weft_status check_pick(const wf_first_subframe *first, const char *path, bool own_part,
                              const wf_subframe *subframe, weft_error *err) {
    const wf_pick *a = &first->pick, *b = wf_subframe_pick(subframe);
    const char *part = wf_subframe_part_name(subframe);
    if (a->kind != b->kind)
        return wf_fail(err, WEFT_FAILED,
                       "%s: its picture is %s, the sequence began with %s; all subframes must "
                       "have the same channels",
                       path, wf_picture_kind_name(b->kind), wf_picture_kind_name(a->kind));
    if (strcmp(a->layer, b->layer))
        return wf_fail(err, WEFT_FAILED,
                       "%s: its picture is layer '%s', the sequence began with layer '%s'; "
                       "name the one to take with --layer",
                       path, b->layer, a->layer);
    if (!own_part && strcmp(first->part_name, part))
        return wf_fail(err, WEFT_FAILED,
                       "%s: its picture is in part '%s', the sequence began with part '%s'; "
                       "name the one to take with --part",
                       path, part, first->part_name);
    return WEFT_OK;
}

static weft_status check_colors(const weft_job *job, const wf_first_subframe *first,
                                const char *path, const wf_subframe *subframe,
                                weft_error *err) {
    const wf_file_colors *a = &first->colors, *b = wf_subframe_colors(subframe);
    char began[128], is[128];
    if (job->from || wf_file_colors_same(a, b)) return WEFT_OK;
    wf_file_colors_name(a, began, sizeof began);
    wf_file_colors_name(b, is, sizeof is);
    return wf_fail(err, WEFT_FAILED,
                   "%s: its colors are %s, the sequence began with %s; name the one that all "
                   "are in with --from",
                   path, is, began);
}

weft_status wf_check_subframe(const weft_job *job, const wf_first_subframe *first,
                              const char *path, bool own_part, const wf_subframe *subframe,
                              weft_error *err) {
    const wf_image_info *info = wf_subframe_info(subframe);
    weft_status status = check_size(&first->info, path, info, err);
    if (!status) status = check_aspect(job, &first->info, path, info, err);
    if (!status) status = check_colors(job, first, path, subframe, err);
    return status ? status : check_pick(first, path, own_part, subframe, err);
}
