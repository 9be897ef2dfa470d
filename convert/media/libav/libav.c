/* Reads video, for the libav module: the first video stream of any file that libavformat and
 * libavcodec can read. */
#include "convert/media/libav/libav.h"

#include "convert/base/infile.h"
#include "convert/media/libav/ffv1_slices.h"
#include "convert/media/libav/libav_reading.h"
#include "convert/media/libav/libav_times.h"
#include "convert/media/metadata_mov.h"

#include <inttypes.h>
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/parseutils.h>
#include <libavutil/pixdesc.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

WEFT_API wf_libav_kind_fn wf_libav_kind;

typedef wf_libav_reading reading;

static weft_status failed(const wf_video *v, const char *doing, int code, weft_error *err) {
    char why[AV_ERROR_MAX_STRING_SIZE] = "";
    av_strerror(code, why, sizeof why);
    return wf_fail(err, code == AVERROR(ENOMEM) ? WEFT_NO_MEMORY : WEFT_FAILED, "%s: %s: %s",
                   v->path, doing, why);
}

/* ---- Opening ---- */

enum { PIPE_BYTES = 1 << 16 };

static int read_pipe(void *opaque, uint8_t *to, int size) {
    wf_video *v = opaque;
    reading *r = v->state;
    FILE *pipe = v->pipe;
    size_t got = fread(to, 1, (size_t)size, pipe);
    r->pipe_bytes += (int64_t)got;
    return got ? (int)got : ferror(pipe) ? AVERROR(EIO) : AVERROR_EOF;
}

/* libav reads a pipe through its FILE, whose first byte has been looked at. */
static weft_status use_pipe(wf_video *v, weft_error *err) {
    reading *r = v->state;
    uint8_t *buffer = av_malloc(PIPE_BYTES);
    r->format = avformat_alloc_context();
    if (buffer) r->pipe = avio_alloc_context(buffer, PIPE_BYTES, 0, v, read_pipe, NULL, NULL);
    if (!r->pipe) av_free(buffer);
    if (!r->format || !r->pipe) return wf_video_no_memory(v, err);
    r->format->pb = r->pipe;
    return WEFT_OK;
}

static weft_status find_stream(wf_video *v, weft_error *err) {
    reading *r = v->state;
    weft_status status = v->pipe ? use_pipe(v, err) : WEFT_OK;
    if (status) return status;
    char *url = malloc(strlen(v->path) + sizeof "file:"); /* a ':' is no protocol's */
    if (!url) return wf_video_no_memory(v, err);
    strcat(strcpy(url, "file:"), v->path);
    int code = avformat_open_input(&r->format, v->pipe ? NULL : url, NULL, NULL);
    free(url);
    if (code < 0)
        return failed(v, "it is no video that libav knows, nor Y4M, v210, uyvy or a picture",
                      code, err);
    code = avformat_find_stream_info(r->format, NULL);
    if (code < 0) return failed(v, "its streams cannot be found out", code, err);
    r->stream = wf_libav_video_of(r->format, &v->info.videos);
    if (r->stream < 0) return wf_libav_no_video(r->format, v->path, err);
    if (r->format->streams[r->stream]->disposition & AV_DISPOSITION_ATTACHED_PIC)
        return wf_fail(err, WEFT_FAILED, "%s: it holds no video, only a picture as its cover",
                       v->path);
    return WEFT_OK;
}

/* Alpha of VP8 and VP9 is a stream beside the picture's, which libvpx's decoders alone show. */
static const AVCodec *decoder_for(wf_video *v, const AVStream *stream) {
    enum AVCodecID codec = stream->codecpar->codec_id;
    const AVDictionaryEntry *alpha = av_dict_get(stream->metadata, "alpha_mode", NULL, 0);
    bool vp8 = codec == AV_CODEC_ID_VP8, vpx = vp8 || codec == AV_CODEC_ID_VP9;
    const AVCodec *found = NULL;
    bool has = vpx && alpha && !strcmp(alpha->value, "1");
    if (has) found = avcodec_find_decoder_by_name(vp8 ? "libvpx" : "libvpx-vp9");
    v->info.alpha_lost = has && !found;
    return found ? found : avcodec_find_decoder(codec);
}

