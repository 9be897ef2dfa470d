/* Decodes one stream of sound, resamples it where it has another rate, and keeps it in time. */
#include "convert/media/libav/libav_sound_stream.h"

#include <libavutil/opt.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "convert/job/audio.h"
#include "convert/media/libav/libav_samples.h"

/* Timestamps may be rounded, and clocks of captures drift; what is further off is a gap. */
#define LEAST_GAP_S 0.04
#define QUEUE_BYTES ((size_t)64 << 20)

enum { MOST_CHANNELS = 64, GAP_BLOCK = 1024 };

static weft_status no_memory(const wf_sound_stream *s, weft_error *err) {
    return wf_fail(err, WEFT_NO_MEMORY, "%.700s: no memory for its sound", s->path);
}

static weft_status damaged(const wf_sound_stream *s, const char *what, int code,
                           weft_error *err) {
    char why[AV_ERROR_MAX_STRING_SIZE] = "";
    if (code == AVERROR(ENOMEM)) return no_memory(s, err);
    av_strerror(code, why, sizeof why);
    return wf_fail(
        err, WEFT_FAILED,
        "%.500s: its sound %s at %.3f s (%s); write it again, or give another --audio", s->path,
        what, wf_sound_stream_time_s(s), why);
}

double wf_sound_stream_time_s(const wf_sound_stream *s) {
    if (!s->begun) return 0;
    return (double)s->first_pts * av_q2d(s->stream->time_base) - s->zero_s +
           (double)s->counted / s->rate;
}

/* ---- Opening ---- */

/* Sums in double precision: of 24 bits nothing is lost. Rates may be any numbers whose ratio is
 * right. */
static weft_status open_resampler(wf_sound_stream *s, wf_rational ratio, weft_error *err) {
    AVChannelLayout any = {.order = AV_CHANNEL_ORDER_UNSPEC, .nb_channels = s->channels};
    int code = swr_alloc_set_opts2(&s->resampler, &any, AV_SAMPLE_FMT_S32, (int)ratio.den, &any,
                                   AV_SAMPLE_FMT_S32, (int)ratio.num, 0, NULL);
    if (code >= 0)
        code =
            av_opt_set_sample_fmt(s->resampler, "internal_sample_fmt", AV_SAMPLE_FMT_DBLP, 0);
    if (code >= 0) code = av_opt_set_int(s->resampler, "filter_size", 64, 0);
    if (code >= 0) code = swr_init(s->resampler);
    return code < 0 ? damaged(s, "cannot be resampled", code, err) : WEFT_OK;
}

static weft_status open_codec(wf_sound_stream *s, weft_error *err) {
    const AVCodecParameters *par = s->stream->codecpar;
    const AVCodec *decoder = avcodec_find_decoder(par->codec_id);
    if (!decoder)
        return wf_fail(err, WEFT_FAILED, "%.700s: libav has no decoder for its sound (%s)",
                       s->path, avcodec_get_name(par->codec_id));
    s->codec = avcodec_alloc_context3(decoder);
    s->frame = av_frame_alloc();
    if (!s->codec || !s->frame) return no_memory(s, err);
    int code = avcodec_parameters_to_context(s->codec, par);
    s->codec->pkt_timebase = s->stream->time_base;
    s->codec->thread_count = 1;
    if (code >= 0) code = avcodec_open2(s->codec, decoder, NULL);
    return code < 0 ? damaged(s, "cannot be decoded", code, err) : WEFT_OK;
}

weft_status wf_sound_stream_open(wf_sound_stream *s, const char *path, const AVStream *stream,
                                 weft_error *err) {
    const AVCodecParameters *par = stream->codecpar;
    *s = (wf_sound_stream){.path = path,
                           .stream = stream,
                           .channels = par->ch_layout.nb_channels,
                           .rate = par->sample_rate,
                           .gap_s = -1};
    if (s->channels < 1 || s->channels > MOST_CHANNELS || s->rate < 1000 || s->rate > 768000)
        return wf_fail(
            err, WEFT_FAILED,
            "%.700s: its sound has %d channels of %d samples a second, which cannot be "
            "read; write it as WAV of 48 kHz",
            path, s->channels, s->rate);
    return open_codec(s, err);
}

