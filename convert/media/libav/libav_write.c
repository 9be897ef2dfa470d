/* Writes deliveries, for the libav module: libavcodec encodes and libavformat lays out. Both
 * are told what the raster is in every place that they look at: frames, encoder, stream. */
#include <inttypes.h>
#include <libavutil/imgutils.h>
#include <libavutil/intreadwrite.h>
#include <libavutil/opt.h>
#include <libavutil/pixdesc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "color/codes/chroma_420.h"
#include "convert/job/colors.h"
#include "convert/job/timecode.h"
#include "convert/media/container.h"
#include "convert/media/container_mkv.h"
#include "convert/media/libav/libav.h"
#include "convert/media/libav/libav_write_sound.h"

WEFT_API wf_libav_writer_fn wf_libav_writer_of;

#define BUFFER_BYTES (1 << 16)

static bool writes_mov(const wf_writing *w) {
    return !strcmp(w->delivery->muxer, "mov");
}

static AVRational ratio(wf_rational r) {
    return (AVRational){(int)r.num, (int)r.den};
}

/* ---- The file, as libavformat sees it ---- */

static int put_bytes(void *user, uint8_t *data, int bytes) {
    wf_writing *w = user;
    XXH3_128bits_update(w->hash, data, (size_t)bytes);
    return wf_outfile_write(w->file, data, (size_t)bytes, &w->failure) ? AVERROR(EIO) : bytes;
}

static int64_t go_to(void *user, int64_t offset, int whence) {
    wf_writing *w = user;
    if (whence != SEEK_SET) return AVERROR(ENOSYS);
    return wf_outfile_seek(w->file, offset, &w->failure) ? AVERROR(EIO) : offset;
}

static weft_status open_file(wf_writing *w, weft_error *err) {
    const wf_output_options *o = &w->options;
    w->hash = XXH3_createState();
    if (!w->hash) return wf_fail(err, WEFT_NO_MEMORY, "%.500s: out of memory", o->output);
    XXH3_128bits_reset(w->hash);
    weft_status status = wf_outfile_open(o->output, o->overwrite || o->resume, &w->file, err);
    if (status) return status;
    int code = avformat_alloc_output_context2(&w->format, NULL, w->delivery->muxer, NULL);
    uint8_t *buffer = code < 0 ? NULL : av_malloc(BUFFER_BYTES);
    if (buffer)
        w->format->pb = avio_alloc_context(buffer, BUFFER_BYTES, 1, w, NULL, put_bytes, go_to);
    if (buffer && !w->format->pb) av_free(buffer);
    if (code >= 0 && !w->format->pb) code = AVERROR(ENOMEM);
    if (code < 0) return wf_writing_failed(w, "its container cannot be begun", code, err);
    w->format->flags |= AVFMT_FLAG_BITEXACT; /* the same input makes the same bytes */
    return WEFT_OK;
}

static void close_file(wf_writing *w) {
    if (w->format && w->format->pb) {
        av_freep(&w->format->pb->buffer);
        avio_context_free(&w->format->pb);
    }
    avformat_free_context(w->format);
    w->format = NULL;
}

/* ---- The encoder ---- */

static enum AVPixelFormat pixels_of(const wf_writing *w) {
    const wf_output_options *o = &w->options;
    char name[32];
    const char *sampling = w->form->folds_chroma ? "420" : o->subsampled ? "422" : "444";
    const char *planes = o->alpha ? "yuva" : "yuv";
    if (o->bits == 8)
        snprintf(name, sizeof name, "%s%sp", planes, sampling);
    else
        snprintf(name, sizeof name, "%s%sp%d", planes, sampling, o->bits);
    return av_get_pix_fmt(name);
}

/* libav's enums are the code points of Rec. ITU-T H.273. */
static void tag_codec(const wf_writing *w, AVCodecContext *c) {
    c->color_primaries = (enum AVColorPrimaries)w->tags.primaries;
    c->color_trc = (enum AVColorTransferCharacteristic)w->tags.transfer;
    c->colorspace = (enum AVColorSpace)w->tags.matrix;
    c->color_range = w->options.full_range ? AVCOL_RANGE_JPEG : AVCOL_RANGE_MPEG;
    c->chroma_sample_location = AVCHROMA_LOC_LEFT;
}

