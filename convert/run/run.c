#include <stdio.h>
#include <stdlib.h>

#include "color/codes/r103.h"
#include "convert/run/deep_source.h"
#include "convert/run/dry_run.h"
#include "convert/run/overwrite_check.h"
#include "convert/run/pipeline.h"
#include "convert/run/render.h"

/* ---- Missing subframes ---- */

/* The numbers of the selection that have no file. */
static wf_rational *list_missing(const wf_sequence *sequence) {
    wf_rational *numbers = malloc((sequence->missing + 1) * sizeof *numbers);
    size_t n = 0;
    for (size_t k = 0; numbers && k < sequence->count; k++)
        if (!sequence->refs[k].path) numbers[n++] = sequence->refs[k].number;
    return numbers;
}

static void number_text(wf_rational number, char *text, size_t size) {
    if (number.den == 1)
        snprintf(text, size, "%lld", (long long)number.num);
    else
        snprintf(text, size, "%.9g", wf_ratio_value(number));
}

/* How many missing subframes the fields of this chunk need; *first is the first of them. */
static size_t count_needed(const wf_setup *s, const weft_job *job, int64_t *first) {
    int per_frame = wf_raster_fields_per_frame(&job->raster);
    size_t needed = 0;
    int64_t k = 0;
    for (int64_t n = s->first_frame * per_frame; n < s->end_frame * per_frame; n++) {
        wf_window window = wf_resampler_window(s->resampler, n);
        for (k = k > window.first ? k : window.first; k < window.first + window.count; k++)
            if (!s->sequence.refs[k].path && !needed++) *first = k;
    }
    return needed;
}

static weft_status face_missing(weft_job *job, const wf_setup *s, bool *degraded,
                                weft_error *err) {
    int64_t first = 0;
    size_t needed = s->sequence.missing ? count_needed(s, job, &first) : 0;
    if (!needed) return WEFT_OK;
    char number[32];
    number_text(s->sequence.refs[first].number, number, sizeof number);
    if (job->on_missing == WF_MISSING_ERROR)
        return wf_fail(
            err, WEFT_FAILED,
            "%s: subframe %s is missing (%zu of the %zu selected are missing and needed); "
            "render it, or give --on-missing hold or black",
            job->inputs[0], number, needed, s->sequence.count);
    *degraded = true;
    wf_job_warn(
        job, "%s: %zu missing subframes, the first is %s: %s", job->inputs[0], needed, number,
        job->on_missing == WF_MISSING_HOLD ? "their neighbours are held" : "they are black");
    return WEFT_OK;
}

/* ---- Running ---- */

static bool is_there(const weft_job *job, const wf_setup *s, int64_t frame) {
    int files = wf_output_files(&s->output_options);
    for (int n = 0; n < files; n++)
        if (!wf_output_present(s->output.kind, job->output, frame * files + n)) return false;
    return true;
}

bool wf_next_frames(const weft_job *job, const wf_setup *s, int64_t *first, int64_t *end) {
    bool leave_out = job->resume && s->output.kind->sequence;
    while (leave_out && *first < s->end_frame && is_there(job, s, *first)) ++*first;
    *end = leave_out && *first < s->end_frame ? *first + 1 : s->end_frame;
    while (leave_out && *end < s->end_frame && !is_there(job, s, *end)) ++*end;
    return *first < s->end_frame;
}

static weft_status convert_frames(wf_pipeline *p, weft_error *err) {
    int64_t first = p->setup->first_frame, end;
    weft_status status = WEFT_OK;
    while (!status && wf_next_frames(p->job, p->setup, &first, &end)) {
        status = wf_pipeline_frames(p, first, end, err);
        first = end;
    }
    return status;
}

static weft_status run_with_sink(wf_pipeline *p, weft_error *err) {
    weft_status status = wf_frames_open(p->frames, err);
    if (!status) status = convert_frames(p, err);
    return status ? status : wf_frames_commit(p->frames, err);
}