weft_status wf_sound_stream_begin(wf_sound_stream *s, const wf_sound_start *start,
                                  weft_error *err) {
    wf_rational ratio = wf_ratio_mul(wf_ratio(s->rate, WF_SOUND_RATE), start->speed);
    s->start = *start;
    if (ratio.num == ratio.den) return WEFT_OK;
    if (!wf_ratio_given(ratio) || ratio.num > INT32_MAX / 2 || ratio.den > INT32_MAX / 2)
        return damaged(s, "cannot be resampled", AVERROR(ERANGE), err);
    return open_resampler(s, ratio, err);
}

/* ---- The queue ---- */

static bool make_block(int32_t **block, size_t *room, size_t samples, int channels) {
    if (samples <= *room) return true;
    int32_t *grown = realloc(*block, samples * (size_t)channels * sizeof *grown);
    if (grown) *block = grown, *room = samples;
    return grown;
}

static weft_status make_room(wf_sound_stream *s, size_t count, weft_error *err) {
    size_t width = (size_t)s->channels * sizeof *s->queue, wanted = s->held + count;
    if (s->from) memmove(s->queue, s->queue + s->from * (size_t)s->channels, s->held * width);
    s->from = 0;
    if (wanted <= s->room) return WEFT_OK;
    if (wanted * width > QUEUE_BYTES)
        return wf_fail(err, WEFT_FAILED,
                       "%.500s: its sound at %.3f s lies too far from the sound about it to be "
                       "read together; write it again as WAV and give that to --audio",
                       s->path, wf_sound_stream_time_s(s));
    return make_block(&s->queue, &s->room, wanted + wanted / 2, s->channels)
               ? WEFT_OK
               : no_memory(s, err);
}

static weft_status enqueue(wf_sound_stream *s, const int32_t *from, int64_t count,
                           weft_error *err) {
    int64_t skipped = s->skip < count ? s->skip : count;
    s->skip -= skipped;
    count -= skipped;
    if (count <= 0) return WEFT_OK;
    size_t channels = (size_t)s->channels;
    weft_status status = make_room(s, (size_t)count, err);
    if (status) return status;
    memcpy(s->queue + s->held * channels, from + (size_t)skipped * channels,
           (size_t)count * channels * sizeof *from);
    s->held += (size_t)count;
    return WEFT_OK;
}

int64_t wf_sound_stream_held(const wf_sound_stream *s) {
    return s->lead + (int64_t)s->held;
}

void wf_sound_stream_take(wf_sound_stream *s, int32_t *to, int stride, int64_t count) {
    int64_t silent = s->lead < count ? s->lead : count;
    size_t channels = (size_t)s->channels;
    s->lead -= silent;
    to += silent * stride;
    for (; silent < count && s->held; silent++, s->from++, s->held--, to += stride)
        memcpy(to, s->queue + s->from * channels, channels * sizeof *to);
    if (silent < count && !s->ended) s->given_up += count - silent;
}

/* ---- Time ---- */

/* The first sample's place: what comes before the place where reading begins is skipped. */
static void place_first(wf_sound_stream *s, int64_t pts) {
    double at_s = (double)pts * av_q2d(s->stream->time_base) - s->zero_s -
                  wf_ratio_value(s->start.start_s);
    double shown_s = at_s / wf_ratio_value(s->start.speed);
    int64_t at = llround(shown_s * WF_SOUND_RATE) - s->start.samples;
    s->begun = true;
    s->first_pts = pts;
    s->lead = at > 0 ? at : 0;
    s->skip = at < 0 ? -at : 0;
    if (s->given_up > s->lead) return;
    s->lead -= s->given_up;
    s->given_up = 0;
}

/* Samples at the stream's own rate go into the queue, resampled where need be. */
static weft_status pass_on(wf_sound_stream *s, const int32_t *from, int64_t count,
                           weft_error *err) {
    if (!s->resampler) return enqueue(s, from, count, err);
    const uint8_t *in = (const uint8_t *)from;
    int most = swr_get_out_samples(s->resampler, (int)count);
    if (most < 0 ||
        !make_block(&s->resampled, &s->resampled_room, (size_t)most + 1, s->channels))
        return no_memory(s, err);
    uint8_t *out = (uint8_t *)s->resampled;
    int got = swr_convert(s->resampler, &out, most, from ? &in : NULL, (int)count);
    return got < 0 ? damaged(s, "cannot be resampled", got, err)
                   : enqueue(s, s->resampled, got, err);
}