/* In QuickTime libavformat writes {2,9} for TB and {2,14} for BT: the fields' lines are
 * stored in turn, and the first letter is the field that is shown first. */
static enum AVFieldOrder order_of(const wf_raster *raster) {
    if (raster->scan != WF_INTERLACED) return AV_FIELD_PROGRESSIVE;
    return raster->top_first ? AV_FIELD_TB : AV_FIELD_BT;
}

/* QuickTime and Matroska are told how the lines are stored, TB or BT. MXF is told that both
 * fields are coded together, TT or BB. */
static enum AVFieldOrder coded_order_of(const wf_writing *w) {
    enum AVFieldOrder order = order_of(&w->raster);
    bool woven = strcmp(w->delivery->muxer, "mxf") && strcmp(w->delivery->muxer, "mxf_d10");
    if (woven || order == AV_FIELD_PROGRESSIVE) return order;
    return order == AV_FIELD_TB ? AV_FIELD_TT : AV_FIELD_BB;
}

static void describe_codec(wf_writing *w, AVCodecContext *c) {
    const wf_raster *r = &w->raster;
    bool interlaced = r->scan == WF_INTERLACED;
    c->width = r->width_px;
    c->height = r->lines;
    c->time_base = av_inv_q(ratio(r->frame_rate));
    c->framerate = ratio(r->frame_rate);
    c->sample_aspect_ratio = ratio(r->pixel_aspect);
    c->pix_fmt = pixels_of(w);
    c->field_order = coded_order_of(w);
    tag_codec(w, c);
    if (interlaced) c->flags |= AV_CODEC_FLAG_INTERLACED_DCT;
    if (interlaced && w->delivery->pictures_a_group) c->flags |= AV_CODEC_FLAG_INTERLACED_ME;
    c->flags |= AV_CODEC_FLAG_BITEXACT;
    if (w->format->oformat->flags & AVFMT_GLOBALHEADER) c->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    c->thread_count = w->delivery->threads ? w->delivery->threads : w->options.threads;
    if (w->form->bit_rate) c->bit_rate = w->form->bit_rate;
    if (w->delivery->constant) c->rc_min_rate = c->rc_max_rate = w->form->bit_rate;
    int group = w->delivery->pictures_a_group;
    /* Half a second of pictures. */
    if (group) c->gop_size = wf_ratio_value(r->frame_rate) < 26 ? group : group * 5 / 4;
    if (w->delivery->constant && !group) c->gop_size = 0;
}

static int read_options(const wf_writing *w, AVDictionary **options) {
    int code = 0;
    if (w->delivery->encoder_options)
        code = av_dict_parse_string(options, w->delivery->encoder_options, "=", ":", 0);
    if (code >= 0 && w->form->options)
        code = av_dict_parse_string(options, w->form->options, "=", ":", 0);
    /* MPEG-2 states a timecode in its groups of pictures, beside that of the container. */
    if (code >= 0 && !strcmp(w->delivery->encoder, "mpeg2video"))
        code = av_dict_set(options, "gop_timecode", w->options.timecode, 0);
    /* x264 takes the order from here alone: told of frames that differ, it says top first. */
    if (code >= 0 && !strcmp(w->delivery->kind.name, "h264") && w->raster.scan == WF_INTERLACED)
        code = av_dict_set(options, "x264-params", w->raster.top_first ? "tff=1" : "bff=1", 0);
    return code;
}

