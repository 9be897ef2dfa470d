#ifndef WF_CONVERT_RUN_DEEP_SOURCE_H
#define WF_CONVERT_RUN_DEEP_SOURCE_H

#include "convert/job/report.h"
#include "convert/run/setup.h"

/* weft convert of sample buffers: a deep EXR file a frame. */

/* Whether the job's first input is one. */
bool wf_takes_samples(const weft_job *job);

weft_status wf_run_samples(weft_job *job, wf_report *report, weft_error *err);

#endif
