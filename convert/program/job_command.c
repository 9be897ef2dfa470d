/* What convert, render and trace have in common: their options, reading job files and the
 * command line into a job, and running it. */
#include "convert/program/job_command.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/base/fail.h"
#include "convert/base/outfile.h"
#include "convert/job/job.h"
#include "convert/job/jobfile.h"
#include "convert/page/compare.h"
#include "convert/page/preview.h"

typedef struct job_state {
    const char *output, *progress, *report, *compare, *preview, *preview_frame;
    bool quiet;
    wf_cmd_list jobs, kept; /* job files, and values that they gave */
    wf_meter meter;
} job_state;

static void on_warning(const char *text, void *user) {
    job_state *state = user;
    if (state->quiet) return;
    wf_meter_clear(&state->meter);
    wf_cmd_say("warning: ", text);
}

static void on_print(const char *line, void *user) {
    job_state *state = user;
    wf_meter_clear(&state->meter);
    fprintf(stderr, "%s\n", line);
}

static weft_status check_state(job_state *state, weft_error *err) {
    weft_status status = wf_cmd_meter(&state->meter, state->progress, state->quiet, err);
    if (status) return status;
    if (state->report && state->output && !strcmp(state->report, "-") &&
        !strcmp(state->output, "-"))
        return wf_fail(err, WEFT_USAGE,
                       "--report and the output cannot both be standard output");
    return WEFT_OK;
}

/* Loads the job files before all other options, wherever they stand. A first reading of the
 * arguments into a job that is thrown away tells which there are. */
static weft_status load_jobs(const wf_cmd *cmd, int argc, char **argv, job_state *state,
                             weft_job *job, weft_error *err) {
    int ignored;
    job_state seen = {0};
    weft_job *trial = weft_job_new();
    char **words = malloc(((size_t)argc + 1) * sizeof *words);
    weft_status status = WEFT_OK;
    if (!trial || !words) status = wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    if (words) memcpy(words, argv, (size_t)argc * sizeof *words);
    if (!status) status = wf_cmd_parse(cmd, argc, words, &seen, trial, &ignored, err);
    if (!status) status = wf_cmd_load(cmd, &seen.jobs, state, job, &state->kept, err);
    weft_job_free(trial);
    free(words);
    return status;
}

static weft_status fill_job(const wf_cmd *cmd, int argc, char **argv, job_state *state,
                            weft_job *job, weft_error *err) {
    int inputs = 0;
    wf_job_layer layer;
    weft_status status = load_jobs(cmd, argc, argv, state, job, err);
    if (status) return status;
    state->jobs.count = 0;
    wf_job_layer_begin(job, &layer);
    status = wf_cmd_parse(cmd, argc, argv, state, job, &inputs, err);
    wf_job_layer_end(job, &layer);
    if (!status) status = check_state(state, err);
    if (inputs) wf_job_clear_inputs(job);
    for (int i = 0; i < inputs && !status; i++) status = weft_job_add_input(job, argv[i], err);
    if (!status && state->output) status = weft_job_set_output(job, state->output, err);
    return status;
}

static weft_status write_report(const char *path, const weft_job *job, weft_error *err) {
    const char *json = weft_job_report(job);
    if (!strcmp(json, "{}"))
        return wf_fail(err, WEFT_NO_MEMORY, "%.700s: no memory for the report", path);
    wf_outfile *file;
    weft_status status = wf_outfile_open(path, true, &file, err);
    if (status) return status;
    status = wf_outfile_write(file, json, strlen(json), err);
    if (!status) return wf_outfile_commit(file, err);
    wf_outfile_abandon(file);
    return status;
}

static void say_done(const job_state *state) {
    const weft_progress *p = &state->meter.last;
    char text[128];
    snprintf(text, sizeof text, "%" PRId64 " frames in %.2f s", p->frames_done, p->seconds);
    if (!state->quiet && state->meter.show && !state->progress) wf_cmd_say("", text);
}

/* ---- Pages and previews ---- */

/* What --compare asks for, made into the page that the output names. */
static weft_status compare(job_state *state, weft_job *job, weft_error *err) {
    const wf_page_request request = {.max_bytes = WF_PAGE_MOST_BYTES,
                                     .max_memory_bytes = job->max_memory_bytes,
                                     .progress = wf_meter_update,
                                     .progress_user = &state->meter,
                                     .warning = on_warning,
                                     .warning_user = state};
    if (state->report)
        return wf_fail(err, WEFT_USAGE, "--report is of one run, and --compare makes several");
    if (state->preview)
        return wf_fail(err, WEFT_USAGE,
                       "--preview is of one video, and --compare makes several; give it to "
                       "weft page, or to a run of its own");
    weft_job_on_warning(job, on_warning, state);
    weft_job_on_print(job, on_print, state);
    wf_cmd_catch_signals(job);
    weft_status status = wf_page_compare(job, state->compare, &request, err);
    wf_cmd_ignore_signals();
    wf_meter_clear(&state->meter);
    return status;
}

static weft_status refuse_page(const char *output, weft_error *err) {
    const char *dot = output ? strrchr(output, '.') : NULL;
    if (!dot || (strcmp(dot, ".html") != 0 && strcmp(dot, ".htm") != 0)) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE,
                   "%.300s: a page is made of several apertures, --compare box,shaped, or of "
                   "finished video, 'weft page shot.y4m -o look.html'",
                   output);
}

