#ifndef WF_CONVERT_MEDIA_LIBAV_LIBAV_READING_H
#define WF_CONVERT_MEDIA_LIBAV_LIBAV_READING_H

#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/pixdesc.h>

#include "convert/media/video_kind.h"

/* Inside the reading of video through libav: what its files share. */

/* video->state. */
typedef struct wf_libav_reading {
    AVFormatContext *format;
    AVCodecContext *codec;
    AVPacket *packet;
    AVFrame *frame;
    const AVPixFmtDescriptor *pixels;
    int stream;
    AVRational aspect; /* of the first frame, and its code points: */
    int primaries, transfer, matrix, range;
    bool have; /* frame holds the next one */
    bool drained;
    bool checked;    /* its packets have checksums */
    int64_t packets; /* of the stream, read so far */
    int64_t listed;  /* of the stream, in the whole file; 0: they have not been counted */
    double end_s;    /* of the last one */
    bool until_key;  /* packets are passed over up to the next keyframe, which is shown at: */
    int64_t key_ticks;
    uint16_t *code;     /* [width] */
    int64_t pipe_bytes; /* that have been read */
    AVIOContext *pipe;  /* what reads video->pipe; NULL: a file */
} wf_libav_reading;

/* The index of the stream of video that is taken: the first that is not a cover, else the first
 * cover; below 0: there is none. `count` gets how many there are but covers, or is NULL.
 * (libav_checks.c) */
int wf_libav_video_of(const AVFormatContext *format, int *count);

/* Opens the file and a decoder of its video; closes what was opened of them. */
weft_status wf_libav_open_stream(wf_video *video, weft_error *err);
void wf_libav_close_stream(wf_video *video);

/* Decodes until a frame is there, however damaged, or the stream has ended. */
weft_status wf_libav_decode(wf_video *video, weft_error *err);

/* The error of a container without video: where there is sound, that it is sound, and what
 * takes it. (libav_checks.c) */
weft_status wf_libav_no_video(AVFormatContext *format, const char *path, weft_error *err);

/* With the first frame in hand: whether the stream is shown as it is coded, not turned. Notes
 * what other frames are held against. (libav_checks.c) */
weft_status wf_libav_check_stream(wf_video *video, weft_error *err);

/* Whether the frame in hand, which is shown at time_s, is as the first one was.
 * (libav_checks.c) */
weft_status wf_libav_check_frame(const wf_video *video, double time_s, weft_error *err);

/* With the first frame in hand: fills info.timecode and its rate, of a track, a tag or MPEG's
 * first group of pictures. (libav_timecode.c) */
void wf_libav_timecode(wf_video *video);

/* wf_video_kind.seek: by the keyframe at or before the picture, where the listed times tell
 * pictures apart and what is decoded from there reaches it; else from the beginning on.
 * (libav_seek.c) */
weft_status wf_libav_seek(wf_video *video, int64_t picture, weft_error *err);

#endif
