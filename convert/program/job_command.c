/* What convert, render and trace have in common: their options, reading job files and the
 * command line into a job, and running it. */
#include "convert/program/job_command.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/base/fail.h"
#include "convert/base/names.h"
#include "convert/base/outfile.h"
#include "convert/job/colors.h"
#include "convert/job/job.h"
#include "convert/page/preview.h"
#include "convert/program/job_state.h"

static void on_warning(const char *text, void *user) {
    wf_job_state *state = user;
    if (state->quiet) return;
    wf_meter_clear(&state->meter);
    wf_cmd_say("warning: ", text);
}

static void on_print(const char *line, void *user) {
    wf_job_state *state = user;
    wf_meter_clear(&state->meter);
    fprintf(stderr, "%s\n", line);
}

static weft_status check_state(wf_job_state *state, const weft_job *job, weft_error *err) {
    weft_status status = wf_cmd_meter(&state->meter, state->progress, state->quiet, err);
    if (status) return status;
    if (state->report && job->output && !strcmp(state->report, "-") &&
        !strcmp(job->output, "-"))
        return wf_fail(err, WEFT_USAGE,
                       "--report and the output cannot both be standard output");
    return WEFT_OK;
}

/* A copy of the arguments, which reading moves about; free(). */
static char **copy_arguments(const wf_job_arguments *a, weft_error *err) {
    char **words = malloc(((size_t)a->argc + 1) * sizeof *words);
    if (words)
        memcpy(words, a->argv, (size_t)a->argc * sizeof *words);
    else
        wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    return words;
}

/* Job files come before all other options, wherever they stand. A first reading of the
 * arguments into a job that is thrown away tells which there are. */
static weft_status read_jobs(wf_job_arguments *a, wf_job_state *seen, weft_error *err) {
    int operands = 0;
    weft_job *trial = weft_job_new();
    char **words = copy_arguments(a, err);
    weft_status status = WEFT_OK;
    if (!trial || !words) status = wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    if (!status) status = wf_cmd_parse(a->cmd, a->argc, words, seen, trial, &operands, err);
    if (!status) status = wf_cmd_read_jobs(&seen->jobs, &a->files, err);
    bool one = a->files.count && (operands || seen->output);
    if (!status && one)
        status =
            wf_fail(err, WEFT_USAGE,
                    "%.300s is a list of jobs, each of which has its own; leave out %.300s",
                    a->files.file[a->files.list].path, operands ? words[0] : "the output");
    if (!status && !a->files.count && seen->only)
        status = wf_fail(err, WEFT_USAGE, "--only is of a list of jobs; give one with --job");
    weft_job_free(trial);
    free(words);
    return status;
}

static weft_status read_arguments(const wf_job_arguments *a, char **words, wf_job_state *state,
                                  weft_job *job, weft_error *err) {
    int inputs = 0;
    wf_job_layer layer;
    state->jobs.count = 0;
    wf_job_layer_begin(job, &layer);
    weft_status status = wf_cmd_parse(a->cmd, a->argc, words, state, job, &inputs, err);
    wf_job_layer_end(job, &layer);
    if (inputs) wf_job_clear_inputs(job);
    for (int i = 0; i < inputs && !status; i++) status = weft_job_add_input(job, words[i], err);
    if (!status && state->output) status = weft_job_set_output(job, state->output, err);
    return status ? status : check_state(state, job, err);
}

weft_status wf_job_fill(const wf_job_arguments *a, size_t index, wf_job_state *state,
                        weft_job *job, weft_error *err) {
    weft_status status = weft_job_set_command(job, a->cmd->name, err);
    if (!status) status = wf_cmd_load(a->cmd, &a->files, index, state, job, &state->kept, err);
    if (status) return status;
    char **words = copy_arguments(a, err);
    if (!words) return WEFT_NO_MEMORY;
    status = read_arguments(a, words, state, job, err);
    free(words);
    return status;
}

