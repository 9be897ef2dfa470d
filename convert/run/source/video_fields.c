/* Video as a source: which of its pictures are taken, when each is shown, and the fields that
 * see them. */
#include "convert/run/source/video_source.h"

#include <inttypes.h>
#include <stdlib.h>

#include "convert/base/range.h"
#include "convert/read/rate.h"
#include "convert/run/source/fitting.h"
#include "convert/run/time/picture_rate.h"
#include "convert/run/time/timecode_start.h"
#include "convert/video/rate.h"

/* Frames of a pipe before its end is met. */
#define ENDLESS_FRAMES (INT64_C(1) << 31)
/* ---- Which pictures ---- */

static weft_status select_pictures(const weft_job *job, wf_video_source *s, weft_error *err) {
    wf_frame_range range;
    wf_rational *numbers = NULL, step;
    weft_status status = wf_range_parse(job->frames, WF_RANGE_MOST, &range, err);
    if (!status) status = wf_range_numbers(&range, job->frames, &numbers, &step, err);
    s->count = range.count;
    bool whole = !status && range.runs == 1 && numbers[0].den == 1 && numbers[0].num >= 0 &&
                 step.den <= 1;
    if (whole) {
        s->picture = numbers[0].num;
        s->step = step.den ? step.num : 1;
    }
    free(numbers);
    wf_range_free(&range);
    if (status || whole) return status;
    return wf_fail(err, WEFT_USAGE,
                   "--frames %s: pictures of video are counted from 0, and one run of them is "
                   "taken, such as 0-99 or 0-99x2",
                   job->frames);
}

/* When pictures of a pipe are shown is known as they come, and so is how many frames they give;
 * what takes that number before has it by the stated rate. */
static void settle_limit(const weft_job *job, wf_video_source *s) {
    bool before = job->chunk_count > 1 || job->dry_run || job->resume;
    if (before || wf_ratio_given(job->subframe_rate) || !wf_ratio_given(s->info.tick_s)) return;
    s->limit = s->count;
    s->count = -1;
}

static weft_status settle_pictures(const weft_job *job, wf_video_source *s, weft_error *err) {
    int64_t there = s->info.frames;
    s->step = 1;
    s->count = there;
    if (!job->frames) return WEFT_OK;
    weft_status status = select_pictures(job, s, err);
    if (status) return status;
    int64_t last = s->picture + (s->count - 1) * s->step;
    if (there < 0) settle_limit(job, s);
    if (there < 0 || last < there) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE,
                   "%s: --frames %s, and its pictures are numbered 0 to %" PRId64, s->path,
                   job->frames, there - 1);
}

/* A file that was cut off has fewer pictures than it was to have; whoever names some of those
 * that are there, or what takes the place of others, knows it. */
static weft_status check_whole(const weft_job *job, wf_video_source *s, weft_error *err) {
    if (job->frames || job->output_end) return WEFT_OK;
    if (job->on_missing == WF_MISSING_ERROR) return wf_video_window_check_whole(s->window, err);
    (void)wf_video_window_check_whole(s->window, &s->cut);
    return WEFT_OK;
}

/* What cannot be done before the end is known. */
static weft_status check_pipe(const weft_job *job, const wf_video_source *s, weft_error *err) {
    const char *what = job->chunk_count > 1 ? "--chunk"
                       : job->dry_run       ? "--dry-run"
                       : job->resume        ? "--resume"
                                            : NULL;
    if (s->count >= 0 || !what) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE,
                   "%s: how many pictures it holds is known at its end only, and %s takes that "
                   "number; give --frames, such as 0-99, or a file",
                   s->path, what);
}

/* ---- Time ---- */

/* A rate of {0, 0} is none: pictures have times. */
static weft_status settle_rate(wf_run *run, wf_rational *rate, weft_error *err) {
    wf_video_source *s = run->source;
    bool given = wf_ratio_given(run->job->subframe_rate);
    char text[48] = "irregular";
    weft_status status = WEFT_OK;
    *rate = run->job->subframe_rate;
    s->keeps_rate = !given;
    if (!given) status = wf_video_rate(&s->info, s->path, rate, err);
    if (!status && !wf_ratio_given(*rate))
        status =
            wf_video_shown(&s->info, s->path, s->picture, s->step, s->count, &s->times_s, err);
    if (status) return status;
    if (!given && !s->times_s) *rate = wf_ratio_div(*rate, wf_ratio(s->step, 1));
    if (!s->times_s) wf_rate_text(*rate, text);
    wf_take(&run->report->taken, "rate", text, given ? "option" : "file");
    return WEFT_OK;
}

static weft_status make_edges(const wf_run *run, weft_error *err) {
    wf_video_source *s = run->source;
    char why[512];
    if (!s->times_s) return WEFT_OK;
    s->edges = calloc((size_t)s->count + 1, sizeof *s->edges);
    if (!s->edges) return wf_fail(err, WEFT_NO_MEMORY, "%s: no memory for its times", s->path);
    if (wf_timing_edges(&run->job->raster, s->times_s, s->count, run->job->subframe_time_center,
                        s->edges, why, sizeof why))
        return WEFT_OK;
    return wf_fail(err, WEFT_FAILED, "%s: %s", s->path, why);
}

/* When the first unit is shown, after the first picture of the video, whose pictures come
 * `rate` a second where they have no times. */
static wf_rational first_s(const wf_video_source *s, wf_rational rate) {
    const wf_video_info *info = &s->info;
    if (!s->times_s) return wf_ratio_div(wf_ratio(s->picture, s->step), rate);
    return wf_ratio_mul(wf_ratio(info->times[s->picture] - info->times[0], 1), info->tick_s);
}

