#include <inttypes.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <unistd.h>

#include "convert/base/fail.h"
#include "convert/base/outfile.h"
#include "convert/job/job.h"
#include "convert/job/jobfile.h"
#include "convert/program/cmd.h"

typedef struct job_state {
    const char *output, *progress, *report;
    bool quiet;
    wf_cmd_list jobs, kept; /* job files, and values that they gave */
    wf_meter meter;
} job_state;

/* ---- Signals ---- */

/* What the handler needs; written before it is installed. */
static weft_job *running_job;
static volatile sig_atomic_t caught;

int wf_cmd_signal(void) {
    return caught;
}

/* How long a job may take to stop: it cannot see that it should while a reader that sleeps
 * keeps it waiting. */
static const struct itimerval patience = {.it_value = {.tv_sec = 1, .tv_usec = 700000}};

static void give_up(int number) {
    (void)number;
    _exit(128 + caught);
}

/* The first signal asks the job to stop; a second one of any kind ends the program at once. */
static void on_signal(int number) {
    caught = number;
    signal(SIGINT, SIG_DFL);
    signal(SIGTERM, SIG_DFL);
    signal(SIGHUP, SIG_DFL);
    weft_job_cancel(running_job);
    setitimer(ITIMER_REAL, &patience, NULL);
}

/* SIGHUP that nohup has ignored stays ignored. SIGINT does not, which shells ignore in whatever
 * a script starts with '&': a job can be asked to stop whoever started it. */
void wf_cmd_catch_signals(weft_job *job) {
    const struct sigaction action = {.sa_handler = on_signal, .sa_flags = SA_RESTART};
    struct sigaction old;
    running_job = job;
    signal(SIGALRM, give_up);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    if (!sigaction(SIGHUP, NULL, &old) && old.sa_handler != SIG_IGN)
        sigaction(SIGHUP, &action, NULL);
}

void wf_cmd_ignore_signals(void) {
    signal(SIGINT, SIG_IGN);
    signal(SIGTERM, SIG_IGN);
    signal(SIGHUP, SIG_IGN);
    signal(SIGALRM, SIG_IGN);
}

/* ---- The command ---- */

