#ifndef WF_CONVERT_CHECK_MEASUREMENT_H
#define WF_CONVERT_CHECK_MEASUREMENT_H

#include "convert/check/figures.h"
#include "convert/check/measure_options.h"
#include "convert/read/signal.h"

/* One kind of measurement: what it does with each frame. `before` is the signal of the frame
 * before, NULL at the first. */
typedef struct wf_measurement {
    /* NULL: no memory. */
    void *(*begin)(const wf_video_info *info, const wf_measure_options *options);
    void (*add)(void *state, const wf_signal *signal, const wf_signal *before);
    /* After the last frame, whose signal is given once more. */
    void (*finish)(void *state, const wf_signal *last, const wf_signal *before,
                   wf_figures *figures);
    void (*free)(void *state); /* NULL is fine */
} wf_measurement;

/* Each is defined in the file of its name; measure.c lists them. */
extern const wf_measurement wf_measure_sharpness, wf_measure_composite, wf_measure_order,
    wf_measure_legal;

#endif
