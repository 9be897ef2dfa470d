/* Loads the job files that --job names: options of the job, and options that the command has of
 * its own. */
#include <stdlib.h>
#include <string.h>

#include "convert/base/fail.h"
#include "convert/job/jobfile.h"
#include "convert/program/cmd.h"

typedef struct loading {
    const wf_cmd *cmd;
    void *state;
    weft_job *job;
    wf_cmd_list *kept;
} loading;

/* The index of a job's option in the table of weft_option_at. */
static size_t row_of(const char *name) {
    weft_option option;
    size_t i = 0;
    while (weft_option_at(i, &option) && strcmp(option.name, name)) i++;
    return i;
}

static bool option_at(void *user, size_t i, weft_option *out, bool *repeats) {
    const loading *l = user;
    char letter;
    if (!wf_cmd_option_at(l->cmd, i, out, &letter)) return false;
    *repeats = i < l->cmd->option_count ? l->cmd->options[i].repeats
                                        : wf_option_repeats(row_of(out->name));
    return true;
}

static weft_status keep(wf_cmd_list *kept, const char *value, char **copy, weft_error *err) {
    if (kept->count == WF_CMD_MOST_VALUES)
        return wf_fail(err, WEFT_USAGE, "job files give more than %d options of this command",
                       WF_CMD_MOST_VALUES);
    *copy = strdup(value);
    if (!*copy) return wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    kept->value[kept->count++] = *copy;
    return WEFT_OK;
}

static weft_status set(void *user, const char *name, const char *value, bool on,
                       weft_error *err) {
    const loading *l = user;
    const wf_cmd_option *own = l->cmd->options, *end = own + l->cmd->option_count;
    while (own < end && strcmp(own->shown.name, name)) own++;
    if (own < end && value)
        return keep(l->kept, value, (char **)(void *)((char *)l->state + own->offset), err);
    if (own < end) {
        *(bool *)((char *)l->state + own->offset) = on;
        return WEFT_OK;
    }
    if (on) return weft_job_set(l->job, name, value, err);
    wf_job_clear_flag(l->job, name);
    return WEFT_OK;
}

weft_status wf_cmd_load(const wf_cmd *cmd, const wf_cmd_list *files, void *state, weft_job *job,
                        wf_cmd_list *kept, weft_error *err) {
    loading l = {cmd, state, job, kept};
    const wf_jobfile_taker taker = {&l, option_at, set, true};
    weft_status status = WEFT_OK;
    for (size_t i = 0; i < files->count && !status; i++)
        status = wf_jobfile_load(job, files->value[i], &taker, err);
    return status;
}

void wf_cmd_forget(wf_cmd_list *kept) {
    for (size_t i = 0; i < kept->count; i++) free(kept->value[i]);
    kept->count = 0;
}