static weft_status open_encoder(wf_writing *w, weft_error *err) {
    AVDictionary *options = NULL;
    const AVCodec *encoder = avcodec_find_encoder_by_name(w->delivery->encoder);
    if (!encoder)
        return wf_fail(err, WEFT_FAILED,
                       "%.500s: this libavcodec has no encoder %s, which %s needs; take "
                       "another --codec",
                       w->options.output, w->delivery->encoder, w->delivery->kind.name);
    w->codec = avcodec_alloc_context3(encoder);
    int code = w->codec ? read_options(w, &options) : AVERROR(ENOMEM);
    if (code >= 0) {
        describe_codec(w, w->codec);
        code = avcodec_open2(w->codec, encoder, &options);
    }
    const AVDictionaryEntry *left = av_dict_get(options, "", NULL, AV_DICT_IGNORE_SUFFIX);
    if (code >= 0 && left) code = AVERROR_OPTION_NOT_FOUND;
    av_dict_free(&options);
    return code < 0 ? wf_writing_failed(w, "its encoder cannot be opened", code, err) : WEFT_OK;
}

/* ---- The container ---- */

static weft_status open_stream(wf_writing *w, weft_error *err) {
    AVStream *s = w->stream = avformat_new_stream(w->format, NULL);
    int code = s ? avcodec_parameters_from_context(s->codecpar, w->codec) : AVERROR(ENOMEM);
    if (code < 0) return wf_writing_failed(w, "its video cannot be begun", code, err);
    s->time_base = w->codec->time_base;
    s->avg_frame_rate = s->r_frame_rate = w->codec->framerate;
    s->sample_aspect_ratio = w->codec->sample_aspect_ratio;
    s->codecpar->field_order = coded_order_of(w);
    if (w->form->stated_rate) s->codecpar->bit_rate = w->form->stated_rate;
    wf_delivery_mark mark = wf_delivery_quicktime(w->delivery, &w->raster);
    if (*mark.tag && writes_mov(w)) {
        s->codecpar->codec_tag = AV_RL32(mark.tag);
        w->format->strict_std_compliance = FF_COMPLIANCE_UNOFFICIAL; /* or it takes its own */
    }
    return WEFT_OK;
}

static const char *encoder_name(char name[64]) {
    snprintf(name, 64, "weft %s", weft_version());
    return name;
}

static int name_packages(AVDictionary **about) {
    int code = av_dict_set(about, "material_package_name", WF_MXF_PACKAGE_NAME, 0);
    return code < 0 ? code : av_dict_set(about, "file_package_name", WF_MXF_PACKAGE_NAME, 0);
}

/* Encoded sound begins with samples that an edit list leaves out, and its length is counted in
 * ticks of the movie: those of frames and of samples, as far as a number holds them. */
static int time_movie(const wf_writing *w, AVDictionary **options) {
    int64_t rate = w->raster.frame_rate.num, samples = WF_SOUND_RATE;
    int64_t ticks = rate / av_gcd(rate, samples) * samples;
    if (!w->options.sound.tracks || !w->delivery->sound_encoder) return 0;
    return av_dict_set_int(options, "movie_timescale", ticks > INT32_MAX ? samples : ticks, 0);
}

static weft_status write_header(wf_writing *w, weft_error *err) {
    AVDictionary **about = &w->format->metadata, *options = NULL;
    char name[64];
    int code = av_dict_set(about, "timecode", w->options.timecode, 0);
    if (code >= 0) code = av_dict_set(about, "company_name", "weft", 0);
    if (code >= 0) code = av_dict_set(about, "product_name", "weft", 0);
    if (code >= 0) code = av_dict_set(about, "product_version", weft_version(), 0);
    if (code >= 0) code = av_dict_set(about, "encoding_tool", encoder_name(name), 0);
    if (code >= 0 && !strcmp(w->delivery->muxer, "matroska"))
        code = av_dict_set(about, "title", WF_MKV_TITLE, 0);
    if (code >= 0 && !strncmp(w->delivery->muxer, "mxf", 3)) code = name_packages(about);
    if (code >= 0 && w->options.date)
        code = av_dict_set(about, "creation_time", w->options.date, 0);
    if (code >= 0) code = time_movie(w, &options);
    if (code >= 0) code = avformat_write_header(w->format, &options);
    /* The muxer of QuickTime writes this at the end if it is not set after the header. */
    if (code >= 0) code = av_dict_set(about, "encoder", name, 0);
    av_dict_free(&options);
    return code < 0 ? wf_writing_failed(w, "its header cannot be written", code, err) : WEFT_OK;
}