weft_status wf_job_write_report(const char *path, const char *json, weft_error *err) {
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

static void say_done(const wf_job_state *state) {
    const weft_progress *p = &state->meter.last;
    char text[128];
    snprintf(text, sizeof text, "%" PRId64 " frames in %.2f s", p->frames_done, p->seconds);
    if (!state->quiet && state->meter.show && !state->progress) wf_cmd_say("", text);
}

/* ---- Pages and previews ---- */

/* What --compare asks for, made into the page that the output names. */
static weft_status compare(wf_job_state *state, weft_job *job, weft_error *err) {
    const weft_compare asked = {.size = sizeof asked, .ways = state->compare};
    if (state->report)
        return wf_fail(err, WEFT_USAGE, "--report is of one run, and --compare makes several");
    if (state->preview)
        return wf_fail(err, WEFT_USAGE,
                       "--preview is of one video, and --compare makes several; give it to "
                       "weft page, or to a run of its own");
    if (state->preview_frame)
        return wf_fail(err, WEFT_USAGE, "--preview-frame is of --preview; leave it out");
    weft_job_on_warning(job, on_warning, state);
    weft_job_on_print(job, on_print, state);
    wf_cmd_catch_signals(job);
    weft_job_on_progress(job, wf_meter_update, &state->meter);
    weft_status status = weft_job_compare(job, &asked, err);
    if (!state->listed) wf_cmd_ignore_signals();
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

/* What a preview is made of, and what it needs to stay where it is. */
typedef struct previewing {
    wf_preview_request request;
    wf_raster raster;
    wf_transfer transfer;
} previewing;

/* Outputs that leave no video to look at. */
static bool leaves_video(const char *output) {
    return output && strcmp(output, "-") != 0 && strncmp(output, "null:", 5) != 0 &&
           strncmp(output, "hash:", 5) != 0;
}

static weft_status check_preview_name(const wf_job_state *state, const weft_job *job,
                                      weft_error *err) {
    const char *others[] = {job->output, job->key, state->report};
    bool own = false;
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        own |= others[i] && wf_name_replaces(state->preview, others[i]);
    for (size_t i = 0; i < job->input_count; i++)
        own |= wf_name_replaces(state->preview, job->inputs[i]);
    if (!own) return wf_preview_check_name(state->preview, job->overwrite, err);
    return wf_fail(err, WEFT_USAGE,
                   "--preview %.300s would replace what the job reads or writes; give it "
                   "another name",
                   state->preview);
}

/* The raster is taken before the run settles it. */
static weft_status read_preview(const wf_job_state *state, const weft_job *job, previewing *p,
                                weft_error *err) {
    p->raster = wf_job_raster_shown(job);
    p->transfer = wf_color_transfer_of(job->to);
    p->request = (wf_preview_request){.video = job->output,
                                      .raster = &p->raster,
                                      .transfer = job->to ? &p->transfer : NULL,
                                      .frame = -1,
                                      .max_memory_bytes = job->max_memory_bytes,
                                      .overwrite = job->overwrite,
                                      .canceled = &job->canceled};
    weft_status status =
        wf_preview_read_frame(state->preview_frame, state->preview, &p->request.frame, err);
    if (status || !state->preview) return status;
    if (!leaves_video(job->output) || job->dry_run)
        return wf_fail(
            err, WEFT_USAGE,
            "--preview looks at the video that was written: give an output that is a "
            "file, and no --dry-run");
    return check_preview_name(state, job, err);
}

static weft_status run_job(wf_job_state *state, weft_job *job, weft_error *err) {
    weft_job_on_progress(job, wf_meter_update, &state->meter);
    weft_job_on_warning(job, on_warning, state);
    weft_job_on_print(job, on_print, state);
    weft_status status = weft_job_run(job, err);
    wf_meter_clear(&state->meter);
    bool finished = status == WEFT_OK || status == WEFT_DEGRADED;
    if (finished && !job->plan) say_done(state);
    if (finished && job->plan && !state->quiet &&
        (!state->report || strcmp(state->report, "-")))
        fputs(job->plan, stdout);
    if (!state->report) return status;
    weft_status written =
        wf_job_write_report(state->report, weft_job_report(job), finished ? err : NULL);
    return finished && written ? written : status;
}

/* Runs the job, and looks at what it has written. */
static weft_status run_and_preview(wf_job_state *state, weft_job *job, weft_error *err) {
    previewing p;
    weft_status status = refuse_page(job->output, err);
    if (!status) status = read_preview(state, job, &p, err);
    if (status) return status;
    wf_cmd_catch_signals(job);
    status = run_job(state, job, err);
    if (state->preview && (!status || status == WEFT_DEGRADED)) {
        weft_status shown = wf_preview_write(&p.request, state->preview, err);
        if (shown) status = shown;
    }
    /* Else the job is about to be freed, and what is left takes no time. */
    if (!state->listed) wf_cmd_ignore_signals();
    return status;
}

weft_status wf_job_run(wf_job_state *state, weft_job *job, weft_error *err) {
    return (state->compare ? compare : run_and_preview)(state, job, err);
}

static weft_status run_one(const wf_job_arguments *arguments, weft_error *err) {
    wf_job_state state = {0};
    weft_job *job = weft_job_new();
    if (!job) return wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    weft_status status = wf_job_fill(arguments, 0, &state, job, err);
    if (!status && state.report) status = wf_outfile_check(state.report, true, err);
    if (!status) status = wf_job_run(&state, job, err);
    weft_job_free(job);
    wf_cmd_forget(&state.kept);
    return status;
}

weft_status wf_job_command_run(const wf_cmd *cmd, int argc, char **argv, weft_error *err) {
    wf_job_arguments arguments = {.cmd = cmd, .argc = argc, .argv = argv};
    wf_job_state seen = {0};
    weft_status status = read_jobs(&arguments, &seen, err);
    if (!status && arguments.files.count)
        status = wf_job_list_run(&arguments, &seen, err);
    else if (!status)
        status = run_one(&arguments, err);
    wf_cmd_free_jobs(&arguments.files);
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
     .offset = offsetof(wf_job_state, output)},
    {WF_CMD_PROGRESS(output), .offset = offsetof(wf_job_state, progress)},
    {{"quiet", NULL, NULL, "Say nothing but errors.", output},
     .letter = 'q',
     .offset = offsetof(wf_job_state, quiet)},
    {{"report", "FILE", NULL, "Write what was done as JSON, also when it failed.", output},
     .offset = offsetof(wf_job_state, report)},
    {{"job", "FILE", NULL,
      "Take options, inputs and output from a JSON file; - is standard input. Of several the "
      "later wins, and over all of them the command line. The file may hold a list of jobs.",
      output},
     .offset = offsetof(wf_job_state, jobs),
     .repeats = true},
    {{"only", "N|A-B", "all", "Run only these jobs of a list, counted from 1.", output},
     .offset = offsetof(wf_job_state, only)},
    /* Of video alone: */
    {{"compare", "A,B,..", NULL,
      "Make the video through each of these apertures, with +limit=E and +weight=MU behind "
      "them where flicker is held, and a page of all: --compare box,shaped,line+limit=.06 -o "
      "look.html.",
      output},
     .offset = offsetof(wf_job_state, compare)},
    {{"preview", "FILE.png", NULL,
      "Also make a picture of one frame, with square pixels and no comb.", output},
     .offset = offsetof(wf_job_state, preview)},
    {{"preview-frame", "N", "the middle one", "Which frame of the output that is, from 0.",
      output},
     .offset = offsetof(wf_job_state, preview_frame)},
};

const char wf_job_command_notes[] =
    "Options and inputs may stand in any order; of an option given twice the last counts;\n"
    "-- ends the options. Numbers may be ratios: 1/3, 30000/1001.\n"
    "\n"
    "Exit codes: 0 done; 1 failed; 2 the request makes no sense; 3 done, but frames were\n"
    "held or samples mended; 128 + n on signal n. On failure nothing unfinished is left.\n"
    "\n"
    "A job file is {\"inputs\": \"shot.####.exr\", \"output\": \"shot.y4m\", \"raster\": "
    "\"625i\"}:\n"
    "keys are the names of options. A list of jobs is an array of such objects, or an object\n"
    "with them as \"jobs\" beside what all of them share. A job that fails does not stop the\n"
    "others: failures are told at the end, with exit code 3, or 1 if no job was done, and the\n"
    "same command with --resume does the rest. --report is then of all jobs.\n";
