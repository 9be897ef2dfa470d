/* What a television shows: video through a composite coder and decoder, frame by frame. */
#include "convert/run/broadcast.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "color/codes/ycbcr.h"
#include "color/composite/decode.h"
#include "color/composite/encode.h"
#include "convert/base/pattern.h"
#include "convert/read/signal.h"
#include "convert/read/television.h"
#include "convert/read/video.h"
#include "convert/finish/frames.h"
#include "convert/finish/overwrite_check.h"
#include "convert/run/time/timecode_start.h"

/* ---- Rasters ---- */

static void list_rasters(char *text, size_t size) {
    const wf_raster *r;
    wf_tv tv;
    size_t used = 0;
    text[0] = '\0';
    for (size_t i = 0; (r = wf_raster_at(i)) && used < size; i++)
        if (wf_television_of(r, &tv))
            used +=
                (size_t)snprintf(text + used, size - used, "%s%s", used ? ", " : "", r->name);
}

static weft_status settle_tv(const weft_job *job, const wf_broadcast *set, wf_tv *tv,
                             weft_error *err) {
    const wf_raster *raster = &job->raster;
    *tv = (wf_tv){.encoder = set->encoder, .decoder = set->decoder};
    if (!wf_television_of(raster, tv)) {
        char there[256];
        list_rasters(there, sizeof there);
        return wf_fail(err, WEFT_USAGE,
                       "%.500s: its raster is %s, which composite video cannot carry; it takes "
                       "%s, and these with -wide: convert to one, or, if it is one, say so "
                       "with --raster",
                       job->inputs[0], raster->name, there);
    }
    if (!set->system || *set->system == tv->system) return WEFT_OK;
    const wf_tv_standard *want = wf_tv_standard_of(*set->system),
                         *is = wf_tv_standard_of(tv->system);
    return wf_fail(
        err, WEFT_USAGE,
        "%.500s: its raster, %s, has %d lines, and %s has %d; leave --system out, or "
        "give %s",
        job->inputs[0], raster->name, is->total_lines, want->name, want->total_lines, is->name);
}

/* ---- Opening ---- */

/* All that a run holds. */
typedef struct run {
    weft_job *job;
    wf_video *video;
    wf_signals *signals;
    wf_signal *signal;
    wf_composite *coder;
    float *composite, *scratch;
    int64_t field; /* in hand */
    wf_setup setup;
    wf_crew crew;
    wf_frames *frames;
} run;

static void release(run *r) {
    wf_frames_free(r->frames);
    wf_setup_free(&r->setup);
    wf_crew_free(&r->crew);
    free(r->composite);
    free(r->scratch);
    wf_composite_free(r->coder);
    wf_signal_free(r->signal);
    wf_signals_free(r->signals);
    wf_video_close(r->video);
}

static weft_status refuse_linear(const weft_job *job, weft_error *err) {
    const wf_output_kind *kind = wf_output_for(job->output, job->codec, err).kind;
    if (!kind) return WEFT_USAGE;
    if (kind->layout != WF_LINEAR) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE,
                   "%.500s: %s holds scene-linear light, and what a television shows is "
                   "finished video; write out.y4m, out.v210, out.uyvy or out.####.png, tif or "
                   "dpx",
                   job->output, kind->name);
}

static weft_status open_video(run *r, const wf_broadcast *set, weft_error *err) {
    const wf_video_options options = {.raster = set->raster,
                                      .max_memory_bytes = r->job->max_memory_bytes};
    weft_status status = wf_video_open(r->job->inputs[0], &options, &r->video, err);
    if (status) return status;
    const wf_video_info *info = wf_video_info_of(r->video);
    r->job->raster = info->raster;
    if (!info->scan_known)
        wf_job_warn(r->job,
                    "%.500s does not say how it is scanned: it is taken for %s, %s; --raster "
                    "says otherwise",
                    r->job->inputs[0], info->raster.name, wf_raster_order(&info->raster));
    return WEFT_OK;
}

static weft_status protect_input(run *r, weft_error *err) {
    if (!r->job->overwrite || !strcmp(r->job->inputs[0], "-")) return WEFT_OK;
    weft_status status = wf_sequence_expand(r->job->inputs, 1, NULL, &r->setup.sequence, err);
    return status ? status : wf_refuse_own_inputs(r->job, &r->setup, err);
}

static void keep_timecode(run *r) {
    const wf_video_info *info = wf_video_info_of(r->video);
    wf_image_info first = {.timecode_all = info->videos, .frames = info->timecode_rate};
    if (!wf_ratio_given(first.frames)) first.frames = r->job->raster.frame_rate;
    snprintf(first.timecode, sizeof first.timecode, "%s", info->timecode);
    wf_start_timecode(r->job, &r->setup, &first);
}

static weft_status set_up(run *r, const wf_broadcast *set, weft_error *err) {
    wf_taken_list taken = {.count = 0};
    /* Pipes, and frames without a container, have no sound that could be kept. */
    bool file = wf_video_info_of(r->video)->videos && strcmp(r->job->inputs[0], "-");
    weft_status status = set->keep_sound && file ? wf_setup_keep_sound(r->job, err) : WEFT_OK;
    if (!status) status = wf_setup_sound(r->job, &r->setup, &taken, err);
    if (!status) status = wf_setup_video(r->job, &r->setup, err);
    if (status) return status;
    keep_timecode(r);
    return wf_setup_begin_sound(&r->setup, err);
}

