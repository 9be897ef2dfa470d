#ifndef WF_TRACER_SCENE_VEC_H
#define WF_TRACER_SCENE_VEC_H

#include <math.h>

#include "tracer/scene/scene.h"

/* Vectors of three doubles. */

static inline double wf_vec_dot(wf_vec a, wf_vec b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline wf_vec wf_vec_minus(wf_vec a, wf_vec b) {
    return (wf_vec){a.x - b.x, a.y - b.y, a.z - b.z};
}

/* a + s b. */
static inline wf_vec wf_vec_along(wf_vec a, double s, wf_vec b) {
    return (wf_vec){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

static inline wf_vec wf_vec_cross(wf_vec a, wf_vec b) {
    return (wf_vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static inline double wf_vec_length(wf_vec v) {
    return sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

/* The size of the largest component. */
static inline double wf_vec_largest(wf_vec v) {
    return fmax(fabs(v.x), fmax(fabs(v.y), fabs(v.z)));
}

/* The same direction with length 1; {0, 0, 0} stays as it is. The largest component is brought
 * to 1 first, so that no size of scene overflows. */
static inline wf_vec wf_vec_unit(wf_vec v) {
    double far = wf_vec_largest(v);
    if (!(far > 0)) return v;
    v = (wf_vec){v.x / far, v.y / far, v.z / far};
    double length = wf_vec_length(v);
    return (wf_vec){v.x / length, v.y / length, v.z / length};
}

#endif
