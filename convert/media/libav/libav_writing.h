#ifndef WF_CONVERT_MEDIA_LIBAV_LIBAV_WRITING_H
#define WF_CONVERT_MEDIA_LIBAV_LIBAV_WRITING_H

#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/audio_fifo.h>
#include <xxhash.h>

#include "convert/base/outfile.h"
#include "convert/job/audio.h"
#include "convert/job/colors.h"
#include "convert/media/libav/libav.h"

/* A delivery that is being written, and what its picture and its sound both do. */

/* A stream of sound, of the tracks from `first` on. */
typedef struct wf_written_stream {
    AVCodecContext *codec;
    AVAudioFifo
        *waiting; /* samples that do not fill a frame of the codec; NULL: it takes any */
    int index;    /* in the file */
    int first, channels;
    int64_t sent; /* samples that the encoder was given */
} wf_written_stream;

/* Sound beside a video. */
typedef struct wf_written_sound {
    wf_written_stream stream[WF_SOUND_TRACKS];
    AVFrame *frame;
    int streams;         /* one a track, a pair of tracks, or for all; 0: no sound */
    int64_t first_frame; /* of the run, from which samples are shared out to frames */
    int64_t samples;     /* of a track, written so far */
    int32_t *next;       /* those of a frame, [][tracks] */
} wf_written_sound;

typedef struct wf_writing {
    wf_output_options options;
    const wf_delivery *delivery;
    const wf_delivery_form *form;
    wf_raster raster; /* as it is in the file */
    wf_color_tags tags;
    wf_outfile *file;
    XXH3_state_t *hash; /* of all bytes that are written */
    weft_error failure; /* the file's own words, where it was what failed */
    AVFormatContext *format;
    AVCodecContext *codec;
    AVStream *stream;
    AVFrame *frame;
    AVPacket *packet;
    uint16_t *row; /* [raster.width_px] */
    wf_written_sound sound;
    int64_t frames;
} wf_writing;

/* Reports an error of libav's in its words, or that of the file where the file was what failed.
 */
weft_status wf_writing_failed(const wf_writing *w, const char *doing, int code,
                              weft_error *err);

/* Gives w->packet, which codec has made, to stream `stream` of the file. 0 or an AVERROR. */
int wf_writing_mux(wf_writing *w, const AVCodecContext *codec, int stream);

#endif
