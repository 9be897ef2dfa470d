/* weft page: one page that shows the fields of video, to look at in a browser. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/base/fail.h"
#include "convert/base/range.h"
#include "convert/base/values.h"
#include "convert/job/job.h"
#include "convert/page/page.h"
#include "convert/page/preview.h"
#include "convert/program/cmd.h"

typedef struct page_state {
    const char *output, *raster_name, *frames, *title, *progress, *max_size, *max_memory;
    const char *preview, *preview_frame;
    wf_cmd_list labels;
    bool overwrite, quiet;
    wf_meter meter;
    wf_raster raster;
    wf_page_clip clip[WF_PAGE_MOST_CLIPS];
} page_state;

static void on_warning(const char *text, void *user) {
    page_state *state = user;
    if (state->quiet) return;
    wf_meter_clear(&state->meter);
    wf_cmd_say("warning: ", text);
}

/* ---- What is asked ---- */

static weft_status read_size(const char *option, const char *text, size_t *to,
                             weft_error *err) {
    if (!text || wf_parse_size(text, to)) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE,
                   "--%s: '%.200s' will not do; it takes a size, such as 20M or 1G", option,
                   text);
}

/* One run of whole numbers from 0 on. */
static weft_status read_frames(const char *text, wf_page_request *r, weft_error *err) {
    wf_frame_range range = {0};
    if (!text) return WEFT_OK;
    weft_status status = wf_range_parse(text, WF_RANGE_MOST, &range, err);
    const wf_range_run *run = range.run;
    if (!status && (range.runs != 1 || run->den != 1 || run->step > 1 || run->first < 0))
        status = wf_fail(err, WEFT_USAGE,
                         "--frames: '%.200s' will not do; a page shows one run of frames, "
                         "numbered from 0, such as 0-59",
                         text);
    if (!status) r->first = run->first, r->count = run->count;
    wf_range_free(&range);
    return status;
}

static weft_status read_raster(page_state *s, wf_page_request *r, weft_error *err) {
    char why[512];
    if (!s->raster_name) return WEFT_OK;
    r->raster = &s->raster;
    if (wf_raster_parse(s->raster_name, &s->raster, why, sizeof why)) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE, "%s", why);
}

static weft_status read_clips(page_state *s, int clips, char **paths, wf_page_request *r,
                              weft_error *err) {
    if (!clips)
        return wf_fail(err, WEFT_USAGE,
                       "nothing to show; give finished video, such as shot.y4m");
    if (clips > WF_PAGE_MOST_CLIPS)
        return wf_fail(err, WEFT_USAGE, "%d clips are given, and a page shows at most %d",
                       clips, WF_PAGE_MOST_CLIPS);
    if (s->labels.count > (size_t)clips)
        return wf_fail(err, WEFT_USAGE, "--label is given %zu times, and there are %d clips",
                       s->labels.count, clips);
    if (!s->output && !s->preview)
        return wf_fail(err, WEFT_USAGE, "where to is not said; give -o look.html");
    if (s->preview && clips > 1)
        return wf_fail(err, WEFT_USAGE, "--preview is of one clip, and %d are given", clips);
    for (size_t i = 0; i < (size_t)clips; i++)
        s->clip[i] = (wf_page_clip){.path = paths[i],
                                    .label = i < s->labels.count ? s->labels.value[i] : NULL};
    r->clip = s->clip;
    r->clips = (size_t)clips;
    return WEFT_OK;
}

static weft_status read_state(page_state *s, int clips, char **paths, wf_page_request *r,
                              weft_error *err) {
    *r = (wf_page_request){.title = s->title,
                           .max_bytes = WF_PAGE_MOST_BYTES,
                           .max_memory_bytes = (size_t)2 << 30,
                           .overwrite = s->overwrite,
                           .progress = wf_meter_update,
                           .progress_user = &s->meter,
                           .warning = on_warning,
                           .warning_user = s};
    weft_status status = read_clips(s, clips, paths, r, err);
    if (!status) status = wf_cmd_meter(&s->meter, s->progress, s->quiet, err);
    if (!status) status = read_raster(s, r, err);
    if (!status) status = read_frames(s->frames, r, err);
    if (!status) status = read_size("max-size", s->max_size, &r->max_bytes, err);
    return status ? status : read_size("max-memory", s->max_memory, &r->max_memory_bytes, err);
}

/* ---- Running ---- */

static weft_status preview(const page_state *s, const wf_page_request *r, weft_error *err) {
    wf_preview_request preview = {.video = s->clip[0].path,
                                  .raster = r->raster,
                                  .frame = -1,
                                  .max_memory_bytes = r->max_memory_bytes,
                                  .overwrite = s->overwrite};
    weft_status status = wf_preview_read_frame(s->preview_frame, &preview.frame, err);
    return status ? status : wf_preview_write(&preview, s->preview, err);
}

/* Signals cancel a job, which has nothing else to do here. */
static weft_status make_page(page_state *s, wf_page_request *r, weft_error *err) {
    weft_job *job = weft_job_new();
    if (!job) return wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    r->cancelled = &job->cancelled;
    wf_cmd_catch_signals(job);
    weft_status status = wf_page_make(r, s->output, err);
    wf_cmd_ignore_signals();
    wf_meter_clear(&s->meter);
    weft_job_free(job);
    return status;
}

static weft_status run(const wf_cmd *cmd, int argc, char **argv, weft_error *err) {
    page_state state = {0};
    wf_page_request request;
    int clips = 0;
    weft_status status = wf_cmd_parse(cmd, argc, argv, &state, NULL, &clips, err);
    if (!status) status = read_state(&state, clips, argv, &request, err);
    if (!status && state.preview) status = preview(&state, &request, err);
    return !status && state.output ? make_page(&state, &request, err) : status;
}

/* ---- What it says of itself ---- */

static const char showing[] = "What is shown", writing[] = "Output and messages";

#define STATE(member) offsetof(page_state, member)

static const wf_cmd_option options[] = {
    {{"raster", "NAME", NULL,
      "What the clips are, where they do not say so (raw v210 and uyvy) or say it wrong.",
      showing},
     .offset = STATE(raster_name)},
    {{"frames", "A-B", "all", "Which frames to show and to measure, from 0.", showing},
     .offset = STATE(frames)},
    {{"label", "TEXT", "the file's name",
      "What to call a clip; may be repeated, in the order of the clips.", showing},
     .offset = STATE(labels),
     .repeats = true},
    {{"title", "TEXT", "the labels", "What to call the page.", showing},
     .offset = STATE(title)},
    {{"output", "FILE", NULL, "Where to write: a file that ends in .html.", writing},
     .letter = 'o',
     .offset = STATE(output)},
    {{"preview", "FILE.png", NULL,
      "Also, or instead, make a picture of one frame of a clip, with square pixels and no "
      "comb.",
      writing},
     .offset = STATE(preview)},
    {{"preview-frame", "N", "the middle one", "Which frame of the clip that is, from 0.",
      writing},
     .offset = STATE(preview_frame)},
    {{"max-size", "SIZE", "100M", "How large the page may be at most.", writing},
     .offset = STATE(max_size)},
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
