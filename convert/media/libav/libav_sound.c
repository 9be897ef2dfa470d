/* Silence beside a video: formats that ask for sound get tracks of it. */
#include "convert/media/libav/libav_sound.h"

#include <string.h>

static int channels_of(const wf_writing *w) {
    return w->delivery->one_audio_stream ? w->options.silent_tracks : 1;
}

static int open_codec(wf_writing *w) {
    const AVCodec *encoder = avcodec_find_encoder_by_name(w->delivery->audio);
    AVCodecContext *c = w->sound.codec = encoder ? avcodec_alloc_context3(encoder) : NULL;
    if (!c) return AVERROR(encoder ? ENOMEM : EINVAL);
    c->sample_fmt = encoder->sample_fmts[0];
    c->sample_rate = WF_SOUND_RATE;
    c->time_base = (AVRational){1, WF_SOUND_RATE};
    c->flags |= AV_CODEC_FLAG_BITEXACT;
    av_channel_layout_default(&c->ch_layout, channels_of(w));
    return avcodec_open2(c, encoder, NULL);
}

static int open_streams(wf_writing *w) {
    wf_sound *s = &w->sound;
    s->first_stream = (int)w->format->nb_streams;
    s->streams = w->delivery->one_audio_stream ? 1 : w->options.silent_tracks;
    for (int i = 0; i < s->streams; i++) {
        AVStream *stream = avformat_new_stream(w->format, NULL);
        if (!stream) return AVERROR(ENOMEM);
        stream->time_base = s->codec->time_base;
        int code = avcodec_parameters_from_context(stream->codecpar, s->codec);
        if (code < 0) return code;
    }
    return 0;
}

weft_status wf_sound_open(wf_writing *w, weft_error *err) {
    wf_sound *s = &w->sound;
    if (!w->options.silent_tracks) return WEFT_OK;
    int code = open_codec(w);
    if (code >= 0) code = open_streams(w);
    s->frame = av_frame_alloc();
    if (code >= 0 && !s->frame) code = AVERROR(ENOMEM);
    return code < 0 ? wf_writing_failed(w, "its sound cannot be begun", code, err) : WEFT_OK;
}

/* Samples from the first to the end of frame n: at 30000/1001 1602 1601 1602 1601 1602, as
 * SMPTE ST 299 has it. */
static int64_t samples_until(const wf_writing *w, int64_t frames) {
    wf_rational rate = w->raster.frame_rate;
    return (2 * frames * WF_SOUND_RATE * rate.den + rate.num) / (2 * rate.num);
}

static int encode(wf_writing *w, int64_t count) {
    wf_sound *s = &w->sound;
    AVFrame *f = s->frame;
    f->nb_samples = (int)count;
    f->format = s->codec->sample_fmt;
    f->sample_rate = WF_SOUND_RATE;
    int code = av_channel_layout_copy(&f->ch_layout, &s->codec->ch_layout);
    if (code >= 0) code = av_frame_get_buffer(f, 0);
    for (int i = 0; i < s->streams && code >= 0; i++) {
        memset(f->data[0], 0, (size_t)f->linesize[0]);
        f->pts = s->samples;
        code = avcodec_send_frame(s->codec, f);
        while (code >= 0 && (code = avcodec_receive_packet(s->codec, w->packet)) >= 0)
            code = wf_writing_mux(w, s->codec, s->first_stream + i);
        if (code == AVERROR(EAGAIN)) code = 0;
    }
    av_frame_unref(f);
    return code;
}

weft_status wf_sound_write(wf_writing *w, weft_error *err) {
    wf_sound *s = &w->sound;
    if (!s->codec) return WEFT_OK;
    int64_t end = samples_until(w, w->frames);
    int code = encode(w, end - s->samples);
    s->samples = end;
    return code < 0 ? wf_writing_failed(w, "its sound cannot be written", code, err) : WEFT_OK;
}

void wf_sound_free(wf_sound *sound) {
    avcodec_free_context(&sound->codec);
    av_frame_free(&sound->frame);
}