static weft_status open_decoder(wf_video *v, weft_error *err) {
    reading *r = v->state;
    const AVCodecParameters *par = r->format->streams[r->stream]->codecpar;
    const AVCodec *decoder = decoder_for(v, r->format->streams[r->stream]);
    if (!decoder)
        return wf_fail(err, WEFT_FAILED, "%s: libav has no decoder for its video (%s)", v->path,
                       avcodec_get_name(par->codec_id));
    r->codec = avcodec_alloc_context3(decoder);
    r->packet = av_packet_alloc();
    r->frame = av_frame_alloc();
    if (!r->codec || !r->packet || !r->frame) return wf_video_no_memory(v, err);
    int code = avcodec_parameters_to_context(r->codec, par);
    r->codec->opaque = r;
    r->codec->thread_count = 0; /* one a core */
    /* Pictures decoded at once are lost together, as many as there are threads; and those of a
     * damaged APNG wait for each other without end. */
    if (v->options.mends || par->codec_id == AV_CODEC_ID_APNG)
        r->codec->thread_type = FF_THREAD_SLICE;
    r->codec->err_recognition = AV_EF_CRCCHECK;
    /* What ends early is concealed without a word. Other decoders of FFmpeg 5.1 hear no more by
     * that, or abort the program where they are told to stop at errors (MPEG-4). */
    if (par->codec_id == AV_CODEC_ID_H264 || par->codec_id == AV_CODEC_ID_MJPEG)
        r->codec->err_recognition |= AV_EF_EXPLODE;
    if (code >= 0) code = avcodec_open2(r->codec, decoder, NULL);
    return code < 0 ? failed(v, "its decoder cannot be opened", code, err) : WEFT_OK;
}

weft_status wf_libav_open_stream(wf_video *v, weft_error *err) {
    weft_status status = find_stream(v, err);
    return status ? status : open_decoder(v, err);
}

void wf_libav_close_stream(wf_video *v) {
    reading *r = v->state;
    av_frame_free(&r->frame);
    av_frame_free(&r->held);
    av_packet_free(&r->packet);
    avcodec_free_context(&r->codec);
    avformat_close_input(&r->format);
    if (r->pipe) av_freep(&r->pipe->buffer);
    avio_context_free(&r->pipe);
}

/* ---- Frames ---- */

static void note_packet(reading *r) {
    const AVStream *stream = r->format->streams[r->stream];
    int64_t start = r->packet->pts != AV_NOPTS_VALUE ? r->packet->pts : r->packet->dts;
    double end = (double)(start + r->packet->duration) * av_q2d(stream->time_base);
    r->packets++;
    if (start != AV_NOPTS_VALUE && end > r->end_s) r->end_s = end;
}

/* The frame in hand, or the first while the file is being opened. */
static int64_t frame_in_hand(const wf_video *v) {
    return v->frame.index < 0 ? 0 : v->frame.index;
}

/* When it is shown, as far as the mean rate tells. */
double wf_libav_time_s(const wf_video *v) {
    const reading *r = v->state;
    AVRational rate = r->format->streams[r->stream]->avg_frame_rate;
    return rate.num > 0 ? (double)frame_in_hand(v) / av_q2d(rate) : 0;
}

static weft_status undecodable(const wf_video *v, int code, weft_error *err) {
    char doing[96];
    snprintf(doing, sizeof doing, "it cannot be decoded about frame %" PRId64 " (%.3f s)",
             frame_in_hand(v), wf_libav_time_s(v));
    return failed(v, doing, code, err);
}

/* Whether the packet in hand is for the decoder; after a jump none is before a keyframe. */
static bool is_wanted(reading *r) {
    if (r->packet->stream_index != r->stream) return false;
    if (r->until_key && r->packet->flags & AV_PKT_FLAG_KEY) {
        r->until_key = false;
        r->key_ticks = r->packet->pts;
    }
    return !r->until_key;
}

/* Whether what carries the packet, or FFV1's checksums, say that it is damaged. Where packets
 * before it had checksums it has them too. */
static bool is_damaged(reading *r) {
    const AVPacket *p = r->packet;
    if (p->flags & AV_PKT_FLAG_CORRUPT) return true;
    if (r->codec->codec_id != AV_CODEC_ID_FFV1 || !r->codec->extradata_size) return false;
    wf_ffv1_slices slices = wf_ffv1_check(p->data, (size_t)p->size);
    bool damaged = slices == WF_FFV1_DAMAGED || (r->checked && slices != WF_FFV1_SOUND);
    r->checked |= slices == WF_FFV1_SOUND;
    return damaged;
}

