#ifndef WF_TRACER_TRACE_SHADE_H
#define WF_TRACER_TRACE_SHADE_H

#include "tracer/trace/tracer_inside.h"

/* Finds what the rays of a level's packet see among culled parts, and its light: into the
 * level's rgb. The packet has begun to be carried; mirrors and glass look on at the levels
 * after it. False: no memory. */
bool wf_look_along(const wf_tracer *tracer, wf_trace_scratch *scratch, int level,
                   const wf_culls *culls);

#endif
