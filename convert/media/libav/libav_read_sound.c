/* Reads sound, for the libav module: all streams of sound of any file that libavformat and
 * libavcodec can read, in step. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/job/audio.h"
#include "convert/media/libav/libav_reading.h"
#include "convert/media/libav/libav_sound_stream.h"
#include "convert/media/sound_reader.h"

WEFT_API wf_libav_sound_fn wf_libav_sound;

/* A stream that has nothing while another has so much is taken as silent. */
#define PATIENCE_SAMPLES ((int64_t)5 * WF_SOUND_RATE)
/* Reading from the beginning is not worth it where one can go to a place exactly. */
#define WORTH_SEEKING_S 10.0

typedef struct hearing {
    char *path;
    AVFormatContext *format;
    AVPacket *packet;
    wf_sound_stream *streams; /* [count] */
    int count, channels;
    bool drained;
    char note[300];
} hearing;

static weft_status failed(const hearing *h, const char *doing, int code, weft_error *err) {
    char why[AV_ERROR_MAX_STRING_SIZE] = "";
    av_strerror(code, why, sizeof why);
    return wf_fail(err, code == AVERROR(ENOMEM) ? WEFT_NO_MEMORY : WEFT_FAILED,
                   "%.700s: %s: %s", h->path, doing, why);
}

/* ---- Opening ---- */

static weft_status open_file(hearing *h, weft_error *err) {
    char *url = malloc(strlen(h->path) + sizeof "file:"); /* a ':' is no protocol's */
    if (!url) return failed(h, "it cannot be opened", AVERROR(ENOMEM), err);
    strcat(strcpy(url, "file:"), h->path);
    int code = avformat_open_input(&h->format, url, NULL, NULL);
    free(url);
    if (code == AVERROR_INVALIDDATA)
        return wf_fail(
            err, WEFT_FAILED,
            "%.700s: it is no sound that libav knows, or its header is damaged; give a "
            "WAV file, such as ffmpeg -i %.200s -c:a pcm_s24le OUT.wav writes",
            h->path, h->path);
    if (code < 0) return failed(h, "it cannot be opened", code, err);
    code = avformat_find_stream_info(h->format, NULL);
    return code < 0 ? failed(h, "its streams cannot be found out", code, err) : WEFT_OK;
}

static bool is_sound(const AVStream *stream) {
    return stream->codecpar->codec_type == AVMEDIA_TYPE_AUDIO;
}

static weft_status open_streams(hearing *h, weft_error *err) {
    weft_status status = WEFT_OK;
    h->streams = calloc(h->format->nb_streams + 1, sizeof *h->streams);
    h->packet = av_packet_alloc();
    if (!h->streams || !h->packet)
        return failed(h, "it cannot be opened", AVERROR(ENOMEM), err);
    for (unsigned i = 0; !status && i < h->format->nb_streams; i++) {
        AVStream *stream = h->format->streams[i];
        if (!is_sound(stream)) stream->discard = AVDISCARD_ALL;
        if (!is_sound(stream)) continue;
        wf_sound_stream *s = &h->streams[h->count++];
        status = wf_sound_stream_open(s, h->path, stream, err);
        h->channels += s->channels;
    }
    return status;
}

static double start_of(const AVStream *stream) {
    bool known = stream->start_time != AV_NOPTS_VALUE;
    return known ? (double)stream->start_time * av_q2d(stream->time_base) : 0;
}

static void find_zero(hearing *h, bool beside_video) {
    int video = wf_libav_video_of(h->format, NULL);
    double zero_s = h->count ? start_of(h->streams[0].stream) : 0;
    for (int i = 1; i < h->count; i++) zero_s = fmin(zero_s, start_of(h->streams[i].stream));
    if (beside_video && video >= 0) zero_s = start_of(h->format->streams[video]);
    for (int i = 0; i < h->count; i++) h->streams[i].zero_s = zero_s;
}

/* ---- What it is ---- */