/* QuickTime and MP4 are read by their index, and a pipe cannot go back from it. */
static weft_status unread(const wf_video *v, int code, weft_error *err) {
    const reading *r = v->state;
    bool by_index = v->pipe && !strncmp(r->format->iformat->name, "mov,", 4);
    if (!by_index || v->frame.index >= 0)
        return failed(v, "it cannot be read to its end", code, err);
    return wf_fail(
        err, WEFT_FAILED,
        "%s: its index is at its end, which a pipe comes to too late, or it was cut off "
        "before its first picture; give the file itself, or write it with ffmpeg -i IN "
        "-c copy -movflags +faststart OUT.mp4",
        v->path);
}

/* Hands the decoder the next packet of the stream; at the end, that there are no more. */
static weft_status feed(wf_video *v, weft_error *err) {
    reading *r = v->state;
    int code = av_read_frame(r->format, r->packet);
    if (code == AVERROR_EOF) {
        r->drained = true;
        avcodec_send_packet(r->codec, NULL);
        return WEFT_OK;
    }
    if (code < 0 && v->options.mends) {
        r->drained = true; /* what was read before may still be decoded */
        avcodec_send_packet(r->codec, NULL);
    }
    if (code < 0) return unread(v, code, err);
    if (is_wanted(r)) {
        note_packet(r);
        r->codec->reordered_opaque = r->packets;
        code = is_damaged(r) ? AVERROR_INVALIDDATA : avcodec_send_packet(r->codec, r->packet);
    }
    av_packet_unref(r->packet);
    if (code >= 0) return WEFT_OK;
    return undecodable(v, code, err);
}

weft_status wf_libav_decode(wf_video *v, weft_error *err) {
    reading *r = v->state;
    weft_status status = WEFT_OK;
    while (!status && !r->have) {
        int code = avcodec_receive_frame(r->codec, r->frame);
        r->have = code >= 0;
        if (code == AVERROR_EOF || (code == AVERROR(EAGAIN) && r->drained)) break;
        if (code == AVERROR(EAGAIN))
            status = feed(v, err);
        else if (code < 0)
            status = undecodable(v, code, err);
    }
    return status;
}

/* The same, and the frame is as it was coded. */
static weft_status decode(wf_video *v, weft_error *err) {
    const reading *r = v->state;
    weft_status status = wf_libav_decode(v, err);
    if (!status && r->have && wf_libav_is_damaged(r->frame))
        status = wf_fail(err, WEFT_FAILED, "%s: frame %" PRId64 " (%.3f s) is damaged", v->path,
                         frame_in_hand(v), wf_libav_time_s(v));
    return status;
}

/* ---- What it is ---- */

/* libav's TB and BT are what QuickTime's {2,9} and {2,14} become: the first letter is the field
 * that is shown first, whatever the names' comments say. */
static void label_scan(const reading *r, wf_video_label *label) {
    enum AVFieldOrder order = r->codec->field_order;
    bool unknown = order == AV_FIELD_UNKNOWN, frame_says = r->frame->interlaced_frame;
    /* The parser of H.264 takes MBAFF for progressive. */
    if (order == AV_FIELD_PROGRESSIVE && frame_says) unknown = true;
    label->interlaced = unknown ? frame_says : order != AV_FIELD_PROGRESSIVE;
    label->top_first = unknown ? frame_says && r->frame->top_field_first
                               : order == AV_FIELD_TT || order == AV_FIELD_TB;
    label->scan_known = !unknown || frame_says;
}

/* Takes the colors that the stream is tagged with; a stream without tags has those of the
 * raster. */
