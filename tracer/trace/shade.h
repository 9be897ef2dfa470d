#ifndef WF_TRACER_TRACE_SHADE_H
#define WF_TRACER_TRACE_SHADE_H

#include "tracer/trace/tracer_inside.h"

/* What a level's hits look like: fills in surfaces, the level's points and its normals, which
 * face the rays, and how far off the surface rays start. False: no memory. */
bool wf_surfaces_of(const wf_tracer *tracer, wf_trace_scratch *scratch, wf_trace_level *level,
                    wf_surfaces *surfaces, double *off);

/* Finds what the rays of a level's packet see among culled parts, and its light: into the
 * level's rgb. culls NULL: among all, each ray on its own way. The packet has begun to be
 * carried; mirrors and glass look on at the levels after it. False: no memory. */
bool wf_look_along(const wf_tracer *tracer, wf_trace_scratch *scratch, int level,
                   const wf_culls *culls);

/* The same among all that there is. */
bool wf_look_about(const wf_tracer *tracer, wf_trace_scratch *scratch, int level);

#endif
