/* Job files of arbitrary bytes: a refusal says why, and names the file. */
#include <stdlib.h>
#include <string.h>

#include "convert/job/joblist.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static bool option_at(void *user, size_t i, weft_option *out, bool *repeats) {
    (void)user;
    *repeats = wf_option_repeats(i);
    return weft_option_at(i, out);
}

static weft_status set(void *user, const char *name, const char *value, bool on,
                       weft_error *err) {
    if (on) return weft_job_set(user, name, value, err);
    wf_job_clear_flag(user, name);
    return WEFT_OK;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    weft_error err = {""};
    weft_job *job = weft_job_new();
    if (!job) abort();
    const wf_jobfile_taker taker = {job, option_at, set, false, true};
    const wf_jobfile_text text = {
        .path = "some/job.json", .bytes = (const char *)data, .size = size};
    wf_jobfile_text *jobs;
    size_t count;
    (void)wf_joblist_find(&text, &jobs, &count, &err);
    for (size_t i = 0; i < count; i++) (void)wf_jobfile_apply(job, &jobs[i], &taker, &err);
    free(jobs);
    err.text[0] = '\0';
    weft_status status = wf_jobfile_apply(job, &text, &taker, &err);
    if (status == WEFT_USAGE && strncmp(err.text, "some/job.json:", 14)) abort();
    if (!status && *err.text) abort();
    if (status != WEFT_OK && status != WEFT_USAGE) abort();
    weft_job_free(job);
    return 0;
}
