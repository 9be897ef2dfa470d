#ifndef WF_CONVERT_JOB_JOB_LAYER_H
#define WF_CONVERT_JOB_JOB_LAYER_H

#include "convert/job/job.h"

/* Layers of options (job files, then the command line): what a layer says wins over earlier
 * ones, and options that exclude each other contradict each other only within one. Between
 * begin and end options are set as always. */
typedef struct wf_job_layer {
    char *to, *display, *view;
    bool overwrite, resume, width_given, angle_given;
} wf_job_layer;
void wf_job_layer_begin(weft_job *job, wf_job_layer *layer);
void wf_job_layer_end(weft_job *job, wf_job_layer *layer);

#endif
