/* What the files of a job are found to be, for reports and for people. */
#ifndef WF_CONVERT_ASK_VERIFY_H
#define WF_CONVERT_ASK_VERIFY_H

#include "convert/check/verify/verify.h"
#include "convert/job/job.h"

/* Who is told of files and troubles as they come, beside the report. */
typedef struct wf_verify_tell {
    void *user;
    void (*findings)(void *user, const char *path, const wf_verification *found);
    weft_warning_fn *trouble; /* NULL: err has the first */
} wf_verify_tell;

/* weft_job_verify. tell NULL: nobody is told. */
weft_status wf_ask_verify(weft_job *job, const weft_verify *asked, const wf_verify_tell *tell,
                          weft_error *err);

#endif
