/* A job from beginning to end:
 * job -> source -> needs of field n -> accumulate -> color -> chroma -> quantize -> sink. */
#include "convert/run/sum/flow.h"

#include <stdlib.h>

#include "color/codes/r103.h"
#include "convert/base/clock.h"
#include "convert/run/dry_run.h"
#include "convert/run/sum/needs.h"
#include "convert/finish/overwrite_check.h"
#include "convert/run/trace.h"

/* ---- Fields ---- */

/* The fields of one run of frames, none of which is left out. */
typedef struct flight {
    int64_t next; /* the next field to be put in flight */
    int64_t past; /* the end of the last */
    wf_walk walk; /* through the units that they need */
} flight;

/* Puts in flight the fields of the group, and later ones that the last of the units belongs to.
 */
static weft_status launch(wf_run *run, flight *f, const wf_units *units, weft_error *err) {
    int64_t last = units->unit[units->count - 1];
    int64_t most = units->group_end + run->pace.fields_carried;
    weft_status status = WEFT_OK;
    if (most > f->past) most = f->past;
    while (!status && f->next < most && run->kind->needs(run, f->next).first <= last)
        status = run->kind->summing->launch(run, f->next++, err);
    return status;
}

/* Reads what fields first <= n < end need and adds it to them, and to those after them that
 * need it too. */
static weft_status accumulate(wf_run *run, flight *f, int64_t first, int64_t end,
                              weft_error *err) {
    wf_units units;
    weft_status status = WEFT_OK;
    wf_walk_group(run, &f->walk, first, end);
    while (!status && wf_walk_units(run, &f->walk, &units)) {
        status = launch(run, f, &units, err);
        if (!status) status = run->kind->summing->add(run, &units, err);
    }
    return status;
}

/* Takes the lines of fields first <= n < end through color, chroma and quantizing, and frames
 * that are whole by that to the sink. */
static weft_status finish(wf_run *run, int64_t first, int64_t end, weft_error *err) {
    int per_frame = wf_raster_fields_per_frame(&run->job->raster);
    weft_status status = WEFT_OK;
    for (int64_t n = first; !status && n < end; n++) {
        status = run->kind->summing->finish(run, n, err);
        if (!status) status = wf_frames_field(run->frames, n, err);
        if (!status && n % per_frame == per_frame - 1)
            status = wf_frames_write(run->frames, n / per_frame, err);
    }
    return status;
}

/* Has the source read ahead to the end of the group that begins with field n, and lowers the
 * flight's end to where the source has met its own. */
static weft_status ready(wf_run *run, flight *f, int64_t n, int64_t *group_end,
                         weft_error *err) {
    int per_frame = wf_raster_fields_per_frame(&run->job->raster);
    *group_end = wf_walk_group_end(run, n, f->past);
    if (!run->kind->ready) return WEFT_OK;
    weft_status status = run->kind->ready(run, *group_end + run->pace.fields_carried, err);
    if (f->past > run->setup.end_frame * per_frame) f->past = run->setup.end_frame * per_frame;
    *group_end = wf_walk_group_end(run, n, f->past);
    return status;
}

/* Makes frames first <= n < end. */
static weft_status make_frames(wf_run *run, int64_t first, int64_t end, weft_error *err) {
    int per_frame = wf_raster_fields_per_frame(&run->job->raster);
    flight f = {first * per_frame, end * per_frame, wf_walk_begin()};
    weft_status status = WEFT_OK;
    run->kind->summing->drop(run);
    for (int64_t n = f.next, group_end; !status && n < f.past; n = group_end) {
        status = ready(run, &f, n, &group_end, err);
        if (!status) status = accumulate(run, &f, n, group_end, err);
        if (!status) status = finish(run, n, group_end, err);
    }
    return status;
}

/* ---- Frames ---- */

static weft_status make_all(wf_run *run, weft_error *err) {
    int64_t first = run->setup.first_frame, end;
    weft_status status = wf_frames_open(run->frames, err);
    if (!status) wf_crew_begin(&run->crew);
    while (!status && wf_frames_next(run->job, &run->setup, &first, &end)) {
        status = make_frames(run, first, end, err);
        first = end;
    }
    if (!status) status = wf_frames_commit(run->frames, err);
    run->finished = !status;
    return status;
}

