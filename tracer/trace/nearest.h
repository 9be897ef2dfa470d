#ifndef WF_TRACER_TRACE_NEAREST_H
#define WF_TRACER_TRACE_NEAREST_H

#include "tracer/trace/tracer_inside.h"

/* Finds the nearest surface along each ray of a packet, among culled parts and before what hits
 * already hold. whole: rays may start inside an object, whose inner surfaces are then none.
 * False: no memory. */
bool wf_nearest(const wf_tracer *tracer, wf_trace_scratch *scratch, const wf_packet *packet,
                const wf_culls *culls, bool whole, wf_hits *hits);

/* The same of the one part of a list. rounding: of the packet's rays; inside: NULL, or set
 * where a ray starts inside the part. */
bool wf_nearest_part(const wf_tracer *tracer, wf_trace_scratch *scratch,
                     const wf_packet *packet, const wf_culls *culls, const double *rounding,
                     bool *inside, wf_hits *hits);

/* Whether one of the culled parts holds where each ray starts, as bytes 0 and 1. */
bool wf_holds(const wf_tracer *tracer, wf_trace_scratch *scratch, const wf_packet *packet,
              const wf_culls *culls, size_t part, uint8_t *in);

/* Copies `count` lanes of a packet, 1 or more. */
void wf_packet_take(const wf_packet *from, const int *lane, int count, wf_packet *to);

#endif
