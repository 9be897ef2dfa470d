/* Opens what --audio asks for and makes tracks of it. */
#include "convert/sound/sound.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "convert/base/module.h"
#include "convert/job/audio.h"
#include "convert/media/sound_reader.h"
#include "convert/read/video.h"
#include "convert/sound/tone.h"

struct wf_sound {
    const weft_job *job;
    wf_audio audio;
    char *path; /* of the file it comes from; NULL: it is made */
    int channels, tracks, bits;
    const char *encoder; /* what is made of the tracks; NULL: samples as they are */
    const wf_sound_reader *reader;
    void *state; /* the reader's */
    wf_sound_info info;
    int32_t *block; /* [room][channels] */
    int64_t room;
    double from_s;  /* on the file's clock */
    double speed;   /* that it is played at, 1 being its own */
    int64_t first;  /* of the run's samples, counted from frame 0 */
    int64_t given;  /* samples of a track */
    int64_t padded; /* of these, after the end of the file */
};

/* ---- Where it comes from ---- */

#define INSTEAD "give --audio FILE.wav, or silent:2 for two silent tracks"

/* The video whose sound is copied; an error where the input has none. */
static weft_status find_video(wf_sound *s, weft_error *err) {
    const weft_job *job = s->job;
    const char *input = job->inputs[0];
    struct stat about;
    if (job->command != WF_CONVERT)
        return wf_fail(err, WEFT_USAGE, "--audio copy: a scene has no sound; " INSTEAD);
    bool video;
    weft_status status = wf_video_is(input, &video, err);
    if (status) return status;
    if (!video)
        return wf_fail(err, WEFT_USAGE, "--audio copy: %.500s has no sound; " INSTEAD, input);
    if (!strcmp(input, "-") || (!stat(input, &about) && !S_ISREG(about.st_mode)))
        return wf_fail(
            err, WEFT_USAGE,
            "--audio copy: a pipe is read once, for its pictures; write its video to a "
            "file first, or " INSTEAD);
    s->path = strdup(input);
    return s->path ? WEFT_OK : wf_fail(err, WEFT_NO_MEMORY, "no memory for the sound");
}

/* A file may have a ':' and a number at its name's end. */
static weft_status find_file(wf_sound *s, weft_error *err) {
    const char *text = s->job->audio;
    struct stat about;
    if (!stat(text, &about)) s->audio.path_length = strlen(text), s->audio.offset = NULL;
    s->path = strndup(text, s->audio.path_length);
    if (!s->path) return wf_fail(err, WEFT_NO_MEMORY, "no memory for the sound");
    if (!stat(s->path, &about) && !S_ISREG(about.st_mode))
        return wf_fail(err, WEFT_USAGE, "--audio: %.500s is no file; " INSTEAD, s->path);
    return WEFT_OK;
}

static weft_status find_reader(wf_sound *s, weft_error *err) {
    void *symbol;
    char what[600];
    wf_libav_sound_fn *reader;
    snprintf(what, sizeof what, "%.500s: sound, unlike silent:2,", s->path);
    weft_status status = wf_module_symbol("libav", "wf_libav_sound", what, &symbol, err);
    if (status) return status;
    memcpy(&reader, &symbol, sizeof reader);
    s->reader = reader();
    return WEFT_OK;
}

static weft_status open_reader(wf_sound *s, weft_error *err) {
    bool copied = s->audio.kind == WF_AUDIO_COPY;
    weft_status status = copied ? find_video(s, err) : find_file(s, err);
    if (!status) status = find_reader(s, err);
    if (!status) status = s->reader->open(s->path, copied, &s->state, &s->info, err);
    if (status) return status;
    s->channels = s->info.channels;
    if (s->channels) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE, "%.500s: it holds no sound%s; " INSTEAD, s->path,
                   copied ? " to copy" : "");
}

/* ---- What becomes of it ---- */

static void settle_tracks(wf_sound *s, const wf_delivery *delivery) {
    bool made = !s->reader;
    if (made) s->channels = s->audio.tracks;
    s->encoder = delivery->sound_encoder;
    s->bits = s->encoder ? 32 : s->job->audio_bits;
    s->tracks = (int)s->job->audio_tracks;
    if (!s->tracks)
        s->tracks = made ? s->channels : wf_delivery_sound_tracks(delivery, s->channels);
}

/* For people: encoders are known by words in capitals. */
static const char *encoding_of(const wf_sound *s) {
    return !strcmp(s->encoder, "aac") ? "AAC" : s->encoder;
}

static void tell_tracks(const wf_sound *s) {
    int channels = s->channels, tracks = s->tracks;
    if (channels > tracks && !s->audio.tracks)
        wf_job_warn(
            s->job,
            "%s: it has %d channels of sound, and there are %d tracks: channels from %d "
            "on are left out",
            s->path, channels, tracks, tracks + 1);
    if (channels < tracks && s->audio.kind != WF_AUDIO_SILENT)
        wf_job_warn(s->job, "--audio: of the %d tracks of sound those from %d on are silent",
                    tracks, channels + 1);
}

