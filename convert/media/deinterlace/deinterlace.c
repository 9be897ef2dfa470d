/* FFmpeg's deinterlacers, for the deinterlace module: frames in, a picture for each field out.
 */
#include "convert/media/deinterlace/deinterlace.h"

#include <libavfilter/avfilter.h>
#include <libavfilter/buffersink.h>
#include <libavfilter/buffersrc.h>
#include <libavutil/imgutils.h>
#include <libavutil/opt.h>
#include <libavutil/pixdesc.h>
#include <stdlib.h>
#include <string.h>

WEFT_API wf_deinterlacer_fn wf_deinterlacer_of;

typedef struct deinterlacing {
    wf_woven woven;
    const char *filter; /* of libavfilter */
    const AVPixFmtDescriptor *pixels;
    enum AVPixelFormat format;
    AVFilterGraph *graph;
    AVFilterContext *source, *sink;
    AVFrame *frame;
    int64_t frames;
} deinterlacing;

static weft_status failed(const deinterlacing *d, const char *doing, int code,
                          weft_error *err) {
    char why[AV_ERROR_MAX_STRING_SIZE] = "";
    av_strerror(code, why, sizeof why);
    return wf_fail(err, code == AVERROR(ENOMEM) ? WEFT_NO_MEMORY : WEFT_FAILED,
                   "--display %s: %s: %s", d->woven.filter, doing, why);
}

/* ---- Opening ---- */

/* Options of libavfilter that give a picture a field, of every frame. */
static const struct {
    const char *filter, *options;
} filters[] = {{"bwdif", "mode=send_field:deint=all"},
               {"yadif", "mode=send_field:deint=all"},
               {"w3fdif", "mode=field:deint=all"}};

/* Planes of their own, of this depth and subsampling, in the order of this machine. */
static bool is_format(const AVPixFmtDescriptor *p, const wf_woven *w) {
    const uint64_t other = AV_PIX_FMT_FLAG_HWACCEL | AV_PIX_FMT_FLAG_FLOAT |
                           AV_PIX_FMT_FLAG_ALPHA | AV_PIX_FMT_FLAG_PAL | AV_PIX_FMT_FLAG_BE |
                           AV_PIX_FMT_FLAG_BITSTREAM;
    bool planar = w->planes == 1 || p->flags & AV_PIX_FMT_FLAG_PLANAR;
    bool rgb = p->flags & AV_PIX_FMT_FLAG_RGB, full = !strncmp(p->name, "yuvj", 4);
    if (p->nb_components != w->planes || !planar || p->flags & other || full) return false;
    if (p->comp[0].depth != w->bits || p->comp[0].shift || rgb == w->ycbcr) return false;
    if (w->planes == 3 && (p->comp[1].plane == p->comp[2].plane)) return false;
    return w->planes == 1 ||
           (1 << p->log2_chroma_w == w->across && 1 << p->log2_chroma_h == w->down);
}

static weft_status find_format(deinterlacing *d, weft_error *err) {
    const AVPixFmtDescriptor *p = NULL;
    while ((p = av_pix_fmt_desc_next(p)))
        if (is_format(p, &d->woven)) break;
    d->pixels = p;
    d->format = p ? av_pix_fmt_desc_get_id(p) : AV_PIX_FMT_NONE;
    if (p) return WEFT_OK;
    return wf_fail(
        err, WEFT_FAILED,
        "--display %s: libavfilter has no pixels of %d bits with %dx%d luma samples to "
        "one of chroma; convert the video to 8 or 10 bits, or measure with --display "
        "bob",
        d->woven.filter, d->woven.bits, d->woven.across, d->woven.down);
}

static weft_status make_source(deinterlacing *d, weft_error *err) {
    AVBufferSrcParameters *p = av_buffersrc_parameters_alloc();
    d->source = avfilter_graph_alloc_filter(d->graph, avfilter_get_by_name("buffer"), "in");
    int code = p && d->source ? 0 : AVERROR(ENOMEM);
    if (!code) {
        wf_rational rate = d->woven.frame_rate;
        p->format = d->format;
        p->width = d->woven.width_px;
        p->height = d->woven.lines;
        p->time_base = (AVRational){(int)rate.den, (int)rate.num};
        p->frame_rate = (AVRational){(int)rate.num, (int)rate.den};
        p->sample_aspect_ratio = (AVRational){1, 1};
        code = av_buffersrc_parameters_set(d->source, p);
    }
    av_free(p);
    if (code >= 0) code = avfilter_init_str(d->source, NULL);
    return code < 0 ? failed(d, "its input cannot be made", code, err) : WEFT_OK;
}

