/* Runs a list of jobs, one after another: a job that fails does not stop the others, failures
 * are told at the end, and there is one report. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/base/fail.h"
#include "convert/base/json.h"
#include "convert/base/names.h"
#include "convert/base/outfile.h"
#include "convert/job/job.h"
#include "convert/program/job_state.h"

/* One job of the list. */
typedef struct listed {
    const wf_jobfile_text *text; /* where it stands */
    weft_job *job;
    wf_job_state state;
    bool chosen, ran;
    weft_status status;
    weft_error error;
} listed;

typedef struct job_list {
    const wf_job_arguments *arguments;
    listed *item;
    size_t count;
    const char *report; /* NULL: none is wanted */
    const char *only;   /* which jobs; NULL: all */
    bool quiet;
    bool stopped; /* by a signal */
} job_list;

static bool is_done(const listed *item) {
    return item->ran && (item->status == WEFT_OK || item->status == WEFT_DEGRADED);
}

/* ---- Loading ---- */

/* Which jobs are to be run: "3" or "3-7", from 1. */
static weft_status choose(job_list *list, const char *only, weft_error *err) {
    unsigned long first = 1, last = list->count;
    char *end = "";
    if (only) {
        first = last = strtoul(only, &end, 10);
        if (*end == '-') last = strtoul(end + 1, &end, 10);
    }
    bool good = !*end && (!only || (*only >= '0' && *only <= '9'));
    if (!good || first < 1 || last < first || last > list->count)
        return wf_fail(err, WEFT_USAGE,
                       "--only: '%.100s' will not do; it takes jobs of the list by their "
                       "numbers, from 1 to %zu, such as 2 or 1-%zu",
                       only, list->count, list->count);
    for (size_t i = 0; i < list->count; i++)
        list->item[i].chosen = i + 1 >= first && i + 1 <= last;
    return WEFT_OK;
}

/* Loads every job, also those that are not chosen: no two may write one output. What is wrong
 * with a job is its own. */
static weft_status load(job_list *list, weft_error *err) {
    for (size_t i = 0; i < list->count; i++) {
        listed *item = &list->item[i];
        item->text = &list->arguments->files.job[i];
        item->job = weft_job_new();
        if (!item->job) return wf_fail(err, WEFT_NO_MEMORY, "out of memory");
        item->state.listed = true;
        item->status = wf_job_fill(list->arguments, i, &item->state, item->job, &item->error);
        if (item->status == WEFT_NO_MEMORY)
            return wf_fail(err, WEFT_NO_MEMORY, "%s", item->error.text);
        if (item->state.report) list->report = item->state.report;
        if (item->state.only) list->only = item->state.only;
        item->state.report = NULL;
        list->quiet = list->quiet || item->state.quiet;
    }
    return WEFT_OK;
}

/* ---- Outputs ---- */

/* What a job writes. */
static const char *const written_words[] = {"output", "key", "preview"};
enum { WRITTEN = sizeof written_words / sizeof *written_words };

static const char *written_by(const listed *item, size_t which) {
    const char *names[WRITTEN] = {item->job->output, item->job->key, item->state.preview};
    return names[which];
}

/* Parts of one sequence have one name; a job whose output is looked at by nobody has any. */
static bool may_share(const weft_job *a, const weft_job *b) {
    bool parts = a->chunk_count > 1 && a->chunk_count == b->chunk_count && a->chunk != b->chunk;
    return parts || !a->output || !strncmp(a->output, "null:", 5);
}

static weft_status refuse_output(const listed *a, const listed *b, size_t which,
                                 weft_error *err) {
    const char *word = written_words[which];
    return wf_fail(err, WEFT_USAGE,
                   "%.300s:%d:%d: job %zu: its %s, %.300s, is that of job %zu (line %d) "
                   "too; give each job of a list an output of its own",
                   b->text->path, b->text->line + 1, b->text->column + 1, b->text->number, word,
                   written_by(b, which), a->text->number, a->text->line + 1);
}

/* Every name is held against those of earlier jobs; name[WRITTEN i + k] is number k of job i.
 */
static weft_status compare_outputs(const job_list *list, char **name, weft_error *err) {
    for (size_t n = 0; n < list->count * WRITTEN; n++) {
        const listed *later = &list->item[n / WRITTEN];
        const char *given = written_by(later, n % WRITTEN);
        if (!given) continue;
        name[n] = wf_name_place(strncmp(given, "hash:", 5) ? given : given + 5);
        if (!name[n]) return wf_fail(err, WEFT_NO_MEMORY, "out of memory");
        for (size_t m = 0; m < n / WRITTEN * WRITTEN; m++)
            if (name[m] && !strcmp(name[m], name[n]) &&
                !may_share(list->item[m / WRITTEN].job, later->job))
                return refuse_output(&list->item[m / WRITTEN], later, n % WRITTEN, err);
    }
    return WEFT_OK;
}

static weft_status check_outputs(const job_list *list, weft_error *err) {
    char **name = calloc(list->count * WRITTEN, sizeof *name);
    if (!name) return wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    weft_status status = compare_outputs(list, name, err);
    for (size_t i = 0; i < list->count * WRITTEN; i++) free(name[i]);
    free(name);
    return status;
}

/* ---- Running ---- */

static void run_item(const job_list *list, listed *item) {
    item->ran = true;
    if (item->status) return; /* it could not be loaded */
    if (item->state.meter.show && !item->state.progress && !list->quiet) {
        char text[600];
        snprintf(text, sizeof text, "job %zu of %zu: %.500s", item->text->number, list->count,
                 item->job->output ? item->job->output : "no output");
        wf_cmd_say("", text);
    }
    item->status = wf_job_run(&item->state, item->job, &item->error);
}

