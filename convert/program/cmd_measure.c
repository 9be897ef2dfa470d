/* weft measure: flicker, cross-color, field order, legality and differences of video. */
#include "convert/program/measure_parts.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "convert/base/fail.h"
#include "convert/base/values.h"
#include "convert/check/heat.h"
#include "convert/plot/plot.h"
#include "convert/program/cmd.h"

#define MOST_LIMITS 32

typedef struct measure_state {
    const char *against, *chart, *display, *heatmap, *raster_name, *progress, *max_memory;
    const char *heat, *view_distance, *peak;
    wf_meter meter;
    wf_cmd_list limits;
    bool json;
    wf_raster raster;
    wf_limit limit[MOST_LIMITS];
    size_t limit_count;
    wf_measure_options options;
} measure_state;

/* ---- What is asked ---- */

static weft_status read_chart(const char *text, wf_measure_options *o, weft_error *err) {
    static const char grating[] = "grating:";
    char *end;
    if (!text) return WEFT_OK;
    o->chart = WF_CHART_ZONEPLATE;
    if (!strcmp(text, "zoneplate")) return WEFT_OK;
    o->chart = WF_CHART_GRATING;
    if (!strncmp(text, grating, sizeof grating - 1)) {
        o->grating = strtod(text + sizeof grating - 1, &end);
        if (!*end && o->grating > 0 && o->grating <= 0.5) return WEFT_OK;
    }
    return wf_fail(
        err, WEFT_USAGE,
        "--chart: '%.200s' will not do; it takes zoneplate, or grating:FY with FY in "
        "cycles a frame line, above 0 and up to 0.5",
        text);
}

static weft_status read_display(const char *text, wf_measure_options *o, weft_error *err) {
    int display = WF_DISPLAY_BOB;
    weft_status status =
        wf_cmd_choose("display", "bob|crt|bwdif|yadif|w3fdif", text, &display, err);
    o->display = (wf_display_kind)display;
    return status;
}

static weft_status read_heat(const char *text, wf_measure_options *o, weft_error *err) {
    int heat = WF_HEAT_FLICKER;
    weft_status status = wf_cmd_choose("heat", "flicker|visible|crawl", text, &heat, err);
    o->heat = (wf_heat_kind)heat;
    return status;
}

/* A number of an option, from low to high. */
static weft_status read_number(const char *option, const char *text, double low, double high,
                               const char *what, double *to, weft_error *err) {
    char *end;
    if (!text) return WEFT_OK;
    *to = strtod(text, &end);
    if (end != text && !*end && *to >= low && *to <= high) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE, "--%s: '%.200s' will not do; it takes %s, from %g to %g",
                   option, text, what, low, high);
}

/* Reads every --limit, each of which may hold several limits with commas between them. */
static weft_status read_limits(measure_state *s, weft_error *err) {
    weft_status status = WEFT_OK;
    for (size_t i = 0; i < s->limits.count && !status; i++) {
        char *rest = s->limits.value[i];
        for (char *word; !status && (word = strsep(&rest, ","));) {
            if (s->limit_count == MOST_LIMITS)
                return wf_fail(err, WEFT_USAGE, "--limit: more than %d of them", MOST_LIMITS);
            status = wf_limit_parse(word, &s->limit[s->limit_count++], err);
        }
    }
    return status;
}

static weft_status read_raster(measure_state *s, weft_error *err) {
    char why[512];
    if (!s->raster_name) return WEFT_OK;
    s->options.raster = &s->raster;
    if (wf_raster_parse(s->raster_name, &s->raster, why, sizeof why)) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE, "%s", why);
}

static bool same_file(const char *a, const char *b) {
    struct stat x, y;
    return !stat(a, &x) && !stat(b, &y) && x.st_dev == y.st_dev && x.st_ino == y.st_ino;
}

/* Refuses names that would be two things at once, such as a heat map that replaces its input.
 */