static weft_status make_chain(deinterlacing *d, const char *options, weft_error *err) {
    const enum AVPixelFormat formats[] = {d->format, AV_PIX_FMT_NONE};
    const AVFilter *kind = avfilter_get_by_name(d->woven.filter);
    AVFilterContext *filter = NULL;
    if (!kind)
        return wf_fail(err, WEFT_FAILED, "--display %s: this libavfilter has no such filter",
                       d->woven.filter);
    int code =
        avfilter_graph_create_filter(&filter, kind, "deinterlace", options, NULL, d->graph);
    if (code >= 0)
        code = avfilter_graph_create_filter(&d->sink, avfilter_get_by_name("buffersink"), "out",
                                            NULL, NULL, d->graph);
    /* Codes are to come out as they went in, and not through another format. */
    if (code >= 0)
        code = av_opt_set_bin(d->sink, "pix_fmts", (const uint8_t *)formats, sizeof formats[0],
                              AV_OPT_SEARCH_CHILDREN);
    if (code >= 0) code = avfilter_link(d->source, 0, filter, 0);
    if (code >= 0) code = avfilter_link(filter, 0, d->sink, 0);
    avfilter_graph_set_auto_convert(d->graph, (unsigned)AVFILTER_AUTO_CONVERT_NONE);
    if (code >= 0) code = avfilter_graph_config(d->graph, NULL);
    if (code >= 0) return WEFT_OK;
    return wf_fail(
        err, code == AVERROR(ENOMEM) ? WEFT_NO_MEMORY : WEFT_FAILED,
        "--display %s: it takes no pictures of %dx%d as %s; convert the video to Y'CbCr "
        "of 8 or 10 bits and at least 3x4, or measure with --display bob",
        d->woven.filter, d->woven.width_px, d->woven.lines, d->pixels->name);
}

static weft_status deinterlace_open(const wf_woven *woven, void **state, weft_error *err) {
    const char *options = "";
    deinterlacing *d = *state = calloc(1, sizeof *d);
    if (!d) return wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    d->woven = *woven;
    for (size_t i = 0; i < sizeof filters / sizeof *filters; i++)
        if (!strcmp(filters[i].filter, woven->filter)) options = filters[i].options;
    av_log_set_level(AV_LOG_QUIET);
    weft_status status = find_format(d, err);
    if (status) return status;
    d->graph = avfilter_graph_alloc();
    d->frame = av_frame_alloc();
    if (!d->graph || !d->frame) return wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    d->graph->nb_threads = 1;
    status = make_source(d, err);
    return status ? status : make_chain(d, options, err);
}

static void deinterlace_close(void *state) {
    deinterlacing *d = state;
    if (!d) return;
    av_frame_free(&d->frame);
    avfilter_graph_free(&d->graph);
    free(d);
}

/* ---- Frames ---- */

/* Where line y of a component is in a frame. */
static uint8_t *line_of(const deinterlacing *d, int component, int y) {
    int plane = d->pixels->comp[component].plane;
    return d->frame->data[plane] + (ptrdiff_t)y * d->frame->linesize[plane];
}

static void plane_size(const deinterlacing *d, int component, int *width, int *lines) {
    const wf_woven *w = &d->woven;
    bool chroma = component && w->ycbcr;
    *width = chroma ? AV_CEIL_RSHIFT(w->width_px, d->pixels->log2_chroma_w) : w->width_px;
    *lines = chroma ? AV_CEIL_RSHIFT(w->lines, d->pixels->log2_chroma_h) : w->lines;
}

static void fill_plane(const deinterlacing *d, int component, const uint16_t *code) {
    int width, lines;
    plane_size(d, component, &width, &lines);
    for (int y = 0; y < lines; y++, code += width) {
        uint8_t *to = line_of(d, component, y);
        if (d->woven.bits > 8)
            memcpy(to, code, (size_t)width * sizeof *code);
        else
            for (int x = 0; x < width; x++) to[x] = (uint8_t)code[x];
    }
}

static void empty_plane(const deinterlacing *d, int component, uint16_t *code) {
    int width, lines;
    plane_size(d, component, &width, &lines);
    for (int y = 0; y < lines; y++, code += width) {
        const uint8_t *from = line_of(d, component, y);
        if (d->woven.bits > 8)
            memcpy(code, from, (size_t)width * sizeof *code);
        else
            for (int x = 0; x < width; x++) code[x] = from[x];
    }
}

static weft_status deinterlace_put(void *state, const uint16_t *const plane[3],
                                   weft_error *err) {
    deinterlacing *d = state;
    int code = 0;
    if (plane) {
        d->frame->format = d->format;
        d->frame->width = d->woven.width_px;
        d->frame->height = d->woven.lines;
        d->frame->interlaced_frame = 1;
        d->frame->top_field_first = d->woven.top_first;
        d->frame->sample_aspect_ratio = (AVRational){1, 1};
        d->frame->pts = d->frames++;
        code = av_frame_get_buffer(d->frame, 0);
        for (int p = 0; p < d->woven.planes && code >= 0; p++) fill_plane(d, p, plane[p]);
    }
    if (code >= 0) code = av_buffersrc_add_frame(d->source, plane ? d->frame : NULL);
    av_frame_unref(d->frame);
    return code < 0 ? failed(d, "a frame cannot be deinterlaced", code, err) : WEFT_OK;
}

static weft_status deinterlace_take(void *state, uint16_t *const plane[3], bool *more,
                                    weft_error *err) {
    deinterlacing *d = state;
    int code = av_buffersink_get_frame(d->sink, d->frame);
    *more = code >= 0;
    if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return WEFT_OK;
    if (code < 0) return failed(d, "a frame cannot be deinterlaced", code, err);
    for (int p = 0; p < d->woven.planes; p++) empty_plane(d, p, plane[p]);
    av_frame_unref(d->frame);
    return WEFT_OK;
}

const wf_deinterlacer *wf_deinterlacer_of(void) {
    static const wf_deinterlacer kind = {deinterlace_open, deinterlace_put, deinterlace_take,
                                         deinterlace_close};
    return &kind;
}
