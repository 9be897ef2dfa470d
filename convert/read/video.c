/* Opens finished video of any kind, and settles which raster it is. */
#include "convert/read/video.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "convert/base/infile.h"
#include "convert/base/names.h"
#include "convert/media/formats.h"
#include "convert/media/structure/structure.h"
#include "convert/media/y4m.h"
#include "convert/read/sequence.h"
#include "convert/read/source_exr.h"
#include "convert/read/video_kinds.h"

/* ---- Which raster it is ---- */

static bool fits(const wf_raster *r, const wf_video_info *info, const wf_video_label *label) {
    bool as_labeled = label->interlaced
                          ? r->scan == WF_INTERLACED && r->top_first == label->top_first
                          : r->scan == WF_PROGRESSIVE;
    return r->width_px == info->width_px && r->lines == info->lines &&
           (!wf_ratio_given(label->rate) || wf_ratio_equal(r->frame_rate, label->rate)) &&
           (!label->scan_known || as_labeled);
}

/* Whether progressive frames have the size and rate of an interlaced raster: those of
 * standard definition have no name of their own. */
static bool fits_whole(const wf_raster *r, const wf_video_info *info,
                       const wf_video_label *label) {
    wf_video_label as_fields = *label;
    as_fields.scan_known = false;
    return label->scan_known && !label->interlaced && r->scan == WF_INTERLACED &&
           fits(r, info, &as_fields);
}

static void make_raster(wf_video_info *info, const wf_video_label *label) {
    wf_rational rate = wf_ratio_given(label->rate) ? label->rate : wf_ratio(25, 1);
    bool given = wf_ratio_given(label->aspect) && label->aspect.num > 0;
    info->raster = (wf_raster){.width_px = info->width_px,
                               .lines = info->lines,
                               .frame_rate = rate,
                               .scan = label->scan_known && !label->interlaced ? WF_PROGRESSIVE
                                                                               : WF_INTERLACED,
                               .top_first = label->scan_known ? label->top_first : true,
                               .pixel_aspect = given ? label->aspect : wf_ratio(1, 1),
                               .matrix = WF_709};
    snprintf(info->raster.name, sizeof info->raster.name, "%dx%d@%" PRId64 "/%" PRId64 "%s",
             info->width_px, info->lines, rate.num, rate.den,
             info->raster.scan == WF_PROGRESSIVE ? "p" : "i");
}

/* Takes the 16:9 variant of the raster where the pixels are nearer to that shape, else the
 * raster with these pixels. */
static void take_aspect(wf_raster *raster, wf_rational aspect) {
    char name[sizeof raster->name + sizeof "-wide"], why[256];
    wf_raster wide;
    if (!wf_ratio_given(aspect) || aspect.num <= 0 ||
        wf_ratio_equal(aspect, raster->pixel_aspect))
        return;
    double shape = wf_ratio_value(aspect), narrow = wf_ratio_value(raster->pixel_aspect);
    snprintf(name, sizeof name, "%s-wide", raster->name);
    if (wf_raster_parse(name, &wide, why, sizeof why) &&
        shape * shape > narrow * wf_ratio_value(wide.pixel_aspect))
        memcpy(raster->name, wide.name, sizeof raster->name);
    raster->pixel_aspect = aspect;
}

static void find_raster(wf_video_info *info, const wf_video_label *label) {
    char why[256];
    wf_raster stated;
    if (label->raster && *label->raster &&
        wf_raster_parse(label->raster, &stated, why, sizeof why) &&
        fits(&stated, info, label)) {
        info->raster = stated;
        info->scan_known = true;
        return;
    }
    const wf_raster *r, *found = NULL;
    for (size_t i = 0; !found && (r = wf_raster_at(i)); i++)
        if (fits(r, info, label)) found = r;
    for (size_t i = 0; !found && (r = wf_raster_at(i)); i++)
        if (fits_whole(r, info, label)) found = r;
    if (!found) {
        make_raster(info, label);
        return;
    }
    info->raster = *found;
    if (!fits(found, info, label)) info->raster.scan = WF_PROGRESSIVE;
    take_aspect(&info->raster, label->aspect);
}

