/* weft measure: flicker, cross-color, field order, legality and differences of video. */
#include <stdio.h>
#include <stdlib.h>

#include "convert/ask/measure.h"
#include "convert/program/cmd.h"
#include "convert/program/measure_print.h"

typedef struct measure_state {
    weft_measure asked;
    const char *progress, *max_memory, *threads;
    wf_meter meter;
    wf_cmd_list limits;
    bool json;
} measure_state;

static void print_figures(void *user, const char *path, const wf_measure_options *options,
                          const wf_figures *figures) {
    measure_state *s = user;
    wf_meter_clear(&s->meter);
    if (!s->json) wf_measure_print(path, options, figures);
}

/* Takes the line of progress away first. */
static void say_trouble(const char *text, void *user) {
    measure_state *s = user;
    wf_meter_clear(&s->meter);
    wf_cmd_trouble(text, NULL);
}

static weft_status measure(measure_state *s, weft_job *job, weft_error *err) {
    const wf_measure_tell tell = {s, print_figures, say_trouble};
    char *limits;
    weft_status status = wf_cmd_meter(&s->meter, s->progress, false, err);
    if (!status && s->max_memory) status = weft_job_set(job, "max-memory", s->max_memory, err);
    if (!status && s->threads) status = weft_job_set(job, "threads", s->threads, err);
    if (!status) status = wf_cmd_join(&s->limits, ',', &limits, err);
    if (status) return status;
    s->asked.limit = limits;
    weft_job_on_progress(job, wf_meter_update, &s->meter);
    status = wf_ask_measure(job, &s->asked, &tell, err);
    free(limits);
    return status;
}

static weft_status run(const wf_cmd *cmd, int argc, char **argv, weft_error *err) {
    measure_state state = {.asked = {.size = sizeof state.asked}};
    weft_job *job;
    weft_status status = wf_cmd_question(cmd, argc, argv, &state, &job, err);
    if (!status) status = measure(&state, job, err);
    return wf_cmd_answer(job, state.json, status);
}

static const char group[] = "Options";

#define STATE(member) offsetof(measure_state, member)

static const wf_cmd_option options[] = {
    {{"raster", "NAME", NULL,
      "What the video is, where it does not say so (raw v210 and uyvy) or says it wrong.",
      group},
     .offset = STATE(asked.raster)},
    {{"chart", "zoneplate|grating:FY", NULL,
      "What is known to be on the picture: with it, the vertical response at 0.25 (FY) cycles "
      "a "
      "line is measured.",
      group},
     .offset = STATE(asked.chart)},
    {{"display", WF_ASK_DISPLAYS, "bob",
      "What shows the fields: bob stretches each over the frame, crt draws it on its own lines "
      "while the other fades, the others are FFmpeg's deinterlacers, with a picture a field.",
      group},
     .offset = STATE(asked.display)},
    {{"view-distance", "N", "6, of more than 608 lines 3",
      "How far the eye is, in heights of the picture, for what is seen of flicker and crawl.",
      group},
     .offset = STATE(asked.view_distance)},
    {{"peak", "CD", "100, of PQ and HLG 203",
      "The luminance of white on the display, in cd/m2, for the same.", group},
     .offset = STATE(asked.peak)},
    {{"against", "REF", NULL,
      "Also the differences from this video, by plane and field; with a display that "
      "deinterlaces, of its pictures from progressive video with a frame for each field.",
      group},
     .offset = STATE(asked.against)},
    {{"limit", "KEY=V", NULL,
      "Exit with 1 if a figure exceeds V (sharpness, psnr and ssim: falls short of it; "
      "order.verdict: is another). May be repeated, or given several with commas.",
      group},
     .offset = STATE(limits),
     .repeats = true},
    {{"heatmap", "FILE", NULL, "Draw where it flickers into a PNG file.", group},
     .offset = STATE(asked.heatmap)},
    {{"heat", WF_ASK_HEATS, "flicker",
      "What --heatmap draws: light that differs, or what is seen of flicker or of crawl.",
      group},
     .offset = STATE(asked.heat)},
    {WF_CMD_PROGRESS(group), .offset = STATE(progress)},
    {{"threads", "N", "all",
      "How many processors to use; the figures are the same for any number.", group},
     .offset = STATE(threads)},
    {{"max-memory", "SIZE", "2G", "How much memory the frames in hand may take.", group},
     .offset = STATE(max_memory)},
    {{"json", NULL, NULL, "Print JSON: an object, an array of several files.", group},
     .offset = STATE(json)},
};

const wf_cmd wf_cmd_measure = {
    .name = "measure",
    .operands = "FILE...",
    .summary = "flicker, cross-color, field order, legality, differences",
    .text =
        "Measures what interlace does to video: Y4M, raw v210 and uyvy, sequences of pictures\n"
        "(frame.####.dpx), linear EXR, and whatever else libav reads.\n"
        "\n"
        "  weft measure shot.y4m\n"
        "  weft measure shot.mov --limit flicker.rms=0.05 --limit order.verdict=tff\n"
        "  weft measure plate.####.exr --chart zoneplate --heatmap flicker.png\n"
        "  weft measure coded.mov --against shot.y4m --json\n",
    .notes =
        "Figures, light being that of the raster's display and white 1:\n"
        "  flicker.rms .p999 .share  half the difference of a frame's two fields, each shown "
        "as\n"
        "                            the display does, where the content stands still\n"
        "  flicker.visible.jnd_p999 .share  what is seen of it at the display's frame rate, "
        "in\n"
        "                            just noticeable differences (JND), and where it is over "
        "1\n"
        "  crawl.rms .p999 .jnd_p999 .share  what comes and goes at edges that drift by half "
        "a\n"
        "                            line a field, in light, and as the eye that follows sees "
        "it\n"
        "  sharpness                 vertical response, of charts\n"
        "  cross_color.rms .p999     color that cheap composite coding makes of luma\n"
        "  cross_luma.rms .p999      luma that it makes of color (525 and 625 lines only)\n"
        "  order.verdict .ratio      tff, bff, progressive, psf, telecined, still or open, "
        "from\n"
        "                            pixels: open where regions of the picture disagree\n"
        "  order.agreement           share of those regions that see that order\n"
        "  legal.range_share         share of the picture outside narrow range,\n"
        "  legal.r103_share          and outside EBU R103\n"
        "  difference.rmse .psnr .ssim  from --against, of the largest code\n"
        "Content stands still where fields of one parity agree within 1 % from frame to frame; "
        "a\n"
        "single frame is taken for a still. Shares are from 0 to 1 in JSON and as limits. "
        "Order\n"
        "needs two frames, telecined six; a ratio beyond 0.8 .. 1.25 is clear, nearer to 1 it "
        "is\n"
        "told only if every pair of frames leans that way. Raw video is 525i without "
        "--raster.\n",
    .options = options,
    .option_count = sizeof options / sizeof *options,
    .run = run,
};
