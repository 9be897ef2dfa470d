#ifndef WF_TRACER_SCENE_MOTION_H
#define WF_TRACER_SCENE_MOTION_H

#include "filters/base/rational.h"
#include "tracer/scene/scene.h"

/* Affine maps, and operators at instants: an exact base, and small offsets from it in double.
 */

/* An operator made ready for offsets from one base: what depends on the base is worked in more
 * than double, so that an angle at frame 10^7 is as good as one at frame 0. */
typedef struct wf_ready_op {
    const wf_op *op;
    wf_affine place, inverse;     /* WF_OP_PLACE */
    wf_vec offset;                /* WF_OP_VELOCITY: where it has got to at the base */
    double phase, turns_a_second; /* WF_OP_SPIN: turns at the base, in 0..1 */
    const wf_key *keys;
    double base_s; /* rounded: keyframes */
} wf_ready_op;

wf_ready_op wf_op_ready(const wf_scene *scene, int op, wf_rational base_s);

/* The operator dt_s seconds after the base: out (inside to outside) or its inverse. */
wf_affine wf_op_at(const wf_ready_op *op, double dt_s);
wf_affine wf_op_inverse_at(const wf_ready_op *op, double dt_s);

/* Whether the operator, or one outside it, changes with time. */
bool wf_op_moves(const wf_scene *scene, int op);

/* ---- Affine maps ---- */

wf_vec wf_apply(const wf_affine *a, wf_vec p); /* a point */
wf_vec wf_turn(const wf_affine *a, wf_vec v);  /* a direction */
wf_affine wf_compose(const wf_affine *outer, const wf_affine *inner);
bool wf_invert(const wf_affine *a, wf_affine *out); /* false if singular */

wf_affine wf_identity(void);
wf_affine wf_scaling(wf_vec size, wf_vec center); /* about the origin, which goes to center */

/* The rotation about a unit axis through a center by the angle of that cosine and sine
 * (Rodrigues' formula). */
wf_affine wf_rotation(wf_vec axis, wf_vec center, double cosine, double sine);

#endif
