/* One pass over a video, frame by frame, through every measurement. */
#include "convert/check/measure.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "convert/base/clock.h"
#include "convert/check/measure_difference.h"
#include "convert/check/measurement.h"

static const wf_measurement *const measurements[] = {&wf_measure_flicker, &wf_measure_sharpness,
                                                     &wf_measure_composite, &wf_measure_order,
                                                     &wf_measure_legal};

#define MEASUREMENTS (sizeof measurements / sizeof *measurements)
#define DELIVERY     3 /* index of the first that a delivery is held to: order and legality */

typedef struct measuring {
    const char *path;
    const wf_measure_options *options;
    wf_video *video, *reference;
    wf_signals *signals;
    wf_signal *signal[2]; /* [frame % 2]: of this frame and of the one before */
    size_t first;         /* of the measurements that are made */
    void *state[MEASUREMENTS];
    wf_difference *difference;
    int64_t frames;
    double began_s;
} measuring;

static weft_status check_lines(const char *path, const wf_video_info *info, weft_error *err) {
    if (info->lines % 2 == 0) return WEFT_OK;
    return wf_fail(err, WEFT_FAILED,
                   "%s: its pictures have %d lines, an odd number; two fields need an even one",
                   path, info->lines);
}

static weft_status open_reference(measuring *m, weft_error *err) {
    const wf_video_options options = {.raster = m->options->raster,
                                      .max_memory_bytes = m->options->max_memory_bytes};
    if (!m->options->against) return WEFT_OK;
    weft_status status = wf_video_open(m->options->against, &options, &m->reference, err);
    if (status) return status;
    const wf_video_info *a = wf_video_info_of(m->video), *b = wf_video_info_of(m->reference);
    if (a->width_px != b->width_px || a->lines != b->lines)
        return wf_fail(err, WEFT_USAGE, "%s is %dx%d and %s, its reference, %dx%d", m->path,
                       a->width_px, a->lines, m->options->against, b->width_px, b->lines);
    if (a->layout != b->layout || a->planes != b->planes || a->across != b->across ||
        a->down != b->down)
        return wf_fail(err, WEFT_USAGE,
                       "%s is %s and %s, its reference, %s: planes differ; convert one of them",
                       m->path, a->format, m->options->against, b->format);
    m->difference = wf_difference_new(a);
    return m->difference ? WEFT_OK : wf_fail(err, WEFT_NO_MEMORY, "out of memory");
}

static weft_status begin(measuring *m, weft_error *err) {
    const wf_video_options options = {.raster = m->options->raster,
                                      .max_memory_bytes = m->options->max_memory_bytes};
    weft_status status = wf_video_open(m->path, &options, &m->video, err);
    if (status) return status;
    const wf_video_info *info = wf_video_info_of(m->video);
    status = check_lines(m->path, info, err);
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

/* Takes the reference's frame, which has to be there exactly if the frame is. */
static weft_status compare(measuring *m, const wf_video_frame *frame, weft_error *err) {
    const wf_video_frame *reference;
    if (!m->reference) return WEFT_OK;
    weft_status status = wf_video_next(m->reference, &reference, err);
    if (status) return status;
    if (!frame != !reference)
        return wf_fail(err, WEFT_FAILED,
                       "%s has %s frames than %s, its reference (%" PRId64 ")", m->path,
                       frame ? "more" : "fewer", m->options->against, m->frames);
    if (frame) wf_difference_add(m->difference, frame, reference);
    return WEFT_OK;
}

static wf_signal *signal_of(const measuring *m, int64_t frame) {
    return frame < 0 ? NULL : m->signal[frame % 2];
}

static void show_progress(const measuring *m) {
    int64_t done = m->frames + 1, total = wf_video_info_of(m->video)->frames;
    const weft_progress progress = {.frames_done = done,
                                    .frames_total = total > done ? total : done,
                                    .seconds = wf_now_s() - m->began_s,
                                    .stage = "measure"};
    if (m->options->progress) m->options->progress(&progress, m->options->progress_user);
}

static weft_status measure_frames(measuring *m, weft_error *err) {
    for (;; m->frames++) {
        const wf_video_frame *frame;
        weft_status status = wf_video_next(m->video, &frame, err);
        if (!status) status = compare(m, frame, err);
        if (status || !frame) return status;
        wf_signal *signal = signal_of(m, m->frames);
        wf_signals_take(m->signals, frame, signal);
        for (size_t i = m->first; i < MEASUREMENTS; i++)
            measurements[i]->add(m->state[i], signal, signal_of(m, m->frames - 1));
        show_progress(m);
    }
}

static weft_status conclude(measuring *m, wf_figures *figures, weft_error *err) {
    if (!m->frames) return wf_fail(err, WEFT_FAILED, "%s: there is no frame in it", m->path);
    figures->frames = m->frames;
    figures->info = *wf_video_info_of(m->video);
    for (size_t i = m->first; i < MEASUREMENTS; i++)
        measurements[i]->finish(m->state[i], signal_of(m, m->frames - 1),
                                signal_of(m, m->frames - 2), figures);
    if (m->difference) wf_difference_finish(m->difference, figures);
    if (!m->options->want_heat || figures->heat) return WEFT_OK;
    return wf_fail(err, WEFT_NO_MEMORY, "%s: no memory for the heat map", m->path);
}

static void end(measuring *m) {
    for (size_t i = m->first; i < MEASUREMENTS; i++) measurements[i]->free(m->state[i]);
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
