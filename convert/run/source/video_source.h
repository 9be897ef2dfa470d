/* What the files of the source of video share: what it holds, and its steps. */
#ifndef WF_CONVERT_RUN_SOURCE_VIDEO_SOURCE_H
#define WF_CONVERT_RUN_SOURCE_VIDEO_SOURCE_H

#include "convert/run/sum/pictures.h"
#include "convert/video/arrivals.h"
#include "convert/video/light.h"
#include "convert/video/window.h"

/* run->source */
typedef struct wf_video_source {
    const char *path; /* the job's */
    wf_video_info info;
    wf_meaning meaning;
    wf_alpha alpha; /* how color lies beside it; unset: there is none */
    int channels;   /* of light: 4 with alpha */
    wf_light *light;
    wf_video_window *window;
    wf_aside ahead; /* decodes what the next units need while fields are summed */
    wf_row_maker maker;
    wf_source_options options; /* of no consequence: nothing is read from files */
    wf_image_info first;
    int64_t picture, step, count; /* unit u is picture + u step; count -1: not known yet */
    int64_t limit;                /* of a pipe: the units that --frames asks for; 0: all */
    wf_rational stated;           /* units a second, before film is slowed or sped */
    bool keeps_rate;              /* timestamps are held against the rate */
    int64_t first_ticks;          /* of a pipe: when picture 0 is shown */
    int64_t last_ticks, ends; /* when the last that was decoded is shown, and ends; 0: none */
    wf_arrivals *arrivals;    /* of a pipe that has timestamps, whose end is not known */
    wf_rational *times_s;     /* [count + 1], where pictures last unequally long */
    wf_rational *edges;       /* of these times; NULL: pictures have a rate */
    wf_timing_desc timing;
    wf_resampler *resampler;
    int64_t end_field;
    wf_rational *missing; /* numbers of pictures that are needed and could not be decoded */
    size_t missing_count;
    weft_error cut; /* what the file's structure says of its end, where that may be missing */
} wf_video_source;

/* (source_video.c) Whether alpha of its pictures counts; and light from their codes, once
 * --from is settled. */
bool wf_video_source_has_alpha(const wf_video_source *source);
weft_status wf_video_source_light(wf_run *run, weft_error *err);

/* (video_fields.c) wf_source_kind's count and needs; frames that so many pictures give; and the
 * error of a number that gives none. */
weft_status wf_video_source_count(wf_run *run, weft_error *err);
wf_needs wf_video_source_needs(const wf_run *run, int64_t field);
int64_t wf_video_source_frames(const wf_video_source *source, int64_t pictures);
weft_status wf_video_source_too_few(const wf_run *run, int64_t count, weft_error *err);

/* (video_decoding.c) wf_source_kind's ready, and wf_picture_reading's prepare. */
weft_status wf_video_source_ready(wf_run *run, int64_t field, weft_error *err);
weft_status wf_video_source_prepare(const wf_run *run, const wf_units *units, weft_error *err);

/* (video_pictures.c) */
extern const wf_picture_reading wf_video_source_pictures;

#endif