static void on_warning(const char *text, void *user) {
    job_state *state = user;
    if (state->quiet) return;
    wf_meter_clear(&state->meter);
    wf_cmd_say("warning: ", text);
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

/* Job files come before all other options, wherever they stand: a trial tells which there are.
 */
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
    if (!strcmp(json, "{}")) return WEFT_OK; /* the run did not get far enough to have one */
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

static weft_status run_job(job_state *state, weft_job *job, weft_error *err) {
    weft_job_on_progress(job, wf_meter_update, &state->meter);
    weft_job_on_warning(job, on_warning, state);
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

static weft_status run(const wf_cmd *cmd, int argc, char **argv, weft_error *err) {
    job_state state = {0};
    weft_job *job = weft_job_new();
    if (!job) return wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    weft_status status = weft_job_set_command(job, cmd->name, err);
    if (!status) status = fill_job(cmd, argc, argv, &state, job, err);
    if (!status) status = run_job(&state, job, err);
    weft_job_free(job);
    wf_cmd_forget(&state.kept);
    return status;
}

static const char output[] = "Output and messages";

static const wf_cmd_option options[] = {
    {{"output", "OUTPUT", NULL,
      "Where to write: .y4m, .v210, .uyvy, .mov, .mxf, .mkv, or a sequence such as "
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
};

#define OPTIONS .options = options, .option_count = sizeof options / sizeof *options

static const char notes[] =
    "Options and inputs may stand in any order; of an option given twice the last counts;\n"
    "-- ends the options. Numbers may be ratios: 1/3, 30000/1001.\n"
    "\n"
    "Exit codes: 0 done; 1 failed; 2 the request makes no sense; 3 done, but frames were\n"
    "held or samples mended; 128 + n on signal n. On failure nothing unfinished is left.\n";

/* ---- weft convert ---- */

#define OUTPUT_SIDE                                                                            \
    "raster", "aperture", "temporal-width", "shutter-angle", "shutter-position", "scan-skew",  \
        "timecode", "ocio", "from", "to", "display", "view", "look", "bits", "range",          \
        "chroma", "legalize", "dither", "codec", "audio"
#define FIELDS  "cadence", "fields"
#define RUNNING "chunk", "threads", "skip", "max-memory", "overwrite", "resume", "dry-run"
#define SCENE   "samples", "sampler", "seed", "set", "scene-steps", "scene-memory"

static const char *const convert_takes[] = {
    OUTPUT_SIDE,     FIELDS,          "fit",      "input-par", "background",
    "subframe-rate", "subframe-time", "frames",   "layer",     "part",
    "on-missing",    "fix-nan",       "on-empty", RUNNING,     NULL};

const wf_cmd wf_cmd_convert = {
    .name = "convert",
    .operands = "INPUT... -o OUTPUT",
    .summary = "subframes or samples to interlaced video",
    .text =
        "Turns pictures rendered many times a field into broadcast video. Every field sees\n"
        "the subframes of its own time through an aperture, in linear light.\n"
        "\n"
        "INPUT is a sequence (shot.####.exr, shot.%04d.exr, subframes as shot.#.#.exr), a\n"
        "directory, or files in order. Eight subframes a field of 525-line video:\n"
        "\n"
        "  weft convert shot.####.exr --subframe-rate 480000/1001 -o shot.y4m\n"
        "\n"
        "The same as 1080i at 25 frames a second, 400 subframes a second, in 10-bit DPX:\n"
        "\n"
        "  weft convert shot.####.exr --subframe-rate 400 --raster 1080i50 -o out.####.dpx\n"
        "\n"
        "To look at it while it is being made:\n"
        "\n"
        "  weft convert shot.####.exr --subframe-rate 480000/1001 -o - | mpv -\n"
        "\n"
        "Deep EXR files with channels sample.x, sample.y and sample.t are sample buffers, one "
        "a\n"
        "frame, as 'weft trace' and other renderers write them.\n",
    .notes = notes,
    OPTIONS,
    .job_options = convert_takes,
    .run = run,
};

/* ---- weft render ---- */

static const char *const render_takes[] = {OUTPUT_SIDE, FIELDS,  "frames", SCENE,
                                           "error",     RUNNING, NULL};

const wf_cmd wf_cmd_render = {
    .name = "render",
    .operands = "SCENE.lua -o OUTPUT",
    .summary = "a scene straight to interlaced video",
    .text =
        "Traces a scene where the apertures of its fields are, in space and in time, and "
        "writes\n"
        "video; nothing dense is stored. Scenes are Lua: examples/scenes/README.md tells how "
        "to\n"
        "write one.\n"
        "\n"
        "  weft render carousel.lua -o carousel.y4m\n"
        "\n"
        "One frame as a picture, quickly:\n"
        "\n"
        "  weft render carousel.lua --frames 0 --samples 16 -o still.#.png\n"
        "\n"
        "Through another aperture, with a shutter of 180 degrees, in 1080i:\n"
        "\n"
        "  weft render carousel.lua --aperture notch --shutter-angle 180 --raster 1080i50 \\\n"
        "      -o carousel.####.dpx\n",
    .notes = notes,
    OPTIONS,
    .job_options = render_takes,
    .run = run,
};

/* ---- weft trace ---- */

static const char *const trace_takes[] = {"raster",
                                          "aperture",
                                          "temporal-width",
                                          "shutter-angle",
                                          "shutter-position",
                                          "scan-skew",
                                          "frames",
                                          SCENE,
                                          "oversample",
                                          RUNNING,
                                          NULL};

const wf_cmd wf_cmd_trace = {
    .name = "trace",
    .operands = "SCENE.lua -o SAMPLES",
    .summary = "a scene to subframes or sample buffers",
    .text = "Traces a scene and stores what it sees, for 'weft convert' to take up.\n"
            "\n"
            "With --oversample, subframes: pictures of so many samples a pixel, a line and a "
            "field.\n"
            "\n"
            "  weft trace carousel.lua --oversample 2x2x8 -o shot.####.exr\n"
            "  weft convert shot.####.exr -o carousel.y4m\n"
            "\n"
            "Without, sample buffers: deep EXR files, one a frame, of samples drawn where the\n"
            "aperture that is given will look for them.\n"
            "\n"
            "  weft trace carousel.lua --samples 16 --aperture box -o samples.####.exr\n"
            "  weft convert samples.####.exr --aperture box -o carousel.y4m\n",
    .notes = notes,
    OPTIONS,
    .job_options = trace_takes,
    .run = run,
};
