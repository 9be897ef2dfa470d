/* A scene as a source: a file of the scene language, traced where fields look. */
#include "convert/run/source/source_scene.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/base/range.h"
#include "convert/read/picture.h"
#include "convert/run/sum/gathering.h"
#include "tracer/scene/load.h"

static weft_status takes(const weft_job *job, bool *takes, weft_error *err) {
    (void)err;
    *takes = job->command != WF_CONVERT;
    return WEFT_OK;
}

/* ---- The scene ---- */

static weft_status split_params(const weft_job *job, wf_param *params, char **names,
                                weft_error *err) {
    for (size_t i = 0; i < job->param_count; i++) {
        names[i] = strdup(job->params[i]);
        if (!names[i]) return wf_fail(err, WEFT_NO_MEMORY, "no memory for --set");
        char *equals = strchr(names[i], '=');
        *equals = '\0';
        params[i] = (wf_param){names[i], equals + 1};
    }
    return WEFT_OK;
}

static void print(void *user, const char *line) {
    const weft_job *job = user;
    if (job->print) job->print(line, job->print_user);
}

static void warn(void *user, const char *text) {
    wf_job_warn(user, "%s", text);
}

static weft_status load(weft_job *job, const wf_param *params, wf_scene *scene,
                        weft_error *err) {
    const wf_raster *r = &job->raster;
    char why[1000];
    const wf_load_options options = {
        .steps = job->scene_steps,
        .memory_bytes = job->scene_memory_bytes,
        .params = params,
        .param_count = job->param_count,
        .width_px = r->width_px,
        .lines = r->lines,
        .pixel_aspect = wf_ratio_value(r->pixel_aspect),
        .frame_rate = wf_ratio_value(r->frame_rate),
        .field_rate = 1 / wf_ratio_value(wf_raster_field_period(r)),
        .load_image = wf_picture_load,
        .print = print,
        .warn = warn,
        .tell_user = job,
    };
    if (wf_scene_load(job->inputs[0], &options, scene, why, sizeof why)) return WEFT_OK;
    return wf_fail(err, WEFT_FAILED, "%s", why);
}

static weft_status load_with_params(weft_job *job, wf_scene *scene, weft_error *err) {
    size_t count = job->param_count + 1;
    wf_param *params = calloc(count, sizeof *params);
    char **names = calloc(count, sizeof *names);
    weft_status status = params && names ? split_params(job, params, names, err)
                                         : wf_fail(err, WEFT_NO_MEMORY, "no memory for --set");
    if (!status) status = load(job, params, scene, err);
    for (size_t i = 0; names && i < job->param_count; i++) free(names[i]);
    free(names);
    free(params);
    return status;
}

static weft_status open_input(wf_run *run, weft_error *err) {
    wf_scene_source *s = run->source = calloc(1, sizeof *s);
    if (!s) return wf_fail(err, WEFT_NO_MEMORY, "no memory for the scene");
    weft_status status = load_with_params(run->job, &s->scene, err);
    run->setup.scene_space = *s->scene.color_space ? s->scene.color_space : NULL;
    return status;
}

static void close_input(wf_run *run) {
    wf_scene_source *s = run->source;
    if (!s) return;
    for (int t = 0; s->scratch && t < run->crew.threads; t++)
        wf_sampling_scratch_free(s->scratch[t]);
    free(s->scratch);
    wf_sampling_free(s->sampling);
    wf_scene_free(&s->scene);
    free(s);
    run->source = NULL;
}

/* ---- Frames ---- */

/* A scene that does not say how long it lasts is one frame. */
static int64_t frames_of(const weft_job *job, const wf_scene *scene) {
    if (!(scene->duration_s > 0)) return 1;
    wf_rational duration = wf_ratio((int64_t)round(scene->duration_s * 1e6), 1000000);
    int64_t frames = wf_ratio_floor_mul(wf_ratio_mul(duration, job->raster.frame_rate), 1);
    return frames > 0 ? frames : 1;
}