static weft_status fill_gap(wf_sound_stream *s, int64_t samples, weft_error *err) {
    weft_status status = WEFT_OK;
    if ((double)samples / s->rate * s->channels * WF_SOUND_RATE > (double)(QUEUE_BYTES / 4))
        return damaged(s, "has a gap too long to be true", AVERROR_INVALIDDATA, err);
    if (!make_block(&s->block, &s->block_room, GAP_BLOCK, s->channels))
        return no_memory(s, err);
    memset(s->block, 0, GAP_BLOCK * (size_t)s->channels * sizeof *s->block);
    for (int64_t n = samples, part; !status && n; n -= part) {
        part = n < GAP_BLOCK ? n : GAP_BLOCK;
        status = pass_on(s, s->block, part, err);
        s->counted += part;
    }
    return status;
}

/* Whether the frame comes when it is expected. Samples are counted, as timestamps of some
 * containers are rounded; only where these are far off they are believed. */
static weft_status keep_time(wf_sound_stream *s, weft_error *err) {
    int64_t pts = s->frame->best_effort_timestamp;
    if (!s->begun && pts == AV_NOPTS_VALUE) pts = 0;
    if (!s->begun) place_first(s, pts);
    if (pts == AV_NOPTS_VALUE) return WEFT_OK;
    AVRational own = {1, s->rate};
    int64_t off = av_rescale_q(pts - s->first_pts, s->stream->time_base, own) - s->counted;
    int64_t least = (int64_t)(LEAST_GAP_S * s->rate);
    int64_t ticks = 2 * av_rescale_q(1, s->stream->time_base, own);
    if (ticks > least) least = ticks;
    if (off > -least && off < least) return WEFT_OK;
    if (s->gap_s < 0) s->gap_s = wf_sound_stream_time_s(s);
    if (off < 0) s->surplus = -off;
    if (off < 0) return WEFT_OK;
    /* Of the gap's silence some may have been given out. */
    if (s->given_up <= off * WF_SOUND_RATE / s->rate) s->skip += s->given_up, s->given_up = 0;
    return fill_gap(s, off, err);
}

/* ---- Decoding ---- */

static weft_status check_frame(const wf_sound_stream *s, weft_error *err) {
    const AVFrame *f = s->frame;
    if (f->ch_layout.nb_channels == s->channels && f->sample_rate == s->rate) return WEFT_OK;
    return wf_fail(
        err, WEFT_FAILED,
        "%.500s: its sound at %.3f s has %d channels of %d Hz, and before it had %d of "
        "%d Hz; write it again as WAV and give that to --audio",
        s->path, wf_sound_stream_time_s(s), f->ch_layout.nb_channels, f->sample_rate,
        s->channels, s->rate);
}

static weft_status use_frame(wf_sound_stream *s, weft_error *err) {
    const AVFrame *f = s->frame;
    weft_status status = check_frame(s, err);
    if (!status) status = keep_time(s, err);
    if (status) return status;
    if (s->given_up) return damaged(s, "comes too late in the file", AVERROR_INVALIDDATA, err);
    if (!make_block(&s->block, &s->block_room, (size_t)f->nb_samples, s->channels))
        return no_memory(s, err);
    if (!wf_libav_samples(f, s->block))
        return damaged(s, "is of a kind that is not read", AVERROR_INVALIDDATA, err);
    int64_t out = s->surplus < f->nb_samples ? s->surplus : f->nb_samples;
    s->surplus -= out;
    s->counted += f->nb_samples - out;
    return pass_on(s, s->block + out * s->channels, f->nb_samples - out, err);
}

weft_status wf_sound_stream_feed(wf_sound_stream *s, const AVPacket *packet, weft_error *err) {
    bool broken = packet && packet->flags & AV_PKT_FLAG_CORRUPT;
    if (broken) return damaged(s, "is damaged or cut off", AVERROR_INVALIDDATA, err);
    int code = avcodec_send_packet(s->codec, packet);
    if (code < 0 && code != AVERROR_EOF) return damaged(s, "cannot be decoded", code, err);
    weft_status status = WEFT_OK;
    while (!status && (code = avcodec_receive_frame(s->codec, s->frame)) >= 0) {
        status = use_frame(s, err);
        av_frame_unref(s->frame);
    }
    if (status) return status;
    if (code != AVERROR(EAGAIN) && code != AVERROR_EOF)
        return damaged(s, "cannot be decoded", code, err);
    if (packet) return WEFT_OK;
    s->ended = true;
    return s->resampler && s->begun ? pass_on(s, NULL, 0, err) : WEFT_OK;
}

void wf_sound_stream_free(wf_sound_stream *s) {
    swr_free(&s->resampler);
    avcodec_free_context(&s->codec);
    av_frame_free(&s->frame);
    free(s->queue);
    free(s->block);
    free(s->resampled);
}
