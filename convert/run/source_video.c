/* Progressive video as a source: a file that libav or weft reads, or a pipe. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/base/range.h"
#include "convert/media/kinds.h"
#include "convert/read/rate.h"
#include "convert/run/fitting.h"
#include "convert/run/time/picture_rate.h"
#include "convert/run/pictures.h"
#include "convert/run/time/timecode_start.h"
#include "convert/video/arrivals.h"
#include "convert/video/light.h"
#include "convert/video/rate.h"
#include "convert/video/window.h"

/* Frames of a pipe before its end is met, and fields that tell how windows overlap. */
#define ENDLESS_FRAMES   (INT64_C(1) << 31)
#define FIELDS_LOOKED_AT 65536

/* run->source */
typedef struct video_source {
    const char *path; /* the job's */
    wf_video_info info;
    wf_meaning meaning;
    wf_alpha alpha; /* how color lies beside it; unset: there is none */
    int channels;   /* of light: 4 with alpha */
    wf_light *light;
    wf_video_window *window;
    wf_aside ahead; /* decodes what the next units need while fields are summed */
    wf_row_maker maker;
    wf_source_options options; /* of no consequence: nothing is read from files */
    wf_image_info first;
    int64_t picture, step, count; /* unit u is picture + u step; count -1: not known yet */
    int64_t limit;                /* of a pipe: the units that --frames asks for; 0: all */
    wf_rational stated;           /* units a second, before film is slowed or sped */
    bool keeps_rate;              /* timestamps are held against the rate */
    int64_t first_ticks;          /* of a pipe: when picture 0 is shown */
    int64_t last_ticks, ends; /* when the last that was decoded is shown, and ends; 0: none */
    wf_arrivals *arrivals;    /* of a pipe that has timestamps, whose end is not known */
    wf_rational *times_s;     /* [count + 1], where pictures last unequally long */
    wf_rational *edges;       /* of these times; NULL: pictures have a rate */
    wf_timing_desc timing;
    wf_resampler *resampler;
    int64_t end_field;
    wf_rational *missing; /* numbers of pictures that are needed and could not be decoded */
    size_t missing_count;
    weft_error cut; /* what the file's structure says of its end, where that may be missing */
} video_source;

static weft_status takes(const weft_job *job, bool *takes, weft_error *err) {
    *takes = false;
    if (job->command != WF_CONVERT || !job->input_count) return WEFT_OK;
    return wf_video_is(job->inputs[0], takes, err);
}

static void close_input(wf_run *run) {
    video_source *s = run->source;
    if (!s) return;
    wf_aside_end(&s->ahead, NULL);
    wf_resampler_free(s->resampler);
    wf_video_window_free(s->window);
    wf_light_free(s->light);
    wf_arrivals_free(s->arrivals);
    free(s->times_s);
    free(s->edges);
    free(s->missing);
    free(s);
    run->source = NULL;
}

/* ---- What it is ---- */

static weft_status refuse_interlaced(const wf_run *run, weft_error *err) {
    const video_source *s = run->source;
    if (!s->info.interlaced || run->job->input_scan == WF_INPUT_PROGRESSIVE) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE,
                   "%s: it says that it is interlaced, and fields are made of progressive "
                   "pictures; deinterlace it first, such as with ffmpeg -i %s -vf "
                   "bwdif=mode=send_field -c:v ffv1 OUT.mkv, or where what it says is wrong "
                   "give --input-scan progressive",
                   s->path, s->path);
}

/* Guesses that can be wrong are told. */
static void tell_guess(const wf_run *run) {
    const video_source *s = run->source;
    const wf_meaning *m = &s->meaning;
    char space[128], curve[24];
    if (*m->colors.warning) wf_job_warn(run->job, "%s: %s", s->path, m->colors.warning);
    if (m->tagged || run->job->from) return;
    wf_file_colors_name(&m->colors, space, sizeof space);
    wf_job_warn(run->job,
                "%s: its colors are not all tagged: it is taken as %s (%s, %s range); --from "
                "says otherwise",
                s->path, space, wf_decoding_name(&m->colors.decoding, curve),
                m->full_range ? "full" : "narrow");
}

