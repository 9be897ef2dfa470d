/* Reads pictures and sequences of them as video, a file a frame or, of fields apart, two. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/read/sequence.h"
#include "convert/read/source_exr.h"
#include "convert/read/video_kinds.h"
#include "filters/base/half.h"

typedef struct pictures {
    wf_sequence sequence;
    wf_source_options source;
    wf_reader *reader;
    wf_image_info first;
    int lines;        /* of a file */
    int fields;       /* files a frame */
    int first_parity; /* of the lines of a frame's first file: 0 top; where there are two */
    wf_rational rate; /* of frames, where there are two */
} pictures;

static weft_status find_files(wf_video *v, weft_error *err) {
    pictures *p = v->state;
    weft_status status = wf_sequence_expand(&v->path, 1, NULL, &p->sequence, err);
    for (size_t k = 0; !status && k < p->sequence.count; k++)
        if (!p->sequence.refs[k].path)
            status = wf_fail(err, WEFT_FAILED,
                             "%s: number %.9g is missing between the first and the last; "
                             "complete the sequence, or name the files",
                             v->path, wf_ratio_value(p->sequence.refs[k].number));
    if (!status && p->sequence.stepped)
        status = wf_fail(err, WEFT_FAILED,
                         "%s: numbers are %.9g apart from the first to the last; complete the "
                         "sequence, or name the files",
                         v->path, wf_ratio_value(p->sequence.number_step));
    return status;
}

static weft_status look_at_first(wf_video *v, weft_error *err) {
    pictures *p = v->state;
    const wf_subframe_ref *ref = &p->sequence.refs[0];
    wf_subframe *subframe;
    weft_status status = wf_subframe_open(ref->path, ref->part, &p->source, &subframe, err);
    if (status) return status;
    p->first = *wf_subframe_info(subframe);
    wf_subframe_close(subframe);
    return WEFT_OK;
}

/* Files of half the lines of the raster that they name, or that is asked for, are its fields:
 * two follow each other in time. */
static void look_for_fields(const wf_video *v, pictures *p, int width) {
    wf_raster named;
    char why[256];
    const wf_raster *r = v->options.raster;
    if (!r && wf_raster_parse(p->first.raster, &named, why, sizeof why)) r = &named;
    p->fields = 1;
    if (!r || r->scan != WF_INTERLACED || r->width_px != width || r->lines != 2 * p->lines)
        return;
    p->fields = 2;
    p->first_parity = wf_raster_parity(r, 0);
    p->rate = r->frame_rate;
}

static weft_status check_pairs(const wf_video *v, weft_error *err) {
    const pictures *p = v->state;
    if (p->sequence.count % (size_t)p->fields == 0) return WEFT_OK;
    return wf_fail(err, WEFT_FAILED,
                   "%s: its files are fields, of which %zu do not make whole frames; complete "
                   "the sequence",
                   v->path, p->sequence.count);
}

static weft_status pictures_open(wf_video *v, wf_video_label *label, weft_error *err) {
    pictures *p = v->state = calloc(1, sizeof *p);
    if (!p) return wf_video_no_memory(v, err);
    p->source = (wf_source_options){.alpha = WF_ALPHA_IGNORED,
                                    .nan_fix = WF_NAN_BOX3,
                                    .max_memory_bytes = v->options.max_memory_bytes};
    weft_status status = find_files(v, err);
    if (!status) status = look_at_first(v, err);
    if (!status) status = wf_reader_new(&p->source, &p->reader, err);
    if (status) return status;
    bool linear;
    status = wf_is_exr(p->sequence.refs[0].path, &linear, err);
    if (status) return status;
    wf_video_info *info = &v->info;
    snprintf(info->format, sizeof info->format, "%s", p->first.format);
    info->width_px = p->first.display.x1 - p->first.display.x0;
    p->lines = p->first.display.y1 - p->first.display.y0;
    look_for_fields(v, p, info->width_px);
    status = check_pairs(v, err);
    if (status) return status;
    info->separate = p->fields == 2;
    info->lines = p->fields * p->lines;
    info->layout = linear ? WF_LINEAR : WF_RGB;
    info->bits = linear ? 32 : 16;
    info->full_range = true;
    info->frames = (int64_t)(p->sequence.count / (size_t)p->fields);
    snprintf(info->timecode, sizeof info->timecode, "%s", p->first.timecode);
    info->timecode_rate = p->first.frames;
    *label = (wf_video_label){.rate = info->separate ? p->rate : p->first.rate,
                              .raster = p->first.raster};
    return WEFT_OK;
}