static int bits_of(const AVCodecParameters *par) {
    int exact = av_get_exact_bits_per_sample(par->codec_id);
    int raw = par->bits_per_raw_sample;
    bool floats = par->format == AV_SAMPLE_FMT_FLT || par->format == AV_SAMPLE_FMT_FLTP ||
                  par->format == AV_SAMPLE_FMT_DBL || par->format == AV_SAMPLE_FMT_DBLP;
    return floats ? 0 : raw ? raw : exact;
}

/* As long as its longest stream says; 0 where that is estimated from its bytes only. */
static double length_s(const hearing *h) {
    double longest = 0;
    if (h->format->duration_estimation_method == AVFMT_DURATION_FROM_BITRATE) return 0;
    for (int i = 0; i < h->count; i++) {
        const AVStream *s = h->streams[i].stream;
        double end_s = start_of(s) - h->streams[i].zero_s;
        if (s->duration > 0)
            longest = fmax(longest, end_s + (double)s->duration * av_q2d(s->time_base));
    }
    return longest;
}

static void describe(const hearing *h, wf_sound_info *info) {
    *info = (wf_sound_info){.channels = h->channels, .length_s = length_s(h)};
    for (int i = 0; i < h->count; i++) {
        int bits = bits_of(h->streams[i].stream->codecpar);
        if (bits > info->bits) info->bits = bits;
        info->resampled |= h->streams[i].rate != WF_SOUND_RATE;
    }
    if (!h->count) return;
    snprintf(info->format, sizeof info->format, "%.24s, %d Hz, %d %s",
             avcodec_get_name(h->streams[0].stream->codecpar->codec_id), h->streams[0].rate,
             h->count, h->count > 1 ? "streams" : "stream");
}

static void hear_close(void *state) {
    hearing *h = state;
    if (!h) return;
    for (int i = 0; i < h->count; i++) wf_sound_stream_free(&h->streams[i]);
    free(h->streams);
    av_packet_free(&h->packet);
    avformat_close_input(&h->format);
    free(h->path);
    free(h);
}

static weft_status hear_open(const char *path, bool beside_video, void **state,
                             wf_sound_info *info, weft_error *err) {
    hearing *h = calloc(1, sizeof *h);
    if (h) h->path = strdup(path);
    if (!h || !h->path) {
        free(h);
        return wf_fail(err, WEFT_NO_MEMORY, "%.700s: no memory for its sound", path);
    }
    av_log_set_level(AV_LOG_QUIET);
    weft_status status = open_file(h, err);
    if (!status) status = open_streams(h, err);
    if (status) {
        hear_close(h);
        return status;
    }
    find_zero(h, beside_video);
    describe(h, info);
    *state = h;
    return WEFT_OK;
}

/* ---- Going to a place ---- */

/* Whether every packet says exactly when it is heard, so that one can begin in the middle. */
static bool can_seek(const hearing *h) {
    static const char *const exact[] = {"wav", "w64", "mov,mp4,m4a,3gp,3g2,mj2"};
    bool known = false;
    for (size_t i = 0; i < sizeof exact / sizeof *exact; i++)
        known = known || !strcmp(h->format->iformat->name, exact[i]);
    for (int i = 0; known && i < h->count; i++) {
        AVRational tick = h->streams[i].stream->time_base;
        known = av_cmp_q(tick, (AVRational){1, h->streams[i].rate}) == 0;
    }
    return known;
}

/* Decoders are given a second to find their feet. */
static weft_status hear_begin(void *state, const wf_sound_start *start, weft_error *err) {
    hearing *h = state;
    weft_status status = WEFT_OK;
    double at_s = wf_ratio_value(start->start_s) +
                  (double)start->samples / WF_SOUND_RATE * wf_ratio_value(start->speed);
    for (int i = 0; !status && i < h->count; i++)
        status = wf_sound_stream_begin(&h->streams[i], start, err);
    if (status || !h->count || at_s < WORTH_SEEKING_S || !can_seek(h)) return status;
    const AVStream *first = h->streams[0].stream;
    double to_s = at_s - 1 + h->streams[0].zero_s;
    int code = av_seek_frame(h->format, first->index,
                             (int64_t)(to_s / av_q2d(first->time_base)), AVSEEK_FLAG_BACKWARD);
    return code < 0 ? failed(h, "its sound cannot be found at the place asked for", code, err)
                    : WEFT_OK;
}

