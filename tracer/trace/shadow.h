#ifndef WF_TRACER_TRACE_SHADOW_H
#define WF_TRACER_TRACE_SHADOW_H

#include "tracer/trace/tracer_inside.h"

/* Whether anything is met by each ray of a packet before s = far, as bytes 0 and 1. The
 * packet's places past its count hold copies of the last ray. False: no memory. */
bool wf_shadow(const wf_tracer *tracer, wf_trace_scratch *scratch, const wf_packet *packet,
               double far, uint8_t *dark);

#endif
