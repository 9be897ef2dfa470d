/* The table of sources. */
#include "convert/run/sum/source.h"

/* The last takes whatever is left. */
static const wf_source_kind *const kinds[] = {
    &wf_source_scene,
    &wf_source_video, /* before those that look into a file, which a pipe allows once only */
    &wf_source_samples,
    &wf_source_subframes,
};

weft_status wf_source_for(const weft_job *job, const wf_source_kind **kind, weft_error *err) {
    bool takes = false;
    weft_status status = WEFT_OK;
    for (size_t n = 0; !status && !takes && n < sizeof kinds / sizeof *kinds; n++) {
        *kind = kinds[n];
        status = kinds[n]->takes(job, &takes, err);
    }
    return status;
}

weft_status wf_source_check(const wf_source_kind *kind, const weft_job *job, weft_error *err) {
    const char *option = job->layer ? "--layer" : job->part ? "--part" : NULL;
    if (!option || kind == &wf_source_subframes) return WEFT_OK;
    return wf_fail(
        err, WEFT_USAGE,
        "%s: %s chooses among the layers and parts of EXR subframes, and the input is "
        "%s, which has none; leave it out",
        job->inputs[0], option, kind->name);
}
