/* The public face of plans. */
#include <stdlib.h>

#include "convert/plan/plan.h"

weft_status weft_job_plan(weft_job *job, const char *format, const char **text,
                          weft_error *err) {
    wf_plan plan = {.asked = job};
    char *told = NULL;
    if (!format) format = "text";
    weft_status status = wf_plan_check_format(job, format, err);
    if (!status) status = wf_plan_make(job, &plan, err);
    if (!status) status = wf_plan_tell(&plan, format, &told, err);
    wf_plan_free(&plan);
    free(job->asked);
    job->asked = told;
    *text = told;
    return status;
}
