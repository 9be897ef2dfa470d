/* What the files of a job are, for reports and for people. */
#ifndef WF_CONVERT_ASK_INFO_H
#define WF_CONVERT_ASK_INFO_H

#include "convert/job/job.h"

/* Who takes facts as lines of text, instead of the report. */
typedef struct wf_info_tell {
    void *user;
    void (*file)(void *user, const char *path); /* whose lines follow */
    void (*line)(void *user, const char *key, const char *value);
} wf_info_tell;

/* weft_job_info. tell NULL: the report is filled. trouble: told of files that cannot be read,
 * as they come; NULL: err has the first. */
weft_status wf_ask_info(weft_job *job, const wf_info_tell *tell, weft_warning_fn *trouble,
                        void *user, weft_error *err);

#endif
