/* weft composite: what an NTSC or PAL television would show. */
#include <inttypes.h>
#include <stdio.h>

#include "convert/ask/composite.h"
#include "convert/base/fail.h"
#include "convert/job/options.h"
#include "convert/program/cmd.h"

typedef struct composite_state {
    weft_composite asked;
    const char *output, *progress;
    bool quiet;
    wf_meter meter;
} composite_state;

/* ---- Running ---- */

static void on_warning(const char *text, void *user) {
    composite_state *state = user;
    if (state->quiet) return;
    wf_meter_clear(&state->meter);
    wf_cmd_say("warning: ", text);
}

static void on_progress(const weft_progress *progress, void *user) {
    composite_state *state = user;
    weft_progress shown = *progress;
    shown.stage = "composite";
    wf_meter_update(&shown, &state->meter);
}

static weft_status show(composite_state *state, weft_job *job, weft_error *err) {
    weft_status status = wf_cmd_meter(&state->meter, state->progress, state->quiet, err);
    if (status) return status;
    weft_job_on_progress(job, on_progress, state);
    weft_job_on_warning(job, on_warning, state);
    wf_cmd_catch_signals(job);
    status = weft_job_composite(job, &state->asked, err);
    wf_cmd_ignore_signals();
    wf_meter_clear(&state->meter);
    if (status || state->quiet || !state->meter.show || state->progress) return status;
    char text[128];
    const weft_progress *last = &state->meter.last;
    snprintf(text, sizeof text, "%" PRId64 " frames in %.2f s", last->frames_done,
             last->seconds);
    wf_cmd_say("", text);
    return WEFT_OK;
}

static weft_status run(const wf_cmd *cmd, int argc, char **argv, weft_error *err) {
    composite_state state = {.asked = {.size = sizeof state.asked}};
    weft_job *job;
    weft_status status = wf_cmd_question(cmd, argc, argv, &state, &job, err);
    if (!status && state.output) status = weft_job_set_output(job, state.output, err);
    if (!status) status = show(&state, job, err);
    return wf_cmd_answer(job, false, status);
}

/* ---- What it says of itself ---- */

static const char coding[] = "Composite", writing[] = "Output and messages";

static const wf_cmd_option options[] = {
    {{"system", WF_ASK_SYSTEMS, "the raster's: 525 lines ntsc, 625 pal", "The color system.",
      coding},
     .offset = offsetof(composite_state, asked.system)},
    {{"encoder", WF_ASK_ENCODERS, "cheap",
      "cheap adds the color to luma as it is, as typical recorders do; filtered first takes "
      "the luma around the subcarrier out.",
      coding},
     .offset = offsetof(composite_state, asked.encoder)},
    {{"decoder", WF_ASK_DECODERS, "notch",
      "notch takes all around the subcarrier for color; comb2 and comb3 only what alternates "
      "with it between a line and one or two others of its field.",
      coding},
     .offset = offsetof(composite_state, asked.decoder)},
    {{"raster", "NAME", "as the file says", "What raster the input is in.", coding},
     .offset = offsetof(composite_state, asked.raster)},
    {{"output", "OUTPUT", NULL,
      "Where to write: .y4m, .v210, .uyvy, a container, or a sequence such as out.####.png "
      "(tif, "
      "dpx); - is Y4M on standard output.",
      writing},
     .letter = 'o',
     .offset = offsetof(composite_state, output)},
    {{"audio", "none|copy|FILE[:OFFSET]|silent:N|tone:N", "the input's",
      "Sound in .mov, .mp4, .mxf and .mkv: the input's, none, that of a file, or N tracks of "
      "silence or "
      "of a tone.",
      writing},
     .offset = offsetof(composite_state, asked.audio)},
    {WF_CMD_PROGRESS(writing), .offset = offsetof(composite_state, progress)},
    {{"quiet", NULL, NULL, "Say nothing but errors.", writing},
     .letter = 'q',
     .offset = offsetof(composite_state, quiet)},
};

const wf_cmd wf_cmd_composite = {
    .name = "composite",
    .operands = "IN -o OUTPUT",
    .summary = "what an NTSC or PAL television would show",
    .text =
        "Takes finished video through a composite coder and a television's decoder, as every\n"
        "analog broadcast and tape did. Fine luma near the color subcarrier comes back as\n"
        "false color (cross-color), edges of color as crawling dots (cross-luma).\n"
        "\n"
        "IN is Y4M, .v210, .uyvy, a container, a picture, a sequence in quotes, or - for Y4M "
        "on\n"
        "standard input. Its time code and sound are kept where OUTPUT holds them. A cheap\n"
        "recorder and an old set:\n"
        "\n"
        "  weft composite shot.y4m -o seen.y4m\n"
        "\n"
        "A careful studio and a good set:\n"
        "\n"
        "  weft composite shot.y4m --encoder filtered --decoder comb3 -o seen.y4m\n"
        "\n"
        "To look at it at once:\n"
        "\n"
        "  weft render carousel.lua -o - | weft composite - -o - | mpv -\n",
    .notes =
        "Composite video has 525 or 625 lines: rasters 525i, 525i-imx, 525i-dv, 525i-rp202,\n"
        "625i and 625i-dv. The subcarrier runs through all lines of the signal, frame 0 being\n"
        "color frame A (NTSC) or fields 1 and 2 of eight (PAL), so that false colors shimmer "
        "as\n"
        "they do on a set. U and V are 1.5 dB down at 1.3 MHz, and done at 2.4 MHz.\n",
    .options = options,
    .option_count = sizeof options / sizeof *options,
    .taken_by = WF_TAKEN_BY_COMPOSITE,
    .run = run,
};
