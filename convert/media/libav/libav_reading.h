#ifndef WF_CONVERT_MEDIA_LIBAV_LIBAV_READING_H
#define WF_CONVERT_MEDIA_LIBAV_LIBAV_READING_H

#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/pixdesc.h>
#include <stdatomic.h>

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
    bool checked;     /* its packets have checksums */
    int64_t packets;  /* of the stream, read so far */
    int64_t listed;   /* of the stream, in the whole file; 0: they have not been counted */
    bool by_decoding; /* info.times are not those that frames have */
    double end_s;     /* of the last one */
    bool until_key;   /* packets are passed over up to the next keyframe, which is shown at: */
    int64_t key_ticks;
    uint16_t *code;     /* [width] */
    int64_t last_ticks; /* when the last picture was shown */
    /* Where damaged pictures are missing ones (libav_mend.c): */
    AVFrame *held; /* the last that was given and is whole; NULL: none was */
    int64_t place; /* the number of the frame in hand; -1: it has not been looked at */
    int64_t lost;  /* times that something could not be decoded, since the last picture */
    int64_t first_bad,
        last_bad;            /* packets that were lost, whose pictures others may look at; -1 */
    atomic_llong complaints; /* of the decoder; those that were noted or passed over: */
    atomic_llong complained; /* about which packet, the first since that was asked; 0: none */
    int64_t noted;
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

/* Whether the decoder says that the frame is not as it was coded. (libav_checks.c) */
bool wf_libav_is_damaged(const AVFrame *frame);

/* Has libav print nothing, and counts the complaints of decoders whose opaque is a reading;
 * notes those that came with the picture in hand; or passes over those of pictures that are not
 * shown. (libav_hear.c) */
void wf_libav_listen(void);
void wf_libav_note_complaints(wf_video *video);
int64_t wf_libav_complained(wf_libav_reading *reading); /* and forgets it */
void wf_libav_pass_complaints(wf_libav_reading *reading);

/* The end of the file, or an error where it comes before what it says is its end. (libav.c) */
weft_status wf_libav_check_end(const wf_video *video, weft_error *err);

/* Says when the picture is shown that is given, and how long. One that does not say when comes
 * at the stated rate after the one before it, as the last of MXF. (libav.c) */
void wf_libav_give_time(wf_video *video, int64_t ticks, int64_t lasts);

/* When the frame in hand is shown, as far as the mean rate tells. (libav.c) */
double wf_libav_time_s(const wf_video *video);

/* options.mends (libav_mend.c): has the first frame that is whole in hand; with it, counts the
 * pictures that the file says it has, which are missing where they are not there; then, for
 * each next picture, says which frame it is made of: NULL at the end. */
weft_status wf_libav_mend_first(wf_video *video, weft_error *err);
weft_status wf_libav_mend_count(wf_video *video, weft_error *err);
weft_status wf_libav_mend_next(wf_video *video, const AVFrame **frame, weft_error *err);
void wf_libav_mend_again(wf_libav_reading *reading); /* it has gone to another place */

/* How many packets the file's index counts for the stream, 0 where the number means something
 * else; and how long the stream states to be in seconds, 0 where it does not. (libav.c) */
int64_t wf_libav_stated_packets(const wf_libav_reading *reading);
double wf_libav_stated_length_s(const wf_libav_reading *reading);

/* With the first frame in hand: fills info.timecode and its rate, of a track, a tag, the
 * first frame (SEI) or MPEG's first group of pictures. (libav_timecode.c) */
void wf_libav_timecode(wf_video *video);

/* wf_video_kind.seek: by the keyframe at or before the picture, where the listed times tell
 * pictures apart and what is decoded from there reaches it; else from the beginning on.
 * (libav_seek.c) */
weft_status wf_libav_seek(wf_video *video, int64_t picture, weft_error *err);

#endif
