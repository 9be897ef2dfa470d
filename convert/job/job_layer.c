/* Layers of options: what a later one says wins over an earlier one. */
#include "convert/job/job_layer.h"

#include <stdlib.h>

void wf_job_layer_begin(weft_job *job, wf_job_layer *layer) {
    *layer = (wf_job_layer){job->to,     job->display,     job->view,       job->overwrite,
                            job->resume, job->width_given, job->angle_given};
    job->to = job->display = job->view = NULL;
    job->overwrite = job->resume = job->width_given = job->angle_given = false;
}

/* Puts back what was there before the layer, unless the layer says something itself or
 * excludes it. */
static void restore(char **now, char *before, bool excluded) {
    if (*now || excluded)
        free(before);
    else
        *now = before;
}

void wf_job_layer_end(weft_job *job, wf_job_layer *layer) {
    bool space = job->to, display = job->display || job->view;
    restore(&job->to, layer->to, display);
    restore(&job->display, layer->display, space);
    restore(&job->view, layer->view, space);
    if (!job->overwrite && !job->resume) {
        job->overwrite = layer->overwrite;
        job->resume = layer->resume;
    }
    if (!job->width_given && !job->angle_given) {
        job->width_given = layer->width_given;
        job->angle_given = layer->angle_given;
    }
    *layer = (wf_job_layer){0};
}
