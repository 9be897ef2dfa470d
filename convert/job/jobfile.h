#ifndef WF_CONVERT_JOB_JOBFILE_H
#define WF_CONVERT_JOB_JOBFILE_H

#include <jansson.h>

#include "convert/job/job.h"
#include "convert/job/job_layer.h"
#include "convert/job/options.h"

/* Job files: one JSON object (RFC 8259) that says what the command line says. Keys are the
 * names of options, and "inputs" (a string or an array), "output" and "command". Of files with
 * several jobs convert/job/joblist.h finds each. */

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
    bool shared;       /* it takes what the jobs of a list share: "jobs" is passed over */
} wf_jobfile_taker;

/* Text of a job, or of a file of several; path names it in messages and says where it lies. */
typedef struct wf_jobfile_text {
    const char *path, *bytes;
    size_t size;
    int line, column; /* where in the file it begins, from 0 */
    size_t number;    /* of a job of a list, from 1; 0: it is the file */
} wf_jobfile_text;

/* Reads path ("-": standard input), which is borrowed, as it is; at most WF_JOBFILE_BYTES.
 * wf_jobfile_free releases the bytes. */
#define WF_JOBFILE_BYTES ((size_t)1 << 20)
weft_status wf_jobfile_read(const char *path, wf_jobfile_text *text, weft_error *err);
void wf_jobfile_free(wf_jobfile_text *text);

/* The JSON of a text (json_decref); NULL after a failure, which is WEFT_USAGE with file, line
 * and column (characters from 1). */
weft_status wf_jobfile_parse(const wf_jobfile_text *text, json_t **root, weft_error *err);

/* Has everything in a text set; a fault is WEFT_USAGE with file, line and column, and of a list
 * the number of the job. Paths in it are relative to the file's folder. What it says wins over
 * what the job held before. */
weft_status wf_jobfile_apply(weft_job *job, const wf_jobfile_text *text,
                             const wf_jobfile_taker *taker, weft_error *err);

#endif
