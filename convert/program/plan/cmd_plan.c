/* weft plan: what a renderer has to make for the frames that are wanted. */
#include <stdio.h>

#include "convert/base/fail.h"
#include "convert/job/options.h"
#include "convert/plan/plan.h"
#include "convert/program/cmd.h"

typedef struct plan_state {
    const char *format;
    bool quiet;
} plan_state;

static void on_warning(const char *text, void *user) {
    const plan_state *state = user;
    if (!state->quiet) wf_cmd_say("warning: ", text);
}

static weft_status refuse_operand(const char *operand, weft_error *err) {
    return wf_fail(err, WEFT_USAGE,
                   "%.200s: a plan needs no input, it is made before there is any; of what is "
                   "rendered already --refine DIR tells what is still wanted",
                   operand);
}

static weft_status print_plan(weft_job *job, plan_state *state, weft_error *err) {
    const char *text;
    weft_job_on_warning(job, on_warning, state);
    wf_cmd_catch_signals(job);
    weft_status status = weft_job_plan(job, state->format, &text, err);
    wf_cmd_ignore_signals();
    if (!status) fputs(text, stdout);
    return status;
}

static weft_status run(const wf_cmd *cmd, int argc, char **argv, weft_error *err) {
    plan_state state = {.format = "text"};
    int operands = 0;
    weft_job *job = weft_job_new();
    if (!job) return wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    weft_status status = wf_cmd_parse(cmd, argc, argv, &state, job, &operands, err);
    if (!status && operands) status = refuse_operand(argv[0], err);
    if (!status) status = print_plan(job, &state, err);
    weft_job_free(job);
    return status;
}

static const char group[] = "Output and messages";

static const wf_cmd_option options[] = {
    {{"format", WF_PLAN_FORMATS, "text",
      "As what: for people, as data, a script for Blender or Houdini, an INI file for POV-Ray.",
      group},
     .offset = offsetof(plan_state, format)},
    {{"quiet", NULL, NULL, "Say nothing but errors.", group},
     .letter = 'q',
     .offset = offsetof(plan_state, quiet)},
};

const wf_cmd wf_cmd_plan = {
    .name = "plan",
    .operands = "--frames A-B --subframe-rate R",
    .summary = "which subframes to render",
    .text =
        "Tells what a renderer has to make for frames A to B of the output: the subframes "
        "that\n"
        "some field sees, their times, their size and the shape of their pixels. With a "
        "width of\n"
        "half a field that is half of all, and the video is the same to the bit.\n"
        "\n"
        "  weft plan --raster 1080i50 --frames 0-99 --subframe-rate 400\n"
        "  weft plan --raster 1080i50 --frames 0-99 --subframe-rate 400 --format blender "
        ">plan.py\n"
        "  blender -b shot.blend -P plan.py -- subframes\n"
        "  weft convert subframes --frames 0-1599 --subframe-rate 400 --raster 1080i50 -o "
        "shot.mxf\n"
        "\n"
        "With --refine only what moves is rendered more than once a field: an empty folder "
        "wants\n"
        "a first pass, and of what is there a plan tells the times and rectangles that are "
        "still\n"
        "wanted, until none are. A file of a rectangle says so by weft:region\n"
        "(examples/stamp_exr.py).\n"
        "\n"
        "  weft plan --raster 1080i50 --frames 0-99 --subframe-rate 400 --refine subframes \\\n"
        "      --error 0.005 --format json\n"
        "\n"
        "Subframes are numbered from 0: number k is the moment k/R of the scene. --frames "
        "0-1599 of\n"
        "convert says so, since files that are not needed are not there.\n",
    .options = options,
    .option_count = sizeof options / sizeof *options,
    .taken_by = WF_TAKEN_BY_PLAN,
    .run = run,
};