static void tell_samples(const wf_sound *s) {
    if (s->reader && s->encoder)
        wf_job_warn(s->job,
                    "%s: its sound is written as %s, which is lossy; .mov and .mkv hold its "
                    "samples as they are",
                    s->path, encoding_of(s));
    if (s->info.bits > s->bits)
        wf_job_warn(s->job, "%s: its sound of %d bits is rounded to %d%s", s->path,
                    s->info.bits, s->bits,
                    s->info.bits > 24 ? "; --audio-bits 32 keeps it, in .mov and .mkv"
                                      : "; --audio-bits 24 keeps it");
    if (s->info.resampled)
        wf_job_warn(s->job, "%s: its sound (%s) is resampled to %d Hz", s->path, s->info.format,
                    WF_SOUND_RATE);
}

weft_status wf_sound_open(const weft_job *job, const wf_delivery *delivery, wf_sound **out,
                          weft_error *err) {
    wf_audio audio;
    *out = NULL;
    if (!wf_audio_parse(job->audio, &audio) || audio.kind == WF_AUDIO_NONE) return WEFT_OK;
    wf_sound *s = calloc(1, sizeof *s);
    if (!s) return wf_fail(err, WEFT_NO_MEMORY, "no memory for the sound");
    s->job = job;
    s->audio = audio;
    bool read = audio.kind == WF_AUDIO_COPY || audio.kind == WF_AUDIO_FILE;
    weft_status status = read ? open_reader(s, err) : WEFT_OK;
    if (status) {
        wf_sound_close(s);
        return status;
    }
    settle_tracks(s, delivery);
    tell_tracks(s);
    tell_samples(s);
    *out = s;
    return WEFT_OK;
}

static void put_channels(const wf_sound_info *info, char *text, size_t size) {
    snprintf(text, size, "%d channel%s (%.48s)", info->channels, info->channels > 1 ? "s" : "",
             info->format);
}

static const char *name_of(const wf_sound *s) {
    const char *slash = strrchr(s->path, '/');
    if (s->audio.kind == WF_AUDIO_COPY) return "copy";
    return slash ? slash + 1 : s->path;
}

const char *wf_sound_text(const wf_sound *s, char text[WF_SOUND_TEXT]) {
    char channels[72], from[100];
    put_channels(&s->info, channels, sizeof channels);
    if (s->audio.kind == WF_AUDIO_SILENT)
        snprintf(from, sizeof from, "silence");
    else if (s->audio.kind == WF_AUDIO_TONE)
        snprintf(from, sizeof from, "%d Hz at %d dBFS", WF_TONE_HZ, WF_TONE_DBFS);
    else
        snprintf(from, sizeof from, "%.24s: %s", name_of(s), channels);
    int used = snprintf(text, WF_SOUND_TEXT, "%s; %d track%s of ", from, s->tracks,
                        s->tracks > 1 ? "s" : "");
    if (s->encoder)
        snprintf(text + used, WF_SOUND_TEXT - (size_t)used, "%s", encoding_of(s));
    else
        snprintf(text + used, WF_SOUND_TEXT - (size_t)used, "%d bits", s->bits);
    return text;
}

weft_status wf_sound_in(const char *path, char text[WF_SOUND_TEXT], weft_error *err) {
    wf_sound s = {.path = (char *)path};
    *text = '\0';
    weft_status status = find_reader(&s, err);
    if (!status) status = s.reader->open(path, true, &s.state, &s.info, err);
    if (status) return status;
    s.reader->close(s.state);
    if (s.info.channels)
        put_channels(&s.info, text, WF_SOUND_TEXT);
    else
        snprintf(text, WF_SOUND_TEXT, "none");
    return WEFT_OK;
}

/* ---- Samples ---- */

static weft_status read_tone(void *self, int32_t *to, int64_t count, weft_error *err) {
    wf_sound *s = self;
    (void)err;
    for (int64_t i = 0; i < count; i++) {
        int32_t sample = wf_tone_sample(s->first + s->given + i, s->bits);
        for (int t = 0; t < s->tracks; t++) *to++ = t < s->channels ? sample : 0;
    }
    s->given += count;
    return WEFT_OK;
}

static weft_status make_room(wf_sound *s, int64_t count, weft_error *err) {
    if (count <= s->room) return WEFT_OK;
    size_t samples = (size_t)count * (size_t)s->channels;
    int32_t *grown = realloc(s->block, samples * sizeof *grown);
    if (!grown) return wf_fail(err, WEFT_NO_MEMORY, "%.700s: no memory for its sound", s->path);
    s->block = grown;
    s->room = count;
    return WEFT_OK;
}

