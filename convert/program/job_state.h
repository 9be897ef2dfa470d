/* What a command that runs jobs was told beside the job itself, and how one job is run. */
#ifndef WF_CONVERT_PROGRAM_JOB_STATE_H
#define WF_CONVERT_PROGRAM_JOB_STATE_H

#include "convert/program/cmd.h"

typedef struct wf_job_state {
    const char *output, *progress, *report, *only, *compare, *preview, *preview_frame;
    bool quiet;
    bool listed;            /* others follow: a signal is still waited for when it is done */
    wf_cmd_list jobs, kept; /* job files, and values that they gave */
    wf_meter meter;
} wf_job_state;

/* The arguments of a command, and the job files that they name. */
typedef struct wf_job_arguments {
    const wf_cmd *cmd;
    int argc;
    char **argv;
    wf_cmd_jobs files;
} wf_job_arguments;

/* Fills a job and its state from the files, of a list job `index`, and then the arguments. */
weft_status wf_job_fill(const wf_job_arguments *arguments, size_t index, wf_job_state *state,
                        weft_job *job, weft_error *err);

/* Runs a job as its state says. */
weft_status wf_job_run(wf_job_state *state, weft_job *job, weft_error *err);

/* Writes a report, which is text, at path. */
weft_status wf_job_write_report(const char *path, const char *json, weft_error *err);

/* Runs the jobs of a list: one that fails does not stop the others. `seen` is what the
 * arguments say. WEFT_DEGRADED where some are done and others failed, or one was degraded.
 * (job_list.c) */
weft_status wf_job_list_run(const wf_job_arguments *arguments, const wf_job_state *seen,
                            weft_error *err);

#endif