static weft_status choose_frames(const weft_job *job, int64_t *first, int64_t *end,
                                 weft_error *err) {
    wf_frame_range range;
    weft_status status = wf_range_parse(job->frames, INT32_MAX, &range, err);
    if (status) return status;
    const wf_range_run *run = range.run;
    bool whole = range.runs == 1 && run->den == 1 && run->first >= 0 &&
                 (run->step == 1 || run->count == 1);
    if (whole) {
        *first = run->first;
        *end = run->first + run->count;
    } else {
        status = wf_fail(err, WEFT_USAGE,
                         "--frames %s: frames are made one after another, from 0 on, such as "
                         "0-59",
                         job->frames);
    }
    wf_range_free(&range);
    return status;
}

weft_status wf_scene_frames(const weft_job *job, const wf_scene *scene, int64_t *first,
                            int64_t *end, weft_error *err) {
    int64_t frames = frames_of(job, scene);
    *first = 0;
    *end = frames;
    weft_status status = job->frames ? choose_frames(job, first, end, err) : WEFT_OK;
    if (!status && scene->duration_s > 0 && *end > frames)
        wf_job_warn(job,
                    "--frames %s: duration(%g) of %s makes %" PRId64
                    " frames, the last of which is %" PRId64
                    "; what moves after that goes on, and keyframes stand",
                    job->frames, scene->duration_s, job->inputs[0], frames, frames - 1);
    return status;
}

static weft_status count(wf_run *run, weft_error *err) {
    const wf_scene_source *s = run->source;
    int64_t first, end;
    weft_status status = wf_scene_frames(run->job, &s->scene, &first, &end, err);
    if (!status) wf_setup_frames(run->job, &run->setup, first, end);
    return status;
}

const char *wf_scene_space(const wf_run *run) {
    return run->setup.scene_space ? run->setup.scene_space : "lin_rec709";
}

/* ---- Samples ---- */

wf_sampling_desc wf_scene_sampling(const weft_job *job, const wf_scene *scene) {
    return (wf_sampling_desc){.scene = scene,
                              .gather = wf_setup_gather(job),
                              .sampler = job->sampler,
                              .count = (int)job->samples,
                              .seed = (uint64_t)job->seed,
                              .skip = job->skip,
                              .error =
                                  wf_ratio_given(job->error) ? wf_ratio_value(job->error) : 0};
}

static weft_status start(wf_run *run, weft_error *err) {
    wf_scene_source *s = run->source;
    wf_sampling_desc desc = wf_scene_sampling(run->job, &s->scene);
    s->sampling = wf_sampling_new(&desc);
    s->scratch = calloc((size_t)run->crew.threads, sizeof(wf_sampling_scratch *));
    bool good = s->sampling && s->scratch;
    for (int t = 0; good && t < run->crew.threads; t++)
        good = (s->scratch[t] = wf_sampling_scratch_new(s->sampling));
    return good ? WEFT_OK : wf_fail(err, WEFT_NO_MEMORY, "no memory for the scene");
}

static wf_needs needs(const wf_run *run, int64_t field) {
    const wf_scene_source *s = run->source;
    int64_t first, last;
    wf_sampling_units(s->sampling, field, &first, &last);
    return (wf_needs){first, last + 1};
}

static weft_status turn(wf_run *run, int64_t unit, weft_error *err) {
    const wf_scene_source *s = run->source;
    return wf_sampling_look(s->sampling, s->scratch[0], unit)
               ? WEFT_OK
               : wf_fail(err, WEFT_NO_MEMORY, "no memory for the scene");
}

static weft_status band(wf_run *run, const wf_worker *worker, int first, int end,
                        const wf_receiver *receiver, weft_error *err) {
    const wf_scene_source *s = run->source;
    return wf_sampling_rows(s->sampling, s->scratch[worker->number], first, end, receiver)
               ? WEFT_OK
               : wf_fail(err, WEFT_NO_MEMORY, "no memory for rays");
}

