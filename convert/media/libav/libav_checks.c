/* Whether streams and their frames are what they are taken for, for the libav module. */
#include <inttypes.h>
#include <libavutil/display.h>
#include <math.h>

#include "convert/media/libav/libav_reading.h"

/* ---- The stream ---- */

weft_status wf_libav_no_video(AVFormatContext *format, const char *path, weft_error *err) {
    if (av_find_best_stream(format, AVMEDIA_TYPE_AUDIO, -1, -1, NULL, 0) < 0)
        return wf_fail(err, WEFT_FAILED, "%.700s: it holds no video", path);
    return wf_fail(
        err, WEFT_FAILED,
        "%.700s: it is sound (%s), which holds no video; 'ffmpeg -i IN OUT.wav' makes "
        "WAV of it; --audio FILE.wav takes sound, beside pictures or video",
        path, format->iformat->long_name);
}

int wf_libav_video_of(const AVFormatContext *format, int *count) {
    int first = -1, cover = -1, found = 0;
    for (int i = (int)format->nb_streams - 1; i >= 0; i--) {
        const AVStream *s = format->streams[i];
        if (s->codecpar->codec_type != AVMEDIA_TYPE_VIDEO) continue;
        bool is_cover = s->disposition & AV_DISPOSITION_ATTACHED_PIC;
        *(is_cover ? &cover : &first) = i;
        found += !is_cover;
    }
    if (count) *count = found;
    return first < 0 ? cover : first;
}

/* Degrees, clockwise. */
static double turn_of(const AVStream *stream) {
    size_t bytes;
    const uint8_t *matrix = av_stream_get_side_data(stream, AV_PKT_DATA_DISPLAYMATRIX, &bytes);
    if (!matrix || bytes < 9 * sizeof(int32_t)) return 0;
    double turn = -av_display_rotation_get((const int32_t *)(const void *)matrix);
    return isfinite(turn) ? turn : 0;
}

weft_status wf_libav_check_stream(wf_video *v, weft_error *err) {
    wf_libav_reading *r = v->state;
    const AVFrame *f = r->frame;
    double turn = turn_of(r->format->streams[r->stream]);
    r->aspect = f->sample_aspect_ratio;
    r->primaries = (int)f->color_primaries;
    r->transfer = (int)f->color_trc;
    r->matrix = (int)f->colorspace;
    r->range = (int)f->color_range;
    if (!v->options.codes_only || fabs(turn) < 0.5) return WEFT_OK;
    return wf_fail(err, WEFT_FAILED,
                   "%s: it is to be shown turned by %.0f degrees; turn it first, with "
                   "ffmpeg -i IN -c:v ffv1 OUT.mkv, or where that is wrong take it off, with "
                   "ffmpeg -i IN -c copy -metadata:s:v rotate=0 OUT.mov",
                   v->path, turn);
}

/* ---- Frames ---- */

static const char *pixels_of(const AVFrame *f) {
    const char *name = av_get_pix_fmt_name((enum AVPixelFormat)f->format);
    return name ? name : "unknown";
}

static const char *what_changed(const wf_libav_reading *r, const wf_video_options *options) {
    const AVFrame *f = r->frame;
    AVRational a = f->sample_aspect_ratio, b = r->aspect;
    if (a.num && b.num && av_cmp_q(a, b)) return "has pixels of another aspect";
    bool full = f->color_range == AVCOL_RANGE_JPEG, was_full = r->range == AVCOL_RANGE_JPEG;
    if ((int)f->colorspace != r->matrix || (int)f->color_primaries != r->primaries ||
        (int)f->color_trc != r->transfer || full != was_full)
        return "has other colors";
    return options->progressive_only && f->interlaced_frame ? "is interlaced" : NULL;
}

bool wf_libav_is_damaged(const AVFrame *frame) {
    return frame->decode_error_flags || frame->flags & AV_FRAME_FLAG_CORRUPT;
}

weft_status wf_libav_check_frame(const wf_video *v, double time_s, weft_error *err) {
    const wf_libav_reading *r = v->state;
    const AVFrame *f = r->frame;
    bool same = f->width == v->info.width_px &&
                f->height == v->info.lines + v->info.interval_lines &&
                av_pix_fmt_desc_get((enum AVPixelFormat)f->format) == r->pixels;
    const char *changed = v->options.codes_only ? what_changed(r, &v->options) : NULL;
    if (!same)
        return wf_fail(
            err, WEFT_FAILED,
            "%s: frame %" PRId64
            " (%.3f s) is %dx%d %s, and the ones before it are %dx%d %s; cut the video "
            "there, and convert the pieces one by one",
            v->path, v->frame.index, time_s, f->width, f->height, pixels_of(f),
            v->info.width_px, v->info.lines, r->pixels->name);
    if (!changed) return WEFT_OK;
    return wf_fail(err, WEFT_FAILED,
                   "%s: frame %" PRId64
                   " (%.3f s) %s, unlike the ones before it; cut the video there, and "
                   "convert the pieces one by one",
                   v->path, v->frame.index, time_s, changed);
}
