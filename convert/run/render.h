#ifndef WF_CONVERT_RUN_RENDER_H
#define WF_CONVERT_RUN_RENDER_H

#include "convert/job/report.h"
#include "convert/run/setup.h"
#include "tracer/sample/sampling.h"

/* Jobs that start from a scene. */

/* Loads the job's scene, with the raster, the parameters and the limits of the job. */
weft_status wf_render_load(const weft_job *job, wf_scene *scene, weft_error *err);

/* Whole frames that the scene lasts, of which the job takes first <= n < *end (--frames,
 * --chunk). */
weft_status wf_render_frames(const weft_job *job, const wf_scene *scene, int64_t *first,
                             int64_t *end, weft_error *err);

/* How the job samples a scene. */
wf_sampling_desc wf_render_sampling(const weft_job *job, const wf_scene *scene);

/* weft render, weft trace: fill the report as far as they get. */
weft_status wf_run_render(weft_job *job, wf_report *report, weft_error *err);
weft_status wf_run_trace(weft_job *job, wf_report *report, weft_error *err);

void wf_report_traced(wf_report *report, const wf_trace_counts *counts);

#endif