static wf_sample_tiling tiling(const wf_run *run) {
    const wf_scene_source *s = run->source;
    return wf_sampling_tiling(s->sampling);
}

static bool still(const wf_run *run) {
    const wf_scene_source *s = run->source;
    return wf_sampling_still(s->sampling);
}

static bool whole(const wf_run *run, int64_t field, int64_t unit) {
    const wf_scene_source *s = run->source;
    return wf_sampling_whole(s->sampling, field, unit);
}

static int64_t samples_a_unit(const wf_run *run) {
    const wf_raster *r = &run->job->raster;
    return run->job->samples * r->width_px * r->lines;
}

/* ---- Report ---- */

void wf_scene_tell_traced(const wf_run *run, wf_report *report) {
    const wf_scene_source *s = run->source;
    for (int t = 0; s && s->scratch && t < run->crew.threads; t++) {
        if (!s->scratch[t]) continue;
        wf_trace_counts counts = wf_sampling_counted(s->scratch[t]);
        report->traced = true;
        report->samples += counts.samples;
        report->rays += counts.rays;
        report->tiles += counts.tiles;
        report->tiles_skipped += counts.tiles_skipped;
    }
}

/* The share of cells that may be short of samples, of which one in six or more is off by more
 * than the error asked for: 99 % of pixels are promised. */
#define UNREACHED 0.02

/* All that was looked at was proved to be background: of a run that came to its end. */
static void warn_of_nothing(const wf_run *run, const wf_report *report) {
    const wf_scene_source *s = run->source;
    if (run->finished && report->tiles > 0 && report->tiles_skipped == report->tiles &&
        s->scene.object_count > 0)
        wf_job_warn(run->job,
                    "%s: nothing of the scene is in view; look at eye= and look_at= of its "
                    "camera, and at where things are by then",
                    run->job->inputs[0]);
}

/* An error that takes more samples than there may be is not reached, and said to be. */
static void tell_error(const wf_run *run, const wf_error_sum *all, wf_report *report) {
    double error = wf_ratio_value(run->job->error), most = UNREACHED * all->cells;
    if (!(all->cells > 0)) return;
    report->error_estimate = sqrt(all->square / all->cells);
    if (all->short_of <= most && report->error_estimate <= error) return;
    report->degraded = true;
    wf_job_warn(
        run->job,
        "%s: --error %g is not reached: %.3g %% of the picture would take more than "
        "%d samples a pixel; ask for %.2g, or see what is so bright or fine in the scene",
        run->job->inputs[0], error, 100 * all->short_of / all->cells, WF_MOST_SAMPLES,
        fmax(2 * error, 2 * report->error_estimate));
}

static void tell(const wf_run *run, wf_report *report) {
    const wf_scene_source *s = run->source;
    wf_error_sum all = {0, 0, 0};
    if (!run->sums) return;
    wf_scene_tell_traced(run, report);
    warn_of_nothing(run, report);
    report->trace_s = wf_crew_times(&run->crew).source_s;
    for (int t = 0; t < run->crew.threads; t++) {
        wf_error_sum one = wf_sampling_error(s->scratch[t]);
        all.square += one.square;
        all.cells += one.cells;
        all.short_of += one.short_of;
    }
    tell_error(run, &all, report);
}

static const wf_sample_reading reading = {
    .turn = turn,
    .band = band,
    .tiling = tiling,
    .still = still,
    .whole = whole,
};

const wf_source_kind wf_source_scene = {
    .name = "scene",
    .takes = takes,
    .open = open_input,
    .count = count,
    .start = start,
    .needs = needs,
    .summing = &wf_summing_samples,
    .samples = &reading,
    .tell = tell,
    .close = close_input,
    .samples_a_unit = samples_a_unit,
};