static void label_color(const reading *r, wf_video_label *label) {
    static const struct {
        enum AVColorSpace space;
        enum AVColorPrimaries primaries; /* AVCOL_PRI_UNSPECIFIED: any */
        wf_matrix matrix;
    } rows[] = {{AVCOL_SPC_BT709, AVCOL_PRI_UNSPECIFIED, WF_709},
                {AVCOL_SPC_BT2020_NCL, AVCOL_PRI_UNSPECIFIED, WF_2020},
                {AVCOL_SPC_BT470BG, AVCOL_PRI_UNSPECIFIED, WF_601_625},
                {AVCOL_SPC_SMPTE170M, AVCOL_PRI_BT470BG, WF_601_625},
                {AVCOL_SPC_SMPTE170M, AVCOL_PRI_UNSPECIFIED, WF_601_525}};
    const AVFrame *f = r->frame;
    for (size_t i = 0; i < sizeof rows / sizeof *rows && !label->matrix_known; i++) {
        bool any = rows[i].primaries == AVCOL_PRI_UNSPECIFIED;
        label->matrix_known =
            f->colorspace == rows[i].space && (any || f->color_primaries == rows[i].primaries);
        label->matrix = rows[i].matrix;
    }
    label->transfer = f->color_trc == AVCOL_TRC_SMPTE2084      ? WF_TRANSFER_PQ
                      : f->color_trc == AVCOL_TRC_ARIB_STD_B67 ? WF_TRANSFER_HLG
                                                               : WF_TRANSFER_BT1886;
}

/* H.273's code points are libav's own numbers. QuickTime's and MPEG's chroma lies to the left
 * where nothing is said, JPEG's amid. */
static wf_video_tags tags_of(const reading *r, bool jpeg) {
    const AVFrame *f = r->frame;
    wf_siting siting = jpeg ? WF_SITING_CENTER : WF_SITING_LEFT;
    if (f->chroma_location == AVCHROMA_LOC_CENTER) siting = WF_SITING_CENTER;
    if (f->chroma_location == AVCHROMA_LOC_TOPLEFT) siting = WF_SITING_TOP_LEFT;
    if (f->chroma_location == AVCHROMA_LOC_LEFT) siting = WF_SITING_LEFT;
    bool range_said = jpeg || f->color_range != AVCOL_RANGE_UNSPECIFIED;
    const char *format = r->format->iformat->name;
    bool pictures = !strcmp(format, "gif") || !strcmp(format, "apng");
    return (wf_video_tags){(int)f->color_primaries,
                           (int)f->color_trc,
                           (int)f->colorspace,
                           range_said,
                           siting,
                           pictures};
}

/* QuickTime says it by the way in which the picture is laid over others (Graphics Modes):
 * straight, and multiplied over black. */
static weft_status read_alpha_said(const wf_video *v, wf_alpha *alpha, weft_error *err) {
    const reading *r = v->state;
    wf_metadata metadata = {0};
    bool mov = !v->pipe && !strncmp(r->format->iformat->name, "mov,", 4);
    FILE *file;
    *alpha = WF_ALPHA_UNSET;
    weft_status status = mov ? wf_infile_open(v->path, &file, err) : WEFT_OK;
    if (!mov || status) return status;
    wf_metadata_mov(file, &metadata);
    *alpha = metadata.graphics_mode == 0x100   ? WF_ALPHA_STRAIGHT
             : metadata.graphics_mode == 0x102 ? WF_ALPHA_PREMULTIPLIED
                                               : WF_ALPHA_UNSET;
    return wf_infile_close(file, v->path, WEFT_OK, err);
}

static weft_status describe_pixels(wf_video *v, weft_error *err) {
    reading *r = v->state;
    const AVPixFmtDescriptor *d = r->pixels =
        av_pix_fmt_desc_get((enum AVPixelFormat)r->frame->format);
    const uint64_t strange = AV_PIX_FMT_FLAG_HWACCEL | AV_PIX_FMT_FLAG_BAYER |
                             AV_PIX_FMT_FLAG_FLOAT | AV_PIX_FMT_FLAG_PAL |
                             AV_PIX_FMT_FLAG_BITSTREAM;
    bool xyz =
        d && !strncmp(d->name, "xyz", 3); /* of digital cinema; libav has no flag for it */
    if (!d || xyz || d->flags & strange || d->comp[0].depth < 8 || d->comp[0].depth > 16)
        return wf_fail(
            err, WEFT_FAILED,
            "%s: its pixels are %s, which is not read; convert it first, such as with "
            "ffmpeg -i IN -pix_fmt gbrp -c:v ffv1 OUT.mkv",
            v->path, d ? d->name : "unknown");
    wf_video_info *info = &v->info;
    bool rgb = d->flags & AV_PIX_FMT_FLAG_RGB, jpeg = !strncmp(d->name, "yuvj", 4);
    snprintf(info->format, sizeof info->format, "%s %s %s", r->format->iformat->name,
             avcodec_get_name(r->codec->codec_id), d->name);
    info->layout = rgb ? WF_RGB : WF_YCBCR;
    info->bits = d->comp[0].depth;
    info->alpha = d->flags & AV_PIX_FMT_FLAG_ALPHA;
    info->full_range = rgb || jpeg || r->frame->color_range == AVCOL_RANGE_JPEG;
    info->planes = d->nb_components < 3 ? 1 : 3;
    info->across = 1 << d->log2_chroma_w;
    info->down = 1 << d->log2_chroma_h;
    info->tags = tags_of(r, jpeg);
    return read_alpha_said(v, &info->alpha_said, err);
}

