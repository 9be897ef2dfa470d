/* Sample buffers as a source: a deep EXR file a frame, whose samples may reach fields of
 * others. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/read/deep_read.h"
#include "convert/run/sum/gathering.h"
#include "filters/raster/timing.h"

/* run->source; the files are setup.sequence. */
typedef struct samples {
    wf_deep_file *file;       /* of the unit in hand; NULL: there is none */
    wf_deep_buffers *buffers; /* [threads] */
    int64_t unit, opened;
    char space[64];
} samples;

/* ---- Opening ---- */

static const char *first_path(const wf_sequence *sequence) {
    for (size_t k = 0; k < sequence->count; k++)
        if (sequence->refs[k].path) return sequence->refs[k].path;
    return NULL;
}

static weft_status takes(const weft_job *job, bool *takes, weft_error *err) {
    wf_sequence sequence = {0};
    *takes = false;
    if (job->command != WF_CONVERT) return WEFT_OK;
    weft_status status =
        wf_sequence_expand(job->inputs, job->input_count, job->frames, &sequence, err);
    const char *path = status ? NULL : first_path(&sequence);
    if (path) status = wf_deep_is(path, takes, err);
    wf_sequence_free(&sequence);
    return status;
}

/* The first file says of itself what all of them are. */
static weft_status look_at_first(wf_run *run, samples *s, weft_error *err) {
    const weft_job *job = run->job;
    weft_status status =
        wf_deep_open(first_path(&run->setup.sequence), &job->raster, &s->file, err);
    if (status) return status;
    snprintf(s->space, sizeof s->space, "%s", wf_deep_space(s->file));
    run->setup.scene_space = *s->space ? s->space : NULL;
    if (*wf_deep_raster(s->file) && strcmp(wf_deep_raster(s->file), job->raster.name))
        wf_job_warn(job, "%s: its samples were made for %s, and are taken for %s",
                    job->inputs[0], wf_deep_raster(s->file), job->raster.name);
    return WEFT_OK;
}

static weft_status open_input(wf_run *run, weft_error *err) {
    const weft_job *job = run->job;
    if (job->cadence != WF_CADENCE_NONE)
        return wf_fail(err, WEFT_USAGE,
                       "%s: --cadence is for subframes and scenes, not for sample buffers, "
                       "whose times count fields",
                       job->inputs[0]);
    weft_status status = wf_sequence_expand(job->inputs, job->input_count, job->frames,
                                            &run->setup.sequence, err);
    if (status) return status;
    if (*run->setup.sequence.notice) wf_job_warn(job, "%s", run->setup.sequence.notice);
    samples *s = run->source = calloc(1, sizeof *s);
    if (s) s->buffers = calloc((size_t)run->crew.threads, sizeof *s->buffers);
    if (!s || !s->buffers) return wf_fail(err, WEFT_NO_MEMORY, "no memory for samples");
    return look_at_first(run, s, err);
}

static void close_input(wf_run *run) {
    samples *s = run->source;
    if (!s) return;
    wf_deep_close(s->file);
    for (int t = 0; s->buffers && t < run->crew.threads; t++)
        wf_deep_buffers_free(&s->buffers[t]);
    free(s->buffers);
    free(s);
    run->source = NULL;
}

/* ---- Which files a field reaches ---- */

static weft_status count(wf_run *run, weft_error *err) {
    return wf_setup_chosen_frames(run->job, &run->setup, (int64_t)run->setup.sequence.count,
                                  err);
}

/* Instants in a frame: those of its two fields, or one. */
static int instants_a_frame(const weft_job *job) {
    return job->raster.scan == WF_INTERLACED ? 2 : 1;
}

static int64_t within(int64_t v, int64_t count) {
    return v < 0 ? 0 : v >= count ? count - 1 : v;
}

/* The frames that its window touches, and its own, in which some renderers put samples of times
 * outside the frame. */
