/* weft trace --oversample: subframes, a picture each. */
#include <stdlib.h>

#include "convert/base/values.h"
#include "convert/run/dry_run.h"
#include "convert/run/source/source_scene.h"
#include "convert/run/trace.h"
#include "convert/write/sink.h"

typedef struct subframes {
    wf_run *run;
    wf_scene_source *source;
    int across, down, times; /* samples a pixel, a line, a field */
    wf_raster raster;        /* whose frames are the subframes */
    wf_rational rate;        /* subframes a second */
    int64_t per_frame;       /* subframes */
    int channels;            /* 4: alpha is stored, as the scene has it; else 3 */
    float *plane[4];         /* [lines][width_px] of one subframe */
    float **rows;            /* [threads]: [WF_TRACE_ROWS][width_px][4] */
    wf_sink *sink;           /* NULL: not open */
} subframes;

/* ---- What they are ---- */

static void describe(subframes *f, wf_run *run) {
    const wf_raster *raster = &run->job->raster;
    *f = (subframes){.run = run, .source = run->source, .raster = *raster};
    f->channels = wf_scene_has_alpha(&f->source->scene) ? 4 : 3;
    wf_parse_oversample(run->job->oversample, &f->across, &f->down, &f->times);
    f->raster.width_px *= f->across;
    f->raster.lines *= f->down;
    f->raster.scan = WF_PROGRESSIVE;
    f->raster.pixel_aspect = wf_ratio_mul(raster->pixel_aspect, wf_ratio(f->down, f->across));
    f->rate = wf_ratio_div(wf_ratio(f->times, 1), wf_raster_field_period(raster));
    f->raster.frame_rate = f->rate;
    f->per_frame = (int64_t)f->times * (raster->scan == WF_INTERLACED ? 2 : 1);
}

/* Makes the setup that of a run whose frames are the subframes. */
static void turn_to_subframes(subframes *f) {
    wf_setup *s = &f->run->setup;
    s->first_frame *= f->per_frame;
    s->end_frame *= f->per_frame;
    s->output_options.raster = &f->raster;
    s->output_options.timecode = NULL;
    s->output_options.alpha = f->channels == 4;
    s->output_options.color_space = wf_scene_space(f->run);
    s->output_options.subframe_rate = f->rate;
    wf_setup_tell_frames(s);
}

/* ---- One subframe ---- */

static void trace_band(void *user, wf_worker *worker, int n) {
    const subframes *f = user;
    float *rgba = f->rows[worker->number];
    size_t width = (size_t)f->raster.width_px;
    int first = n * WF_TRACE_ROWS, left = f->raster.lines - first;
    int rows = left < WF_TRACE_ROWS ? left : WF_TRACE_ROWS;
    if (!wf_sampling_subframe_rows(f->source->sampling, f->source->scratch[worker->number],
                                   f->raster.width_px, f->raster.lines, first, first + rows,
                                   rgba)) {
        wf_crew_fail(&f->run->crew, worker,
                     wf_fail(&worker->error, WEFT_NO_MEMORY, "no memory for rays"));
        return;
    }
    for (size_t k = 0; k < (size_t)rows * width; k++)
        for (int c = 0; c < f->channels; c++)
            f->plane[c][(size_t)first * width + k] = rgba[4 * k + (size_t)c];
}

static weft_status trace_subframe(subframes *f, int64_t k, weft_error *err) {
    wf_crew *crew = &f->run->crew;
    wf_frame frame = {.index = k};
    if (!wf_sampling_subframe(f->source->sampling, wf_ratio_div(wf_ratio(k, 1), f->rate)))
        return wf_fail(err, WEFT_NO_MEMORY, "no memory for the scene");
    wf_crew_part(crew, 0, 1);
    wf_crew_within(crew, (f->raster.lines + WF_TRACE_ROWS - 1) / WF_TRACE_ROWS, trace_band, f);
    weft_status status = wf_crew_status(crew, err);
    for (int c = 0; c < f->channels; c++) {
        frame.plane[c] = f->plane[c];
        frame.stride[c] = (size_t)f->raster.width_px;
    }
    if (!status) status = f->run->setup.output.ops->write(f->sink, &frame, err);
    if (!status) wf_crew_step(crew);
    return status;
}

/* ---- All of them ---- */

static weft_status make_buffers(subframes *f, weft_error *err) {
    size_t width = (size_t)f->raster.width_px, bytes = width * sizeof(float);
    for (int c = 0; c < f->channels; c++)
        if (!(f->plane[c] = malloc(bytes * (size_t)f->raster.lines)))
            return wf_fail(err, WEFT_NO_MEMORY, "no memory for a subframe");
    f->rows = calloc((size_t)f->run->crew.threads, sizeof *f->rows);
    for (int t = 0; f->rows && t < f->run->crew.threads; t++)
        if (!(f->rows[t] = malloc(4 * WF_TRACE_ROWS * bytes)))
            return wf_fail(err, WEFT_NO_MEMORY, "no memory for a band");
    return f->rows ? WEFT_OK : wf_fail(err, WEFT_NO_MEMORY, "no memory for a band");
}

static void free_buffers(subframes *f) {
    for (int t = 0; f->rows && t < f->run->crew.threads; t++) free(f->rows[t]);
    for (int c = 0; c < f->channels; c++) free(f->plane[c]);
    free(f->rows);
}

static weft_status trace_all(subframes *f, weft_error *err) {
    const weft_job *job = f->run->job;
    const wf_setup *s = &f->run->setup;
    const wf_sink_ops *ops = s->output.ops;
    weft_status status = wf_output_open(s->output, &s->output_options, &f->sink, err);
    if (!status) wf_crew_begin(&f->run->crew);
    for (int64_t k = s->first_frame; !status && k < s->end_frame; k++)
        if (!job->resume || !wf_output_present(s->output.kind, job->output, k))
            status = trace_subframe(f, k, err);
    if (f->sink && !status) return ops->commit(f->sink, err);
    if (f->sink) ops->abandon(f->sink);
    return status;
}

weft_status wf_store_subframes(wf_run *run, weft_error *err) {
    subframes f;
    describe(&f, run);
    turn_to_subframes(&f);
    if (run->job->dry_run) return wf_dry_run_make(run, true, err);
    run->crew.total = run->setup.end_frame - run->setup.first_frame;
    weft_status status = run->kind->start(run, err);
    if (!status) status = make_buffers(&f, err);
    if (!status) status = trace_all(&f, err);
    free_buffers(&f);
    wf_scene_tell_traced(run, run->report);
    run->report->frames = run->crew.done;
    return status;
}
