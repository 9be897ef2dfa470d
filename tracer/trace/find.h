#ifndef WF_TRACER_TRACE_FIND_H
#define WF_TRACER_TRACE_FIND_H

#include "tracer/trace/tracer_inside.h"

/* Which parts of a scene the rays of a shaft may meet. */

/* Finds what a packet within the shaft may meet; packet NULL: any in the window of time. The
 * packet's carrying has begun. False: no memory. */
bool wf_find(const wf_tracer *tracer, wf_trace_scratch *scratch, const wf_packet *packet,
             const wf_shaft *shaft, wf_culls *out);

/* The same, as long as the shaft's boxes are no more than `most` and some: else *few is false,
 * and out says nothing. */
bool wf_find_few(const wf_tracer *tracer, wf_trace_scratch *scratch, const wf_packet *packet,
                 const wf_shaft *shaft, int most, bool *few, wf_culls *out);

/* The same of parts that have no box, or of one part. */
bool wf_find_endless(const wf_tracer *tracer, wf_trace_scratch *scratch,
                     const wf_packet *packet, const wf_shaft *shaft, wf_culls *out);
bool wf_find_part(const wf_tracer *tracer, wf_trace_scratch *scratch, const wf_packet *packet,
                  const wf_shaft *shaft, int part, wf_culls *out);

/* The same among what was found for a wider shaft. */
bool wf_find_again(const wf_tracer *tracer, wf_trace_scratch *scratch, const wf_packet *packet,
                   const wf_shaft *shaft, const wf_culls *from, wf_culls *out);

#endif
