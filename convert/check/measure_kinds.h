#ifndef WF_CONVERT_CHECK_MEASURE_KINDS_H
#define WF_CONVERT_CHECK_MEASURE_KINDS_H

#include "convert/check/measure.h"
#include "convert/read/signal.h"

/* Inside the measuring: one kind of measurement. `before` is the signal of the frame before,
 * NULL at the first. */
typedef struct wf_measurement {
    /* NULL: no memory. */
    void *(*begin)(const wf_video_info *info, const wf_measure_options *options);
    void (*add)(void *state, const wf_signal *signal, const wf_signal *before);
    /* After the last frame, whose signal is given once more. */
    void (*finish)(void *state, const wf_signal *last, const wf_signal *before,
                   wf_figures *figures);
    void (*free)(void *state); /* NULL is fine */
} wf_measurement;

extern const wf_measurement wf_measure_flicker, wf_measure_sharpness, wf_measure_composite,
    wf_measure_order, wf_measure_legal;

/* Differences go by frames of two videos, not by signals. */
typedef struct wf_difference wf_difference;
wf_difference *wf_difference_new(const wf_video_info *info); /* NULL: no memory */
void wf_difference_free(wf_difference *difference);
void wf_difference_add(wf_difference *difference, const wf_video_frame *frame,
                       const wf_video_frame *reference);
void wf_difference_finish(const wf_difference *difference, wf_figures *figures);

#endif
