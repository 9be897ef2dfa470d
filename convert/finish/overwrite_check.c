/* Whether an output is one of the inputs. */
#include "convert/finish/overwrite_check.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>

#include "convert/base/pattern.h"
#include "convert/job/audio.h"

/* What makes two names one file. */
typedef struct identity {
    dev_t device;
    ino_t inode;
} identity;

static bool identify(const char *path, identity *out) {
    struct stat about;
    if (stat(path, &about) || !S_ISREG(about.st_mode)) return false;
    *out = (identity){about.st_dev, about.st_ino};
    return true;
}

static int by_identity(const void *left, const void *right) {
    const identity *a = left, *b = right;
    if (a->device != b->device) return a->device < b->device ? -1 : 1;
    return (a->inode > b->inode) - (a->inode < b->inode);
}

static bool identify_sound(const weft_job *job, identity *out) {
    wf_audio audio;
    char path[4096];
    if (!wf_audio_parse(job->audio, &audio) || audio.kind != WF_AUDIO_FILE) return false;
    snprintf(path, sizeof path, "%.*s", (int)audio.path_length, job->audio);
    return identify(path, out);
}

static size_t identify_inputs(const weft_job *job, const wf_sequence *sequence,
                              identity *inputs) {
    size_t count = 0;
    for (size_t i = 0; i < job->input_count; i++)
        if (identify(job->inputs[i], &inputs[count])) count++;
    if (identify_sound(job, &inputs[count])) count++;
    for (size_t k = 0; k < sequence->count; k++)
        if (sequence->refs[k].path && identify(sequence->refs[k].path, &inputs[count])) count++;
    qsort(inputs, count, sizeof *inputs, by_identity);
    return count;
}

static weft_status check(const char *path, const identity *inputs, size_t count,
                         weft_error *err) {
    identity own;
    if (!identify(path, &own) || !bsearch(&own, inputs, count, sizeof own, by_identity))
        return WEFT_OK;
    return wf_fail(err, WEFT_USAGE,
                   "%s: the output would replace an input; write it under another name", path);
}

static weft_status check_output(const char *output, const wf_setup *s, const identity *inputs,
                                size_t count, weft_error *err) {
    if (!wf_pattern_is(output)) return check(output, inputs, count, err);
    weft_status status = WEFT_OK;
    char path[4096];
    int files = wf_output_files(&s->output_options);
    for (int64_t n = s->first_frame * files; n < s->end_frame * files && !status; n++)
        if (wf_pattern_path(output, n, path, sizeof path))
            status = check(path, inputs, count, err);
    return status;
}

weft_status wf_refuse_own_inputs(const weft_job *job, const wf_setup *s, weft_error *err) {
    if (!job->overwrite) return WEFT_OK;
    identity *inputs = malloc((s->sequence.count + job->input_count + 2) * sizeof *inputs);
    if (!inputs) return wf_fail(err, WEFT_NO_MEMORY, "no memory to list the inputs");
    size_t count = identify_inputs(job, &s->sequence, inputs);
    weft_status status = count ? check_output(job->output, s, inputs, count, err) : WEFT_OK;
    if (!status && count && job->key) status = check_output(job->key, s, inputs, count, err);
    free(inputs);
    return status;
}