static weft_status check_names(const measure_state *s, int files, char **paths,
                               weft_error *err) {
    if (files > 1 && s->heatmap)
        return wf_fail(err, WEFT_USAGE, "--heatmap draws one file, and %d are given", files);
    int streams = s->against && !strcmp(s->against, "-");
    for (int i = 0; i < files; i++) streams += !strcmp(paths[i], "-");
    if (streams > 1)
        return wf_fail(err, WEFT_USAGE,
                       "standard input can be read once, and - is given twice");
    bool own = s->heatmap && (same_file(s->heatmap, paths[0]) ||
                              (s->against && same_file(s->heatmap, s->against)));
    if (!own) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE,
                   "--heatmap %.300s would replace what is measured; give it another name",
                   s->heatmap);
}

static weft_status read_memory(measure_state *s, weft_error *err) {
    if (!s->max_memory || wf_parse_size(s->max_memory, &s->options.max_memory_bytes))
        return WEFT_OK;
    return wf_fail(err, WEFT_USAGE,
                   "--max-memory: '%.200s' will not do; it takes a size, such as 512M or 4G",
                   s->max_memory);
}

static weft_status read_state(measure_state *s, int files, char **paths, weft_error *err) {
    s->options = (wf_measure_options){.against = s->against,
                                      .want_heat = s->heatmap,
                                      .max_memory_bytes = (size_t)2 << 30,
                                      .progress = wf_meter_update,
                                      .progress_user = &s->meter};
    if (!files)
        return wf_fail(
            err, WEFT_USAGE,
            "nothing to measure; give a video, a pattern such as frame.####.exr, or - "
            "for Y4M on standard input");
    weft_status status = wf_cmd_meter(&s->meter, s->progress, false, err);
    if (!status) status = check_names(s, files, paths, err);
    if (!status) status = read_memory(s, err);
    if (!status) status = read_chart(s->chart, &s->options, err);
    if (!status) status = read_display(s->display, &s->options, err);
    if (!status) status = read_heat(s->heat, &s->options, err);
    if (!status)
        status = read_number("view-distance", s->view_distance, 0.25, 50,
                             "a number of picture heights", &s->options.view_heights, err);
    if (!status)
        status = read_number("peak", s->peak, 1, 10000, "a luminance in cd/m2",
                             &s->options.peak_cd_m2, err);
    if (!status) status = read_raster(s, err);
    return status ? status : read_limits(s, err);
}

/* ---- The heat map ---- */

/* What each kind of heat map is called, and the figure that its colors reach to. */
static const struct {
    const char *title;
    size_t high;
} heats[] = {{"Interline flicker", offsetof(wf_figures, flicker_p999)},
             {"Visible flicker", offsetof(wf_figures, visible_jnd_p999)},
             {"Crawl", offsetof(wf_figures, crawl_jnd_p999)}};

static void describe_heat(const measure_state *s, const wf_figures *f, char text[128]) {
    const char *format = "99.9th percentile %.3g JND; over 1 JND: %.2g %%";
    if (s->options.heat == WF_HEAT_VISIBLE)
        snprintf(text, 128, format, f->visible_jnd_p999, 100 * f->visible_share);
    else if (s->options.heat == WF_HEAT_CRAWL)
        snprintf(text, 128, format, f->crawl_jnd_p999, 100 * f->crawl_share);
    else
        snprintf(text, 128, "RMS %.4f, 99.9th percentile %.3f of white; over 2 %%: %.2g %%",
                 f->flicker_rms, f->flicker_p999, 100 * f->flicker_share);
}

static weft_status draw_heat(const measure_state *s, const wf_figures *f, weft_error *err) {
    char subtitle[128];
    double high;
    describe_heat(s, f, subtitle);
    memcpy(&high, (const char *)f + heats[s->options.heat].high, sizeof high);
    const wf_plot_map map = {.title = heats[s->options.heat].title,
                             .subtitle = subtitle,
                             .value = f->heat,
                             .width_px = f->info.width_px,
                             .lines = f->info.lines,
                             .pixel_aspect = wf_ratio_value(f->info.raster.pixel_aspect),
                             .high = wf_heat_top(high)};
    return wf_cmd_draw("wf_plot_heat", &map, s->heatmap, err);
}

/* ---- Measuring ---- */