/* ---- Frames ---- */

static weft_status make_frame(wf_writing *w, weft_error *err) {
    AVFrame *f = w->frame = av_frame_alloc();
    w->packet = av_packet_alloc();
    if (!f || !w->packet) return wf_writing_failed(w, "no memory", AVERROR(ENOMEM), err);
    f->width = w->codec->width;
    f->height = w->codec->height;
    f->format = w->codec->pix_fmt;
    int code = av_frame_get_buffer(f, 0);
    w->row = malloc((size_t)w->raster.width_px * sizeof *w->row);
    if (!w->row) code = AVERROR(ENOMEM);
    return code < 0 ? wf_writing_failed(w, "no memory for a frame", code, err) : WEFT_OK;
}

/* libav 5.1 reads scan and colors from the frame as well, and believes it over the encoder. */
static void tag_frame(const wf_writing *w) {
    AVFrame *f = w->frame;
    f->interlaced_frame = w->raster.scan == WF_INTERLACED;
    f->top_field_first = f->interlaced_frame && w->raster.top_first;
    f->sample_aspect_ratio = w->codec->sample_aspect_ratio;
    f->color_primaries = w->codec->color_primaries;
    f->color_trc = w->codec->color_trc;
    f->colorspace = w->codec->colorspace;
    f->color_range = w->codec->color_range;
    f->chroma_location = w->codec->chroma_sample_location;
    f->pts = w->frames;
}

static void put_line(uint8_t *to, const uint16_t *code, int count, bool wide) {
    if (wide)
        memcpy(to, code, (size_t)count * sizeof *code);
    else
        for (int i = 0; i < count; i++) to[i] = (uint8_t)code[i];
}

static void put_black(uint8_t *to, int plane, int count, const wf_output_options *o) {
    uint16_t code = (uint16_t)((plane ? 128 : 16) << (o->bits - 8));
    for (int i = 0; i < count; i++)
        put_line(to + i * (o->bits > 8 ? 2 : 1), &code, 1, o->bits > 8);
}

/* Codes 0 and the highest of 8 bits are for synchronizing (Rec. ITU-R BT.601), and those that
 * begin with the same bits. */
static void fold_chroma(const wf_writing *w, const wf_frame *frame, int p) {
    const wf_output_options *o = &w->options;
    int count = w->raster.width_px / 2, one = 1 << (o->bits - 8);
    bool woven = w->raster.scan == WF_INTERLACED;
    for (int row = 0; row < w->raster.lines / 2; row++) {
        uint8_t *to = w->frame->data[p] + (ptrdiff_t)row * w->frame->linesize[p];
        wf_chroma_420_row((const uint16_t *)frame->plane[p], frame->stride[p], w->raster.lines,
                          count, row, woven, one, 255 * one - 1, w->row);
        put_line(to, w->row, count, o->bits > 8);
    }
}

static bool is_chroma(int plane) {
    return plane == 1 || plane == 2;
}

static void take_plane(const wf_writing *w, const wf_frame *frame, int p) {
    const wf_output_options *o = &w->options;
    int width = is_chroma(p) && o->subsampled ? w->raster.width_px / 2 : w->raster.width_px;
    for (int y = 0; y < w->raster.lines; y++) {
        uint8_t *to = w->frame->data[p] + (ptrdiff_t)y * w->frame->linesize[p];
        int from = y - w->form->above_lines + w->form->skip_lines;
        if (y < w->form->above_lines)
            put_black(to, p, width, o);
        else
            put_line(to, (const uint16_t *)frame->plane[p] + (size_t)from * frame->stride[p],
                     width, o->bits > 8);
    }
}

static void take_frame(const wf_writing *w, const wf_frame *frame) {
    for (int p = 0; p < (w->options.alpha ? 4 : 3); p++)
        if (is_chroma(p) && w->form->folds_chroma)
            fold_chroma(w, frame, p);
        else
            take_plane(w, frame, p);
}