static wf_rational ratio_of(AVRational r) {
    return r.num > 0 && r.den > 0 ? wf_ratio(r.num, r.den) : (wf_rational){0, 0};
}

/* D-10 (SMPTE ST 356) codes the end of the vertical interval with the picture. */
static int interval_lines(const reading *r) {
    const AVFrame *f = r->frame;
    if (r->codec->codec_id != AV_CODEC_ID_MPEG2VIDEO || f->width != 720) return 0;
    return f->height == 608 ? 32 : f->height == 512 ? 26 : 0;
}

/* MXF states the aspect ratio of the picture, which is not exactly that of a whole line of
 * 601. */
static wf_rational pixel_aspect(const reading *r, int lines) {
    static const struct {
        int lines;
        wf_rational narrow, wide;
    } rows[] = {
        {480, {10, 11}, {40, 33}}, {486, {10, 11}, {40, 33}}, {576, {12, 11}, {16, 11}}};
    AVStream *stream = r->format->streams[r->stream];
    /* The container's pixel aspect is taken before the codec's, which may state none. */
    wf_rational given = ratio_of(av_guess_sample_aspect_ratio(r->format, stream, r->frame));
    if (strcmp(r->format->iformat->name, "mxf") || r->frame->width != 720) return given;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (rows[i].lines == lines && wf_ratio_given(given))
            return wf_ratio_value(given) > 1.15 ? rows[i].wide : rows[i].narrow;
    return given;
}

static bool is_customary(wf_rational rate) {
    const wf_raster *r;
    for (size_t i = 0; (r = wf_raster_at(i)); i++)
        if (wf_ratio_equal(r->frame_rate, rate)) return true;
    return false;
}

/* Whether a mean is no rate of video, and what lies between most pictures is one like it: in
 * milliseconds, and whatever is copied from those, frames of 30000/1001 are uneven. */
static bool is_rounded(wf_rational mean, wf_rational between) {
    if (!wf_ratio_given(between) || is_customary(mean) || !is_customary(between)) return false;
    return fabs(wf_ratio_value(mean) / wf_ratio_value(between) - 1) < 0.01;
}

/* The rate at which frames are shown. Elementary streams have no times, and the demuxer makes
 * up 25 a second; fields that are packets of their own count twice; and where fields are
 * repeated, as in film on 60 fields, fewer frames are coded than are shown. A mean that is no
 * rate of video is one of times that were rounded. AVI counts empty chunks, which H.264 often
 * has after each picture, since its clock counts fields. */
static wf_rational frame_rate(const reading *r) {
    const AVStream *stream = r->format->streams[r->stream];
    wf_rational average = ratio_of(stream->avg_frame_rate);
    wf_rational between = ratio_of(stream->r_frame_rate); /* empty chunks of AVI, by times */
    wf_rational coded = ratio_of(r->codec->framerate);
    if (!wf_ratio_given(average) || is_rounded(average, between)) average = between;
    bool empty = !strcmp(r->format->iformat->name, "avi") && between.num > 0 &&
                 wf_ratio_value(between) < 0.9 * wf_ratio_value(average);
    if (!wf_ratio_given(coded) || !wf_ratio_given(average)) return empty ? between : average;
    double times = wf_ratio_value(average) / wf_ratio_value(coded);
    bool untimed = r->format->iformat->flags & AVFMT_NOTIMESTAMPS;
    bool by_fields = !strcmp(r->format->iformat->name, "gxf"); /* its time base is theirs */
    bool fields = (r->frame->interlaced_frame || by_fields) && fabs(times - 2) < 1e-6;
    bool repeats =
        r->codec->codec_id == AV_CODEC_ID_MPEG2VIDEO && times > 0.79 && times < 0.999;
    bool rounded = fabs(times - 1) < 0.1 && is_customary(coded) && !is_customary(average);
    return untimed || fields || repeats || rounded ? coded : empty ? between : average;
}