static weft_status read_file(void *self, int32_t *to, int64_t count, weft_error *err) {
    wf_sound *s = self;
    int64_t got = 0;
    weft_status status = make_room(s, count, err);
    if (!status) status = s->reader->read(s->state, s->block, count, &got, err);
    if (status) return status;
    for (int64_t i = 0; i < count; i++)
        for (int t = 0; t < s->tracks; t++)
            *to++ =
                t < s->channels ? wf_sample_rounded(s->block[i * s->channels + t], s->bits) : 0;
    s->given += count;
    s->padded += count - got;
    return WEFT_OK;
}

wf_sound_feed wf_sound_feed_of(wf_sound *s) {
    wf_sound_feed feed = {.tracks = s->tracks, .bits = s->bits, .self = s};
    if (s->reader) feed.read = read_file;
    if (s->audio.kind == WF_AUDIO_TONE) feed.read = read_tone;
    return feed;
}

/* ---- Beginning and end ---- */

/* A picture's speed that is not quite the sound's may be one rate written in two ways. */
#define SAME_SPEED 2e-6

/* Sound that is copied goes with its pictures. */
static weft_status find_speed(const wf_sound *s, const wf_sound_place *place,
                              wf_rational *speed, weft_error *err) {
    double value = wf_ratio_given(place->speed) ? wf_ratio_value(place->speed) : 1;
    bool copied = s->audio.kind == WF_AUDIO_COPY;
    *speed = wf_ratio(1, 1);
    if (!copied || (value > 1 - SAME_SPEED && value < 1 + SAME_SPEED)) return WEFT_OK;
    if (value < 0.5 || value > 2)
        return wf_fail(err, WEFT_USAGE,
                       "%.500s: its pictures are shown at %.6g times their speed, which is too "
                       "much for its sound; leave out --subframe-rate, or " INSTEAD,
                       s->path, value);
    wf_job_warn(s->job,
                "%s: its sound is resampled to %.6g times its speed, that of the pictures",
                s->path, value);
    *speed = place->speed;
    return WEFT_OK;
}

static weft_status find_start(const wf_sound *s, const wf_sound_place *place,
                              wf_rational *start_s, weft_error *err) {
    bool copied = s->audio.kind == WF_AUDIO_COPY;
    *start_s = wf_ratio(0, 1);
    if (copied && wf_ratio_given(place->copied_s)) *start_s = place->copied_s;
    if (!s->audio.offset ||
        wf_audio_offset(s->audio.offset, s->job->raster.frame_rate, start_s))
        return WEFT_OK;
    return wf_fail(
        err, WEFT_USAGE,
        "--audio: there is no timecode %.100s at the frame rate of %s; give seconds, such "
        "as 1.5",
        s->audio.offset, s->job->raster.name);
}

weft_status wf_sound_begin(wf_sound *s, const wf_sound_place *place, weft_error *err) {
    wf_sound_start start = {
        .samples = wf_sound_samples(s->job->raster.frame_rate, place->first_frame)};
    s->first = start.samples;
    if (!s->reader) return WEFT_OK;
    weft_status status = find_start(s, place, &start.start_s, err);
    if (!status) status = find_speed(s, place, &start.speed, err);
    if (status) return status;
    s->speed = wf_ratio_value(start.speed);
    s->from_s = wf_ratio_value(start.start_s) + (double)s->first / WF_SOUND_RATE * s->speed;
    if (s->audio.kind == WF_AUDIO_FILE && s->info.length_s > 0 && s->from_s >= s->info.length_s)
        return wf_fail(
            err, WEFT_USAGE,
            "--audio: %.500s is %.3f s long, and its sound from %.3f s on is asked for",
            s->path, s->info.length_s, s->from_s);
    return s->reader->begin(s->state, &start, err);
}

/* Frames that are asked for by number are a part of the sound, and it goes on after them. */
static bool is_part(const wf_sound *s) {
    return s->job->output_end || (s->audio.kind == WF_AUDIO_COPY && s->job->frames);
}

void wf_sound_tell(wf_sound *s) {
    if (!s->reader) return;
    const char *note = s->reader->note(s->state);
    double end_s = s->from_s + (double)s->given / WF_SOUND_RATE * s->speed;
    double after_s = s->info.length_s - end_s;
    double least_s = s->audio.kind == WF_AUDIO_COPY
                         ? 1 / wf_ratio_value(s->job->raster.frame_rate)
                         : 1.5 / WF_SOUND_RATE;
    if (*note) wf_job_warn(s->job, "%s: %s", s->path, note);
    if (s->padded > 1)
        wf_job_warn(s->job,
                    "%s: its sound ends %.3f s before the pictures do, which are silent from "
                    "there on",
                    s->path, (double)s->padded / WF_SOUND_RATE);
    if (after_s > least_s && !is_part(s))
        wf_job_warn(s->job,
                    "%s: its sound goes on for %.3f s after the pictures, which is left out",
                    s->path, after_s);
}

void wf_sound_close(wf_sound *s) {
    if (!s) return;
    if (s->state) s->reader->close(s->state);
    free(s->block);
    free(s->path);
    free(s);
}