/* When the selection begins on the clock of the file, which its sound keeps to, and how fast
 * its pictures are shown, `rate` units a second. */
static void settle_sound(wf_run *run, wf_rational rate) {
    const wf_video_source *s = run->source;
    wf_rational own =
        s->keeps_rate ? s->stated : wf_ratio_div(s->info.rate, wf_ratio(s->step, 1));
    if (!s->times_s && !(wf_ratio_given(own) && own.num > 0)) return;
    run->setup.sound_s = first_s(s, own);
    if (!s->times_s) run->setup.speed = wf_ratio_div(rate, own);
}

static double mean_rate(const wf_video_source *s, wf_rational rate) {
    return s->times_s ? (double)s->count / wf_ratio_value(s->times_s[s->count])
                      : wf_ratio_value(rate);
}

/* ---- Fields ---- */

static void describe_first(wf_video_source *s) {
    double aspect = wf_ratio_given(s->info.aspect) && s->info.aspect.num > 0
                        ? wf_ratio_value(s->info.aspect)
                        : 1;
    s->first = (wf_image_info){.display = {0, 0, s->info.width_px, s->info.lines},
                               .data = {0, 0, s->info.width_px, s->info.lines},
                               .pixel_aspect = aspect,
                               .rate = s->info.rate,
                               .frames = s->info.rate};
}

static void start_timecode(wf_run *run) {
    wf_video_source *s = run->source;
    wf_image_info *first = &s->first;
    bool told = wf_ratio_given(s->info.timecode_rate);
    snprintf(first->timecode, sizeof first->timecode, "%s", s->info.timecode);
    first->timecode_all = true;
    first->frames = told ? s->info.timecode_rate : s->info.rate;
    if (s->picture) wf_advance_timecode(run->job, first, first_s(s, s->stated));
    wf_start_timecode(run->job, &run->setup, first);
    if (*run->setup.timecode)
        wf_take(&run->report->taken, "timecode", run->setup.timecode, "file");
}

static wf_resample_desc describe_fields(const wf_run *run, wf_rational rate) {
    const weft_job *job = run->job;
    wf_video_source *s = run->source;
    wf_resample_desc desc = wf_describe_fields(
        job, &s->first, rate, s->count < 0 ? ENDLESS_FRAMES * WF_UNITS_TOGETHER : s->count);
    desc.timing.edges = s->edges;
    if (s->edges)
        desc.timing.shown =
            wf_ratio_div(s->times_s[s->count], wf_raster_field_period(&job->raster));
    desc.channels = s->channels;
    desc.floats = true;
    s->timing = desc.timing;
    return desc;
}

/* Only libav's pipes have timestamps. */
static weft_status await_times(const wf_run *run, weft_error *err) {
    wf_video_source *s = run->source;
    const wf_arrivals_desc desc = {.path = s->path,
                                   .rate = s->stated,
                                   .tick_s = s->info.tick_s,
                                   .period_s = wf_raster_field_period(&run->job->raster),
                                   .center = run->job->subframe_time_center};
    if (s->count >= 0 || !s->keeps_rate || !wf_ratio_given(desc.tick_s)) return WEFT_OK;
    return wf_arrivals_new(&desc, &s->arrivals, err);
}

weft_status wf_video_source_too_few(const wf_run *run, int64_t count, weft_error *err) {
    const wf_video_source *s = run->source;
    return wf_fail(err, WEFT_FAILED,
                   "%s: %" PRId64 " pictures, %.6g a second, do not fill one frame of %s",
                   s->path, count, mean_rate(s, s->timing.subframe_rate),
                   run->job->raster.name);
}

/* How many frames so many pictures give. */
int64_t wf_video_source_frames(const wf_video_source *s, int64_t pictures) {
    wf_timing_desc desc = s->timing;
    desc.subframes = pictures;
    if (desc.edges && s->arrivals) desc.shown = wf_arrivals_shown(s->arrivals, pictures);
    return pictures < 1 ? 0 : wf_timing_frames(&desc);
}

static weft_status settle_fields(wf_run *run, wf_rational rate, weft_error *err) {
    wf_video_source *s = run->source;
    int64_t frames = ENDLESS_FRAMES;
    weft_status status = make_edges(run, err);
    if (!status) status = await_times(run, err);
    if (status) return status;
    const wf_resample_desc desc = describe_fields(run, rate);
    if (s->count >= 0) frames = wf_video_source_frames(s, s->count);
    if (frames < 1) return wf_video_source_too_few(run, s->count, err);
    run->setup.endless = s->count < 0 && !run->job->output_end;
    return wf_fit_frames(run, &desc, frames, &s->end_field, &s->resampler, err);
}

weft_status wf_video_source_count(wf_run *run, weft_error *err) {
    wf_video_source *s = run->source;
    const weft_job *job = run->job;
    wf_rational rate = {0, 0};
    weft_status status = wf_video_source_light(run, err);
    if (!status) status = settle_pictures(job, s, err);
    if (!status) status = check_pipe(job, s, err);
    if (!status) status = check_whole(job, s, err);
    if (!status) status = settle_rate(run, &rate, err);
    s->stated = rate;
    if (!status && job->raster.pulldown) status = wf_settle_film(job, "pictures", &rate, err);
    if (status) return status;
    settle_sound(run, rate);
    describe_first(s);
    wf_warn_of_few(job, mean_rate(s, rate));
    status = settle_fields(run, rate, err);
    if (!status) start_timecode(run);
    return status;
}

wf_needs wf_video_source_needs(const wf_run *run, int64_t field) {
    const wf_video_source *s = run->source;
    wf_window window = wf_resampler_window(s->resampler, field);
    return (wf_needs){window.first, window.first + window.count};
}