/* Decides all that can be decided before a pixel is read. An output of no kind is told before
 * files are looked at. */
static weft_status settle(wf_run *run, weft_error *err) {
    if (!wf_output_for(run->job->output, run->job->codec, err).kind) return WEFT_USAGE;
    weft_status status = wf_source_for(run->job, &run->kind, err);
    if (!status) status = wf_source_check(run->kind, run->job, err);
    if (!status) status = run->kind->open(run, err);
    if (!status) status = wf_setup_sound(run->job, &run->setup, &run->report->taken, err);
    if (!status) status = wf_setup_output(run->job, &run->setup, err);
    if (!status) status = run->kind->count(run, err);
    if (!status) status = wf_setup_begin_sound(&run->setup, err);
    if (!status) status = wf_refuse_own_inputs(run->job, &run->setup, err);
    run->crew.total = run->setup.endless ? 0 : run->setup.end_frame - run->setup.first_frame;
    return status;
}

/* A dry run needs to know how many files are open at once only where it tells of files. */
static weft_status begin(wf_run *run, weft_error *err) {
    bool begins = !run->job->dry_run || run->kind->opens;
    weft_status status = run->kind->start ? run->kind->start(run, err) : WEFT_OK;
    if (!status && begins) status = run->kind->summing->begin(run, err);
    if (status) run->kind->summing->end(run);
    return status;
}

static void tell(const wf_run *run) {
    wf_report *report = run->report;
    wf_worker times = wf_crew_times(&run->crew);
    report->legal = wf_setup_legal(run->job, &run->setup);
    report->coded = run->setup.raster;
    if (run->setup.output.kind) report->raster = &report->coded;
    report->frames = run->crew.done;
    report->fields = run->crew.done * wf_raster_fields_per_frame(&report->coded);
    report->resample_s = times.resample_s;
    report->color_s = times.color_s;
    if (run->frames) wf_frames_tell(run->frames, report);
    if (run->sums) run->kind->summing->tell(run, report);
    if (run->source) run->kind->tell(run, report); /* else it was not opened */
    if (run->finished) wf_setup_tell_sound(&run->setup);
}

static weft_status make_video(wf_run *run, weft_error *err) {
    weft_status status = settle(run, err);
    bool done = !status && !run->job->dry_run && wf_frames_all_there(run->job, &run->setup);
    if (!status && !done) status = begin(run, err);
    if (!status && !done)
        status = run->job->dry_run ? wf_dry_run_make(run, false, err) : make_all(run, err);
    tell(run);
    return status;
}

/* ---- Any job ---- */

typedef weft_status run_fn(wf_run *run, weft_error *err);

static run_fn *const runs[] = {
    [WF_CONVERT] = make_video,
    [WF_RENDER] = make_video,
    [WF_TRACE] = wf_run_trace,
};

static void release(wf_run *run) {
    if (run->kind) {
        run->kind->summing->end(run);
        run->kind->close(run);
    }
    wf_frames_free(run->frames);
    wf_setup_free(&run->setup);
    wf_crew_free(&run->crew);
}

static weft_status run_job(weft_job *job, wf_report *report, weft_error *err) {
    wf_run run = {.job = job, .report = report};
    weft_status status = wf_crew_new(job, 0, &run.crew, err);
    if (!status) status = runs[job->command](&run, err);
    release(&run);
    return status;
}

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
    /* Both fields of a segmented frame would be found to be the same picture. */
    job->raster.whole_frames =
        job->raster.all_lines && job->raster.scan == WF_SEGMENTED && job->command != WF_TRACE;
    if (!status) status = run_job(job, &report, err);
    if (!status) tell_outside(job, &report.legal.counts);
    report.wall_s = wf_now_s() - start;
    if (job->dry_run) report.frames = report.fields = 0;
    report.error = status ? err->text : NULL;
    free(job->report);
    job->report = wf_report_json(&report);
    free(report.missing);
    wf_dry_run_free(report.plan);
    return status ? status : report.degraded ? WEFT_DEGRADED : WEFT_OK;
}
