/* The table of sources. */
#include "convert/run/source.h"

/* The last takes whatever is left. */
static const wf_source_kind *const kinds[] = {
    &wf_source_scene,
    &wf_source_video, /* before those that look into a file, which a pipe allows once only */
    &wf_source_samples,
    &wf_source_subframes,
};

const wf_source_kind *wf_source_for(const weft_job *job) {
    size_t n = 0, last = sizeof kinds / sizeof *kinds - 1;
    while (n < last && !kinds[n]->takes(job)) n++;
    return kinds[n];
}
