/* One pass over a video, frame by frame, through every measurement. */
#include "convert/check/measure.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "convert/base/clock.h"
#include "convert/check/measure_difference.h"
#include "convert/check/measure_flicker.h"
#include "convert/check/measurement.h"

static const wf_measurement *const measurements[] = {
    &wf_measure_sharpness, &wf_measure_composite, &wf_measure_order, &wf_measure_legal};

#define MEASUREMENTS (sizeof measurements / sizeof *measurements)
#define DELIVERY     2 /* index of the first that a delivery is held to: order and legality */

typedef struct measuring {
    const char *path;
    const wf_measure_options *options;
    bool deinterlaces; /* the display does */
    wf_video *video, *reference;
    wf_signals *signals;
    wf_signal *signal[2]; /* [frame % 2]: of this frame and of the one before */
    size_t first;         /* of the measurements that are made */
    void *state[MEASUREMENTS];
    wf_difference *difference;
    /* Of a display that deinterlaces: what makes signals of the reference's frames, which are
     * as many as fields. */
    wf_signals *reference_signals;
    wf_signal *reference_signal;
    int64_t references; /* frames of it that have been compared */
    wf_screen *screen;  /* NULL, as are the next two, where only a delivery is looked at */
    wf_flicker *flicker;
    wf_crawl *crawl; /* NULL: fields have no order in time */
    int64_t frames;
    double began_s;
} measuring;

static weft_status check_lines(const char *path, const wf_video_info *info, weft_error *err) {
    if (info->lines % 2 == 0) return WEFT_OK;
    return wf_fail(err, WEFT_FAILED,
                   "%s: its pictures have %d lines, an odd number; two fields need an even one",
                   path, info->lines);
}

/* A reference of what is shown has a frame a field. */
static weft_status check_rate(const measuring *m, weft_error *err) {
    const wf_video_info *a = wf_video_info_of(m->video), *b = wf_video_info_of(m->reference);
    double fields = 2 * wf_ratio_value(a->raster.frame_rate);
    double frames = wf_ratio_value(b->raster.frame_rate);
    if (!m->deinterlaces || fabs(frames / fields - 1) < 0.001) return WEFT_OK;
    return wf_fail(
        err, WEFT_USAGE,
        "%s: a reference of what --display %s shows has %.6g frames a second, one for "
        "each field of %s, and this has %.6g; render it on a progressive raster of "
        "that rate, or leave --display out to compare frames as they are coded",
        m->options->against, wf_display_name(m->options->display), fields, m->path, frames);
}

static weft_status check_planes(const measuring *m, weft_error *err) {
    const wf_video_info *a = wf_video_info_of(m->video), *b = wf_video_info_of(m->reference);
    if (a->width_px != b->width_px || a->lines != b->lines)
        return wf_fail(err, WEFT_USAGE, "%s is %dx%d and %s, its reference, %dx%d", m->path,
                       a->width_px, a->lines, m->options->against, b->width_px, b->lines);
    if (a->layout != b->layout || a->planes != b->planes || a->across != b->across ||
        a->down != b->down)
        return wf_fail(err, WEFT_USAGE,
                       "%s is %s and %s, its reference, %s: planes differ; convert one of them",
                       m->path, a->format, m->options->against, b->format);
    return WEFT_OK;
}

static weft_status open_reference(measuring *m, weft_error *err) {
    const wf_video_options options = {.raster = m->deinterlaces ? NULL : m->options->raster,
                                      .max_memory_bytes = m->options->max_memory_bytes};
    if (!m->options->against) return WEFT_OK;
    weft_status status = wf_video_open(m->options->against, &options, &m->reference, err);
    if (!status) status = check_planes(m, err);
    if (!status) status = check_rate(m, err);
    if (!status && m->deinterlaces)
        status = wf_signals_new(wf_video_info_of(m->reference), &m->reference_signals, err);
    if (!status && m->deinterlaces)
        status = wf_signal_new(m->reference_signals, &m->reference_signal, err);
    if (status) return status;
    const wf_video_info *shown = m->screen ? wf_screen_info(m->screen) : NULL;
    m->difference = wf_difference_new(shown ? shown : wf_video_info_of(m->video));
    return m->difference ? WEFT_OK : wf_fail(err, WEFT_NO_MEMORY, "out of memory");
}

static int threads_of(const measuring *m) {
    return m->options->crew ? m->options->crew->threads : 1;
}