static bool has_alpha(const video_source *s) {
    return s->alpha == WF_ALPHA_STRAIGHT || s->alpha == WF_ALPHA_PREMULTIPLIED;
}

/* Alpha counts wherever there is some; it is delivered where something lies behind the
 * pictures, or it is written. */
static void find_alpha(wf_run *run) {
    const weft_job *job = run->job;
    video_source *s = run->source;
    s->alpha = wf_meaning_alpha(&s->info, job->alpha, &run->report->taken);
    s->channels =
        has_alpha(s) && (wf_job_shows_background(job) || wf_job_writes_alpha(job)) ? 4 : 3;
    if (s->info.alpha_lost && job->alpha != WF_ALPHA_IGNORED)
        wf_job_warn(job,
                    "%s: it has alpha, which this libavcodec does not decode: its pictures are "
                    "taken as they are, and --alpha ignore says that this is right",
                    s->path);
}

static void tell_others(const wf_run *run) {
    const video_source *s = run->source;
    if (s->info.videos > 1)
        wf_job_warn(
            run->job,
            "%s: it holds %d streams of video, and the first is taken; ffmpeg -i IN -map "
            "0:v:1 -c copy OUT.mkv makes a file of the second",
            s->path, s->info.videos);
}

/* What a tag of H.273 is that says nothing. */
enum { UNSAID = 2 };

/* --from counts whatever the stream says, and settles the matrix where that is not said; it is
 * looked up when the output is settled. */
static weft_status find_meaning(wf_run *run, weft_error *err) {
    video_source *s = run->source;
    bool said = s->info.tags.matrix != UNSAID || !run->job->from;
    if (!said) s->info.tags.matrix = wf_matrix_of_space(run->job->from);
    weft_status status = wf_meaning_of(&s->info, s->path, &s->meaning, err);
    if (status) return status;
    s->meaning.matrix_asked = !said && s->info.tags.matrix != UNSAID;
    wf_meaning_take(&s->meaning, &s->info, &run->report->taken);
    run->setup.decodes = true;
    find_alpha(run);
    tell_others(run);
    if (run->job->from) return WEFT_OK;
    if (*s->meaning.colors.trouble)
        return wf_fail(err, WEFT_USAGE, "%s: %s", s->path, s->meaning.colors.trouble);
    tell_guess(run);
    run->setup.scene_primaries = &s->meaning.colors.primaries;
    return WEFT_OK;
}

static weft_status make_light(wf_run *run, weft_error *err) {
    video_source *s = run->source;
    const wf_transform *decode = run->job->from ? &run->setup.decode : NULL;
    if (run->setup.from_curve) { /* as if the stream had said it, so that it is as quick */
        s->meaning.colors.decoding = wf_decoding_of(run->setup.from_curve);
        decode = NULL;
    }
    wf_setup_take_from(run->job, &run->setup, &run->report->taken);
    return wf_light_new(&s->info, &s->meaning, decode, &s->light, err);
}

static weft_status open_video(wf_run *run, weft_error *err) {
    video_source *s = run->source;
    wf_video *video;
    const wf_video_options options = {.max_memory_bytes = run->job->max_memory_bytes,
                                      .want_times = true,
                                      .codes_only = true,
                                      .want_alpha = run->job->alpha != WF_ALPHA_IGNORED,
                                      .progressive_only =
                                          run->job->input_scan != WF_INPUT_PROGRESSIVE,
                                      .mends = run->job->on_missing != WF_MISSING_ERROR};
    weft_status status = wf_video_open(s->path, &options, &video, err);
    if (status) return status;
    s->info = *wf_video_info_of(video);
    return wf_video_window_new(video, options.want_alpha, run->job->max_memory_bytes / 2,
                               &s->window, err);
}

