#ifndef WF_CONVERT_JOB_OPTIONS_H
#define WF_CONVERT_JOB_OPTIONS_H

#include "convert/job/job.h"

/* The options of a job by their index, which is weft_option_at's. */

/* The commands that take an option. */
enum {
    WF_TAKEN_BY_CONVERT = 1,
    WF_TAKEN_BY_RENDER = 2,
    WF_TAKEN_BY_TRACE = 4,
    WF_TAKEN_BY_COMPOSITE = 8,
    WF_TAKEN_BY_FILTERS = 16,
    WF_TAKEN_BY_PLAN = 32
};

/* WF_TAKEN_BY_ bits of the commands that take the option; 0 past the end. */
unsigned wf_option_commands(size_t index);

/* Whether the option may be given several times. */
bool wf_option_repeats(size_t index);

/* Gives a zeroed job what the presets of its options say. */
weft_status wf_job_preset(weft_job *job, weft_error *err);

/* Lowers a flag of weft_job_set's again. */
void wf_job_clear_flag(weft_job *job, const char *name);

/* Frees what the options have stored; the job is then good for nothing but being freed. */
void wf_job_release_options(weft_job *job);

#endif