static weft_status open_output(run *r, const wf_broadcast *set, weft_error *err) {
    int64_t frames = wf_video_info_of(r->video)->frames;
    weft_status status = set_up(r, set, err);
    if (status) return status;
    if (frames < 0 && r->setup.output.kind->sequence && !wf_pattern_is(r->job->output))
        return wf_fail(err, WEFT_USAGE,
                       "%.500s: each frame is a file; say where its number goes, such as "
                       "out.####.%s",
                       r->job->output, r->setup.output.kind->endings);
    r->setup.end_frame = r->crew.total = frames < 0 ? 0 : frames;
    wf_setup_tell_frames(&r->setup);
    status = protect_input(r, err);
    if (!status) status = wf_frames_new(&r->crew, &r->setup, 2, &r->frames, err);
    return status ? status : wf_frames_open(r->frames, err);
}

static weft_status make_coder(run *r, const wf_tv *tv, weft_error *err) {
    weft_status status = wf_signals_new(wf_video_info_of(r->video), &r->signals, err);
    if (!status) status = wf_signal_new(r->signals, &r->signal, err);
    if (status) return status;
    r->coder = wf_composite_new(tv);
    if (!r->coder) return wf_fail(err, WEFT_NO_MEMORY, "no memory for the coder");
    size_t samples = wf_composite_row(r->coder) * (size_t)tv->lines;
    r->composite = malloc(samples * sizeof *r->composite);
    r->scratch = malloc(wf_composite_scratch(r->coder) * sizeof *r->scratch);
    if (r->composite && r->scratch) return WEFT_OK;
    return wf_fail(err, WEFT_NO_MEMORY, "no memory for a frame of composite video");
}

/* ---- Frames ---- */

/* Line `line` of the field in hand, of the picture that is shown. */
static void finish_line(void *user, wf_worker *worker, int line) {
    const run *r = user;
    const wf_raster *raster = &r->job->raster;
    size_t width = (size_t)raster->width_px;
    int y = wf_raster_parity(raster, r->field) + line * wf_raster_line_step(raster);
    float *rgb[3];
    wf_frames_place(r->frames, worker, r->field, line, rgb);
    for (int p = 0; p < 3; p++)
        memcpy(rgb[p], r->signal->ycbcr[p] + (size_t)y * width, width * sizeof **rgb);
    wf_rgb_of_ycbcr(WF_LUMA_601, rgb[0], rgb[1], rgb[2], width);
    wf_frames_line(r->frames, worker, r->field, line);
}

static weft_status show_frame(run *r, const wf_video_frame *frame, weft_error *err) {
    const wf_raster *raster = &r->job->raster;
    int fields = wf_raster_fields_per_frame(raster);
    wf_signals_take(r->signals, frame, r->signal);
    wf_composite_encode(r->coder, frame->index, r->signal->ycbcr, r->composite, r->scratch);
    wf_composite_decode(r->coder, frame->index, r->composite, r->signal->ycbcr, r->scratch);
    for (r->field = frame->index * fields; r->field < (frame->index + 1) * fields; r->field++) {
        int lines = wf_raster_field_lines(raster, wf_raster_parity(raster, r->field));
        wf_crew_each(&r->crew, lines, 4, finish_line, r);
    }
    weft_status status = wf_crew_status(&r->crew, err);
    return status ? status : wf_frames_write(r->frames, frame->index, err);
}

static weft_status show_all(run *r, weft_error *err) {
    const wf_video_frame *frame;
    weft_status status = wf_video_next(r->video, &frame, err);
    if (!status && !frame)
        return wf_fail(err, WEFT_FAILED, "%.500s: there is no frame in it", r->job->inputs[0]);
    while (!status && frame) {
        status = show_frame(r, frame, err);
        if (!status) status = wf_video_next(r->video, &frame, err);
    }
    if (!status) status = wf_frames_commit(r->frames, err);
    if (!status) wf_setup_tell_sound(&r->setup);
    return status;
}

static void tell(const run *r, wf_report *report) {
    if (!r->frames) return; /* it did not get so far that there is anything to tell */
    report->frames = r->crew.done;
    report->fields = r->crew.done * wf_raster_fields_per_frame(&r->job->raster);
    report->color_s = wf_crew_times(&r->crew).color_s;
    report->legal = wf_setup_legal(r->job, &r->setup);
    wf_frames_tell(r->frames, report);
}

weft_status wf_broadcast_run(weft_job *job, const wf_broadcast *set, wf_report *report,
                             weft_error *err) {
    run r = {.job = job};
    wf_tv tv;
    weft_status status = wf_job_check(job, err);
    if (!status) status = wf_crew_new(job, 0, &r.crew, err);
    if (!status) status = refuse_linear(job, err);
    if (!status) status = open_video(&r, set, err);
    if (!status) status = settle_tv(job, set, &tv, err);
    if (!status) status = wf_job_check(job, err); /* the raster is known now */
    if (!status) status = make_coder(&r, &tv, err);
    if (!status) status = open_output(&r, set, err);
    if (!status) status = show_all(&r, err);
    tell(&r, report);
    release(&r);
    return status;
}
