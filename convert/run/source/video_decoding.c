/* Video as a source: pictures are decoded in the order of time, held against their rate, and
 * the end is met. */
#include "convert/run/source/video_source.h"

#include <inttypes.h>
#include <stdlib.h>

#include "convert/run/time/picture_rate.h"
#include "convert/video/rate.h"
/* ---- Decoding ---- */

static weft_status ends_early(const wf_video_source *s, int64_t unit, weft_error *err) {
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
static weft_status take_edges(wf_video_source *s, weft_error *err) {
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
static void note_end(wf_video_source *s, int64_t ticks, int64_t lasts) {
    if (!lasts) lasts = s->ends ? ticks - s->last_ticks : 1;
    s->last_ticks = ticks;
    s->ends = ticks + lasts;
}

/* Whether the picture that was decoded last, of any number, keeps to the stated rate. */
static bool in_step(wf_video_source *s, int64_t ticks) {
    int64_t picture = wf_video_window_next(s->window) - 1;
    wf_rational rate = wf_ratio_mul(s->stated, wf_ratio(s->step, 1));
    if (!picture) s->first_ticks = ticks;
    return wf_video_in_step(&s->info, rate, picture, ticks - s->first_ticks);
}

static weft_status untimed(const wf_video_source *s, weft_error *err) {
    return wf_fail(err, WEFT_FAILED,
                   "%s: picture %" PRId64 " does not say when it is shown; give "
                   "--subframe-rate to take all pictures as equally long",
                   s->path, wf_video_window_next(s->window) - 1);
}

/* When the picture that was decoded last is shown, of a pipe whose end is not known. */
static weft_status note_time(const wf_run *run, weft_error *err) {
    wf_video_source *s = run->source;
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
    wf_video_source *s = run->source;
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
static weft_status jump_to(wf_video_source *s, int64_t number, weft_error *err) {
    int64_t next = wf_video_window_next(s->window);
    bool far = number - next > (next ? WORTH_A_JUMP : 0);
    return far && s->info.frames >= 0 ? wf_video_window_jump(s->window, number, err) : WEFT_OK;
}

/* Decodes up to and with a unit, and keeps it; those before it are kept from `keep` on. */
static weft_status decode_to(const wf_run *run, int64_t unit, int64_t keep, weft_error *err) {
    wf_video_source *s = run->source;
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
static int64_t units_read(const wf_video_source *s) {
    int64_t past = wf_video_window_next(s->window) - s->picture;
    return past <= 0 ? 0 : (past + s->step - 1) / s->step;
}

/* The unit after the last that is asked for has told already how long that is shown. */
static weft_status end_times(wf_video_source *s, weft_error *err) {
    if (!s->arrivals || !units_read(s)) return WEFT_OK;
    if (s->limit && units_read(s) > s->limit) return WEFT_OK;
    if (s->step > 1) wf_arrivals_last_until(s->arrivals, s->ends);
    weft_status status = wf_arrivals_end(s->arrivals, err);
    return status || !wf_arrivals_uneven(s->arrivals) ? status : take_edges(s, err);
}

static weft_status meet_end(wf_run *run, weft_error *err) {
    wf_video_source *s = run->source;
    weft_status status = end_times(s, err);
    if (status) return status;
    int64_t units = units_read(s);
    if (s->limit && units < s->limit) return ends_early(s, units, err);
    s->timing.subframes = s->count = s->limit ? s->limit : units;
    int64_t frames = wf_video_source_frames(s, s->count);
    if (frames < 1) return wf_video_source_too_few(run, s->count, err);
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
    const wf_video_source *s = run->source;
    int64_t first = wf_video_source_needs(run, field).first, last = units_read(s) - 1;
    return s->arrivals && s->count < 0 && first > last ? last : first;
}

/* Forgets the units that neither fields from this one on see nor later ones. */
static void forget_before(wf_video_source *s, int64_t unit) {
    wf_video_window_forget(s->window, s->picture + unit * s->step);
    if (!s->arrivals || unit < 1) return;
    wf_arrivals_forget(s->arrivals, unit - 1);
    if (wf_arrivals_uneven(s->arrivals)) (void)take_edges(s, NULL); /* which have moved */
}

/* Of a pipe it reads all that these fields see, and so much that they are known to be part of a
 * frame that is there; and one more where that tells how long the last is shown. */
weft_status wf_video_source_ready(wf_run *run, int64_t field, weft_error *err) {
    wf_video_source *s = run->source;
    int per_frame = wf_raster_fields_per_frame(&run->job->raster);
    int64_t frames = (field + per_frame - 1) / per_frame;
    weft_status status = wf_aside_end(&s->ahead, err);
    while (!status && s->count < 0) {
        int64_t read = units_read(s), sure = s->arrivals ? read - 1 : read;
        if (s->limit && read > s->limit) return meet_end(run, err);
        if (sure >= wf_video_source_needs(run, field - 1).end &&
            wf_video_source_frames(s, sure) >= frames)
            break;
        int64_t keep = first_seen(run, run->setup.first_frame * per_frame);
        wf_video_window_forget(s->window, s->picture + keep * s->step);
        status = decode_to(run, read, keep, err);
        if (!status && wf_video_window_end(s->window) >= 0) return meet_end(run, err);
    }
    if (s->arrivals) wf_arrivals_decide(s->arrivals);
    return status;
}

/* After the last picture of a file, which tells whether the file is whole. */
static weft_status check_end(const wf_video_source *s, weft_error *err) {
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
    wf_video_source *s = run->source;
    int64_t fields = run->setup.end_frame * wf_raster_fields_per_frame(&run->job->raster);
    bool told = s->count >= 0 || !s->arrivals;
    int64_t next = wf_video_window_next(s->window), count = units->count * s->step;
    int64_t past =
        told ? s->picture + wf_video_source_needs(run, fields - 1).end * s->step : INT64_MAX;
    if (count > past - next) count = past - next;
    if (count < 1) return;
    wf_video_window_plan_ahead(s->window, count > 100 ? 100 : (int)count);
    wf_aside_begin(&s->ahead, read_ahead, s->window);
}

/* Units come in ascending order, some of them for several groups. */
static weft_status note_missing(wf_video_source *s, int64_t unit, weft_error *err) {
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
weft_status wf_video_source_prepare(const wf_run *run, const wf_units *units, weft_error *err) {
    wf_video_source *s = run->source;
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
