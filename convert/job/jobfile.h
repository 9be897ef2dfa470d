#ifndef WF_CONVERT_JOB_JOBFILE_H
#define WF_CONVERT_JOB_JOBFILE_H

#include "convert/job/job.h"
#include "convert/job/job_layer.h"
#include "convert/job/options.h"

/* Job files: one JSON object (RFC 8259) that says what the command line says. Keys are the
 * names of options, and "inputs" (a string or an array), "output" and "command". */

/* Who takes the options of a job file, instead of weft_job_set: a command, which has options of
 * its own beside the job's. */
typedef struct wf_jobfile_taker {
    void *user;
    /* Option i, and whether it may be given several times; false past the end. */
    bool (*option_at)(void *user, size_t i, weft_option *out, bool *repeats);
    /* Value NULL: a flag; on tells whether it is raised. Values are borrowed for the call. */
    weft_status (*set)(void *user, const char *name, const char *value, bool on,
                       weft_error *err);
    bool keep_command; /* "command" must name the job's own */
} wf_jobfile_taker;

/* Reads path ("-": standard input) and has everything in it set; a fault is WEFT_USAGE with
 * file, line and column (characters from 1). Paths in it are relative to the file's folder. At
 * most WF_JOBFILE_BYTES. What it says wins over what the job held before. */
#define WF_JOBFILE_BYTES ((size_t)1 << 20)
weft_status wf_jobfile_load(weft_job *job, const char *path, const wf_jobfile_taker *taker,
                            weft_error *err);

/* The same from text; path names it in messages and says where it lies. */
typedef struct wf_jobfile_text {
    const char *path, *bytes;
    size_t size;
} wf_jobfile_text;
weft_status wf_jobfile_apply(weft_job *job, const wf_jobfile_text *text,
                             const wf_jobfile_taker *taker, weft_error *err);

#endif