/* What is shown takes about so many floats a pixel besides what frames and signals take, and
 * each thread some tiles of a few lines. */
static weft_status check_memory(const measuring *m, weft_error *err) {
    const wf_video_info *info = wf_video_info_of(m->video);
    double floats = m->deinterlaces ? 54 : 38;
    double bytes = floats * sizeof(float) * info->width_px * info->lines;
    bytes += 160.0 * sizeof(float) * info->width_px * threads_of(m);
    if (bytes <= (double)m->options->max_memory_bytes) return WEFT_OK;
    return wf_fail(
        err, WEFT_NO_MEMORY,
        "%s: measuring frames of %dx%d takes %.0f MB, and --max-memory allows %zu MB; "
        "allow more",
        m->path, info->width_px, info->lines, bytes / (1 << 20),
        m->options->max_memory_bytes >> 20);
}

static weft_status begin_screen(measuring *m, weft_error *err) {
    const wf_video_info *info = wf_video_info_of(m->video);
    if (m->options->of_delivery) return WEFT_OK;
    weft_status status = check_memory(m, err);
    if (!status) status = wf_screen_new(info, m->options->display, &m->screen, err);
    if (status) return status;
    bool drifts = info->raster.scan == WF_INTERLACED && info->scan_known;
    m->flicker = wf_flicker_new(info, m->options, threads_of(m));
    m->crawl = drifts ? wf_crawl_new(info, m->options, threads_of(m)) : NULL;
    if (m->flicker && (m->crawl || !drifts)) return WEFT_OK;
    return wf_fail(err, WEFT_NO_MEMORY, "%s: out of memory", m->path);
}

static weft_status begin(measuring *m, weft_error *err) {
    const wf_video_options options = {.raster = m->options->raster,
                                      .transfer = m->options->transfer,
                                      .max_memory_bytes = m->options->max_memory_bytes};
    weft_status status = wf_video_open(m->path, &options, &m->video, err);
    if (status) return status;
    const wf_video_info *info = wf_video_info_of(m->video);
    m->deinterlaces = m->options->display >= WF_DISPLAY_BWDIF;
    status = check_lines(m->path, info, err);
    if (!status) status = begin_screen(m, err);
    if (!status) status = open_reference(m, err);
    if (!status) status = wf_signals_new(info, &m->signals, err);
    for (int i = 0; i < 2 && !status; i++)
        status = wf_signal_new(m->signals, &m->signal[i], err);
    for (size_t i = m->first; i < MEASUREMENTS && !status; i++) {
        m->state[i] = measurements[i]->begin(info, m->options);
        if (!m->state[i]) status = wf_fail(err, WEFT_NO_MEMORY, "%s: out of memory", m->path);
    }
    return status;
}

/* Takes the reference's next frame, which has to be there exactly if a picture is. */
static weft_status next_reference(measuring *m, bool there, const wf_video_frame **reference,
                                  weft_error *err) {
    weft_status status = wf_video_next(m->reference, reference, err);
    if (status) return status;
    if (there != !!*reference)
        return wf_fail(err, WEFT_FAILED,
                       "%s has %s %s than %s, its reference, has frames (%" PRId64 ")", m->path,
                       there ? "more" : "fewer", m->deinterlaces ? "fields" : "frames",
                       m->options->against, m->references);
    m->references += there;
    return WEFT_OK;
}

/* Compares a frame as it is coded; NULL: there are no more. */
static weft_status compare(measuring *m, const wf_video_frame *frame, weft_error *err) {
    const wf_video_frame *reference;
    if (!m->reference || m->deinterlaces) return WEFT_OK;
    weft_status status = next_reference(m, frame, &reference, err);
    if (!status && frame) wf_difference_add(m->difference, frame, reference);
    return status;
}

/* Compares the two pictures that a frame was deinterlaced to. Linear light is compared as it is
 * encoded. */
static weft_status compare_shown(measuring *m, const wf_shown *shown, weft_error *err) {
    const wf_video_frame *reference;
    if (!m->reference || !m->deinterlaces) return WEFT_OK;
    weft_status status = WEFT_OK;
    for (int k = 0; k < 2 && !status; k++) {
        status = next_reference(m, true, &reference, err);
        if (status) break;
        if (wf_video_info_of(m->reference)->layout == WF_LINEAR) {
            wf_signals_take(m->reference_signals, reference, m->reference_signal);
            reference = &m->reference_signal->coded;
        }
        wf_difference_add(m->difference, shown->picture[k], reference);
    }
    return status;
}

