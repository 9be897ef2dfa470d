#ifndef WF_CONVERT_SETUP_H
#define WF_CONVERT_SETUP_H

#include "convert/job.h"
#include "convert/sequence.h"
#include "filters/resampler.h"

/* A job settled: what there is to read, what is to be written, and all that stands between. */
typedef struct wf_setup {
    wf_sequence sequence;
    wf_source_options source;
    wf_image_info first; /* what the first subframe says of itself; all must agree in size */
    wf_resampler *resampler;
    int64_t first_frame, end_frame; /* of this chunk */
    int64_t end_field;              /* of the whole run */

    const wf_sink_kind *sink;
    wf_sink_options sink_options;
    char color_space[64];
    wf_transform transform; /* apply is NULL where colour is left alone */
    wf_encoding encoding;   /* where codes are written */
} wf_setup;

/* Reads the headers it has to and decides everything that can be decided before a pixel is
 * read. Whatever the status, wf_setup_free releases it. */
weft_status wf_setup_make(weft_job *job, wf_setup *setup, weft_error *err);
void wf_setup_free(wf_setup *setup);

#endif
