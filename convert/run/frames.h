#ifndef WF_CONVERT_RUN_FRAMES_H
#define WF_CONVERT_RUN_FRAMES_H

#include "convert/base/clock.h"
#include "convert/run/setup.h"

/* Frames while they are put together: lines of fields come in any order, go through colour into
 * codes, and whole frames go to the sink. */
typedef struct wf_frames wf_frames;

/* What one thread finishes lines with, and how long it has. */
typedef struct wf_finisher {
    float *line;         /* [3][width]: one line of scene-linear, then of R'G'B' */
    float *code_scratch; /* wf_encode_scratch */
    double color_s;
} wf_finisher;

/* Room for frames of `fields` fields in flight, the first of which may be a frame's second.
 * Their bytes: wf_frames_bytes. */
weft_status wf_frames_new(weft_job *job, const wf_setup *setup, int fields, wf_frames **out,
                          weft_error *err);
void wf_frames_free(wf_frames *frames); /* abandons the sink if it is still open */
size_t wf_frames_bytes(const weft_job *job, const wf_setup *setup, int fields);

weft_status wf_finisher_new(const wf_frames *frames, wf_finisher *out, weft_error *err);
void wf_finisher_free(wf_finisher *finisher);

/* Where line `line` of a field is to be put as R, G, B [width] scene-linear; then through
 * colour into its frame. */
void wf_frames_room(const wf_frames *frames, const wf_finisher *finisher, int64_t field,
                    int line, float *rgb[3]);
void wf_frames_line(const wf_frames *frames, wf_finisher *finisher, int64_t field, int line);

/* Opens the sink, hands it a frame whose lines are all there, closes it. */
weft_status wf_frames_open(wf_frames *frames, weft_error *err);
weft_status wf_frames_write(wf_frames *frames, int64_t index, weft_error *err);
weft_status wf_frames_commit(wf_frames *frames, weft_error *err);

/* Adds to legal what r103 has done to the codes of the frames written. */
void wf_frames_tell_legal(const wf_frames *frames, wf_report_legal *legal);

int64_t wf_frames_done(const wf_frames *frames);
double wf_frames_write_s(const wf_frames *frames);

/* The next run of frames *first <= n < *end that are to be made; with --resume those whose
 * files are there are left out. False when nothing remains. (run.c) */
bool wf_next_frames(const weft_job *job, const wf_setup *setup, int64_t *first, int64_t *end);

#endif
