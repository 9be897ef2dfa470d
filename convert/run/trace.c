/* weft trace: what a scene shows, stored for weft convert. */
#include "convert/run/trace.h"

#include "convert/base/pattern.h"
#include "convert/run/source/source_scene.h"

static weft_status check_output(const weft_job *job, const wf_setup *s, weft_error *err) {
    if (s->output.kind->layout != WF_LINEAR)
        return wf_fail(err, WEFT_USAGE,
                       "%s: samples are stored as EXR, such as samples.####.exr", job->output);
    if (!wf_pattern_is(job->output))
        return wf_fail(err, WEFT_USAGE,
                       "%s: samples are many files; say where their number goes, such as "
                       "samples.####.exr",
                       job->output);
    return WEFT_OK;
}

/* A stored sample has one time; of an own width there must be one window that it belongs to. */
static weft_status check_widths(const weft_job *job, const wf_scene *scene, weft_error *err) {
    bool own = false;
    for (int n = 0; n < scene->op_count; n++) own |= scene->ops[n].own_width;
    if (!own || wf_ratio_value(wf_setup_width(job)) <= 1) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE,
                   "%s: solids with a temporal width of their own cannot be stored for windows "
                   "longer than a field; give --temporal-width 1 or less, or use weft render",
                   job->inputs[0]);
}

static weft_status store(wf_run *run, weft_error *err) {
    const wf_scene_source *source = run->source;
    int64_t first, end;
    if (run->job->oversample) return wf_store_subframes(run, err);
    weft_status status = check_widths(run->job, &source->scene, err);
    if (!status) status = wf_scene_frames(run->job, &source->scene, &first, &end, err);
    return status ? status : wf_store_samples(run, end - 1, err);
}

weft_status wf_run_trace(wf_run *run, weft_error *err) {
    run->kind = &wf_source_scene;
    weft_status status = wf_setup_output(run->job, &run->setup, err);
    if (!status) status = check_output(run->job, &run->setup, err);
    if (!status) status = run->kind->open(run, err);
    if (!status) status = run->kind->count(run, err);
    return status ? status : store(run, err);
}
