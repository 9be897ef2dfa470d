#ifndef WF_TRACER_TRACE_GLASS_H
#define WF_TRACER_TRACE_GLASS_H

#include "tracer/trace/tracer_inside.h"

/* Clear solids: those whose material has a share that passes (refract > 0). What a place is
 * filled with is asked of the solids that hold it, never counted along a ray: of clear ones
 * that hold it together the smallest by volume counts, of equals the one that the scene names
 * last, so that water in glass is water. */

/* Finds which parts are clear, and fills in the tracer's media. False: no memory. */
bool wf_glass_judge(wf_tracer *tracer);
void wf_glass_free(wf_tracer *tracer);

/* Finds, for each ray of a level's packet that has met something clear, the index of refraction
 * before the surface over that behind it: ratio[WF_PACKET]. off: how far off the surface places
 * are asked for, as `wf_light_ops.off_surface` has it; normals face the rays. Where something
 * opaque begins in the same place, which a ray would otherwise go into, the level's hits become
 * of that, and *changed is set. Forgets what has been carried. False: no memory. */
bool wf_glass_bend(const wf_tracer *tracer, wf_trace_scratch *scratch, wf_trace_level *level,
                   const wf_surfaces *surfaces, const double *off, double *ratio,
                   bool *changed);

/* Light that comes straight through clear solids, which are not seen to bend it: follows rays
 * of a packet, those of lanes[0 .. count - 1], to s = far. dark[lane] becomes WF_SHADOW_NONE
 * (`shadow.h`) where nothing opaque is met, and tint[3][WF_PACKET] the product of refract times
 * color of all solids on the way, each once. Forgets what has been carried. False: no memory.
 */
bool wf_glass_light(const wf_tracer *tracer, wf_trace_scratch *scratch, const wf_packet *packet,
                    const int *lanes, int count, double far, uint8_t *dark,
                    double tint[3][WF_PACKET]);

#endif
