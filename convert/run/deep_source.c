#include "convert/run/deep_source.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/read/deep_read.h"
#include "convert/run/dry_run.h"
#include "convert/run/gathering.h"

/* A unit is a file, which is a frame. */
typedef struct samples {
    const weft_job *job;
    wf_sequence sequence;
    wf_deep_file *file; /* of the unit in hand; NULL: there is none */
    wf_deep_buffers *buffers;
    int threads;
    int64_t unit, opened;
    char space[64];
} samples;

/* ---- Which files a field reaches ---- */

/* Instants in a frame: those of its two fields, or one. */
static int instants_a_frame(const weft_job *job) {
    return job->raster.scan == WF_INTERLACED ? 2 : 1;
}

static int64_t within(int64_t v, int64_t count) {
    return v < 0 ? 0 : v >= count ? count - 1 : v;
}

/* The frames that its window touches, and its own, in which some renderers put samples of times
 * outside the frame. */
static void units(void *self, int64_t field, int64_t *first, int64_t *last) {
    const samples *s = self;
    wf_gather_desc d = wf_setup_gather(s->job);
    int per_frame = instants_a_frame(s->job);
    int64_t instant = wf_raster_instant(&s->job->raster, field), own = instant / per_frame;
    double tau = wf_ratio_value(d.width);
    double from = (double)instant - wf_position_anchor(d.position) * tau;
    double skew = wf_ratio_given(d.skew) ? wf_ratio_value(d.skew) : 0;
    int64_t low = (int64_t)floor(from / per_frame);
    int64_t high = (int64_t)ceil((from + tau + skew) / per_frame) - 1;
    int64_t count = (int64_t)s->sequence.count;
    *first = within(low < own ? low : own, count);
    *last = within(high > own ? high : own, count);
}

/* ---- Files ---- */

static weft_status begin(void *self, int64_t unit, weft_error *err) {
    samples *s = self;
    const wf_subframe_ref *ref = &s->sequence.refs[unit];
    wf_deep_close(s->file);
    s->file = NULL;
    s->unit = unit;
    if (!ref->path)
        return wf_fail(err, WEFT_FAILED,
                       "%s: the samples of frame %lld of the selection are missing",
                       s->job->inputs[0], (long long)unit);
    s->opened++;
    return wf_deep_open(ref->path, &s->job->raster, &s->file, err);
}

/* What is not covered shows the background. */
static void lay_over_background(const weft_job *job, const wf_deep_line *line, size_t count) {
    float *const rgb[3] = {line->channel[WF_DEEP_R], line->channel[WF_DEEP_G],
                           line->channel[WF_DEEP_B]};
    const float *alpha = line->channel[WF_DEEP_A];
    for (int c = 0; alpha && c < 3; c++)
        for (size_t i = 0; i < count; i++) rgb[c][i] += (1 - alpha[i]) * job->background[c];
}

static weft_status band(void *self, int thread, int first, int end, const wf_receiver *receiver,
                        weft_error *err) {
    samples *s = self;
    wf_deep_buffers *b = &s->buffers[thread];
    int per_frame = wf_raster_fields_per_frame(&s->job->raster);
    for (int y = first; y < end; y++) {
        weft_status status = wf_deep_read(s->file, b, y, err);
        if (status) return status;
        const wf_deep_line *l = &b->line;
        size_t count = (size_t)l->upto[s->job->raster.width_px - 1];
        lay_over_background(s->job, l, count);
        const wf_samples block = {
            .count = count,
            .x = l->channel[WF_DEEP_X],
            .y = l->channel[WF_DEEP_Y],
            .t = l->channel[WF_DEEP_T],
            .field = s->unit * per_frame,
            .rgb = {l->channel[WF_DEEP_R], l->channel[WF_DEEP_G], l->channel[WF_DEEP_B]},
            .weight = l->channel[WF_DEEP_WEIGHT]};
        if (count) receiver->samples(receiver->user, &block);
    }
    return WEFT_OK;
}

/* ---- The job ---- */

