#ifndef WF_CONVERT_CHECK_MEASURE_DIFFERENCE_H
#define WF_CONVERT_CHECK_MEASURE_DIFFERENCE_H

#include "convert/check/figures.h"

/* Differences from a reference. They are of the frames of two videos, not of one signal, and so
 * are no row of the measurements. */
typedef struct wf_difference wf_difference;
wf_difference *wf_difference_new(const wf_video_info *info); /* NULL: no memory */
void wf_difference_free(wf_difference *difference);
void wf_difference_add(wf_difference *difference, const wf_video_frame *frame,
                       const wf_video_frame *reference);
void wf_difference_finish(const wf_difference *difference, wf_figures *figures);

#endif