/* Hands the encoder a frame, or none at the end, and the file what comes of it. */
static weft_status encode(wf_writing *w, AVFrame *frame, weft_error *err) {
    int code = avcodec_send_frame(w->codec, frame);
    while (code >= 0) {
        code = avcodec_receive_packet(w->codec, w->packet);
        if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return WEFT_OK;
        if (code >= 0) code = wf_writing_mux(w, w->codec, w->stream->index);
    }
    char doing[64];
    snprintf(doing, sizeof doing, "frame %" PRId64 " cannot be written", w->frames);
    return wf_writing_failed(w, doing, code, err);
}

static weft_status write_frame(void *state, const wf_frame *frame, weft_error *err) {
    wf_writing *w = state;
    int code = av_frame_make_writable(w->frame);
    if (code < 0) return wf_writing_failed(w, "no memory for a frame", code, err);
    tag_frame(w);
    take_frame(w, frame);
    weft_status status = encode(w, w->frame, err);
    w->frames++;
    return status ? status : wf_written_sound_write(w, err);
}

/* ---- Life ---- */

static void release(wf_writing *w) {
    wf_written_sound_free(&w->sound);
    avcodec_free_context(&w->codec);
    av_frame_free(&w->frame);
    av_packet_free(&w->packet);
    close_file(w);
    XXH3_freeState(w->hash);
    free(w->row);
    free(w);
}

static void abandon(void *state) {
    wf_writing *w = state;
    wf_outfile *file = w->file;
    /* What libavformat still wants to write goes nowhere. */
    release(w);
    if (file) wf_outfile_abandon(file);
}

static weft_status open_writing(const wf_output_options *options, const wf_delivery *delivery,
                                void **state, weft_error *err) {
    wf_writing *w = calloc(1, sizeof *w);
    if (!w) return wf_fail(err, WEFT_NO_MEMORY, "%.500s: out of memory", options->output);
    *w = (wf_writing){.options = *options, .delivery = delivery};
    w->form = wf_delivery_form_for(delivery, options, err);
    w->raster = wf_delivery_raster(w->form, options->raster);
    w->tags = wf_color_tags_of(options->color_space, options->raster->matrix);
    av_log_set_level(AV_LOG_QUIET);
    weft_status status = open_file(w, err);
    if (!status) status = open_encoder(w, err);
    if (!status) status = open_stream(w, err);
    if (!status) status = wf_written_sound_open(w, err);
    if (!status) status = make_frame(w, err);
    if (!status) status = write_header(w, err);
    if (status)
        abandon(w);
    else
        *state = w;
    return status;
}

static weft_status complete(wf_writing *w, weft_error *err) {
    wf_container_facts facts = {
        .muxer = w->delivery->muxer,
        .raster = &w->raster,
        .tags = w->tags,
        .compressor = wf_delivery_quicktime(w->delivery, &w->raster).name,
        .alpha = w->options.alpha,
        .straight = w->options.straight,
    };
    XXH128_canonicalFromHash((XXH128_canonical_t *)(void *)facts.identity,
                             XXH3_128bits_digest(w->hash));
    return wf_container_complete(w->file, &facts, err);
}

static weft_status commit(void *state, weft_error *err) {
    wf_writing *w = state;
    weft_status status = encode(w, NULL, err);
    if (!status) status = wf_written_sound_finish(w, err);
    int code = status ? 0 : av_write_trailer(w->format);
    if (!status && code >= 0) {
        avio_flush(w->format->pb);
        code = w->format->pb->error;
    }
    if (code < 0) status = wf_writing_failed(w, "it cannot be finished", code, err);
    if (!status) status = complete(w, err);
    wf_outfile *file = w->file;
    release(w);
    if (!status) return wf_outfile_commit(file, err);
    wf_outfile_abandon(file);
    return status;
}

const wf_libav_writer *wf_libav_writer_of(void) {
    static const wf_libav_writer writer = {open_writing, write_frame, commit, abandon};
    return &writer;
}
