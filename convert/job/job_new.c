/* Jobs are made with the presets of their options, and freed with what the options own. */
#include <stdlib.h>

#include "convert/job/job.h"
#include "convert/job/options.h"

weft_job *weft_job_new(void) {
    weft_job *job = calloc(1, sizeof *job);
    if (job && wf_job_preset(job, NULL)) {
        weft_job_free(job);
        return NULL;
    }
    if (job) wf_job_settle(job);
    return job;
}

void weft_job_free(weft_job *job) {
    if (!job) return;
    wf_job_release_options(job);
    wf_job_clear_inputs(job);
    free(job->inputs);
    free(job->output);
    free(job->report);
    free(job->plan);
    free(job->asked);
    free(job);
}