static const char *first_path(const wf_sequence *sequence) {
    for (size_t k = 0; k < sequence->count; k++)
        if (sequence->refs[k].path) return sequence->refs[k].path;
    return NULL;
}

bool wf_takes_samples(const weft_job *job) {
    wf_sequence sequence = {0};
    weft_error ignored;
    bool deep = false;
    if (!wf_sequence_expand(job->inputs, job->input_count, job->frames, &sequence, &ignored)) {
        const char *path = first_path(&sequence);
        deep = path && wf_deep_is(path);
    }
    wf_sequence_free(&sequence);
    return deep;
}

static weft_status open_samples(const weft_job *job, samples *s, weft_error *err) {
    *s = (samples){.job = job, .threads = wf_gathering_threads(job)};
    weft_status status =
        wf_sequence_expand(job->inputs, job->input_count, job->frames, &s->sequence, err);
    if (status) return status;
    s->buffers = calloc((size_t)s->threads, sizeof *s->buffers);
    if (!s->buffers) return wf_fail(err, WEFT_NO_MEMORY, "no memory for samples");
    status = wf_deep_open(first_path(&s->sequence), &job->raster, &s->file, err);
    if (status) return status;
    snprintf(s->space, sizeof s->space, "%s", wf_deep_space(s->file));
    if (*wf_deep_raster(s->file) && strcmp(wf_deep_raster(s->file), job->raster.name))
        wf_job_warn(job, "%s: its samples were made for %s, and are taken for %s",
                    job->inputs[0], wf_deep_raster(s->file), job->raster.name);
    return WEFT_OK;
}

static void free_samples(samples *s) {
    wf_deep_close(s->file);
    for (int t = 0; s->buffers && t < s->threads; t++) wf_deep_buffers_free(&s->buffers[t]);
    free(s->buffers);
    wf_sequence_free(&s->sequence);
}

static void tell(const weft_job *job, const samples *s, const wf_gathering *g,
                 wf_report *report) {
    wf_gathering_counts counts = wf_gathering_counted(g);
    report->frames = counts.frames;
    report->fields = counts.frames * wf_raster_fields_per_frame(&job->raster);
    report->opened = s->opened;
    report->decode_s = counts.source_s;
    report->resample_s = counts.resample_s;
    report->color_s = counts.color_s;
    report->write_s = counts.write_s;
    wf_gathering_tell_legal(g, &report->legal);
    if (!counts.pixels_filled) return;
    report->degraded = true;
    wf_job_warn(job, "%lld pixels that no sample reached are what is nearest to them",
                (long long)counts.pixels_filled);
}

static weft_status convert(weft_job *job, wf_setup *setup, samples *s, wf_report *report,
                           weft_error *err) {
    wf_gathering *g = NULL;
    const wf_sample_source source = {.self = s, .units = units, .begin = begin, .band = band};
    const wf_foresee_desc plan = {.job = job, .setup = setup};
    if (job->dry_run) return wf_foresee(&plan, report, err);
    weft_status status = wf_gathering_new(job, setup, &source, &g, err);
    if (!status) status = wf_gathering_run(g, err);
    if (g) tell(job, s, g, report);
    wf_gathering_free(g);
    return status;
}

weft_status wf_run_samples(weft_job *job, wf_report *report, weft_error *err) {
    wf_setup setup = {0};
    samples s = {0};
    weft_status status = open_samples(job, &s, err);
    report->listed = (int64_t)s.sequence.count;
    setup.scene_space = *s.space ? s.space : NULL;
    if (!status) status = wf_setup_output(job, &setup, err);
    if (!status) {
        int64_t frames = (int64_t)s.sequence.count;
        setup.first_frame = frames * (job->chunk - 1) / job->chunk_count;
        setup.end_frame = frames * job->chunk / job->chunk_count;
        wf_setup_count_frames(&setup);
        report->legal = wf_setup_legal(job, &setup);
        status = convert(job, &setup, &s, report, err);
    }
    free_samples(&s);
    wf_setup_free(&setup);
    return status;
}
