#ifndef WF_CONVERT_RUN_TRACE_H
#define WF_CONVERT_RUN_TRACE_H

#include "convert/run/sum/flow.h"

/* weft trace: stores what a scene shows, for weft convert to read: the samples themselves, a
 * deep EXR file a frame, or subframes. */
weft_status wf_run_trace(wf_run *run, weft_error *err);

/* ---- Between the files of trace ---- */

/* Rows that a thread traces at a time. */
enum { WF_TRACE_ROWS = 8 };

/* The two things that are stored; the scene is open, and its frames are counted. last_frame is
 * that of the whole run, whatever the chunk. */
weft_status wf_store_samples(wf_run *run, int64_t last_frame, weft_error *err);
weft_status wf_store_subframes(wf_run *run, weft_error *err);

#endif
