#ifndef WF_TRACER_TRACE_PARTS_H
#define WF_TRACER_TRACE_PARTS_H

#include "tracer/trace/tracer_inside.h"

/* Takes the scene's objects apart: fills the tracer's parts, siblings and most_stack. False: no
 * memory. */
bool wf_parts_split(wf_tracer *tracer);

/* Notes what can be said of each part's materials, and whether anything moves at all. The
 * tracer's arrays have been made. */
void wf_parts_judge(wf_tracer *tracer);

#endif
