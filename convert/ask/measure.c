/* Measuring the files of a job: what is asked, their figures, limits on them, a heat map. */
#include "convert/ask/measure.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/ask/asking.h"
#include "convert/ask/draw.h"
#include "convert/ask/measure_limit.h"
#include "convert/base/names.h"
#include "convert/base/outfile.h"
#include "convert/check/heat.h"
#include "convert/plot/plot.h"

#define MOST_LIMITS  32
#define MOST_THREADS 16 /* more would wait for memory, and each takes some */

typedef struct asking {
    weft_job *job;
    weft_measure asked;
    const wf_measure_tell *tell; /* NULL: nobody is told */
    wf_raster raster;
    char *limits; /* the limits' verdicts point into it */
    wf_limit limit[MOST_LIMITS];
    size_t limit_count;
    wf_measure_options options;
    wf_troubles troubles;
} asking;

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

/* Reads the limits, which have commas between them. */
static weft_status read_limits(asking *a, weft_error *err) {
    weft_status status = WEFT_OK;
    if (!a->asked.limit) return WEFT_OK;
    char *rest = a->limits = strdup(a->asked.limit);
    if (!rest) return wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    for (char *word; !status && (word = strsep(&rest, ","));) {
        if (a->limit_count == MOST_LIMITS)
            return wf_fail(err, WEFT_USAGE, "--limit: more than %d of them", MOST_LIMITS);
        status = wf_limit_parse(word, &a->limit[a->limit_count++], err);
    }
    return status;
}

/* Refuses names that would be two things at once, such as a heat map that replaces its input.
 */
static weft_status check_names(const weft_job *job, const weft_measure *asked,
                               weft_error *err) {
    const char *heatmap = asked->heatmap, *against = asked->against;
    if (job->input_count > 1 && heatmap)
        return wf_fail(err, WEFT_USAGE, "--heatmap draws one file, and %zu are given",
                       job->input_count);
    int streams = against && !strcmp(against, "-");
    for (size_t i = 0; i < job->input_count; i++) streams += !strcmp(job->inputs[i], "-");
    if (streams > 1)
        return wf_fail(err, WEFT_USAGE,
                       "standard input can be read once, and - is given twice");
    bool own = heatmap && (wf_name_replaces(heatmap, job->inputs[0]) ||
                           (against && wf_name_replaces(heatmap, against)));
    if (!own) return heatmap ? wf_outfile_check(heatmap, true, err) : WEFT_OK;
    return wf_fail(err, WEFT_USAGE,
                   "--heatmap %.300s would replace what is measured; give it another name",
                   heatmap);
}

static weft_status read_words(const weft_measure *asked, wf_measure_options *o,
                              weft_error *err) {
    int display = WF_DISPLAY_BOB, heat = WF_HEAT_FLICKER;
    weft_status status = read_chart(asked->chart, o, err);
    if (!status)
        status = wf_ask_choose("display", WF_ASK_DISPLAYS, asked->display, &display, err);
    if (!status) status = wf_ask_choose("heat", WF_ASK_HEATS, asked->heat, &heat, err);
    o->display = (wf_display_kind)display;
    o->heat = (wf_heat_kind)heat;
    if (!status)
        status = read_number("view-distance", asked->view_distance, 0.25, 50,
                             "a number of picture heights", &o->view_heights, err);
    if (!status)
        status = read_number("peak", asked->peak, 1, 10000, "a luminance in cd/m2",
                             &o->peak_cd_m2, err);
    return status;
}

static weft_status read_asked(asking *a, weft_error *err) {
    weft_job *job = a->job;
    a->options = (wf_measure_options){.against = a->asked.against,
                                      .raster = a->asked.raster ? &a->raster : NULL,
                                      .want_heat = a->asked.heatmap,
                                      .max_memory_bytes = job->max_memory_bytes,
                                      .progress = job->progress,
                                      .progress_user = job->progress_user,
                                      .canceled = &job->canceled};
    weft_status status = wf_ask_inputs(
        job,
        "nothing to measure; give a video, a pattern such as frame.####.exr, or - "
        "for Y4M on standard input",
        err);
    if (!status) status = check_names(job, &a->asked, err);
    if (!status) status = read_words(&a->asked, &a->options, err);
    if (!status) status = wf_ask_raster(a->asked.raster, &a->raster, err);
    return status ? status : read_limits(a, err);
}

/* ---- The heat map ---- */

