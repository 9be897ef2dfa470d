#ifndef WF_CONVERT_RUN_DRY_RUN_PARTS_H
#define WF_CONVERT_RUN_DRY_RUN_PARTS_H

#include <limits.h>

#include "convert/run/dry_run.h"

/* What foresee.c sees and foresee_tell.c tells. */
typedef struct wf_seen_field {
    int64_t index;
    double from_s, to_s; /* its window of time */
    wf_window window;    /* of subframes */
    int64_t missing;     /* of them */
} wf_seen_field;

struct wf_foreseen {
    wf_seen_field *fields;
    size_t field_count;
    int64_t frames;
    bool reads; /* subframes: */
    int64_t opened, files, read_bytes;
    int64_t samples; /* of a scene; < 0: not known */
    int64_t outputs, present;
    char first_output[PATH_MAX], last_output[PATH_MAX];
    wf_sink_size size;
    size_t memory_bytes; /* 0: not known */
    int threads;         /* 0: not known */
    const char *kind;    /* of output */
};

/* For people, into job->plan; and for the report. */
weft_status wf_foreseen_text(const wf_foreseen *foreseen, weft_job *job, weft_error *err);
void wf_foreseen_json(wf_json *json, const void *foreseen);

#endif