static wf_needs needs(const wf_run *run, int64_t field) {
    wf_gather_desc d = wf_setup_gather(run->job);
    int per_frame = instants_a_frame(run->job);
    int64_t instant = wf_raster_instant(&run->job->raster, field), own = instant / per_frame;
    double tau = wf_ratio_value(d.width);
    double from = (double)instant - wf_position_anchor(d.position) * tau;
    double skew = wf_ratio_given(d.skew) ? wf_ratio_value(d.skew) : 0;
    int64_t low = (int64_t)floor(from / per_frame);
    int64_t high = (int64_t)ceil((from + tau + skew) / per_frame) - 1;
    int64_t files = (int64_t)run->setup.sequence.count;
    return (wf_needs){within(low < own ? low : own, files),
                      within(high > own ? high : own, files) + 1};
}

/* ---- Reading ---- */

static weft_status turn(wf_run *run, int64_t unit, weft_error *err) {
    samples *s = run->source;
    const wf_subframe_ref *ref = &run->setup.sequence.refs[unit];
    wf_deep_close(s->file);
    s->file = NULL;
    s->unit = unit;
    if (!ref->path)
        return wf_fail(err, WEFT_FAILED,
                       "%s: the samples of frame %lld of the selection are missing",
                       run->job->inputs[0], (long long)unit);
    s->opened++;
    return wf_deep_open(ref->path, &run->job->raster, &s->file, err);
}

/* What is not covered shows the background; where alpha is written there is none. */
static void lay_over_background(const weft_job *job, const wf_deep_line *line, size_t count) {
    float *const rgb[3] = {line->channel[WF_DEEP_R], line->channel[WF_DEEP_G],
                           line->channel[WF_DEEP_B]};
    const float *alpha = line->channel[WF_DEEP_A];
    for (int c = 0; alpha && c < 3; c++)
        for (size_t i = 0; i < count; i++) rgb[c][i] += (1 - alpha[i]) * job->background[c];
}

static void hand_over(const wf_run *run, const wf_deep_line *l, const wf_receiver *receiver) {
    const samples *s = run->source;
    const wf_raster *raster = &run->job->raster;
    size_t count = (size_t)l->upto[raster->width_px - 1];
    lay_over_background(run->job, l, count);
    const wf_samples block = {
        .count = count,
        .x = l->channel[WF_DEEP_X],
        .y = l->channel[WF_DEEP_Y],
        .t = l->channel[WF_DEEP_T],
        .field = s->unit * wf_raster_fields_per_frame(raster),
        .rgb = {l->channel[WF_DEEP_R], l->channel[WF_DEEP_G], l->channel[WF_DEEP_B]},
        .weight = l->channel[WF_DEEP_WEIGHT],
        .alpha = l->channel[WF_DEEP_A]};
    if (count) receiver->samples(receiver->user, &block);
}

static weft_status band(wf_run *run, const wf_worker *worker, int first, int end,
                        const wf_receiver *receiver, weft_error *err) {
    samples *s = run->source;
    wf_deep_buffers *buffers = &s->buffers[worker->number];
    for (int y = first; y < end; y++) {
        weft_status status = wf_deep_read(s->file, buffers, y, err);
        if (status) return status;
        hand_over(run, &buffers->line, receiver);
    }
    return WEFT_OK;
}

/* ---- Report ---- */

static void tell(const wf_run *run, wf_report *report) {
    const samples *s = run->source;
    const wf_gathering *g = run->sums;
    report->listed = (int64_t)run->setup.sequence.count;
    if (!g) return;
    report->opened = s->opened;
    report->decode_s = wf_crew_times(&run->crew).source_s;
    if (!g->filled) return;
    report->degraded = true;
    wf_job_warn(run->job, "%lld pixels that no sample reached are what is nearest to them",
                (long long)g->filled);
}

static const wf_sample_reading reading = {.turn = turn, .band = band};

const wf_source_kind wf_source_samples = {
    .name = "sample buffers",
    .takes = takes,
    .open = open_input,
    .count = count,
    .needs = needs,
    .summing = &wf_summing_samples,
    .samples = &reading,
    .tell = tell,
    .close = close_input,
};
