/* What is measured of the files of a job, for reports and for people. */
#ifndef WF_CONVERT_ASK_MEASURE_H
#define WF_CONVERT_ASK_MEASURE_H

#include "convert/base/json.h"
#include "convert/check/measure.h"
#include "convert/job/job.h"

/* Values of options, in the order of wf_display_kind and wf_heat_kind. */
#define WF_ASK_DISPLAYS "bob|crt|bwdif|yadif|w3fdif"
#define WF_ASK_HEATS    "flicker|visible|crawl"

/* Who is told of files and troubles as they come, beside the report. */
typedef struct wf_measure_tell {
    void *user;
    void (*figures)(void *user, const char *path, const wf_measure_options *options,
                    const wf_figures *figures);
    weft_warning_fn *trouble; /* NULL: err has the first */
} wf_measure_tell;

/* weft_job_measure. tell NULL: nobody is told. */
weft_status wf_ask_measure(weft_job *job, const weft_measure *asked,
                           const wf_measure_tell *tell, weft_error *err);

/* Adds an object with the figures of a file; a figure that could not be measured is null. If
 * error is not NULL, the object holds that message instead. */
void wf_measure_json(wf_json *json, const char *path, const wf_figures *figures,
                     const char *error);

#endif
