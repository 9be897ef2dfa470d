#ifndef WF_TRACER_RAYS_TEXTURE_H
#define WF_TRACER_RAYS_TEXTURE_H

#include "filters/base/isa.h"
#include "tracer/rays/solid.h"

/* Colors of a texture at the first count points of a packet, in the space that it was written
 * in. */
typedef void wf_texture_fn(const wf_scene *scene, const wf_texture *texture,
                           const wf_points *points, int count, double *const rgb[3]);

typedef struct wf_texture_ops {
    wf_texture_fn *color[WF_TEXTURES]; /* by kind; none for WF_TEXTURE_NONE */
} wf_texture_ops;

WF_ISA_DECLARE(wf_texture_ops);

#endif