static void describe_stream(wf_video *v, wf_video_label *label) {
    const reading *r = v->state;
    const AVStream *stream = r->format->streams[r->stream];
    v->info.width_px = r->frame->width;
    v->info.interval_lines = interval_lines(r);
    v->info.lines = r->frame->height - v->info.interval_lines;
    v->info.frames = !v->pipe && stream->nb_frames > 0 ? stream->nb_frames : -1;
    label->rate = frame_rate(r);
    label->aspect = pixel_aspect(r, v->info.lines);
    label_scan(r, label);
    label_color(r, label);
}

static weft_status libav_open(wf_video *v, wf_video_label *label, weft_error *err) {
    reading *r = v->state = calloc(1, sizeof *r);
    if (!r) return wf_video_no_memory(v, err);
    wf_libav_listen();
    weft_status status = wf_libav_open_stream(v, err);
    bool mends = v->options.mends;
    if (!status) status = mends ? wf_libav_mend_first(v, err) : decode(v, err);
    if (!status && !r->have)
        status = wf_fail(err, WEFT_FAILED, "%s: there is no frame in its video", v->path);
    if (!status) status = describe_pixels(v, err);
    if (!status) status = wf_libav_check_stream(v, err);
    if (status) return status;
    describe_stream(v, label);
    wf_libav_timecode(v);
    AVRational tick = r->format->streams[r->stream]->time_base;
    v->info.tick_s = wf_ratio(tick.num, tick.den);
    if (v->options.want_times)
        status = wf_libav_times(v, r->stream, &r->listed, &r->by_decoding, err);
    if (!status && mends) status = wf_libav_mend_count(v, err);
    if (status) return status;
    r->code = malloc((size_t)v->info.width_px * sizeof *r->code);
    return r->code ? WEFT_OK : wf_video_no_memory(v, err);
}

/* ---- Reading ---- */

/* The codes of a line of a component, which lie one after the other in most formats: bytes or,
 * where they have more than 8 bits, pairs of them; else NULL. */
static const uint8_t *plain_line(const wf_video *v, const AVFrame *f, int p, int y) {
    const reading *r = v->state;
    const AVComponentDescriptor *c = &r->pixels->comp[p];
    const uint8_t *line = f->data[c->plane] + (ptrdiff_t)y * f->linesize[c->plane] + c->offset;
    bool plain = !c->shift && !(r->pixels->flags & AV_PIX_FMT_FLAG_BE);
    bool pairs = c->step == 2 && c->depth > 8 && (uintptr_t)line % 2 == 0;
    return plain && (pairs || (c->step == 1 && c->depth == 8)) ? line : NULL;
}

/* One line of a component: plain ones are taken as they are, or bytes are widened. */
static const uint16_t *line_codes(const wf_video *v, const AVFrame *f, int p, int y,
                                  int width) {
    reading *r = v->state;
    const uint8_t *line = plain_line(v, f, p, y);
    if (line && r->pixels->comp[p].depth > 8) return (const uint16_t *)(const void *)line;
    if (line)
        for (int x = 0; x < width; x++) r->code[x] = line[x];
    else
        av_read_image_line2(r->code, (const uint8_t **)f->data, f->linesize, r->pixels, 0, y, p,
                            width, 0, sizeof *r->code);
    return r->code;
}

/* The components of libav's RGB and Y'CbCr formats are in the order of weft's planes, and alpha
 * comes last. */
static void take_plane(wf_video *v, const AVFrame *f, int p, int component) {
    bool bytes = v->take_codes && wf_video_code_bytes(&v->info) == 1;
    for (int y = 0; y < v->frame.lines[p]; y++) {
        int from = y + v->info.interval_lines;
        const uint8_t *line = bytes ? plain_line(v, f, component, from) : NULL;
        if (line)
            wf_video_take_bytes(v, p, y, line);
        else
            wf_video_take_codes(v, p, y,
                                line_codes(v, f, component, from, v->frame.width_px[p]));
    }
}

static void take_frame(wf_video *v, const AVFrame *f) {
    const wf_libav_reading *r = v->state;
    for (int p = 0; p < v->info.planes; p++) take_plane(v, f, p, p);
    if (wf_video_planes(&v->options, &v->info) > 3)
        take_plane(v, f, 3, r->pixels->nb_components - 1);
}