static void run_all(job_list *list) {
    for (size_t i = 0; i < list->count && !list->stopped; i++) {
        if (list->item[i].chosen) run_item(list, &list->item[i]);
        list->stopped = wf_cmd_signal() || list->item[i].status == WEFT_INTERRUPTED;
    }
    wf_cmd_ignore_signals();
}

/* ---- Telling ---- */

static const char *status_word(const listed *item) {
    if (!item->ran) return "left";
    static const char *const words[] = {
        [WEFT_OK] = "done",           [WEFT_FAILED] = "failed",    [WEFT_USAGE] = "refused",
        [WEFT_DEGRADED] = "degraded", [WEFT_NO_MEMORY] = "failed", [WEFT_INTERRUPTED] = "left"};
    return words[item->status];
}

static size_t count_done(const job_list *list) {
    size_t done = 0;
    for (size_t i = 0; i < list->count; i++) done += is_done(&list->item[i]);
    return done;
}

static size_t count_chosen(const job_list *list) {
    size_t chosen = 0;
    for (size_t i = 0; i < list->count; i++) chosen += list->item[i].chosen;
    return chosen;
}

static void add_item(wf_json *json, const listed *item) {
    bool failed = item->ran && !is_done(item);
    const char *report = weft_job_report(item->job);
    wf_json_open(json, NULL, '{');
    wf_json_int(json, "job", (int64_t)item->text->number);
    wf_json_text(json, "file", item->text->path);
    wf_json_int(json, "line", item->text->line + 1);
    wf_json_text(json, "output", item->job->output);
    wf_json_text(json, "status", status_word(item));
    wf_json_text(json, "error", failed ? item->error.text : NULL);
    if (strcmp(report, "{}") != 0)
        wf_json_document(json, "report", report);
    else
        wf_json_text(json, "report", NULL);
    wf_json_close(json);
}

static weft_status write_report(const job_list *list, weft_error *err) {
    wf_json json = {0};
    wf_json_open(&json, NULL, '{');
    wf_json_text(&json, "version", WEFT_VERSION);
    wf_json_text(&json, "command", list->arguments->cmd->name);
    wf_json_int(&json, "done", (int64_t)count_done(list));
    wf_json_open(&json, "jobs", '[');
    for (size_t i = 0; i < list->count; i++)
        if (list->item[i].chosen) add_item(&json, &list->item[i]);
    char *text = wf_json_finish(&json);
    if (!text) return wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    weft_status status = wf_job_write_report(list->report, text, err);
    free(text);
    return status;
}

/* What is wrong with a job that could not be loaded says where it stands already. */
static void say_failure(const listed *item) {
    char text[1400];
    bool placed = !strncmp(item->error.text, item->text->path, strlen(item->text->path));
    if (placed)
        snprintf(text, sizeof text, "%s", item->error.text);
    else
        snprintf(text, sizeof text, "%.300s:%d:%d: job %zu: %s", item->text->path,
                 item->text->line + 1, item->text->column + 1, item->text->number,
                 item->error.text);
    wf_cmd_say("", text);
}

/* Tells every failure, and how to go on. */
static weft_status conclude(const job_list *list, weft_error *err) {
    size_t done = count_done(list), chosen = count_chosen(list);
    bool degraded = false;
    for (size_t i = 0; i < list->count; i++) {
        const listed *item = &list->item[i];
        degraded = degraded || (is_done(item) && item->status == WEFT_DEGRADED);
        if (item->ran && !is_done(item) && item->status != WEFT_INTERRUPTED) say_failure(item);
    }
    if (done == chosen) return degraded ? WEFT_DEGRADED : WEFT_OK;
    char text[128];
    snprintf(text, sizeof text, "%zu of %zu jobs are done; with --resume the rest is", done,
             chosen);
    if (list->stopped) return wf_fail(err, WEFT_INTERRUPTED, "interrupted: %s", text);
    if (!done) return wf_fail(err, WEFT_FAILED, "none of %zu jobs is done", chosen);
    wf_cmd_say("", text);
    return WEFT_DEGRADED;
}

static weft_status run_list(job_list *list, weft_error *err) {
    weft_status status = load(list, err);
    if (!status) status = choose(list, list->only, err);
    if (!status) status = check_outputs(list, err);
    if (!status && list->report) status = wf_outfile_check(list->report, true, err);
    if (status) return status;
    run_all(list);
    weft_error why = {""};
    weft_status written = list->report ? write_report(list, &why) : WEFT_OK;
    status = conclude(list, err);
    if (!written || (status && status != WEFT_DEGRADED)) return status;
    return wf_fail(err, written, "%s", why.text);
}

weft_status wf_job_list_run(const wf_job_arguments *arguments, const wf_job_state *seen,
                            weft_error *err) {
    job_list list = {.arguments = arguments,
                     .count = arguments->files.count,
                     .report = seen->report,
                     .only = seen->only,
                     .quiet = seen->quiet};
    list.item = calloc(list.count, sizeof *list.item);
    if (!list.item) return wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    weft_status status = run_list(&list, err);
    for (size_t i = 0; i < list.count; i++) {
        weft_job_free(list.item[i].job);
        wf_cmd_forget(&list.item[i].state.kept);
    }
    free(list.item);
    return status;
}
