#include "convert/run/render.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "convert/base/range.h"
#include "convert/read/picture.h"
#include "convert/run/dry_run.h"
#include "convert/run/gathering.h"
#include "tracer/scene/load.h"

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

static weft_status load(const weft_job *job, const wf_param *params, wf_scene *scene,
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
    };
    if (wf_scene_load(job->inputs[0], &options, scene, why, sizeof why)) return WEFT_OK;
    return wf_fail(err, WEFT_FAILED, "%s", why);
}

weft_status wf_render_load(const weft_job *job, wf_scene *scene, weft_error *err) {
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

weft_status wf_render_frames(const weft_job *job, const wf_scene *scene, int64_t *first,
                             int64_t *end, weft_error *err) {
    int64_t start = 0, stop = frames_of(job, scene);
    weft_status status = job->frames ? choose_frames(job, &start, &stop, err) : WEFT_OK;
    if (status) return status;
    int64_t frames = stop - start;
    *first = start + frames * (job->chunk - 1) / job->chunk_count;
    *end = start + frames * job->chunk / job->chunk_count;
    return WEFT_OK;
}

/* ---- Samples ---- */

wf_sampling_desc wf_render_sampling(const weft_job *job, const wf_scene *scene) {
    return (wf_sampling_desc){.scene = scene,
                              .gather = wf_setup_gather(job),
                              .sampler = job->sampler,
                              .count = (int)job->samples,
                              .seed = (uint64_t)job->seed,
                              .skip = job->skip,
                              .error =
                                  wf_ratio_given(job->error) ? wf_ratio_value(job->error) : 0};
}

typedef struct renderer {
    wf_sampling *sampling;
    wf_sampling_scratch **scratch;
    int threads;
} renderer;

static void units(void *self, int64_t field, int64_t *first, int64_t *last) {
    const renderer *r = self;
    wf_sampling_units(r->sampling, field, first, last);
}

static weft_status begin(void *self, int64_t unit, weft_error *err) {
    const renderer *r = self;
    return wf_sampling_look(r->sampling, r->scratch[0], unit)
               ? WEFT_OK
               : wf_fail(err, WEFT_NO_MEMORY, "no memory for the scene");
}

static bool still(void *self) {
    const renderer *r = self;
    return wf_sampling_still(r->sampling);
}

static bool whole(void *self, int64_t field, int64_t unit) {
    const renderer *r = self;
    return wf_sampling_whole(r->sampling, field, unit);
}

static weft_status band(void *self, int thread, int first, int end, const wf_receiver *receiver,
                        weft_error *err) {
    const renderer *r = self;
    return wf_sampling_rows(r->sampling, r->scratch[thread], first, end, receiver)
               ? WEFT_OK
               : wf_fail(err, WEFT_NO_MEMORY, "no memory for rays");
}

static void free_renderer(renderer *r) {
    for (int t = 0; r->scratch && t < r->threads; t++) wf_sampling_scratch_free(r->scratch[t]);
    free(r->scratch);
    wf_sampling_free(r->sampling);
}

static weft_status make_renderer(const weft_job *job, const wf_scene *scene, renderer *r,
                                 weft_error *err) {
    wf_sampling_desc desc = wf_render_sampling(job, scene);
    *r = (renderer){.threads = wf_gathering_threads(job)};
    r->sampling = wf_sampling_new(&desc);
    r->scratch = calloc((size_t)r->threads, sizeof(wf_sampling_scratch *));
    bool good = r->sampling && r->scratch;
    for (int t = 0; good && t < r->threads; t++)
        good = (r->scratch[t] = wf_sampling_scratch_new(r->sampling));
    return good ? WEFT_OK : wf_fail(err, WEFT_NO_MEMORY, "no memory for the scene");
}

/* ---- The job ---- */

void wf_report_traced(wf_report *report, const wf_trace_counts *counts) {
    report->traced = true;
    report->samples += counts->samples;
    report->rays += counts->rays;
    report->tiles += counts->tiles;
    report->tiles_skipped += counts->tiles_skipped;
}

static void tell(const weft_job *job, const renderer *r, const wf_gathering *g,
                 wf_report *report) {
    wf_gathering_counts counts = wf_gathering_counted(g);
    report->frames = counts.frames;
    report->fields = counts.frames * wf_raster_fields_per_frame(&job->raster);
    report->trace_s = counts.source_s;
    report->resample_s = counts.resample_s;
    report->color_s = counts.color_s;
    report->write_s = counts.write_s;
    wf_gathering_tell_legal(g, &report->legal);
    report->tiles_reused = counts.tiles_reused;
    report->fields_reused = counts.fields_reused;
    wf_error_sum all = {0, 0};
    for (int t = 0; t < r->threads; t++) {
        wf_error_sum one = wf_sampling_error(r->scratch[t]);
        all.square += one.square;
        all.cells += one.cells;
        wf_trace_counts traced = wf_sampling_counted(r->scratch[t]);
        wf_report_traced(report, &traced);
    }
    if (all.cells > 0) report->error_estimate = sqrt(all.square / all.cells);
}

static weft_status render(weft_job *job, wf_setup *s, const wf_scene *scene, wf_report *report,
                          weft_error *err) {
    renderer r = {0};
    wf_gathering *g = NULL;
    weft_status status = make_renderer(job, scene, &r, err);
    const wf_foresee_desc plan = {.job = job, .setup = s, .sampling = r.sampling};
    if (job->dry_run) {
        if (!status) status = wf_foresee(&plan, report, err);
        free_renderer(&r);
        return status;
    }
    wf_sample_source source = {.self = &r,
                               .units = units,
                               .begin = begin,
                               .still = still,
                               .whole = whole,
                               .band = band};
    if (!status) source.tiling = wf_sampling_tiling(r.sampling);
    if (!status) status = wf_gathering_new(job, s, &source, &g, err);
    if (!status) status = wf_gathering_run(g, err);
    if (g) tell(job, &r, g, report);
    wf_gathering_free(g);
    free_renderer(&r);
    return status;
}

weft_status wf_run_render(weft_job *job, wf_report *report, weft_error *err) {
    wf_setup s = {0};
    wf_scene scene = {0};
    weft_status status = wf_render_load(job, &scene, err);
    s.scene_space = *scene.color_space ? scene.color_space : NULL;
    if (!status) status = wf_setup_output(job, &s, err);
    if (!status) status = wf_render_frames(job, &scene, &s.first_frame, &s.end_frame, err);
    if (!status) {
        wf_setup_count_frames(&s);
        report->legal = wf_setup_legal(job, &s);
        bool done = job->resume && !s.output.kind->sequence &&
                    wf_output_present(s.output.kind, job->output, -1);
        if (!done || job->dry_run) status = render(job, &s, &scene, report, err);
    }
    wf_setup_free(&s);
    wf_scene_free(&scene);
    return status;
}
