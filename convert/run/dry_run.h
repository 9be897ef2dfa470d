#ifndef WF_CONVERT_RUN_DRY_RUN_H
#define WF_CONVERT_RUN_DRY_RUN_H

#include "convert/job/report.h"
#include "convert/run/pipeline.h"
#include "tracer/sample/sampling.h"

/* --dry-run: what a job would do. */
typedef struct wf_foreseen wf_foreseen;

typedef struct wf_foresee_desc {
    weft_job *job;
    const wf_setup *setup;       /* its frames, sink and the sink's options */
    wf_pipeline *pipeline;       /* of subframes; NULL: there are none */
    const wf_sampling *sampling; /* of a scene; NULL: there is none */
    bool pictures;               /* what is made are subframes, not frames of fields */
} wf_foresee_desc;

/* Puts the plan into the report, as "plan", and for people into the job. Nothing is read or
 * written. */
weft_status wf_foresee(const wf_foresee_desc *desc, wf_report *report, weft_error *err);
void wf_foreseen_free(wf_foreseen *foreseen); /* NULL is fine */

#endif
