#ifndef WF_CONVERT_RUN_SETUP_H
#define WF_CONVERT_RUN_SETUP_H

#include "color/codes/encode.h"
#include "color/space/transform.h"
#include "convert/job/job.h"
#include "convert/job/report.h"
#include "convert/job/timecode.h"
#include "convert/read/sequence.h"
#include "convert/read/source.h"
#include "convert/write/sink.h"
#include "filters/gather/samples.h"
#include "filters/resample/resampler.h"

/* A job settled: what there is to read, what is to be written, and all that stands between. */
typedef struct wf_setup {
    wf_sequence sequence;
    wf_source_options source;
    wf_image_info first; /* what the first subframe says of itself; all must agree in size */
    wf_resampler *resampler;
    int64_t first_frame, end_frame; /* of this chunk */
    int64_t end_field;              /* of the whole run */

    wf_output output;
    wf_output_options output_options;
    char timecode[WF_TIMECODE_SIZE]; /* of frame 0, where the input told it */
    const char *scene_space; /* what the input says that its colours are in; NULL: nothing */
    char color_space[64];
    wf_transform transform; /* apply is NULL where colour is left alone */
    wf_encoding encoding;   /* where codes are written */
    wf_display *display;    /* the encoding's, for luma-adjust; else NULL */
} wf_setup;

/* Reads the headers it has to and decides everything that can be decided before a pixel is
 * read. Whatever the status, wf_setup_free releases it. */
weft_status wf_setup_make(weft_job *job, wf_setup *setup, weft_error *err);
void wf_setup_free(wf_setup *setup);

/* The output's side of it alone: sink, colour, codes. */
weft_status wf_setup_output(weft_job *job, wf_setup *setup, weft_error *err);

/* Parts of it (setup_color.c): the transform, and what luma-adjust takes the display for. */
weft_status wf_setup_color(const weft_job *job, wf_setup *setup, weft_error *err);
weft_status wf_setup_display(const weft_job *job, wf_setup *setup, weft_error *err);

/* Of that the sink and the codes, for signals that are in the raster's color already: nothing
 * is transformed. */
weft_status wf_setup_sink(const weft_job *job, wf_setup *setup, weft_error *err);

/* Tells the sink which frames there will be: first_frame to end_frame. */
void wf_setup_count_frames(wf_setup *setup);

/* How fields look at samples. Borrows the job's raster. */
wf_gather_desc wf_setup_gather(const weft_job *job);

wf_report_legal wf_setup_legal(const weft_job *job, const wf_setup *setup);

#endif
