/* Sound beside a video: formats that ask for it get tracks of PCM, or encoded pairs of tracks.
 */
#include "convert/media/libav/libav_write_sound.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A second of an encoded channel; twice as much is more than the encoder takes. */
#define BITS_PER_CHANNEL 160000

static int tracks_of(const wf_writing *w) {
    return w->options.sound.tracks;
}

/* Of a full stream: the last may have fewer. */
static int channels_of(const wf_writing *w) {
    return w->delivery->sound_encoder ? 2 : w->delivery->one_audio_stream ? tracks_of(w) : 1;
}

/* ---- Opening ---- */

static int open_codec(const wf_writing *w, wf_written_stream *s) {
    char name[16];
    snprintf(name, sizeof name, "pcm_s%dle", w->options.sound.bits);
    const char *asked = w->delivery->sound_encoder ? w->delivery->sound_encoder : name;
    const AVCodec *encoder = avcodec_find_encoder_by_name(asked);
    AVCodecContext *c = s->codec = encoder ? avcodec_alloc_context3(encoder) : NULL;
    if (!c) return AVERROR(encoder ? ENOMEM : EINVAL);
    c->sample_fmt = encoder->sample_fmts[0];
    c->sample_rate = WF_SOUND_RATE;
    c->time_base = (AVRational){1, WF_SOUND_RATE};
    c->flags |= AV_CODEC_FLAG_BITEXACT;
    if (w->format->oformat->flags & AVFMT_GLOBALHEADER) c->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    if (w->delivery->sound_encoder) c->bit_rate = BITS_PER_CHANNEL * s->channels;
    av_channel_layout_default(&c->ch_layout, s->channels);
    int code = avcodec_open2(c, encoder, NULL);
    if (code < 0 || !c->frame_size) return code;
    s->waiting = av_audio_fifo_alloc(c->sample_fmt, s->channels, c->frame_size);
    return s->waiting ? 0 : AVERROR(ENOMEM);
}

/* Players mute tracks that are not enabled, and libavformat enables those that are "default".
 */
static int open_stream(wf_writing *w, wf_written_stream *s) {
    int code = open_codec(w, s);
    AVStream *stream = code < 0 ? NULL : avformat_new_stream(w->format, NULL);
    if (!stream) return code < 0 ? code : AVERROR(ENOMEM);
    s->index = stream->index;
    stream->time_base = s->codec->time_base;
    stream->disposition |= AV_DISPOSITION_DEFAULT;
    return avcodec_parameters_from_context(stream->codecpar, s->codec);
}

static int open_streams(wf_writing *w) {
    int tracks = tracks_of(w), most = channels_of(w), code = 0;
    for (int first = 0; first < tracks && code >= 0; first += most) {
        wf_written_stream *s = &w->sound.stream[w->sound.streams++];
        s->first = first;
        s->channels = tracks - first < most ? tracks - first : most;
        code = open_stream(w, s);
    }
    return code;
}

/* libavformat's MXF shares samples out to frames itself, and begins with the file's first. */
static int64_t first_frame(const wf_writing *w) {
    return strncmp(w->delivery->muxer, "mxf", 3) ? w->options.first_frame : 0;
}

static int64_t samples_until(const wf_writing *w, int64_t frames) {
    wf_rational rate = w->raster.frame_rate;
    return wf_sound_samples(rate, w->sound.first_frame + frames) -
           wf_sound_samples(rate, w->sound.first_frame);
}

static int make_room(wf_writing *w) {
    wf_rational rate = w->raster.frame_rate;
    size_t most = (size_t)(WF_SOUND_RATE * rate.den / rate.num) + 1;
    w->sound.next = calloc(most * (size_t)tracks_of(w), sizeof *w->sound.next);
    w->sound.frame = av_frame_alloc();
    return w->sound.next && w->sound.frame ? 0 : AVERROR(ENOMEM);
}

weft_status wf_written_sound_open(wf_writing *w, weft_error *err) {
    if (!tracks_of(w)) return WEFT_OK;
    w->sound.first_frame = first_frame(w);
    w->stream->disposition |= AV_DISPOSITION_DEFAULT;
    int code = open_streams(w);
    if (code >= 0) code = make_room(w);
    return code < 0 ? wf_writing_failed(w, "its sound cannot be begun", code, err) : WEFT_OK;
}

/* ---- Writing ---- */