/* How long the stream states to be; 0 if it does not. Matroska keeps that in a tag. */
double wf_libav_stated_length_s(const wf_libav_reading *r) {
    const AVStream *stream = r->format->streams[r->stream];
    const AVDictionaryEntry *tag = av_dict_get(stream->metadata, "DURATION", NULL, 0);
    int64_t microseconds;
    if (tag && av_parse_time(&microseconds, tag->value, 1) >= 0)
        return 1e-6 * (double)microseconds;
    return r->format->nb_streams == 1 && r->format->duration > 0
               ? (double)r->format->duration / AV_TIME_BASE
               : 0;
}

/* How many packets the file's index counts for the stream; 0 where the number means
 * something else. */
int64_t wf_libav_stated_packets(const wf_libav_reading *r) {
    const char *format = r->format->iformat->name;
    const AVStream *stream = r->format->streams[r->stream];
    if (!strncmp(format, "mov", 3)) return stream->nb_frames;
    return !strcmp(format, "mxf") && stream->duration > 0 ? stream->duration : 0;
}

/* Packets of transport streams have 188 bytes, and with what recorders add 192 or 204. */
static bool ends_in_packet(const reading *r) {
    int64_t bytes = r->pipe_bytes;
    bool stream = !strcmp(r->format->iformat->name, "mpegts");
    return stream && bytes % 188 && bytes % 192 && bytes % 204;
}

/* libavformat does not tell a file that was cut off from one that has ended, so the length
 * is compared. */
weft_status wf_libav_check_end(const wf_video *v, weft_error *err) {
    const reading *r = v->state;
    int64_t packets = wf_libav_stated_packets(r);
    double frame_s = 1 / wf_ratio_value(v->info.raster.frame_rate);
    bool matroska = !strncmp(r->format->iformat->name, "matroska", 8);
    double length_s = matroska ? wf_libav_stated_length_s(r) : 0;
    bool whole = r->packets >= packets && r->end_s + 1.5 * frame_s >= length_s;
    if (whole && !ends_in_packet(r)) return WEFT_OK;
    return wf_fail(err, WEFT_FAILED,
                   "%s: it ends after %" PRId64
                   " frames (%.3f s), before what it says is its end; write it again",
                   v->path, v->frame.index, (double)v->frame.index * frame_s);
}

void wf_libav_give_time(wf_video *v, int64_t ticks, int64_t lasts) {
    reading *r = v->state;
    wf_libav_note_complaints(v);
    bool after = v->frame.index && r->last_ticks != AV_NOPTS_VALUE;
    if (ticks == AV_NOPTS_VALUE && after && wf_ratio_given(v->info.rate))
        ticks = r->last_ticks +
                llround(1 / (wf_ratio_value(v->info.rate) * wf_ratio_value(v->info.tick_s)));
    v->frame.timed = ticks != AV_NOPTS_VALUE;
    v->frame.ticks = r->last_ticks = ticks;
    v->frame.lasts = lasts > 0 ? lasts : 0;
}

/* With pictures that are missing. */
static weft_status mended_next(wf_video *v, bool *more, weft_error *err) {
    const AVFrame *shown = NULL;
    weft_status status = wf_libav_mend_next(v, &shown, err);
    *more = !status && shown;
    if (*more && !(v->take_codes && !v->code[0])) take_frame(v, shown);
    return status;
}

static weft_status libav_next(wf_video *v, bool *more, weft_error *err) {
    reading *r = v->state;
    if (v->options.mends) return mended_next(v, more, err);
    weft_status status = decode(v, err);
    *more = r->have;
    if (status) return status;
    if (!r->have) return wf_libav_check_end(v, err);
    status = wf_libav_check_frame(v, wf_libav_time_s(v), err);
    if (!status && !(v->take_codes && !v->code[0])) take_frame(v, r->frame);
    wf_libav_give_time(v, r->frame->best_effort_timestamp, r->frame->pkt_duration);
    av_frame_unref(r->frame);
    r->have = false;
    return status;
}

static void libav_close(wf_video *v) {
    reading *r = v->state;
    if (!r) return;
    wf_libav_close_stream(v);
    free(r->code);
    free(r);
}

const wf_video_kind *wf_libav_kind(void) {
    static const wf_video_kind kind = {libav_open, libav_next, wf_libav_seek, libav_close};
    return &kind;
}
