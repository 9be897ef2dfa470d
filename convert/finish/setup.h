#ifndef WF_CONVERT_FINISH_SETUP_H
#define WF_CONVERT_FINISH_SETUP_H

#include "color/codes/encode.h"
#include "color/codes/key_law.h"
#include "color/space/transform.h"
#include "convert/finish/nearest.h"
#include "convert/job/job.h"
#include "convert/job/report.h"
#include "convert/job/timecode.h"
#include "convert/read/sequence.h"
#include "convert/write/sink.h"
#include "filters/gather/samples.h"

/* A job settled: which files and frames there are, what is to be written, and how colors become
 * codes. Made by one thread before a pixel is read, and only read after that. A zeroed setup is
 * an empty one; wf_setup_free releases it whatever was made of it. */
typedef struct wf_setup {
    wf_sequence sequence;           /* the files that the source reads; empty: a scene, video */
    int64_t first_frame, end_frame; /* of this chunk */
    bool endless;                   /* the source lowers end_frame when it meets its end */
    const char *scene_space; /* what the input says that its light is in; NULL: nothing */
    const wf_chromaticities *scene_primaries; /* and its primaries, where they have no name */
    bool decodes; /* the source decodes what --from encodes, before it is summed */

    struct wf_sound *sound; /* NULL: there is none */
    wf_rational sound_s; /* when frame 0 begins, on the clock of the input's sound; {0, 0}: 0 */
    wf_rational speed;   /* of pictures as they are shown, that clock's being 1; {0, 0}: 1 */

    wf_raster raster; /* of what is written: the job's, with the matrix of the codes */
    wf_raster made;   /* the same, whose lines are those that a field is made to have */
    wf_output output;
    wf_output_options output_options;
    wf_output key; /* the key's, beside the fill that output is; {NULL}: there is none */
    wf_output_options key_options;
    char timecode[WF_TIMECODE_SIZE]; /* of frame 0, where the input told it */
    char color_space[128];           /* of what is written; "" if it has no name */
    wf_chromaticities primaries;     /* of light that is written as it came in */
    wf_transform decode;             /* what --from encodes becomes light before it is summed;
                                        apply is NULL where the input is taken as it is */
    const wf_curve *from_curve;      /* of --from, where weft has the space; NULL: none */
    char from_transfer[24];          /* how --from encodes: "sRGB", "linear"; "encoded" where a
                                        configuration does not say */
    wf_transform transform;          /* apply is NULL where colors are left alone */
    wf_key_law key_law;              /* where alpha is written */
    wf_encoding encoding;            /* where codes are written */
    wf_nearest_desc flicker;         /* where it is held; but for fields */
    wf_display *display;             /* the encoding's, for luma-adjust; else NULL */
} wf_setup;

void wf_setup_free(wf_setup *setup);

/* Settles the output: its sink, the way from scene_space to its colors, and its codes. */
weft_status wf_setup_output(const weft_job *job, wf_setup *setup, weft_error *err);

/* The same for video, whose colors are those of the raster already and are not transformed. */
weft_status wf_setup_video(const weft_job *job, wf_setup *setup, weft_error *err);

/* Opens the sound that --audio asks for, so that the output can be told of its tracks, before
 * wf_setup_output; has it begin with first_frame, when that and sound_s are known; and warns of
 * what was left out or added, after the last frame. (setup_sound.c) */
weft_status wf_setup_sound(const weft_job *job, wf_setup *setup, wf_taken_list *taken,
                           weft_error *err);
/* Asks for the sound of the job's input, a file of video, where there is some and the output,
 * which is of a kind that exists, holds it; else it is told that it is left out. */
weft_status wf_setup_keep_sound(weft_job *job, weft_error *err);
weft_status wf_setup_begin_sound(const wf_setup *setup, weft_error *err);
void wf_setup_tell_sound(const wf_setup *setup);

/* Tells what --from, if it is given, has the input taken for, once the output is settled. */
void wf_setup_take_from(const weft_job *job, const wf_setup *setup, wf_taken_list *taken);

/* Settles the frames first <= n < end that the whole run makes: those of the job's chunk go to
 * first_frame and end_frame, and the sink is told of them. */
void wf_setup_frames(const weft_job *job, wf_setup *setup, int64_t first, int64_t end);

/* The same of the job's output-frames among those that the input gives, from 0 on; WEFT_USAGE
 * where they are not among them. */
weft_status wf_setup_chosen_frames(const weft_job *job, wf_setup *setup, int64_t given,
                                   weft_error *err);

/* Tells the sink which frames there will be: first_frame to end_frame. */
void wf_setup_tell_frames(wf_setup *setup);

/* How fields look at samples. Borrows the job's raster. */
wf_gather_desc wf_setup_gather(const weft_job *job);

/* Temporal width of a job's fields, in field periods: its own or its aperture's. */
wf_rational wf_setup_width(const weft_job *job);

/* What a report says of legal colors before anything is counted. */
wf_report_legal wf_setup_legal(const weft_job *job, const wf_setup *setup);

/* ---- Between the setup's files ---- */

/* Finds the transform to the output's colors, and names these. (setup_color.c) */
weft_status wf_setup_color(const weft_job *job, wf_setup *setup, weft_error *err);

/* Names the raster's own colors as the output's. */
void wf_setup_color_of_raster(const weft_job *job, wf_setup *setup);

/* Settles how flicker is held, and of what light, once colors are settled. (setup_flicker.c) */
void wf_setup_flicker(const weft_job *job, wf_setup *setup);

/* The same of fields of scene-linear light that nothing is written of; raster is borrowed. */
wf_nearest_desc wf_setup_flicker_of_light(const weft_job *job, const wf_raster *raster);

/* Makes the display of the output's colors, where luma-adjust looks at one. */
weft_status wf_setup_display(const weft_job *job, wf_setup *setup, weft_error *err);

#endif
