#ifndef WF_TRACER_TRACE_PARTS_H
#define WF_TRACER_TRACE_PARTS_H

#include "tracer/trace/tracer_inside.h"

/* Takes the scene's objects apart: fills the tracer's parts, siblings and most_stack. False: no
 * memory. */
bool wf_parts_split(wf_tracer *tracer);

/* Notes what can be said of each part's materials, and whether anything moves at all. The
 * tracer's arrays have been made. */
void wf_parts_judge(wf_tracer *tracer);

/* The box of a part over the window, in the space within an operator; -1: in the world. solids:
 * [solid], where those of its solids are noted too, or NULL. */
void wf_parts_bound(wf_tracer *tracer, int part, int within, wf_bounds *solids, wf_bounds *out);

#endif
