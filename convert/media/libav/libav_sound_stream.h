#ifndef WF_CONVERT_MEDIA_LIBAV_LIBAV_SOUND_STREAM_H
#define WF_CONVERT_MEDIA_LIBAV_LIBAV_SOUND_STREAM_H

#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswresample/swresample.h>

#include "convert/media/sound_reader.h"

/* One stream of sound: packets in, a queue of samples at WF_SOUND_RATE out, each at its place
 * in time. */
typedef struct wf_sound_stream {
    const char *path; /* of the file; borrowed */
    const AVStream *stream;
    AVCodecContext *codec;
    AVFrame *frame;
    SwrContext *resampler; /* NULL: it has that rate, and is played as it was recorded */
    int channels, rate;
    double zero_s; /* what is time 0 on the stream's clock */

    bool begun;        /* its first sample has been met: */
    int64_t first_pts; /* when, in ticks of the stream */
    int64_t counted;   /* samples at its own rate since then, with those put into gaps */
    int64_t surplus;   /* of these, to be left out: they would overlap what there is */
    wf_sound_start start;

    int64_t lead;   /* silent samples that come before those of the queue */
    int64_t skip;   /* samples that come before the place where reading begins */
    int32_t *queue; /* [room][channels], of which from..from + held are there */
    size_t from, held, room;
    int32_t *block, *resampled; /* [][channels]: a frame's */
    size_t block_room, resampled_room;
    int64_t given_up; /* silent samples given out while others had theirs */
    bool ended;
    double gap_s; /* of the first gap or overlap; negative: there was none */
} wf_sound_stream;

weft_status wf_sound_stream_open(wf_sound_stream *s, const char *path, const AVStream *stream,
                                 weft_error *err);

/* Says where reading begins; before the first packet. */
weft_status wf_sound_stream_begin(wf_sound_stream *s, const wf_sound_start *start,
                                  weft_error *err);

/* Decodes a packet, or with NULL what is left at the end. */
weft_status wf_sound_stream_feed(wf_sound_stream *s, const AVPacket *packet, weft_error *err);

/* How many samples are there to be taken, silent ones included. */
int64_t wf_sound_stream_held(const wf_sound_stream *s);

/* Takes up to `count` samples into to[count][stride]; the rest stay as they are. */
void wf_sound_stream_take(wf_sound_stream *s, int32_t *to, int stride, int64_t count);

/* When its next sample is heard, in seconds from time 0. */
double wf_sound_stream_time_s(const wf_sound_stream *s);

void wf_sound_stream_free(wf_sound_stream *s);

#endif
