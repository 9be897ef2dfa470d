#ifndef WF_CONVERT_RUN_GATHERING_H
#define WF_CONVERT_RUN_GATHERING_H

#include <stdatomic.h>

#include "convert/run/frames.h"
#include "filters/gather/samples.h"

/* From samples to frames: whoever has samples gives them unit by unit of time and band by band
 * of rows; fields gather them and are finished when their last unit is done. */

/* A source of samples. Functions but `band` are called by one thread. */
typedef struct wf_sample_source {
    void *self;
    wf_sample_tiling tiling; /* how it hands them over; count 0: not in tiles */
    /* Units first <= u <= *last whose samples a field may need. */
    void (*units)(void *self, int64_t field, int64_t *first, int64_t *last);
    /* Turns to a unit; an absent one is an error or has no samples. */
    weft_status (*begin)(void *self, int64_t unit, weft_error *err);
    /* Of a source with tiles: whether fields that need this unit see nothing move; and whether
     * a field sees a unit from its beginning to its end, and one moment of it as well as
     * another. */
    bool (*still)(void *self);
    bool (*whole)(void *self, int64_t field, int64_t unit);
    /* Hands over the samples of rows first <= j < end; thread: whose buffers to use. */
    weft_status (*band)(void *self, int thread, int first, int end, const wf_receiver *receiver,
                        weft_error *err);
} wf_sample_source;

typedef struct wf_gathering wf_gathering;

weft_status wf_gathering_new(weft_job *job, const wf_setup *setup,
                             const wf_sample_source *source, wf_gathering **out,
                             weft_error *err);
void wf_gathering_free(wf_gathering *gathering);

/* Makes the frames of the setup and writes them. */
weft_status wf_gathering_run(wf_gathering *gathering, weft_error *err);

/* What a report tells: frames made and time spent (seconds of all threads together). */
typedef struct wf_gathering_counts {
    int64_t frames;
    double source_s, resample_s, color_s, write_s;
    int64_t pixels_filled;               /* that no sample reached: --on-empty nearest */
    int64_t tiles_reused, fields_reused; /* that were still and had been gathered before */
} wf_gathering_counts;

/* Adds to legal what r103 has done to the codes of the frames written. */
void wf_gathering_tell_legal(const wf_gathering *gathering, wf_report_legal *legal);
wf_gathering_counts wf_gathering_counted(const wf_gathering *gathering);
int wf_gathering_threads(const weft_job *job);

#endif