static weft_status read_preview(const job_state *state, const weft_job *job,
                                wf_preview_request *preview, weft_error *err) {
    *preview = (wf_preview_request){.video = job->output,
                                    .raster = &job->raster,
                                    .frame = -1,
                                    .max_memory_bytes = job->max_memory_bytes,
                                    .overwrite = job->overwrite};
    if (!state->preview) return WEFT_OK;
    if (!job->output || !strcmp(job->output, "-") || job->dry_run)
        return wf_fail(
            err, WEFT_USAGE,
            "--preview looks at the video that was written: give an output that is a "
            "file, and no --dry-run");
    weft_status status = wf_preview_read_frame(state->preview_frame, &preview->frame, err);
    return status ? status : wf_preview_check_name(state->preview, job->overwrite, err);
}

static weft_status run_job(job_state *state, weft_job *job, weft_error *err) {
    weft_job_on_progress(job, wf_meter_update, &state->meter);
    weft_job_on_warning(job, on_warning, state);
    weft_job_on_print(job, on_print, state);
    wf_cmd_catch_signals(job);
    weft_status status = weft_job_run(job, err);
    wf_cmd_ignore_signals(); /* the job is about to be freed, and what is left takes no time */
    wf_meter_clear(&state->meter);
    bool finished = status == WEFT_OK || status == WEFT_DEGRADED;
    if (finished && !job->plan) say_done(state);
    if (finished && job->plan && !state->quiet &&
        (!state->report || strcmp(state->report, "-")))
        fputs(job->plan, stdout);
    if (!state->report) return status;
    weft_status written = write_report(state->report, job, finished ? err : NULL);
    return finished && written ? written : status;
}

/* Runs the job, and looks at what it has written. */
static weft_status run_and_preview(job_state *state, weft_job *job, weft_error *err) {
    wf_preview_request preview;
    weft_status status = refuse_page(job->output, err);
    if (!status) status = read_preview(state, job, &preview, err);
    if (!status) status = run_job(state, job, err);
    if (!state->preview || (status && status != WEFT_DEGRADED)) return status;
    weft_status shown = wf_preview_write(&preview, state->preview, err);
    return shown ? shown : status;
}

weft_status wf_job_command_run(const wf_cmd *cmd, int argc, char **argv, weft_error *err) {
    job_state state = {0};
    weft_job *job = weft_job_new();
    if (!job) return wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    weft_status status = weft_job_set_command(job, cmd->name, err);
    if (!status) status = fill_job(cmd, argc, argv, &state, job, err);
    if (!status && state.report) status = wf_outfile_check(state.report, true, err);
    if (!status && state.compare)
        status = compare(&state, job, err);
    else if (!status)
        status = run_and_preview(&state, job, err);
    weft_job_free(job);
    wf_cmd_forget(&state.kept);
    return status;
}

/* ---- What they say of themselves ---- */

static const char output[] = "Output and messages";

const wf_cmd_option wf_job_command_options[WF_VIDEO_COMMAND_OPTIONS] = {
    {{"output", "OUTPUT", NULL,
      "Where to write: .y4m, .v210, .uyvy, .mov, .mp4, .mxf, .mkv, or a sequence such as "
      "out.####.dpx "
      "(exr, tif, png); - is Y4M on standard output.",
      output},
     .letter = 'o',
     .offset = offsetof(job_state, output)},
    {WF_CMD_PROGRESS(output), .offset = offsetof(job_state, progress)},
    {{"quiet", NULL, NULL, "Say nothing but errors.", output},
     .letter = 'q',
     .offset = offsetof(job_state, quiet)},
    {{"report", "FILE", NULL, "Write what was done as JSON, also when it failed.", output},
     .offset = offsetof(job_state, report)},
    {{"job", "FILE", NULL,
      "Take options, inputs and output from a JSON file; - is standard input. Of several the "
      "later wins, and over all of them the command line.",
      output},
     .offset = offsetof(job_state, jobs),
     .repeats = true},
    /* Of video alone: */
    {{"compare", "A,B,..", NULL,
      "Make the video through each of these apertures, with +limit=E and +weight=MU behind "
      "them where flicker is held, and a page of all: --compare box,shaped,line+limit=.06 -o "
      "look.html.",
      output},
     .offset = offsetof(job_state, compare)},
    {{"preview", "FILE.png", NULL,
      "Also make a picture of one frame, with square pixels and no comb.", output},
     .offset = offsetof(job_state, preview)},
    {{"preview-frame", "N", "the middle one", "Which frame of the output that is, from 0.",
      output},
     .offset = offsetof(job_state, preview_frame)},
};

const char wf_job_command_notes[] =
    "Options and inputs may stand in any order; of an option given twice the last counts;\n"
    "-- ends the options. Numbers may be ratios: 1/3, 30000/1001.\n"
    "\n"
    "Exit codes: 0 done; 1 failed; 2 the request makes no sense; 3 done, but frames were\n"
    "held or samples mended; 128 + n on signal n. On failure nothing unfinished is left.\n";