static weft_status settle_raster(wf_video *v, const wf_video_label *label, weft_error *err) {
    const wf_raster *given = v->options.raster;
    wf_video_info *info = &v->info;
    info->scan_known = label->scan_known || given;
    info->transfer = v->options.transfer ? *v->options.transfer : label->transfer;
    info->rate = label->rate;
    info->aspect = label->aspect;
    info->interlaced = label->interlaced;
    if (!given) {
        find_raster(info, label);
        if (label->matrix_known) info->raster.matrix = label->matrix;
        return WEFT_OK;
    }
    info->raster = *given;
    if (given->width_px == info->width_px && given->lines == info->lines) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE,
                   "%s: its pictures are %dx%d, and --raster %s is %dx%d; leave --raster out, "
                   "or give one of that size",
                   v->path, info->width_px, info->lines, given->name, given->width_px,
                   given->lines);
}

/* ---- Opening ---- */

static weft_status is_y4m(const char *path, bool *is, weft_error *err) {
    char head[sizeof WF_Y4M_MAGIC] = "";
    size_t got;
    weft_status status = wf_infile_head(path, head, sizeof head - 1, &got, err);
    *is = got == sizeof head - 1 && !strcmp(head, WF_Y4M_MAGIC);
    return status;
}

/* The kind of a file by how it begins, and where that says nothing by its name. */
static weft_status look_into(const char *path, const wf_video_kind **kind, weft_error *err) {
    bool y4m, animated = false, picture = false;
    weft_status status = is_y4m(path, &y4m, err);
    if (!status) status = wf_is_animated_png(path, &animated, err);
    if (!status) status = wf_begins_as_picture(path, &picture, err);
    bool stills = wf_name_ends_in(path, ".mjpeg") || wf_name_ends_in(path, ".mjpg");
    bool named = wf_name_is_picture(wf_base_name(path)) && !wf_name_ends_in(path, ".gif");
    if (y4m)
        *kind = &wf_video_y4m;
    else if (!animated && ((picture && !stills) || named))
        *kind = &wf_video_pictures;
    return status;
}

static bool is_pipe(const char *path) {
    struct stat about;
    return !strcmp(path, "-") ||
           (!stat(path, &about) && !S_ISREG(about.st_mode) && !S_ISDIR(about.st_mode));
}

static weft_status find_kind(const char *path, const wf_video_kind **kind, weft_error *err) {
    struct stat about;
    bool there = !stat(path, &about);
    *kind = &wf_video_libav;
    /* Pipes are looked into when they are opened, since they cannot be read twice. */
    if (is_pipe(path))
        *kind = &wf_video_y4m;
    else if (there ? S_ISDIR(about.st_mode) : wf_pattern_is(path))
        *kind = &wf_video_pictures;
    else if (!there)
        return wf_fail(err, WEFT_FAILED, "%s: %s", path, strerror(errno));
    else if (wf_name_ends_in(path, ".v210") || wf_name_ends_in(path, ".uyvy"))
        *kind = &wf_video_raw;
    else if (!about.st_size)
        return wf_fail(err, WEFT_FAILED, "%s: the file is empty", path);
    else
        return look_into(path, kind, err);
    return WEFT_OK;
}

weft_status wf_video_is(const char *path, bool *is, weft_error *err) {
    const wf_video_kind *kind;
    struct stat about;
    *is = false;
    if (!is_pipe(path) && (stat(path, &about) || !about.st_size)) return WEFT_OK;
    weft_status status = find_kind(path, &kind, err);
    *is = !status && (kind == &wf_video_y4m || kind == &wf_video_libav);
    return status;
}

static weft_status make_planes(wf_video *v, weft_error *err) {
    const wf_video_info *info = &v->info;
    for (int p = 0; p < 4; p++) {
        bool chroma = p == 1 || p == 2;
        int across = chroma ? info->across : 1, down = chroma ? info->down : 1;
        int width = (info->width_px + across - 1) / across;
        int lines = (info->lines + down - 1) / down;
        v->frame.width_px[p] = width;
        v->frame.lines[p] = lines;
        if (v->options.codes_only || p > 2) continue;
        v->frame.plane[p] = calloc((size_t)width * (size_t)lines, sizeof(float));
        if (!v->frame.plane[p]) return wf_video_no_memory(v, err);
    }
    return WEFT_OK;
}

/* Opens a pipe and tells by its first byte, which is put back, whether it may be Y4M. */
static weft_status open_pipe(wf_video *v, weft_error *err) {
    v->pipe = strcmp(v->path, "-") ? fopen(v->path, "rb") : stdin;
    if (!v->pipe) return wf_fail(err, WEFT_FAILED, "%s: %s", v->path, strerror(errno));
    int first = getc(v->pipe);
    if (ferror(v->pipe)) return wf_fail(err, WEFT_FAILED, "%s: %s", v->path, strerror(errno));
    if (first == EOF) return wf_fail(err, WEFT_FAILED, "%s: the pipe is empty", v->path);
    ungetc(first, v->pipe);
    v->kind = first == WF_Y4M_MAGIC[0] ? &wf_video_y4m : &wf_video_libav;
    return WEFT_OK;
}