static void tell(const weft_job *job, const wf_setup *s, const wf_pipeline *p,
                 wf_report *report) {
    report->listed = (int64_t)s->sequence.count;
    report->missing = list_missing(&s->sequence);
    report->missing_count = report->missing ? s->sequence.missing : 0;
    report->legal = wf_setup_legal(job, s);
    if (!p) return;
    wf_source_counts counts = wf_pipeline_counts(p);
    wf_worker times = wf_pipeline_times(p);
    report->frames = wf_frames_done(p->frames);
    report->fields = report->frames * wf_raster_fields_per_frame(&job->raster);
    report->opened = p->opened;
    report->chunks_decoded = counts.chunks_decoded;
    report->chunks_reused = counts.chunks_reused;
    report->nan_fixed = counts.nan_fixed;
    report->decode_s = times.decode_s;
    report->resample_s = times.resample_s;
    report->color_s = times.finisher.color_s;
    report->write_s = wf_frames_write_s(p->frames);
    wf_frames_tell_legal(p->frames, &report->legal);
}

static void tell_mended(const weft_job *job, int64_t pixels, bool *degraded) {
    if (!pixels) return;
    *degraded = true;
    wf_job_warn(job, "%lld pixels of the input were NaN or infinite: %s", (long long)pixels,
                job->nan_fix == WF_NAN_BLACK ? "they are black"
                                             : "they are the means of their neighbours");
}

static weft_status run_setup(weft_job *job, const wf_setup *s, wf_pipeline **p,
                             wf_report *report, weft_error *err) {
    bool *degraded = &report->degraded;
    bool done = job->resume && !s->output.kind->sequence &&
                wf_output_present(s->output.kind, job->output, -1);
    if (done && !job->dry_run) return WEFT_OK;
    weft_status status = wf_refuse_own_inputs(job, s, err);
    if (!status && !done) status = face_missing(job, s, degraded, err);
    if (!status) status = wf_pipeline_new(job, s, p, err);
    const wf_foresee_desc plan = {.job = job, .setup = s, .pipeline = *p};
    if (!status && job->dry_run) return wf_foresee(&plan, report, err);
    if (!status) status = run_with_sink(*p, err);
    if (!status) tell_mended(job, wf_pipeline_counts(*p).nan_fixed, degraded);
    return status;
}

static weft_status run_convert(weft_job *job, wf_report *report, weft_error *err) {
    wf_setup setup = {0};
    wf_pipeline *pipeline = NULL;
    if (wf_takes_samples(job)) {
        if (job->cadence == WF_CADENCE_NONE) return wf_run_samples(job, report, err);
        return wf_fail(err, WEFT_USAGE,
                       "%s: --cadence is for subframes and scenes, not for sample buffers, "
                       "whose times count fields",
                       job->inputs[0]);
    }
    weft_status status = wf_setup_make(job, &setup, err);
    if (!status) status = run_setup(job, &setup, &pipeline, report, err);
    tell(job, &setup, pipeline, report);
    wf_pipeline_free(pipeline);
    wf_setup_free(&setup);
    return status;
}

/* ---- Any job ---- */

typedef weft_status run_fn(weft_job *job, wf_report *report, weft_error *err);

static run_fn *const runs[] = {
    [WF_CONVERT] = run_convert, [WF_RENDER] = wf_run_render, [WF_TRACE] = wf_run_trace};

static void tell_outside(const weft_job *job, const wf_legal_counts *counts) {
    double share = (double)counts->outside / (double)(counts->pixels + 1);
    if (share <= WF_R103_SHARE) return;
    wf_job_warn(job,
                "--legalize r103: %.2g %% of the picture is still outside, and 1 %% may be",
                100 * share);
}

weft_status weft_job_run(weft_job *job, weft_error *err) {
    double start = wf_now_s();
    weft_error own;
    if (!err) err = &own;
    err->text[0] = '\0';
    wf_report report = {.command = wf_command_name(job->command), .raster = &job->raster};
    weft_status status = wf_job_check(job, err);
    if (!status) wf_job_settle(job);
    if (!status) status = runs[job->command](job, &report, err);
    if (!status) tell_outside(job, &report.legal.counts);
    report.wall_s = wf_now_s() - start;
    if (job->dry_run) report.frames = report.fields = 0;
    report.error = status ? err->text : NULL;
    free(job->report);
    job->report = wf_report_json(&report);
    free(report.missing);
    wf_foreseen_free(report.plan);
    return status ? status : report.degraded ? WEFT_DEGRADED : WEFT_OK;
}
