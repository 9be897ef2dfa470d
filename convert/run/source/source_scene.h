#ifndef WF_CONVERT_RUN_SOURCE_SOURCE_SCENE_H
#define WF_CONVERT_RUN_SOURCE_SOURCE_SCENE_H

#include "convert/run/sum/flow.h"
#include "tracer/sample/sampling.h"

/* What trace, which stores what it samples, has of the source that is a scene. */

/* run->source. */
typedef struct wf_scene_source {
    wf_scene scene;
    wf_sampling *sampling;         /* NULL before start */
    wf_sampling_scratch **scratch; /* [threads] */
} wf_scene_source;

/* The frames first <= n < *end of the scene that --frames chooses, whatever the chunk. */
weft_status wf_scene_frames(const weft_job *job, const wf_scene *scene, int64_t *first,
                            int64_t *end, weft_error *err);

/* How the job samples the scene; borrows both. */
wf_sampling_desc wf_scene_sampling(const weft_job *job, const wf_scene *scene);

/* The space that its colors are in. Static storage, or the scene's. */
const char *wf_scene_space(const wf_run *run);

/* Adds to the report what was traced. Nothing before start. */
void wf_scene_tell_traced(const wf_run *run, wf_report *report);

#endif