/* ---- Reading ---- */

static wf_sound_stream *stream_of(hearing *h, const AVPacket *packet) {
    for (int i = 0; i < h->count; i++)
        if (h->streams[i].stream->index == packet->stream_index) return &h->streams[i];
    return NULL;
}

/* libavformat does not tell a file that was cut off from one that has ended. */
static weft_status check_end(const hearing *h, const wf_sound_stream *s, weft_error *err) {
    double end_s = wf_sound_stream_time_s(s), tick_s = av_q2d(s->stream->time_base);
    bool pcm = av_get_exact_bits_per_sample(s->stream->codecpar->codec_id) > 0;
    double stated_s = start_of(s->stream) - s->zero_s + (double)s->stream->duration * tick_s;
    if (s->stream->duration <= 0 || end_s > stated_s - (pcm ? 0.001 : 0.1) - 2 * tick_s ||
        h->format->duration_estimation_method == AVFMT_DURATION_FROM_BITRATE)
        return WEFT_OK;
    return wf_fail(
        err, WEFT_FAILED,
        "%.500s: its sound ends at %.3f s, and it says that it is %.3f s long: it was "
        "cut off; copy it again",
        h->path, end_s, stated_s);
}

static weft_status drain(hearing *h, weft_error *err) {
    weft_status status = WEFT_OK;
    h->drained = true;
    for (int i = 0; !status && i < h->count; i++) {
        status = wf_sound_stream_feed(&h->streams[i], NULL, err);
        if (!status) status = check_end(h, &h->streams[i], err);
    }
    return status;
}

static weft_status read_packet(hearing *h, weft_error *err) {
    char doing[64];
    int code = av_read_frame(h->format, h->packet);
    if (code == AVERROR_EOF && !(h->format->pb && h->format->pb->error < 0))
        return drain(h, err);
    if (code < 0) {
        snprintf(doing, sizeof doing, "its sound cannot be read at %.3f s",
                 wf_sound_stream_time_s(&h->streams[0]));
        return failed(h, doing, code, err);
    }
    wf_sound_stream *s = stream_of(h, h->packet);
    weft_status status = s ? wf_sound_stream_feed(s, h->packet, err) : WEFT_OK;
    av_packet_unref(h->packet);
    return status;
}

/* Whether all streams have so many samples, or one has so many that the others are silent. */
static bool have(const hearing *h, int64_t count) {
    bool all = true;
    for (int i = 0; i < h->count; i++) {
        int64_t held = wf_sound_stream_held(&h->streams[i]);
        if (held >= count + PATIENCE_SAMPLES && !h->streams[i].lead) return true;
        all = all && (held >= count || h->streams[i].ended);
    }
    return all;
}

static weft_status hear_read(void *state, int32_t *to, int64_t count, int64_t *got,
                             weft_error *err) {
    hearing *h = state;
    weft_status status = WEFT_OK;
    while (!status && !h->drained && !have(h, count)) status = read_packet(h, err);
    if (status) return status;
    memset(to, 0, (size_t)count * (size_t)h->channels * sizeof *to);
    *got = 0;
    for (int i = 0; i < h->count; i++) {
        wf_sound_stream *s = &h->streams[i];
        int64_t held = wf_sound_stream_held(s);
        if (held > *got) *got = held < count ? held : count;
        wf_sound_stream_take(s, to, h->channels, count);
        to += s->channels;
    }
    return WEFT_OK;
}

static const char *hear_note(void *state) {
    hearing *h = state;
    for (int i = 0; i < h->count && !*h->note; i++)
        if (h->streams[i].gap_s >= 0)
            snprintf(h->note, sizeof h->note,
                     "its sound has a gap or an overlap at %.3f s, by its timestamps, which is "
                     "kept in time with silence or cut",
                     h->streams[i].gap_s);
    return h->note;
}

const wf_sound_reader *wf_libav_sound(void) {
    static const wf_sound_reader reader = {hear_open, hear_begin, hear_read, hear_note,
                                           hear_close};
    return &reader;
}
