/* Reads what a container and its streams say, for the libav module. */
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/pixdesc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/media/libav/libav_packets.h"
#include "convert/media/libav/libav_reading.h"

WEFT_API wf_libav_metadata_fn wf_libav_metadata;

static void copy(char *to, size_t size, const char *text) {
    snprintf(to, size, "%s", text ? text : "");
}

static wf_rational ratio_of(AVRational r) {
    return r.num > 0 && r.den > 0 ? wf_ratio(r.num, r.den) : (wf_rational){0, 0};
}

static void read_scan(enum AVFieldOrder order, wf_metadata *c) {
    c->scan_known = order != AV_FIELD_UNKNOWN;
    c->interlaced = c->scan_known && order != AV_FIELD_PROGRESSIVE;
    c->top_first = order == AV_FIELD_TT || order == AV_FIELD_TB;
}

static double seconds_of(const AVStream *s) {
    return s->duration > 0 ? (double)s->duration * av_q2d(s->time_base) : 0;
}

static void read_video(const AVStream *s, wf_metadata *c) {
    const AVCodecParameters *p = s->codecpar;
    copy(c->codec, sizeof c->codec, avcodec_get_name(p->codec_id));
    copy(c->profile, sizeof c->profile, avcodec_profile_name(p->codec_id, p->profile));
    copy(c->pixels, sizeof c->pixels, av_get_pix_fmt_name((enum AVPixelFormat)p->format));
    c->level = p->level;
    c->bit_rate = p->bit_rate;
    c->width_px = p->width;
    c->lines = p->height;
    c->rate = ratio_of(s->avg_frame_rate.num ? s->avg_frame_rate : s->r_frame_rate);
    c->pixel_aspect =
        ratio_of(s->sample_aspect_ratio.num ? s->sample_aspect_ratio : p->sample_aspect_ratio);
    read_scan(p->field_order, c);
    c->tags = (wf_color_tags){(int)p->color_primaries, (int)p->color_trc, (int)p->color_space};
    c->tagged = p->color_primaries != AVCOL_PRI_UNSPECIFIED &&
                p->color_trc != AVCOL_TRC_UNSPECIFIED &&
                p->color_space != AVCOL_SPC_UNSPECIFIED;
    c->frames = s->nb_frames > 0 ? s->nb_frames : -1;
    c->video_s = seconds_of(s);
    if (s->start_time != AV_NOPTS_VALUE && s->start_time > 0)
        c->start_s = (double)s->start_time * av_q2d(s->time_base);
}

static void read_sound(const AVStream *s, wf_metadata *c) {
    double length_s = seconds_of(s);
    int bits = s->codecpar->bits_per_raw_sample;
    if (!c->sound_streams++)
        copy(c->sound_codec, sizeof c->sound_codec, avcodec_get_name(s->codecpar->codec_id));
    c->sound_channels += s->codecpar->ch_layout.nb_channels;
    c->sound_rate = s->codecpar->sample_rate;
    c->sound_bits = bits ? bits : av_get_bits_per_sample(s->codecpar->codec_id);
    if (c->sound_streams == 1 || length_s < c->sound_s) c->sound_s = length_s;
}

static void read_timecode(const AVDictionary *tags, wf_metadata *c) {
    const AVDictionaryEntry *tag = av_dict_get(tags, "timecode", NULL, 0);
    if (tag && !*c->timecode) copy(c->timecode, sizeof c->timecode, tag->value);
}

/* Codecs whose pictures say when they are progressive; of others no word is no answer. */
static bool says_progressive(enum AVCodecID id) {
    static const enum AVCodecID ids[] = {
        AV_CODEC_ID_MPEG2VIDEO, AV_CODEC_ID_H264, AV_CODEC_ID_HEVC,      AV_CODEC_ID_PRORES,
        AV_CODEC_ID_DNXHD,      AV_CODEC_ID_VC1,  AV_CODEC_ID_MPEG1VIDEO};
    for (size_t i = 0; i < sizeof ids / sizeof *ids; i++)
        if (ids[i] == id) return true;
    return false;
}

/* The first picture states the scan where the container does not. */
static void read_frame(const AVFrame *frame, enum AVCodecID id, wf_metadata *c) {
    c->coded_fields = frame->interlaced_frame;
    c->coded_top_first = c->coded_fields && frame->top_field_first;
    bool fields_after_all = c->scan_known && !c->interlaced && frame->interlaced_frame &&
                            id == AV_CODEC_ID_H264; /* its parser takes MBAFF for progressive */
    if ((c->scan_known && !fields_after_all) ||
        !(frame->interlaced_frame || says_progressive(id)))
        return;
    c->scan_known = true;
    c->interlaced = frame->interlaced_frame;
    c->top_first = c->interlaced && frame->top_field_first;
}

/* Counts what is there, and looks at the first picture. */
static weft_status read_contents(AVFormatContext *format, int video, wf_metadata *c,
                                 weft_error *err) {
    AVFrame *frame = av_frame_alloc();
    int code = frame ? wf_libav_packets(format, video, c, frame) : AVERROR(ENOMEM);
    if (code >= 0 && frame->width)
        read_frame(frame, format->streams[video]->codecpar->codec_id, c);
    av_frame_free(&frame);
    return code < 0 ? wf_fail(err, WEFT_NO_MEMORY, "no memory to count packets") : WEFT_OK;
}

static weft_status read_format(AVFormatContext *format, const char *path, wf_metadata *c,
                               weft_error *err) {
    int video = wf_libav_video_of(format, NULL);
    if (video < 0) return wf_libav_no_video(format, path, err);
    size_t first = strcspn(format->iformat->name, ",");
    snprintf(c->container, sizeof c->container, "%.*s", (int)first, format->iformat->name);
    const AVDictionaryEntry *brand = av_dict_get(format->metadata, "major_brand", NULL, 0);
    c->of_mpeg4 = brand && strcmp(brand->value, "qt  ");
    read_video(format->streams[video], c);
    if (format->duration_estimation_method != AVFMT_DURATION_FROM_STREAM) c->video_s = 0;
    read_timecode(format->metadata, c);
    for (unsigned i = 0; i < format->nb_streams; i++) {
        const AVStream *s = format->streams[i];
        read_timecode(s->metadata, c);
        if (s->codecpar->codec_type == AVMEDIA_TYPE_AUDIO) read_sound(s, c);
    }
    if (format->duration_estimation_method != AVFMT_DURATION_FROM_STREAM) c->sound_s = 0;
    return read_contents(format, video, c, err);
}

weft_status wf_libav_metadata(const char *path, wf_metadata *metadata, weft_error *err) {
    AVFormatContext *format = NULL;
    char why[AV_ERROR_MAX_STRING_SIZE] = "";
    char *url = malloc(strlen(path) + sizeof "file:"); /* a ':' is no protocol's */
    if (!url) return wf_fail(err, WEFT_NO_MEMORY, "%.700s: out of memory", path);
    strcat(strcpy(url, "file:"), path);
    av_log_set_level(AV_LOG_QUIET);
    int code = avformat_open_input(&format, url, NULL, NULL);
    free(url);
    if (code >= 0) code = avformat_find_stream_info(format, NULL);
    weft_status status = code < 0 ? WEFT_FAILED : read_format(format, path, metadata, err);
    avformat_close_input(&format);
    if (code >= 0) return status;
    av_strerror(code, why, sizeof why);
    return wf_fail(err, WEFT_FAILED, "%.700s: it is no video that libav knows: %s", path, why);
}
