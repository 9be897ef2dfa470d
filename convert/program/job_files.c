/* Loads the job files that --job names: options of the job, and options that the command has of
 * its own. */
#include <stdlib.h>
#include <string.h>

#include "convert/base/fail.h"
#include "convert/program/cmd.h"

typedef struct loading {
    const wf_cmd *cmd;
    void *state;
    weft_job *job;
    wf_cmd_list *kept;
    bool listed; /* it is a job of a list */
} loading;

/* Options of the command that are of the whole list. */
static bool is_of_list(const char *name) {
    static const char *const names[] = {"report", "progress", "quiet", "only"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (!strcmp(names[i], name)) return true;
    return false;
}

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
    if (own < end && l->listed && is_of_list(name))
        return wf_fail(
            err, WEFT_USAGE,
            "\"%s\" is of the whole list, and not of one of its jobs; give it beside "
            "\"jobs\", or on the command line",
            name);
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

weft_status wf_cmd_load(const wf_cmd *cmd, const wf_cmd_jobs *jobs, size_t index, void *state,
                        weft_job *job, wf_cmd_list *kept, weft_error *err) {
    loading l = {cmd, state, job, kept, false};
    const wf_jobfile_taker taker = {&l, option_at, set, true, jobs->count > 0};
    const wf_jobfile_taker own = {&l, option_at, set, true, false};
    weft_status status = WEFT_OK;
    for (size_t i = 0; i < jobs->files && !status; i++) {
        bool list = jobs->count && i == jobs->list;
        l.listed = false;
        if (!list || wf_joblist_shares(&jobs->file[i]))
            status = wf_jobfile_apply(job, &jobs->file[i], &taker, err);
        l.listed = true;
        if (!status && list) status = wf_jobfile_apply(job, &jobs->job[index], &own, err);
    }
    return status;
}

/* Reads the next file. There can be one list. */
static weft_status read_file(const char *path, wf_cmd_jobs *jobs, weft_error *err) {
    wf_jobfile_text *found;
    size_t count;
    weft_status status = wf_jobfile_read(path, &jobs->file[jobs->files], err);
    if (status) return status;
    const wf_jobfile_text *file = &jobs->file[jobs->files++];
    status = wf_joblist_find(file, &found, &count, err);
    if (status || !count) return status;
    if (jobs->count) {
        free(found);
        return wf_fail(err, WEFT_USAGE,
                       "%.300s and %.300s are both lists of jobs; give one list at a time",
                       jobs->file[jobs->list].path, file->path);
    }
    jobs->job = found;
    jobs->count = count;
    jobs->list = jobs->files - 1;
    return WEFT_OK;
}

weft_status wf_cmd_read_jobs(const wf_cmd_list *files, wf_cmd_jobs *jobs, weft_error *err) {
    weft_status status = WEFT_OK;
    for (size_t i = 0; i < files->count && !status; i++)
        status = read_file(files->value[i], jobs, err);
    return status;
}

void wf_cmd_free_jobs(wf_cmd_jobs *jobs) {
    for (size_t i = 0; i < jobs->files; i++) wf_jobfile_free(&jobs->file[i]);
    free(jobs->job);
    *jobs = (wf_cmd_jobs){.files = 0};
}

void wf_cmd_forget(wf_cmd_list *kept) {
    for (size_t i = 0; i < kept->count; i++) free(kept->value[i]);
    kept->count = 0;
}
