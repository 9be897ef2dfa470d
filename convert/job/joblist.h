/* Job files that hold several jobs. */
#ifndef WF_CONVERT_JOB_JOBLIST_H
#define WF_CONVERT_JOB_JOBLIST_H

#include "convert/job/jobfile.h"

/* Finds the jobs of a file that is an array of job objects, or an object that has such an array
 * as "jobs" beside what all of them share. *jobs is an array of *count texts that borrow from
 * `text` (free()), each of which wf_jobfile_apply takes; NULL and 0 of a file that is one job.
 * WEFT_USAGE, with file, line and column, where a job is no object or there is none, and where
 * the file is not JSON. */
weft_status wf_joblist_find(const wf_jobfile_text *text, wf_jobfile_text **jobs, size_t *count,
                            weft_error *err);

/* Whether what all jobs of a list share stands in the file too: it is an object. */
bool wf_joblist_shares(const wf_jobfile_text *text);

#endif