static void put_sample(const AVFrame *f, int channels, int i, int c, int32_t value) {
    int at = i * channels + c;
    if (f->format == AV_SAMPLE_FMT_FLTP)
        ((float *)(void *)f->data[c])[i] = (float)value * 0x1p-31f;
    else if (f->format == AV_SAMPLE_FMT_S16)
        ((int16_t *)(void *)f->data[0])[at] = (int16_t)(value >> 16);
    else
        ((int32_t *)(void *)f->data[0])[at] = value;
}

/* The samples of a stream's channels. */
static void fill(const wf_writing *w, const wf_written_stream *s) {
    const AVFrame *f = w->sound.frame;
    for (int i = 0; i < f->nb_samples; i++)
        for (int c = 0; c < s->channels; c++)
            put_sample(f, s->channels, i, c, w->sound.next[i * tracks_of(w) + s->first + c]);
}

static int make_frame(const wf_writing *w, const wf_written_stream *s, int64_t count) {
    AVFrame *f = w->sound.frame;
    f->nb_samples = (int)count;
    f->format = s->codec->sample_fmt;
    f->sample_rate = WF_SOUND_RATE;
    int code = av_channel_layout_copy(&f->ch_layout, &s->codec->ch_layout);
    return code < 0 ? code : av_frame_get_buffer(f, 0);
}

/* Hands the encoder a frame, or none at the end, and the file what comes of it. */
static int encode(wf_writing *w, wf_written_stream *s, AVFrame *frame) {
    if (frame) frame->pts = s->sent;
    if (frame) s->sent += frame->nb_samples;
    int code = avcodec_send_frame(s->codec, frame);
    while (code >= 0 && (code = avcodec_receive_packet(s->codec, w->packet)) >= 0)
        code = wf_writing_mux(w, s->codec, s->index);
    return code == AVERROR(EAGAIN) || code == AVERROR_EOF ? 0 : code;
}

/* Encodes samples that wait, in frames of the codec's size, of which the file's last may be
 * smaller. */
static int encode_waiting(wf_writing *w, wf_written_stream *s, int least) {
    AVFrame *f = w->sound.frame;
    int code = 0, held;
    while (code >= 0 && (held = av_audio_fifo_size(s->waiting)) >= least) {
        int count = held < s->codec->frame_size ? held : s->codec->frame_size;
        av_frame_unref(f);
        code = make_frame(w, s, count);
        if (code >= 0) code = av_audio_fifo_read(s->waiting, (void **)f->data, count);
        if (code >= 0) code = encode(w, s, f);
    }
    return code;
}

static int write_stream(wf_writing *w, wf_written_stream *s, int64_t count) {
    AVFrame *f = w->sound.frame;
    int code = make_frame(w, s, count);
    if (code < 0) return code;
    fill(w, s);
    if (!s->waiting) return encode(w, s, f);
    code = av_audio_fifo_write(s->waiting, (void **)f->data, (int)count);
    return code < 0 ? code : encode_waiting(w, s, s->codec->frame_size);
}

static int write_samples(wf_writing *w, int64_t count) {
    wf_written_sound *sound = &w->sound;
    int code = 0;
    for (int i = 0; i < sound->streams && code >= 0; i++) {
        code = write_stream(w, &sound->stream[i], count);
        av_frame_unref(sound->frame);
    }
    sound->samples += count;
    return code;
}

weft_status wf_written_sound_write(wf_writing *w, weft_error *err) {
    const wf_sound_feed *feed = &w->options.sound;
    if (!w->sound.streams) return WEFT_OK;
    int64_t count = samples_until(w, w->frames) - w->sound.samples;
    weft_status status =
        feed->read ? feed->read(feed->self, w->sound.next, count, err) : WEFT_OK;
    if (status) return status;
    int code = write_samples(w, count);
    return code < 0 ? wf_writing_failed(w, "its sound cannot be written", code, err) : WEFT_OK;
}

weft_status wf_written_sound_finish(wf_writing *w, weft_error *err) {
    int code = 0;
    for (int i = 0; i < w->sound.streams && code >= 0; i++) {
        wf_written_stream *s = &w->sound.stream[i];
        if (!s->waiting) continue;
        code = encode_waiting(w, s, 1);
        if (code >= 0) code = encode(w, s, NULL);
    }
    return code < 0 ? wf_writing_failed(w, "its sound cannot be finished", code, err) : WEFT_OK;
}

void wf_written_sound_free(wf_written_sound *sound) {
    for (int i = 0; i < sound->streams; i++) {
        avcodec_free_context(&sound->stream[i].codec);
        av_audio_fifo_free(sound->stream[i].waiting);
    }
    av_frame_free(&sound->frame);
    free(sound->next);
}
