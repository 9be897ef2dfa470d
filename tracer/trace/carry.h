#ifndef WF_TRACER_TRACE_CARRY_H
#define WF_TRACER_TRACE_CARRY_H

#include "tracer/trace/tracer_inside.h"

/* Packets in the spaces of operators: a solid that moves stands still in its operator's space,
 * and rays are carried there, each by its own time. */

/* Seconds from the window's base at which a packet sees what an operator moves. */
void wf_carry_times(const wf_tracer *tracer, const wf_packet *packet, const wf_op *op,
                    double *dt_s);

/* Forgets the packet before. */
void wf_carry_begin(wf_trace_scratch *scratch);

/* The packet's rays in the space of an operator; -1: the world's. NULL: no memory. */
const wf_rays *wf_carry_rays(const wf_tracer *tracer, wf_trace_scratch *scratch,
                             const wf_packet *packet, int op);

/* Their shaft; `world` is the packet's own. NULL: no memory. */
const wf_shaft *wf_carry_shaft(const wf_tracer *tracer, wf_trace_scratch *scratch,
                               const wf_packet *packet, const wf_shaft *world, int op);

/* Directions from the space of an operator out into the world, in place, as unit vectors; to be
 * called after the packet's rays have been carried there. */
void wf_carry_normals(const wf_tracer *tracer, const wf_trace_scratch *scratch, int op,
                      int count, wf_points *normals);

#endif
