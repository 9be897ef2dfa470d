#ifndef WF_CONVERT_RUN_DRY_RUN_PARTS_H
#define WF_CONVERT_RUN_DRY_RUN_PARTS_H

#include <limits.h>

#include "convert/run/dry_run.h"

/* What dry_run.c finds and dry_run_tell.c tells. */
typedef struct wf_dry_field {
    int64_t index;
    double from_s, to_s; /* its window of time */
    wf_needs needs;      /* subframes */
    int64_t missing;     /* of them */
} wf_dry_field;

/* Of an output: its kind (NULL: there is none), its files, those that are there already. */
typedef struct wf_dry_output {
    const char *kind;
    int64_t files, present;
    char first[PATH_MAX], last[PATH_MAX];
    wf_sink_size size;
} wf_dry_output;

struct wf_dry_run {
    wf_dry_field *fields; /* NULL: it makes subframes */
    size_t field_count;
    int64_t frames;
    const wf_taken_list *taken;
    bool reads; /* files, which are known: */
    int64_t opened, files, read_bytes;
    size_t memory_bytes;
    int threads;
    int64_t samples; /* to be traced; < 0: not known */
    wf_dry_output output, key;
};

/* For people, into job->plan; and for the report. */
weft_status wf_dry_run_text(const wf_dry_run *dry_run, weft_job *job, weft_error *err);
void wf_dry_run_json(wf_json *json, const void *dry_run);

#endif
