#ifndef WF_TRACER_TRACE_PAINT_H
#define WF_TRACER_TRACE_PAINT_H

#include "tracer/trace/tracer_inside.h"

/* Fills in the surfaces and normals of what a level's packet has met; *shines: something there
 * has a highlight. Forgets what has been carried. False: no memory. */
bool wf_paint(const wf_tracer *tracer, wf_trace_scratch *scratch, wf_trace_level *level,
              wf_surfaces *surfaces, bool *shines);

#endif