weft_status wf_video_open(const char *path, const wf_video_options *options, wf_video **out,
                          weft_error *err) {
    const wf_video_kind *kind;
    weft_status status = find_kind(path, &kind, err);
    if (status) return status;
    wf_video *v = calloc(1, sizeof *v);
    if (v) v->path = strdup(path);
    if (!v || !v->path) {
        free(v);
        return wf_fail(err, WEFT_NO_MEMORY, "%s: out of memory", path);
    }
    v->kind = kind;
    v->options = *options;
    v->info = (wf_video_info){.planes = 3,
                              .across = 1,
                              .down = 1,
                              .frames = -1,
                              .tags = {2, 2, 2, false, WF_SITING_LEFT, false}};
    v->frame.index = -1;
    wf_video_label label = {0};
    status = is_pipe(path) ? open_pipe(v, err) : WEFT_OK;
    if (!status) status = v->kind->open(v, &label, err);
    if (!status) status = settle_raster(v, &label, err);
    if (!status) status = wf_video_check_memory(v, err);
    if (!status) status = make_planes(v, err);
    if (status)
        wf_video_close(v);
    else
        *out = v;
    return status;
}

const wf_video_info *wf_video_info_of(const wf_video *video) {
    return &video->info;
}

weft_status wf_video_next(wf_video *video, const wf_video_frame **frame, weft_error *err) {
    bool more = false;
    *frame = NULL;
    video->frame.index++;
    video->take_codes = false;
    weft_status status = video->kind->next(video, &more, err);
    if (!status && more) *frame = &video->frame;
    return status;
}

weft_status wf_video_next_codes(wf_video *video, void *const plane[], bool *more,
                                weft_error *err) {
    video->frame.index++;
    video->take_codes = true;
    int planes = wf_video_planes(&video->options, &video->info);
    for (int p = 0; p < planes; p++) video->code[p] = plane ? plane[p] : NULL;
    return video->kind->next(video, more, err);
}

weft_status wf_video_seek(wf_video *video, int64_t picture, int64_t *next, weft_error *err) {
    weft_status status = WEFT_OK;
    if (video->kind->seek && picture > video->frame.index + 1)
        status = video->kind->seek(video, picture, err);
    *next = video->frame.index + 1;
    return status;
}

weft_status wf_video_check_whole(const wf_video *video, weft_error *err) {
    wf_structure structure = {0};
    char container[sizeof video->info.format];
    size_t first = strcspn(video->info.format, ", ");
    snprintf(container, sizeof container, "%.*s", (int)first, video->info.format);
    if (video->pipe) return WEFT_OK;
    weft_status status = wf_structure_read(video->path, container, &structure, err);
    if (status) return status;
    if (!structure.known || !*structure.missing) return WEFT_OK;
    const wf_video_info *info = &video->info;
    return wf_fail(err, WEFT_FAILED,
                   "%s: it was cut off or is still being written: %s; %" PRId64
                   " pictures (%.3f s) are there, and --frames takes some of them",
                   video->path, structure.missing, info->frames,
                   (double)info->frames / wf_ratio_value(info->raster.frame_rate));
}

void wf_video_plane_size(const wf_video *video, int p, int *width_px, int *lines) {
    *width_px = video->frame.width_px[p];
    *lines = video->frame.lines[p];
}

int64_t wf_video_ticks(const wf_video *video) {
    return video->frame.timed ? video->frame.ticks : INT64_MIN;
}

int64_t wf_video_lasts(const wf_video *video) {
    return video->frame.lasts;
}

bool wf_video_is_missing(const wf_video *video) {
    return video->frame.missing;
}

const wf_video_troubles *wf_video_troubles_of(const wf_video *video) {
    return &video->troubles;
}

void wf_video_close(wf_video *video) {
    if (!video) return;
    video->kind->close(video);
    for (int p = 0; p < 3; p++) free(video->frame.plane[p]);
    if (video->pipe && video->pipe != stdin) fclose(video->pipe);
    free(video->info.times);
    free(video->path);
    free(video);
}