/* Says of every limit that is exceeded by how much it is. */
static weft_status check_limits(const measure_state *s, const char *path, const wf_figures *f) {
    weft_status worst = WEFT_OK;
    for (size_t i = 0; i < s->limit_count; i++) {
        weft_error exceeded = {""};
        weft_status status = wf_limit_check(&s->limit[i], path, f, &exceeded);
        if (!status) continue;
        fflush(stdout);
        wf_cmd_say("", exceeded.text);
        worst = status;
    }
    return worst;
}

/* Measures a file and says what is wrong with it, so that the others can still be measured. */
static weft_status measure_one(measure_state *s, const char *path, wf_json *json) {
    wf_figures figures;
    weft_error trouble = {""};
    weft_status status = wf_measure(path, &s->options, &figures, &trouble);
    wf_meter_clear(&s->meter);
    if (!status && s->heatmap) status = draw_heat(s, &figures, &trouble);
    if (json)
        wf_measure_json(json, path, &figures, status ? trouble.text : NULL);
    else if (!status)
        wf_measure_print(path, &s->options, &figures);
    free(figures.heat);
    if (!status) return check_limits(s, path, &figures);
    fflush(stdout);
    wf_cmd_say("", trouble.text);
    return status;
}

static weft_status measure_all(measure_state *s, int count, char **paths, weft_error *err) {
    wf_json json = {0};
    weft_status worst = WEFT_OK;
    if (s->json && count > 1) wf_json_open(&json, NULL, '[');
    for (int i = 0; i < count; i++) {
        weft_status status = measure_one(s, paths[i], s->json ? &json : NULL);
        if (status > worst) worst = status;
    }
    weft_status printed = s->json ? wf_cmd_print_json(wf_json_finish(&json), err) : WEFT_OK;
    return worst ? worst : printed;
}

static weft_status run(const wf_cmd *cmd, int argc, char **argv, weft_error *err) {
    measure_state state = {0};
    int count = 0;
    weft_status status = wf_cmd_parse(cmd, argc, argv, &state, NULL, &count, err);
    if (!status) status = read_state(&state, count, argv, err);
    return status ? status : measure_all(&state, count, argv, err);
}

static const char group[] = "Options";

#define STATE(member) offsetof(measure_state, member)

static const wf_cmd_option options[] = {
    {{"raster", "NAME", NULL,
      "What the video is, where it does not say so (raw v210 and uyvy) or says it wrong.",
      group},
     .offset = STATE(raster_name)},
    {{"chart", "zoneplate|grating:FY", NULL,
      "What is known to be on the picture: with it, the vertical response at 0.25 (FY) cycles "
      "a "
      "line is measured.",
      group},
     .offset = STATE(chart)},
    {{"display", "bob|crt|bwdif|yadif|w3fdif", "bob",
      "What shows the fields: bob stretches each over the frame, crt draws it on its own lines "
      "while the other fades, the others are FFmpeg's deinterlacers, with a picture a field.",
      group},
     .offset = STATE(display)},
    {{"view-distance", "N", "6, of more than 608 lines 3",
      "How far the eye is, in heights of the picture, for what is seen of flicker and crawl.",
      group},
     .offset = STATE(view_distance)},
    {{"peak", "CD", "100, of PQ and HLG 203",
      "The luminance of white on the display, in cd/m2, for the same.", group},
     .offset = STATE(peak)},
    {{"against", "REF", NULL,
      "Also the differences from this video, by plane and field; with a display that "
      "deinterlaces, of its pictures from progressive video with a frame for each field.",
      group},
     .offset = STATE(against)},
    {{"limit", "KEY=V", NULL,
      "Exit with 1 if a figure exceeds V (sharpness, psnr and ssim: falls short of it; "
      "order.verdict: is another). May be repeated, or given several with commas.",
      group},
     .offset = STATE(limits),
     .repeats = true},
    {{"heatmap", "FILE", NULL, "Draw where it flickers into a PNG file.", group},
     .offset = STATE(heatmap)},
    {{"heat", "flicker|visible|crawl", "flicker",
      "What --heatmap draws: light that differs, or what is seen of flicker or of crawl.",
      group},
     .offset = STATE(heat)},
    {WF_CMD_PROGRESS(group), .offset = STATE(progress)},
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
