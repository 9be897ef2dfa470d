#ifndef WF_CONVERT_FORESEE_H
#define WF_CONVERT_FORESEE_H

#include "convert/pipeline.h"
#include "convert/report.h"

/* --dry-run: what a conversion would do. */
typedef struct wf_foreseen wf_foreseen;

/* Puts the plan into the report, as "plan", and for people into the job. Nothing is read or
 * written. The report's plan borrows the pipeline's setup until the report is text. */
weft_status wf_foresee(wf_pipeline *pipeline, wf_report *report, weft_error *err);
void wf_foreseen_free(wf_foreseen *foreseen); /* NULL is fine */

#endif
