#ifndef WF_TRACER_TRACE_NEAREST_H
#define WF_TRACER_TRACE_NEAREST_H

#include "tracer/trace/tracer_inside.h"

/* Finds the nearest surface along each ray of a packet, among culled parts and before what hits
 * already hold. whole: rays may start inside an object, whose inner surfaces are then none.
 * False: no memory. */
bool wf_nearest(const wf_tracer *tracer, wf_trace_scratch *scratch, const wf_packet *packet,
                const wf_culls *culls, bool whole, wf_hits *hits);

#endif
