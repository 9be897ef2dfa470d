/* Sound beside a video: formats that ask for it get tracks of PCM. */
#include "convert/media/libav/libav_write_sound.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int tracks_of(const wf_writing *w) {
    return w->options.sound.tracks;
}

static int channels_of(const wf_writing *w) {
    return w->delivery->one_audio_stream ? tracks_of(w) : 1;
}

/* ---- Opening ---- */

static int open_codec(wf_writing *w) {
    char name[16];
    snprintf(name, sizeof name, "pcm_s%dle", w->options.sound.bits);
    const AVCodec *encoder = avcodec_find_encoder_by_name(name);
    AVCodecContext *c = w->sound.codec = encoder ? avcodec_alloc_context3(encoder) : NULL;
    if (!c) return AVERROR(encoder ? ENOMEM : EINVAL);
    c->sample_fmt = encoder->sample_fmts[0];
    c->sample_rate = WF_SOUND_RATE;
    c->time_base = (AVRational){1, WF_SOUND_RATE};
    c->flags |= AV_CODEC_FLAG_BITEXACT;
    av_channel_layout_default(&c->ch_layout, channels_of(w));
    return avcodec_open2(c, encoder, NULL);
}

/* Players mute tracks that are not enabled, and libavformat enables those that are "default".
 */
static int open_streams(wf_writing *w) {
    wf_written_sound *s = &w->sound;
    s->first_stream = (int)w->format->nb_streams;
    s->streams = w->delivery->one_audio_stream ? 1 : tracks_of(w);
    for (int i = 0; i < s->streams; i++) {
        AVStream *stream = avformat_new_stream(w->format, NULL);
        if (!stream) return AVERROR(ENOMEM);
        stream->time_base = s->codec->time_base;
        stream->disposition |= AV_DISPOSITION_DEFAULT;
        int code = avcodec_parameters_from_context(stream->codecpar, s->codec);
        if (code < 0) return code;
    }
    return 0;
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
    int code = open_codec(w);
    if (code >= 0) code = open_streams(w);
    if (code >= 0) code = make_room(w);
    return code < 0 ? wf_writing_failed(w, "its sound cannot be begun", code, err) : WEFT_OK;
}

/* ---- Writing ---- */

/* The samples of a stream's channels, from track `first` on. */
static void fill(const wf_writing *w, AVFrame *f, int first) {
    int channels = channels_of(w), tracks = tracks_of(w);
    bool narrow = f->format == AV_SAMPLE_FMT_S16;
    int16_t *to16 = (int16_t *)(void *)f->data[0];
    int32_t *to32 = (int32_t *)(void *)f->data[0];
    for (int i = 0; i < f->nb_samples; i++)
        for (int c = 0; c < channels; c++) {
            int32_t value = w->sound.next[i * tracks + first + c];
            if (narrow)
                *to16++ = (int16_t)(value >> 16);
            else
                *to32++ = value;
        }
}

static int make_frame(const wf_writing *w, int64_t count) {
    AVFrame *f = w->sound.frame;
    f->nb_samples = (int)count;
    f->format = w->sound.codec->sample_fmt;
    f->sample_rate = WF_SOUND_RATE;
    int code = av_channel_layout_copy(&f->ch_layout, &w->sound.codec->ch_layout);
    return code < 0 ? code : av_frame_get_buffer(f, 0);
}

static int encode(wf_writing *w, int stream) {
    wf_written_sound *s = &w->sound;
    s->frame->pts = s->samples;
    int code = avcodec_send_frame(s->codec, s->frame);
    while (code >= 0 && (code = avcodec_receive_packet(s->codec, w->packet)) >= 0)
        code = wf_writing_mux(w, s->codec, s->first_stream + stream);
    return code == AVERROR(EAGAIN) ? 0 : code;
}

static int write_samples(wf_writing *w, int64_t count) {
    wf_written_sound *s = &w->sound;
    int code = 0;
    for (int i = 0; i < s->streams && code >= 0; i++) {
        code = make_frame(w, count);
        if (code >= 0) fill(w, s->frame, i * channels_of(w));
        if (code >= 0) code = encode(w, i);
        av_frame_unref(s->frame);
    }
    s->samples += count;
    return code;
}

weft_status wf_written_sound_write(wf_writing *w, weft_error *err) {
    const wf_sound_feed *feed = &w->options.sound;
    if (!w->sound.codec) return WEFT_OK;
    int64_t count = samples_until(w, w->frames) - w->sound.samples;
    weft_status status =
        feed->read ? feed->read(feed->self, w->sound.next, count, err) : WEFT_OK;
    if (status) return status;
    int code = write_samples(w, count);
    return code < 0 ? wf_writing_failed(w, "its sound cannot be written", code, err) : WEFT_OK;
}

void wf_written_sound_free(wf_written_sound *sound) {
    avcodec_free_context(&sound->codec);
    av_frame_free(&sound->frame);
    free(sound->next);
}