static void pictures_close(wf_video *v) {
    pictures *p = v->state;
    if (!p) return;
    wf_reader_free(p->reader);
    wf_sequence_free(&p->sequence);
    free(p);
}

/* Copies the rows of the data window that lie within the display window, those of field n to
 * every other line. */
static void take_rows(wf_video *v, int n, const wf_image_info *info, const wf_rows *rows) {
    const pictures *p = v->state;
    int first = p->fields == 2 ? (p->first_parity + n) % 2 : 0;
    int left = rows->x0 > info->display.x0 ? rows->x0 : info->display.x0;
    int right = rows->x1 < info->display.x1 ? rows->x1 : info->display.x1;
    for (int c = 0; c < 3; c++)
        for (int y = rows->y0; y < rows->y1; y++) {
            if (y < info->display.y0 || y >= info->display.y1) continue;
            float *to =
                v->frame.plane[c] +
                (size_t)((y - info->display.y0) * p->fields + first) * (size_t)v->info.width_px;
            size_t line = (size_t)(y - rows->y0) * rows->line_stride;
            for (int x = left; x < right; x++) {
                size_t from = line + (size_t)(x - rows->x0);
                to[x - info->display.x0] =
                    rows->type == WF_HALF
                        ? wf_half_value(((const uint16_t *)rows->plane[c])[from])
                        : ((const float *)rows->plane[c])[from];
            }
        }
}

static weft_status read_picture(wf_video *v, int n, const wf_subframe *subframe,
                                weft_error *err) {
    pictures *p = v->state;
    const wf_image_info *info = wf_subframe_info(subframe);
    size_t samples = (size_t)v->info.width_px * (size_t)v->info.lines;
    for (int c = 0; c < 3 && !n; c++) memset(v->frame.plane[c], 0, samples * sizeof(float));
    weft_status status = WEFT_OK;
    int step = info->band_lines > 0 ? info->band_lines : 16;
    for (int y = info->data.y0; !status && y < info->data.y1; y += step) {
        wf_rows rows;
        int end = y + step < info->data.y1 ? y + step : info->data.y1;
        status = wf_reader_rows(p->reader, subframe, y, end, &rows, err);
        if (!status) take_rows(v, n, info, &rows);
    }
    return status;
}

static weft_status check_size(const wf_video *v, const char *path, const wf_image_info *info,
                              weft_error *err) {
    int width = info->display.x1 - info->display.x0,
        lines = info->display.y1 - info->display.y0;
    const pictures *p = v->state;
    if (width == v->info.width_px && lines == p->lines) return WEFT_OK;
    return wf_fail(err, WEFT_FAILED,
                   "%s: it is %dx%d, and the pictures before it are %dx%d; the frames of one "
                   "video are of one size",
                   path, width, lines, v->info.width_px, p->lines);
}

static weft_status read_file(wf_video *v, int n, weft_error *err) {
    pictures *p = v->state;
    const wf_subframe_ref *ref = &p->sequence.refs[v->frame.index * p->fields + n];
    wf_subframe *subframe;
    weft_status status = wf_subframe_open(ref->path, ref->part, &p->source, &subframe, err);
    if (status) return status;
    status = check_size(v, ref->path, wf_subframe_info(subframe), err);
    if (!status) status = read_picture(v, n, subframe, err);
    wf_subframe_close(subframe);
    return status;
}

static weft_status pictures_next(wf_video *v, bool *more, weft_error *err) {
    const pictures *p = v->state;
    weft_status status = WEFT_OK;
    *more = v->frame.index < v->info.frames;
    for (int n = 0; *more && !status && n < p->fields; n++) status = read_file(v, n, err);
    return status;
}

const wf_video_kind wf_video_pictures = {pictures_open, pictures_next, NULL, pictures_close};