/* ---- One frame ---- */

/* What is done at once of a frame that has been read, and of the one that is shown, which may
 * be the one before it. NULL: there is none. Each of what is found and counted has a state of
 * its own, so that threads may share these out; what is seen they share out by pieces. */
typedef struct step {
    measuring *m;
    const wf_signal *read, *before;
    const wf_signal *frame, *other; /* other: the one whose content is compared */
    const wf_shown *shown;
    wf_seen *seen[2]; /* of flicker and of crawl, what has begun */
} step;

static void each(step *s, int count, wf_crew_work *work) {
    wf_worker alone = {0};
    if (s->m->options->crew)
        wf_crew_each(s->m->options->crew, count, 1, work, s);
    else
        for (int n = 0; n < count; n++) work(s, &alone, n);
}

/* What takes longest comes first. */
static void find_one(void *user, wf_worker *worker, int n) {
    const step *s = user;
    size_t kind = s->m->first + (size_t)n - 2;
    (void)worker;
    if (n == 0 && s->m->crawl && s->shown) wf_crawl_find(s->m->crawl, s->frame, s->shown);
    if (n == 1 && s->m->flicker && s->shown)
        wf_flicker_find(s->m->flicker, s->frame, s->other, s->shown);
    if (n >= 2 && s->read) measurements[kind]->add(s->m->state[kind], s->read, s->before);
}

/* Calls a function of the one or the other of what is seen, for piece n of both. */
static void do_piece(const step *s, const wf_worker *worker, int n,
                     int (*count)(const wf_seen *seen),
                     void (*piece)(wf_seen *seen, int worker, int n)) {
    int first = s->seen[0] ? count(s->seen[0]) : 0;
    if (n < first)
        piece(s->seen[0], worker->number, n);
    else
        piece(s->seen[1], worker->number, n - first);
}

static int count_pieces(const step *s, int (*count)(const wf_seen *seen)) {
    return (s->seen[0] ? count(s->seen[0]) : 0) + (s->seen[1] ? count(s->seen[1]) : 0);
}

static void prepare_one(void *user, wf_worker *worker, int n) {
    do_piece(user, worker, n, wf_seen_preparations, wf_seen_prepare);
}

static void see_one(void *user, wf_worker *worker, int n) {
    do_piece(user, worker, n, wf_seen_tiles, wf_seen_tile);
}

static void count_one(void *user, wf_worker *worker, int n) {
    const step *s = user;
    (void)worker;
    if (n == 0 && s->m->crawl) wf_crawl_count(s->m->crawl);
    if (n == 1) wf_flicker_count(s->m->flicker);
}

/* Measures a frame that has been read, and shows `frame`, which it follows. */
static weft_status measure_frame(measuring *m, step s, weft_error *err) {
    weft_status status = WEFT_OK;
    s.m = m;
    if (m->screen) status = wf_screen_show(m->screen, s.frame, s.read, &s.shown, err);
    if (status) return status;
    each(&s, 2 + (int)(MEASUREMENTS - m->first), find_one);
    if (!s.shown) return WEFT_OK;
    s.seen[0] = wf_flicker_begun(m->flicker);
    s.seen[1] = m->crawl ? wf_crawl_begun(m->crawl) : NULL;
    each(&s, count_pieces(&s, wf_seen_preparations), prepare_one);
    each(&s, count_pieces(&s, wf_seen_tiles), see_one);
    each(&s, 2, count_one);
    return compare_shown(m, s.shown, err);
}

/* ---- All frames ---- */

static wf_signal *signal_of(const measuring *m, int64_t frame) {
    return frame < 0 ? NULL : m->signal[frame % 2];
}

/* Frames that will be measured; 0: it is not known. */
static int64_t frames_in_all(const measuring *m) {
    int64_t asked = m->options->frame_count, there = wf_video_info_of(m->video)->frames;
    if (there > 0)
        there = there > m->options->first_frame ? there - m->options->first_frame : 0;
    return there > 0 && (!asked || there < asked) ? there : asked;
}

