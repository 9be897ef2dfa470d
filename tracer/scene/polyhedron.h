#ifndef WF_TRACER_SCENE_POLYHEDRON_H
#define WF_TRACER_SCENE_POLYHEDRON_H

#include "tracer/scene/scene.h"

/* Finds the box around a polyhedron's corners and notes it in its shape, unless it is endless
 * or of very many planes. */
void wf_polyhedron_bound(wf_solid *solid, const wf_plane *planes);

/* About how many steps of a script that takes. */
double wf_polyhedron_cost(int planes);

#endif