static weft_status open_input(wf_run *run, weft_error *err) {
    const weft_job *job = run->job;
    video_source *s = run->source = calloc(1, sizeof *s);
    if (!s) return wf_fail(err, WEFT_NO_MEMORY, "no memory for the job");
    s->path = job->inputs[0];
    if (job->input_count > 1)
        return wf_fail(
            err, WEFT_USAGE,
            "%s is video, of which one file is taken at a time, and %s is given too; "
            "convert them one by one, or join them first",
            s->path, job->inputs[1]);
    weft_status status = wf_refuse_kind(s->path, err);
    if (!status) status = open_video(run, err);
    if (!status) status = refuse_interlaced(run, err);
    return status ? status : find_meaning(run, err);
}

/* ---- Which pictures ---- */

static weft_status select_pictures(const weft_job *job, video_source *s, weft_error *err) {
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
static void settle_limit(const weft_job *job, video_source *s) {
    bool before = job->chunk_count > 1 || job->dry_run || job->resume;
    if (before || wf_ratio_given(job->subframe_rate) || !wf_ratio_given(s->info.tick_s)) return;
    s->limit = s->count;
    s->count = -1;
}

static weft_status settle_pictures(const weft_job *job, video_source *s, weft_error *err) {
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
static weft_status check_whole(const weft_job *job, video_source *s, weft_error *err) {
    if (job->frames || job->output_end) return WEFT_OK;
    if (job->on_missing == WF_MISSING_ERROR) return wf_video_window_check_whole(s->window, err);
    (void)wf_video_window_check_whole(s->window, &s->cut);
    return WEFT_OK;
}

/* What cannot be done before the end is known. */
static weft_status check_pipe(const weft_job *job, const video_source *s, weft_error *err) {
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
    video_source *s = run->source;
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
    video_source *s = run->source;
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
static wf_rational first_s(const video_source *s, wf_rational rate) {
    const wf_video_info *info = &s->info;
    if (!s->times_s) return wf_ratio_div(wf_ratio(s->picture, s->step), rate);
    return wf_ratio_mul(wf_ratio(info->times[s->picture] - info->times[0], 1), info->tick_s);
}

/* When the selection begins on the clock of the file, which its sound keeps to, and how fast
 * its pictures are shown, `rate` units a second. */
static void settle_sound(wf_run *run, wf_rational rate) {
    const video_source *s = run->source;
    wf_rational own =
        s->keeps_rate ? s->stated : wf_ratio_div(s->info.rate, wf_ratio(s->step, 1));
    if (!s->times_s && !(wf_ratio_given(own) && own.num > 0)) return;
    run->setup.sound_s = first_s(s, own);
    if (!s->times_s) run->setup.speed = wf_ratio_div(rate, own);
}

static double mean_rate(const video_source *s, wf_rational rate) {
    return s->times_s ? (double)s->count / wf_ratio_value(s->times_s[s->count])
                      : wf_ratio_value(rate);
}

/* ---- Fields ---- */

static void describe_first(video_source *s) {
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
    video_source *s = run->source;
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
    video_source *s = run->source;
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
    video_source *s = run->source;
    const wf_arrivals_desc desc = {.path = s->path,
                                   .rate = s->stated,
                                   .tick_s = s->info.tick_s,
                                   .period_s = wf_raster_field_period(&run->job->raster),
                                   .center = run->job->subframe_time_center};
    if (s->count >= 0 || !s->keeps_rate || !wf_ratio_given(desc.tick_s)) return WEFT_OK;
    return wf_arrivals_new(&desc, &s->arrivals, err);
}

static weft_status too_few(const wf_run *run, int64_t count, weft_error *err) {
    const video_source *s = run->source;
    return wf_fail(err, WEFT_FAILED,
                   "%s: %" PRId64 " pictures, %.6g a second, do not fill one frame of %s",
                   s->path, count, mean_rate(s, s->timing.subframe_rate),
                   run->job->raster.name);
}

/* How many frames so many pictures give. */
static int64_t frames_of(const video_source *s, int64_t pictures) {
    wf_timing_desc desc = s->timing;
    desc.subframes = pictures;
    if (desc.edges && s->arrivals) desc.shown = wf_arrivals_shown(s->arrivals, pictures);
    return pictures < 1 ? 0 : wf_timing_frames(&desc);
}

static weft_status settle_fields(wf_run *run, wf_rational rate, weft_error *err) {
    video_source *s = run->source;
    int64_t frames = ENDLESS_FRAMES;
    char why[512];
    weft_status status = make_edges(run, err);
    if (!status) status = await_times(run, err);
    if (status) return status;
    const wf_resample_desc desc = describe_fields(run, rate);
    if (s->count >= 0) frames = frames_of(s, s->count);
    if (frames < 1) return too_few(run, s->count, err);
    run->setup.endless = s->count < 0 && !run->job->output_end;
    status = wf_setup_chosen_frames(run->job, &run->setup, frames, err);
    if (status) return status;
    s->end_field = frames * wf_raster_fields_per_frame(&run->job->raster);
    if (!wf_resampler_new(&desc, &s->resampler, why, sizeof why))
        return wf_fail(err, WEFT_FAILED, "%s", why);
    return WEFT_OK;
}

static weft_status count(wf_run *run, weft_error *err) {
    video_source *s = run->source;
    const weft_job *job = run->job;
    wf_rational rate = {0, 0};
    weft_status status = make_light(run, err);
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

static wf_needs needs(const wf_run *run, int64_t field) {
    const video_source *s = run->source;
    wf_window window = wf_resampler_window(s->resampler, field);
    return (wf_needs){window.first, window.first + window.count};
}

/* ---- Decoding ---- */

static weft_status ends_early(const video_source *s, int64_t unit, weft_error *err) {
    int64_t held = wf_video_window_end(s->window);
    double at_s = s->times_s ? wf_ratio_value(s->times_s[unit])
                             : (double)unit / wf_ratio_value(s->timing.subframe_rate);
    return wf_fail(err, WEFT_FAILED,
                   "%s: it ends after %" PRId64 " pictures, at %.3f s, and %" PRId64
                   " were expected; it was cut off, or --frames asks for more than there are",
                   s->path, held, at_s,
                   s->picture + ((s->limit ? s->limit : s->count) - 1) * s->step + 1);
}

/* Times that have come are those of windows from here on. */
static weft_status take_edges(video_source *s, weft_error *err) {
    int64_t pictures = wf_arrivals_count(s->arrivals);
    if (s->limit && pictures > s->limit) pictures = s->limit;
    s->timing.edges = wf_arrivals_edges(s->arrivals, &s->timing.edges_from);
    if (wf_resampler_set_edges(s->resampler, s->timing.edges, s->timing.edges_from, pictures))
        return WEFT_OK;
    return wf_fail(
        err, WEFT_FAILED,
        "%s: the times of its pictures, the temporal width and the scan skew are too "
        "fine to be counted exactly together; give them with fewer digits",
        s->path);
}

static weft_status tell_uneven(const wf_run *run, weft_error *err) {
    wf_rational film = {0, 0};
    wf_take(&run->report->taken, "rate", "irregular", "file");
    return run->job->raster.pulldown ? wf_settle_film(run->job, "pictures", &film, err)
                                     : WEFT_OK;
}

/* When the picture that was decoded last ends, which the next one may tell again. */
static void note_end(video_source *s, int64_t ticks, int64_t lasts) {
    if (!lasts) lasts = s->ends ? ticks - s->last_ticks : 1;
    s->last_ticks = ticks;
    s->ends = ticks + lasts;
}

/* Whether the picture that was decoded last, of any number, keeps to the stated rate. */
static bool in_step(video_source *s, int64_t ticks) {
    int64_t picture = wf_video_window_next(s->window) - 1;
    wf_rational rate = wf_ratio_mul(s->stated, wf_ratio(s->step, 1));
    if (!picture) s->first_ticks = ticks;
    return wf_video_in_step(&s->info, rate, picture, ticks - s->first_ticks);
}

static weft_status untimed(const video_source *s, weft_error *err) {
    return wf_fail(err, WEFT_FAILED,
                   "%s: picture %" PRId64 " does not say when it is shown; give "
                   "--subframe-rate to take all pictures as equally long",
                   s->path, wf_video_window_next(s->window) - 1);
}

/* When the picture that was decoded last is shown, of a pipe whose end is not known. */
static weft_status note_time(const wf_run *run, weft_error *err) {
    video_source *s = run->source;
    int64_t ticks = wf_video_window_ticks(s->window), lasts = wf_video_window_lasts(s->window);
    int64_t past = wf_video_window_next(s->window) - 1 - s->picture;
    bool was = wf_arrivals_uneven(s->arrivals);
    if (wf_video_window_end(s->window) >= 0) return WEFT_OK;
    if (ticks == INT64_MIN) return untimed(s, err);
    note_end(s, ticks, lasts);
    if (!in_step(s, ticks)) wf_arrivals_turn_uneven(s->arrivals);
    weft_status status =
        past < 0 || past % s->step ? WEFT_OK : wf_arrivals_add(s->arrivals, ticks, lasts, err);
    bool uneven = wf_arrivals_uneven(s->arrivals);
    if (!status && uneven && !was) status = tell_uneven(run, err);
    bool told = uneven && wf_arrivals_count(s->arrivals);
    return status || !told ? status : take_edges(s, err);
}

/* The timestamps of a file have been listed before; those of a pipe come with its pictures. */
static weft_status check_step(const wf_run *run, weft_error *err) {
    video_source *s = run->source;
    int64_t ticks = wf_video_window_ticks(s->window),
            picture = wf_video_window_next(s->window) - 1;
    if (s->arrivals) return note_time(run, err);
    if (s->info.frames >= 0 || !s->keeps_rate || ticks == INT64_MIN || picture < 0)
        return WEFT_OK;
    if (in_step(s, ticks)) return WEFT_OK;
    return wf_fail(err, WEFT_FAILED,
                   "%s: its pictures do not last equally long: number %" PRId64
                   ", at %.3f s, is out of step, which a pipe cannot tell before, and --chunk, "
                   "--resume and --dry-run count frames before; leave them out, write a file "
                   "first, or give --subframe-rate to take them as equally long",
                   s->path, picture,
                   (double)(ticks - s->first_ticks) * wf_ratio_value(s->info.tick_s));
}

/* Fewer pictures are sooner decoded than passed over. */
#define WORTH_A_JUMP 250

/* Where what follows is far ahead of what was decoded last, and always at first. */
static weft_status jump_to(video_source *s, int64_t number, weft_error *err) {
    int64_t next = wf_video_window_next(s->window);
    bool far = number - next > (next ? WORTH_A_JUMP : 0);
    return far && s->info.frames >= 0 ? wf_video_window_jump(s->window, number, err) : WEFT_OK;
}

/* Decodes up to and with a unit, and keeps it; those before it are kept from `keep` on. */
static weft_status decode_to(const wf_run *run, int64_t unit, int64_t keep, weft_error *err) {
    video_source *s = run->source;
    int64_t number = s->picture + unit * s->step;
    weft_status status = WEFT_OK;
    while (!status && wf_video_window_next(s->window) <= number &&
           wf_video_window_end(s->window) < 0) {
        int64_t next = wf_video_window_next(s->window) - s->picture;
        bool selected = next >= 0 && next % s->step == 0;
        bool kept = selected && (next / s->step >= keep || next / s->step == unit);
        status = wf_video_window_advance(s->window, kept, err);
        if (!status) status = check_step(run, err);
    }
    return status;
}

/* How many units there are, as far as is known. */
static int64_t units_read(const video_source *s) {
    int64_t past = wf_video_window_next(s->window) - s->picture;
    return past <= 0 ? 0 : (past + s->step - 1) / s->step;
}

/* The unit after the last that is asked for has told already how long that is shown. */
static weft_status end_times(video_source *s, weft_error *err) {
    if (!s->arrivals || !units_read(s)) return WEFT_OK;
    if (s->limit && units_read(s) > s->limit) return WEFT_OK;
    if (s->step > 1) wf_arrivals_last_until(s->arrivals, s->ends);
    weft_status status = wf_arrivals_end(s->arrivals, err);
    return status || !wf_arrivals_uneven(s->arrivals) ? status : take_edges(s, err);
}

static weft_status meet_end(wf_run *run, weft_error *err) {
    video_source *s = run->source;
    weft_status status = end_times(s, err);
    if (status) return status;
    int64_t units = units_read(s);
    if (s->limit && units < s->limit) return ends_early(s, units, err);
    s->timing.subframes = s->count = s->limit ? s->limit : units;
    int64_t frames = frames_of(s, s->count);
    if (frames < 1) return too_few(run, s->count, err);
    wf_resampler_set_end(s->resampler, s->count);
    if (frames < run->setup.end_frame && !run->setup.endless)
        return wf_fail(err, WEFT_FAILED,
                       "%s: it ends after %" PRId64 " frames, and "
                       "--output-frames asks for %" PRId64,
                       s->path, frames, run->setup.end_frame);
    if (frames < run->setup.end_frame) run->setup.end_frame = frames;
    return WEFT_OK;
}

/* The first unit that a field or a later one sees, as far as is known: the one that was read
 * last may be shown for long. */
static int64_t first_seen(const wf_run *run, int64_t field) {
    const video_source *s = run->source;
    int64_t first = needs(run, field).first, last = units_read(s) - 1;
    return s->arrivals && s->count < 0 && first > last ? last : first;
}

/* Forgets the units that neither fields from this one on see nor later ones. */
static void forget_before(video_source *s, int64_t unit) {
    wf_video_window_forget(s->window, s->picture + unit * s->step);
    if (!s->arrivals || unit < 1) return;
    wf_arrivals_forget(s->arrivals, unit - 1);
    if (wf_arrivals_uneven(s->arrivals)) (void)take_edges(s, NULL); /* which have moved */
}

/* Of a pipe it reads all that these fields see, and so much that they are known to be part of a
 * frame that is there; and one more where that tells how long the last is shown. */
static weft_status ready(wf_run *run, int64_t field, weft_error *err) {
    video_source *s = run->source;
    int per_frame = wf_raster_fields_per_frame(&run->job->raster);
    int64_t frames = (field + per_frame - 1) / per_frame;
    weft_status status = wf_aside_end(&s->ahead, err);
    while (!status && s->count < 0) {
        int64_t read = units_read(s), sure = s->arrivals ? read - 1 : read;
        if (s->limit && read > s->limit) return meet_end(run, err);
        if (sure >= needs(run, field - 1).end && frames_of(s, sure) >= frames) break;
        int64_t keep = first_seen(run, run->setup.first_frame * per_frame);
        wf_video_window_forget(s->window, s->picture + keep * s->step);
        status = decode_to(run, read, keep, err);
        if (!status && wf_video_window_end(s->window) >= 0) return meet_end(run, err);
    }
    if (s->arrivals) wf_arrivals_decide(s->arrivals);
    return status;
}

/* After the last picture of a file, which tells whether the file is whole. */
static weft_status check_end(const video_source *s, weft_error *err) {
    bool last = wf_video_window_next(s->window) == s->info.frames;
    return last ? wf_video_window_advance(s->window, false, err) : WEFT_OK;
}

static weft_status read_ahead(void *window, weft_error *err) {
    (void)err; /* the window tells when the picture's turn comes */
    wf_video_window_read_ahead(window);
    return WEFT_OK;
}

/* As many pictures again as these units took, but none that no field of the run needs, where
 * their times tell. */
static void begin_ahead(const wf_run *run, const wf_units *units) {
    video_source *s = run->source;
    int64_t fields = run->setup.end_frame * wf_raster_fields_per_frame(&run->job->raster);
    bool told = s->count >= 0 || !s->arrivals;
    int64_t next = wf_video_window_next(s->window), count = units->count * s->step;
    int64_t past = told ? s->picture + needs(run, fields - 1).end * s->step : INT64_MAX;
    if (count > past - next) count = past - next;
    if (count < 1) return;
    wf_video_window_plan_ahead(s->window, count > 100 ? 100 : (int)count);
    wf_aside_begin(&s->ahead, read_ahead, s->window);
}

/* Units come in ascending order, some of them for several groups. */
static weft_status note_missing(video_source *s, int64_t unit, weft_error *err) {
    int64_t number = s->picture + unit * s->step;
    size_t count = s->missing_count;
    bool told = count && s->missing[count - 1].num >= number;
    if (told || !wf_video_window_lacks(s->window, number)) return WEFT_OK;
    wf_rational *grown = realloc(s->missing, (count + 1) * sizeof *grown);
    if (!grown) return wf_fail(err, WEFT_NO_MEMORY, "no memory for numbers");
    s->missing = grown;
    s->missing[s->missing_count++] = wf_ratio(number, 1);
    return WEFT_OK;
}

/* Pictures are forgotten that neither these units are nor a later field needs: where fields are
 * not carried, and where frames are left out, what follows may see some of them again. */
static weft_status prepare(const wf_run *run, const wf_units *units, weft_error *err) {
    video_source *s = run->source;
    int64_t later = first_seen(run, units->group_end), first = units->unit[0];
    bool again = !run->pace.fields_carried || run->job->resume;
    wf_aside_end(&s->ahead, NULL);
    int64_t keep = again ? later : INT64_MAX;
    int64_t needed = first < keep ? first : keep;
    forget_before(s, needed);
    weft_status status = jump_to(s, s->picture + needed * s->step, err);
    for (int i = 0; !status && i < units->count; i++) {
        status = decode_to(run, units->unit[i], keep, err);
        bool met = wf_video_window_end(s->window) >= 0;
        if (!status && met && units_read(s) <= units->unit[i])
            status = ends_early(s, units->unit[i], err);
        if (!status) status = note_missing(s, units->unit[i], err);
    }
    if (!status) status = check_end(s, err);
    if (!status) begin_ahead(run, units);
    return status;
}

/* ---- Pictures ---- */

typedef struct shown {
    const wf_light *light;
    const video_source *source;
    const void *plane[4];
} shown;

/* Alpha has codes of full range. */
static void take_alpha(const shown *p, int y0, int y1, float *to) {
    const wf_video_info *info = &p->source->info;
    size_t width = (size_t)info->width_px, at = (size_t)y0 * width;
    size_t count = (size_t)(y1 - y0) * width;
    const uint8_t *bytes = (const uint8_t *)p->plane[3] + at;
    const uint16_t *pairs = (const uint16_t *)p->plane[3] + at;
    const float most = (float)((1 << info->bits) - 1);
    bool narrow = wf_video_code_bytes(info) == 1;
    for (size_t i = 0; i < count; i++) to[i] = (narrow ? bytes[i] : pairs[i]) / most;
}

static void multiply(float *const rgb[], const float *alpha, size_t count) {
    for (int c = 0; c < 3; c++)
        for (size_t i = 0; i < count; i++) rgb[c][i] *= alpha[i];
}

/* Alpha that is not delivered is made after the scratch of light. */
static void make_rows_with_alpha(const shown *p, int y0, int y1, void *scratch,
                                 float *const rgb[]) {
    const video_source *s = p->source;
    float *own = (float *)(void *)((char *)scratch + wf_light_scratch(p->light));
    float *alpha = s->channels == 4 ? rgb[3] : own;
    take_alpha(p, y0, y1, alpha);
    if (s->alpha == WF_ALPHA_PREMULTIPLIED) {
        wf_light_rows_multiplied(p->light, p->plane, y0, y1, scratch, alpha, rgb);
        return;
    }
    wf_light_rows(p->light, p->plane, y0, y1, scratch, rgb);
    multiply(rgb, alpha, (size_t)(y1 - y0) * (size_t)s->info.width_px);
}

static void make_rows(const void *picture, int y0, int y1, void *scratch, float *const rgb[]) {
    const shown *p = picture;
    if (has_alpha(p->source))
        make_rows_with_alpha(p, y0, y1, scratch, rgb);
    else
        wf_light_rows(p->light, p->plane, y0, y1, scratch, rgb);
}

static weft_status open_picture(const wf_run *run, int64_t k, wf_subframe **out,
                                weft_error *err) {
    const video_source *s = run->source;
    bool black = run->job->on_missing == WF_MISSING_BLACK;
    if (black && wf_video_window_lacks(s->window, s->picture + k * s->step)) return WEFT_OK;
    shown *p = calloc(1, sizeof *p);
    if (!p) return wf_fail(err, WEFT_NO_MEMORY, "no memory for a picture");
    p->light = s->light;
    p->source = s;
    if (!wf_video_window_find(s->window, s->picture + k * s->step, p->plane)) {
        free(p);
        return wf_fail(err, WEFT_FAILED, "%s: picture %" PRId64 " has passed", s->path, k);
    }
    return wf_subframe_made(&s->maker, p, s->info.width_px, s->info.lines, out, err);
}

static bool same(const wf_run *run, int64_t a, int64_t b) {
    (void)run;
    return a == b;
}

/* Pictures in memory at once, as codes. */
#define MOST_BYTES ((size_t)64 << 20)
/* Of sums that are carried: codes are smaller, and soon made light again. */
#define CARRIED_BYTES ((size_t)48 << 20)

static int open_together(const video_source *s) {
    size_t pictures = MOST_BYTES / wf_video_window_picture_bytes(s->window);
    return pictures < 1 ? 1 : pictures > WF_UNITS_TOGETHER ? WF_UNITS_TOGETHER : (int)pictures;
}

static wf_picture_desc describe(const wf_run *run) {
    video_source *s = run->source;
    int64_t looked_at = s->end_field < FIELDS_LOOKED_AT ? s->end_field : FIELDS_LOOKED_AT;
    size_t alpha = (size_t)WF_LIGHT_ROWS * (size_t)s->info.width_px * sizeof(float);
    s->maker = (wf_row_maker){wf_light_scratch(s->light) + (has_alpha(s) ? alpha : 0),
                              WF_LIGHT_ROWS, s->channels, make_rows, free};
    return (wf_picture_desc){
        s->resampler, &s->options,         open_together(s),
        looked_at,    s->arrivals != NULL, CARRIED_BYTES,
    };
}

static void tell_missing(const wf_run *run, const wf_video_troubles *troubles) {
    const video_source *s = run->source;
    const char *instead =
        run->job->on_missing == WF_MISSING_HOLD ? "their neighbors are held" : "they are black";
    size_t count = s->missing_count;
    if (!count && !troubles->cut && !*s->cut.text) return;
    run->report->degraded = true;
    wf_job_warn(run->job, "%s", *troubles->missing.text ? troubles->missing.text : s->cut.text);
    if (count)
        wf_job_warn(run->job, "%s: %zu picture%s missing, the first is %" PRId64 ": %s",
                    s->path, count, count == 1 ? " is" : "s are", s->missing[0].num, instead);
}

static void tell_troubles(const wf_run *run, const wf_video_troubles *troubles) {
    const video_source *s = run->source;
    tell_missing(run, troubles);
    if (troubles->complaints && !s->missing_count)
        wf_job_warn(run->job,
                    "%s: its decoder complained %" PRId64
                    " time%s, first about picture %" PRId64
                    ", and went on: look whether it shows what it should",
                    s->path, troubles->complaints, troubles->complaints == 1 ? "" : "s",
                    troubles->complained_at);
}

static void tell(const wf_run *run, wf_report *report) {
    video_source *s = run->source;
    report->listed = s->count < 0 ? 0 : s->count;
    if (run->finished && s->window) tell_troubles(run, wf_video_window_troubles(s->window));
    report->missing = s->missing;
    report->missing_count = s->missing_count;
    s->missing = NULL; /* the report's now */
}

static const wf_picture_reading reading = {
    .describe = describe,
    .prepare = prepare,
    .open = open_picture,
    .same = same,
};

const wf_source_kind wf_source_video = {
    .name = "video",
    .takes = takes,
    .open = open_input,
    .count = count,
    .ready = ready,
    .needs = needs,
    .summing = &wf_summing_pictures,
    .pictures = &reading,
    .tell = tell,
    .close = close_input,
};