static void show_progress(const measuring *m, int64_t done) {
    const weft_progress progress = {.frames_done = done,
                                    .frames_total = frames_in_all(m),
                                    .seconds = wf_now_s() - m->began_s,
                                    .stage = m->options->stage ? m->options->stage : "measure"};
    if (m->options->progress) m->options->progress(&progress, m->options->progress_user);
}

/* The next frame of those that are asked for; NULL after them. */
static weft_status next_frame(measuring *m, const wf_video_frame **frame, weft_error *err) {
    int64_t first = m->options->first_frame, count = m->options->frame_count;
    if (count && m->frames == count) {
        *frame = NULL;
        return WEFT_OK;
    }
    weft_status status = WEFT_OK;
    do status = wf_video_next(m->video, frame, err);
    while (!status && *frame && (*frame)->index < first);
    return status;
}

static weft_status measure_frames(measuring *m, weft_error *err) {
    show_progress(m, 0);
    for (;; m->frames++) {
        const wf_video_frame *frame;
        if (m->options->canceled && *m->options->canceled)
            return wf_fail(err, WEFT_INTERRUPTED, "interrupted");
        weft_status status = next_frame(m, &frame, err);
        if (!status) status = compare(m, frame, err);
        if (status || !frame) return status;
        wf_signal *signal = signal_of(m, m->frames);
        wf_signals_take(m->signals, frame, signal);
        const wf_signal *before = signal_of(m, m->frames - 1);
        const step s = {.read = signal, .before = before, .frame = before, .other = signal};
        status = measure_frame(m, s, err);
        if (status) return status;
        show_progress(m, m->frames + 1);
    }
}

static weft_status conclude(measuring *m, wf_figures *figures, weft_error *err) {
    if (!m->frames && m->options->first_frame)
        return wf_fail(err, WEFT_USAGE, "%s: there is no frame %" PRId64 " in it", m->path,
                       m->options->first_frame);
    if (!m->frames) return wf_fail(err, WEFT_FAILED, "%s: there is no frame in it", m->path);
    figures->frames = m->frames;
    figures->info = *wf_video_info_of(m->video);
    const wf_signal *last = signal_of(m, m->frames - 1), *before = signal_of(m, m->frames - 2);
    weft_status status = measure_frame(m, (step){.frame = last, .other = before}, err);
    if (!status && m->options->canceled && *m->options->canceled)
        return wf_fail(err, WEFT_INTERRUPTED, "interrupted");
    const wf_video_frame *none;
    if (!status && m->reference && m->deinterlaces)
        status = next_reference(m, false, &none, err);
    if (status) return status;
    for (size_t i = m->first; i < MEASUREMENTS; i++)
        measurements[i]->finish(m->state[i], last, before, figures);
    if (m->flicker) wf_flicker_finish(m->flicker, figures);
    if (m->crawl) wf_crawl_finish(m->crawl, figures);
    if (m->difference) wf_difference_finish(m->difference, figures);
    if (!m->options->want_heat || figures->heat) return WEFT_OK;
    return wf_fail(
        err, WEFT_USAGE,
        "%s: there is no crawl to draw: it is that of interlaced video, and this does "
        "not say that it is any; name its --raster",
        m->path);
}

static void end(measuring *m) {
    for (size_t i = m->first; i < MEASUREMENTS; i++) measurements[i]->free(m->state[i]);
    wf_flicker_free(m->flicker);
    wf_crawl_free(m->crawl);
    wf_screen_free(m->screen);
    wf_signal_free(m->reference_signal);
    wf_signals_free(m->reference_signals);
    wf_difference_free(m->difference);
    for (int i = 0; i < 2; i++) wf_signal_free(m->signal[i]);
    wf_signals_free(m->signals);
    wf_video_close(m->reference);
    wf_video_close(m->video);
}

weft_status wf_measure(const char *path, const wf_measure_options *options, wf_figures *figures,
                       weft_error *err) {
    measuring m = {.path = path,
                   .options = options,
                   .first = options->of_delivery ? DELIVERY : 0,
                   .began_s = wf_now_s()};
    *figures = (wf_figures){.frames = 0};
    for (size_t i = 0; wf_figure_at(i); i++) {
        const double none = NAN;
        memcpy((char *)figures + wf_figure_at(i)->offset, &none, sizeof none);
    }
    weft_status status = begin(&m, err);
    if (!status) status = measure_frames(&m, err);
    if (!status) status = conclude(&m, figures, err);
    end(&m);
    return status;
}
