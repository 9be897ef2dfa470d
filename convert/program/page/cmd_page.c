/* weft page: one page that shows the fields of video, to look at in a browser. */
#include <stdlib.h>

#include "convert/program/cmd.h"

typedef struct page_state {
    weft_page asked;
    const char *output, *progress, *max_memory;
    wf_cmd_list labels;
    bool overwrite, quiet;
    wf_meter meter;
} page_state;

static void on_warning(const char *text, void *user) {
    page_state *state = user;
    if (state->quiet) return;
    wf_meter_clear(&state->meter);
    wf_cmd_say("warning: ", text);
}

/* What the options say that are the job's own. */
static weft_status set_job(const page_state *s, weft_job *job, weft_error *err) {
    weft_status status = WEFT_OK;
    if (s->output) status = weft_job_set_output(job, s->output, err);
    if (!status && s->overwrite) status = weft_job_set(job, "overwrite", NULL, err);
    if (!status && s->max_memory) status = weft_job_set(job, "max-memory", s->max_memory, err);
    return status;
}

static weft_status make_page(page_state *s, weft_job *job, weft_error *err) {
    char *labels;
    weft_status status = wf_cmd_meter(&s->meter, s->progress, s->quiet, err);
    if (!status) status = set_job(s, job, err);
    if (!status) status = wf_cmd_join(&s->labels, '\n', &labels, err);
    if (status) return status;
    s->asked.labels = labels;
    weft_job_on_progress(job, wf_meter_update, &s->meter);
    weft_job_on_warning(job, on_warning, s);
    wf_cmd_catch_signals(job);
    status = weft_job_page(job, &s->asked, err);
    wf_cmd_ignore_signals();
    wf_meter_clear(&s->meter);
    free(labels);
    return status;
}

static weft_status run(const wf_cmd *cmd, int argc, char **argv, weft_error *err) {
    page_state state = {.asked = {.size = sizeof state.asked}};
    weft_job *job;
    weft_status status = wf_cmd_question(cmd, argc, argv, &state, &job, err);
    if (!status) status = make_page(&state, job, err);
    return wf_cmd_answer(job, false, status);
}

/* ---- What it says of itself ---- */

static const char showing[] = "What is shown", writing[] = "Output and messages";

#define STATE(member) offsetof(page_state, member)

static const wf_cmd_option options[] = {
    {{"raster", "NAME", NULL,
      "What the clips are, where they do not say so (raw v210 and uyvy) or say it wrong.",
      showing},
     .offset = STATE(asked.raster)},
    {{"frames", "A-B", "all", "Which frames to show and to measure, from 0.", showing},
     .offset = STATE(asked.frames)},
    {{"label", "TEXT", "the file's name",
      "What to call a clip; may be repeated, in the order of the clips.", showing},
     .offset = STATE(labels),
     .repeats = true},
    {{"title", "TEXT", "the labels", "What to call the page.", showing},
     .offset = STATE(asked.title)},
    {{"output", "FILE", NULL, "Where to write: a file that ends in .html.", writing},
     .letter = 'o',
     .offset = STATE(output)},
    {{"preview", "FILE.png", NULL,
      "Also, or instead, make a picture of one frame of a clip, with square pixels and no "
      "comb.",
      writing},
     .offset = STATE(asked.preview)},
    {{"preview-frame", "N", "the middle one", "Which frame of the clip that is, from 0.",
      writing},
     .offset = STATE(asked.preview_frame)},
    {{"max-size", "SIZE", "100M", "How large the page may be at most.", writing},
     .offset = STATE(asked.max_size)},
    {{"max-memory", "SIZE", "2G", "How much memory a frame in hand may take.", writing},
     .offset = STATE(max_memory)},
    {{"overwrite", NULL, NULL, "Replace a page that exists.", writing},
     .offset = STATE(overwrite)},
    {WF_CMD_PROGRESS(writing), .offset = STATE(progress)},
    {{"quiet", NULL, NULL, "Say nothing but errors.", writing},
     .letter = 'q',
     .offset = STATE(quiet)},
};

const wf_cmd wf_cmd_page = {
    .name = "page",
    .operands = "FILE... -o look.html",
    .summary = "fields to look at in a browser",
    .text =
        "Makes one page of HTML that shows finished interlaced video field by field, at its "
        "rate,\n"
        "as a tube, bob or weave would, up to 16 clips of one size and rate side by side or as "
        "a\n"
        "wipe, with what 'weft measure' finds in them and where they flicker. It needs no\n"
        "network, and nothing but itself.\n"
        "\n"
        "  weft page shot.mxf -o look.html\n"
        "  weft page box.y4m shaped.y4m --label box --label shaped -o look.html\n"
        "  weft page long.mov --frames 100-159 -o look.html\n"
        "\n"
        "Fields are kept without loss in 8 bits. Two seconds of 525 lines take about 6 MB; "
        "the\n"
        "page says what is guessed and what is left out.\n",
    .options = options,
    .option_count = sizeof options / sizeof *options,
    .run = run,
};
