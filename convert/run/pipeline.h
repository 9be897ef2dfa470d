#ifndef WF_CONVERT_RUN_PIPELINE_H
#define WF_CONVERT_RUN_PIPELINE_H

#include <stdatomic.h>

#include "convert/run/frames.h"

/* What one thread works with, and how long it has worked. */
typedef struct wf_worker {
    wf_reader *reader;
    wf_scratch *scratch;
    wf_finisher finisher;
    weft_status status;
    weft_error error;
    double decode_s, resample_s;
} wf_worker;

/* A run of whole frames through source, resampler, colour and sink. */
typedef struct wf_pipeline {
    weft_job *job;
    const wf_setup *setup;
    wf_frames *frames;
    wf_worker *workers;
    int threads;
    int group_most;   /* fields finished together */
    int carried_most; /* fields that begin before others end, kept between groups; 0: none are
                       */
    bool merge;       /* equal pictures of one window are added once with their weights' sum */
    atomic_bool stop;
    int64_t
        next_subframe; /* the first that no field in flight has seen; 0 where none is carried */
    wf_field **flight; /* fields in flight, from flight_first on; room for all of a group */
    wf_field **active; /* those of them that the batch in hand adds to */
    wf_field **spare;  /* fields done with, whose memory later ones take over */
    int spare_count;
    int64_t flight_first;
    int flight_count;
    int64_t end_field; /* of the frames in hand: nothing later is put in flight */
    int64_t opened;
    size_t bytes; /* that all of it holds at most, but for the libraries' own needs */
} wf_pipeline;

weft_status wf_pipeline_new(weft_job *job, const wf_setup *setup, wf_pipeline **out,
                            weft_error *err);
void wf_pipeline_free(wf_pipeline *pipeline);

/* Converts frames first <= n < end and hands them to the sink. */
weft_status wf_pipeline_frames(wf_pipeline *pipeline, int64_t first, int64_t end,
                               weft_error *err);

/* Counts as `opened` what wf_pipeline_frames would open, and marks the subframes of which it
 * would read something: needed[sequence.count]. Opens nothing. */
void wf_pipeline_foresee(wf_pipeline *pipeline, int64_t first, int64_t end, bool *needed);

/* What the workers counted and how long they took, added up. */
wf_source_counts wf_pipeline_counts(const wf_pipeline *pipeline);
wf_worker wf_pipeline_times(const wf_pipeline *pipeline);

/* ---- Between the pipeline's files ---- */

/* Reads the subframes that fields first <= n < end need and adds them to these fields, and to
 * the later ones they already touch where fields are carried. */
weft_status wf_batch_read(wf_pipeline *pipeline, int64_t first, int64_t end, weft_error *err);

void wf_batch_foresee(wf_pipeline *pipeline, int64_t first, int64_t end, bool *needed);

/* Takes line `line` of a field through colour into its frame. */
void wf_pipeline_finish_line(wf_pipeline *pipeline, wf_worker *worker, const wf_field *field,
                             int line);

/* The first worker's failure, or cancellation. */
weft_status wf_pipeline_status(const wf_pipeline *pipeline, weft_error *err);
void wf_worker_fail(wf_pipeline *pipeline, wf_worker *worker, weft_status status);

#endif
