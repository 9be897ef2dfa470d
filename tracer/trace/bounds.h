#ifndef WF_TRACER_TRACE_BOUNDS_H
#define WF_TRACER_TRACE_BOUNDS_H

#include "tracer/rays/walk.h"
#include "tracer/scene/motion.h"

/* Boxes that hold solids over a window of time, and shafts that hold packets of rays. Every
 * answer errs to the side of "may be seen": a little more than rounding is added where it
 * counts. */

wf_bounds wf_bounds_none(void); /* holds nothing; neutral in unions */
bool wf_bounds_empty(const wf_bounds *b);
bool wf_bounds_finite(const wf_bounds *b);
wf_bounds wf_bounds_unite(wf_bounds a, wf_bounds b);
wf_bounds wf_bounds_intersect(wf_bounds a, wf_bounds b);
wf_bounds wf_bounds_of_point(wf_vec p);

/* The box of what an operator makes of a box at any time from..to seconds after its base. */
wf_bounds wf_bounds_move(const wf_ready_op *op, double from_s, double to_s, wf_bounds b);

/* The box of what is in a solid at any time of from..to, in the space within an operator; -1:
 * in the world. ops: ready operators by the scene's indices. */
wf_bounds wf_bounds_solid(const wf_scene *scene, const wf_ready_op *ops, int solid, int within,
                          double from_s, double to_s);

wf_shaft wf_shaft_new(wf_bounds o, wf_bounds d, double most);
wf_shaft wf_shaft_of_rays(const wf_rays *rays, double most);

/* The shaft of the same rays in another space. */
wf_shaft wf_shaft_place(const wf_affine *map, const wf_shaft *shaft);

/* A stretch of rays: from <= s <= to. */
typedef struct wf_stretch {
    double from, to;
} wf_stretch;

/* Whether the shaft may reach the box; no ray is in it outside the stretch. */
bool wf_shaft_meets(const wf_shaft *shaft, const wf_bounds *b, wf_stretch *stretch);

#endif