/* What each kind of heat map is called, and the figure that its colors reach to. */
static const struct {
    const char *title;
    size_t high;
} heats[] = {{"Interline flicker", offsetof(wf_figures, flicker_p999)},
             {"Visible flicker", offsetof(wf_figures, visible_jnd_p999)},
             {"Crawl", offsetof(wf_figures, crawl_jnd_p999)}};

static void describe_heat(wf_heat_kind heat, const wf_figures *f, char text[128]) {
    const char *format = "99.9th percentile %.3g JND; over 1 JND: %.2g %%";
    if (heat == WF_HEAT_VISIBLE)
        snprintf(text, 128, format, f->visible_jnd_p999, 100 * f->visible_share);
    else if (heat == WF_HEAT_CRAWL)
        snprintf(text, 128, format, f->crawl_jnd_p999, 100 * f->crawl_share);
    else
        snprintf(text, 128, "RMS %.4f, 99.9th percentile %.3f of white; over 2 %%: %.2g %%",
                 f->flicker_rms, f->flicker_p999, 100 * f->flicker_share);
}

static weft_status draw_heat(const asking *a, const wf_figures *f, weft_error *err) {
    char subtitle[128];
    double high;
    describe_heat(a->options.heat, f, subtitle);
    memcpy(&high, (const char *)f + heats[a->options.heat].high, sizeof high);
    const wf_plot_map map = {.title = heats[a->options.heat].title,
                             .subtitle = subtitle,
                             .value = f->heat,
                             .width_px = f->info.width_px,
                             .lines = f->info.lines,
                             .pixel_aspect = wf_ratio_value(f->info.raster.pixel_aspect),
                             .high = wf_heat_top(high)};
    return wf_draw("wf_plot_heat", &map, a->asked.heatmap, err);
}

/* ---- Measuring ---- */

/* Says of every limit that is exceeded by how much it is. */
static void check_limits(asking *a, const char *path, const wf_figures *f) {
    for (size_t i = 0; i < a->limit_count; i++) {
        weft_error exceeded = {""};
        weft_status status = wf_limit_check(&a->limit[i], path, f, &exceeded);
        if (status) wf_trouble(&a->troubles, status, exceeded.text);
    }
}

/* Measures a file and says what is wrong with it, so that the others can still be measured. */
static weft_status measure_one(asking *a, const char *path, wf_json *json) {
    wf_figures figures;
    weft_error trouble = {""};
    weft_status status = wf_measure(path, &a->options, &figures, &trouble);
    if (!status && a->asked.heatmap) status = draw_heat(a, &figures, &trouble);
    wf_measure_json(json, path, &figures, status ? trouble.text : NULL);
    if (!status && a->tell) a->tell->figures(a->tell->user, path, &a->options, &figures);
    free(figures.heat);
    if (status)
        wf_trouble(&a->troubles, status, trouble.text);
    else
        check_limits(a, path, &figures);
    return status;
}

static weft_status measure_all(asking *a, weft_error *err) {
    wf_json json = {0};
    const weft_job *job = a->job;
    wf_crew crew;
    weft_status status = wf_crew_new(a->job, 0, &crew, err);
    if (status) return status;
    if (crew.threads > MOST_THREADS) crew.threads = MOST_THREADS;
    a->options.crew = &crew;
    if (job->input_count > 1) wf_json_open(&json, NULL, '[');
    for (size_t i = 0; i < job->input_count && status != WEFT_INTERRUPTED; i++)
        status = measure_one(a, job->inputs[i], &json);
    wf_crew_free(&crew);
    weft_status told = wf_ask_report(a->job, &json, err);
    status = wf_troubles_end(&a->troubles, err);
    return status ? status : told;
}

weft_status wf_ask_measure(weft_job *job, const weft_measure *asked,
                           const wf_measure_tell *tell, weft_error *err) {
    asking a = {.job = job, .tell = tell};
    if (tell) a.troubles = (wf_troubles){.tell = tell->trouble, .user = tell->user};
    weft_status status = wf_asked(asked, "weft_measure", &a.asked, sizeof a.asked, err);
    if (!status) status = read_asked(&a, err);
    if (!status) status = measure_all(&a, err);
    free(a.limits);
    return status;
}

weft_status weft_job_measure(weft_job *job, const weft_measure *asked, weft_error *err) {
    return wf_ask_measure(job, asked, NULL, err);
}
