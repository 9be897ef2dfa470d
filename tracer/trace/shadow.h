#ifndef WF_TRACER_TRACE_SHADOW_H
#define WF_TRACER_TRACE_SHADOW_H

#include "tracer/trace/tracer_inside.h"

/* What stands in the way of light. */
enum {
    WF_SHADOW_NONE,
    WF_SHADOW_OPAQUE,
    WF_SHADOW_CLEAR /* an object that lets light through somewhere, and perhaps others */
};

/* What is met by each ray of a packet before s = far. The packet's places past its count hold
 * copies of the last ray. False: no memory. */
bool wf_shadow(const wf_tracer *tracer, wf_trace_scratch *scratch, const wf_packet *packet,
               double far, uint8_t *dark);

#endif
