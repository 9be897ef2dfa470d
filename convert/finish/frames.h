#ifndef WF_CONVERT_FINISH_FRAMES_H
#define WF_CONVERT_FINISH_FRAMES_H

#include "convert/job/report.h"
#include "convert/finish/crew.h"
#include "convert/finish/setup.h"

/* Frames while they are put together: lines of fields come in any order and from any worker, go
 * through color, chroma and quantizing into codes, and whole frames go to the sink. */
typedef struct wf_frames wf_frames;

/* Makes planes for as many frames as `fields` consecutive fields can belong to, the first of
 * which may be a frame's second; wf_frames_bytes says how much that is. Crew and setup must
 * outlive the frames. */
weft_status wf_frames_new(wf_crew *crew, const wf_setup *setup, int fields, wf_frames **out,
                          weft_error *err);
void wf_frames_free(wf_frames *frames); /* abandons the sink if it is still open */
size_t wf_frames_bytes(const weft_job *job, const wf_setup *setup, int threads, int fields);

/* Where a worker is to put line `line` of a field, as the job's raster counts its lines: R, G,
 * B of width_px scene-linear samples. Then wf_frames_line takes what it has put there through
 * color into the field's frame. A worker has one line in hand at a time. */
void wf_frames_place(const wf_frames *frames, const wf_worker *worker, int64_t field, int line,
                     float *rgb[3]);
/* The same for its alpha: width_px samples; NULL where none is written. */
float *wf_frames_alpha(const wf_frames *frames, const wf_worker *worker, int64_t field,
                       int line);
void wf_frames_line(wf_frames *frames, wf_worker *worker, int64_t field, int line);

/* All lines of a field are there: where flicker is held, they are those of its frame, and the
 * field's own are made of them now. By one thread, field by field. */
weft_status wf_frames_field(wf_frames *frames, int64_t field, weft_error *err);

/* Opens the sink; hands it frame `index`, whose lines are all there, and tells progress: it is
 * written while later frames are made, and the next call tells if that failed; closes
 * the sink, after which the output stands at its name. By one thread. */
weft_status wf_frames_open(wf_frames *frames, weft_error *err);
weft_status wf_frames_write(wf_frames *frames, int64_t index, weft_error *err);
weft_status wf_frames_commit(wf_frames *frames, weft_error *err);

/* Adds to the report the seconds that writing took and, where the output is codes, what r103
 * has done to those of the frames written. */
void wf_frames_tell(wf_frames *frames, wf_report *report);

/* The next frames *first <= n < *end that are to be made, from *first on: with --resume those
 * whose files are there already are left out. False when none remain. */
bool wf_frames_next(const weft_job *job, const wf_setup *setup, int64_t *first, int64_t *end);

/* Whether --resume finds the whole output there already, and nothing is to be made. */
bool wf_frames_all_there(const weft_job *job, const wf_setup *setup);

#endif
