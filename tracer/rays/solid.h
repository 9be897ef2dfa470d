#ifndef WF_TRACER_RAYS_SOLID_H
#define WF_TRACER_RAYS_SOLID_H

#include "filters/base/isa.h"
#include "tracer/scene/scene.h"

/* Rays travel in packets, one array for each component, so that loops over them vectorize.
 * Loops run over the places that `count` rays take, up to the next multiple of 8; those past
 * the count hold copies of the last ray. Arrays are of WF_PACKET places, of which those beyond
 * hold nothing. */
#define WF_PACKET 128

static inline int wf_places(int count) {
    return (count + 7) / 8 * 8;
}

typedef struct wf_rays {
    int count;
    _Alignas(64) double ox[WF_PACKET], oy[WF_PACKET], oz[WF_PACKET]; /* origin */
    _Alignas(64) double dx[WF_PACKET], dy[WF_PACKET],
        dz[WF_PACKET]; /* direction, any length > 0 */
} wf_rays;

/* Where rays are inside a solid: up to two runs in < s < out of the ray's parameter s, for s in
 * (-inf, inf): from behind the origin too. Convex solids and half-spaces use the first; a torus
 * and a non-convex quadric may use both, in order (a quadric's outer runs may be infinite). An
 * empty run has in = +inf, out = -inf; tangent rays count as missing. Never NaN. */
typedef struct wf_runs {
    _Alignas(64) double in[2][WF_PACKET], out[2][WF_PACKET];
} wf_runs;

/* An axis-parallel box; infinite where the solid is. */
typedef struct wf_bounds {
    double low[3], high[3];
} wf_bounds;

typedef struct wf_points {
    _Alignas(64) double x[WF_PACKET], y[WF_PACKET], z[WF_PACKET];
} wf_points;

/* Outward normals, of any length > 0, at `count` points on (or within rounding of) the surface.
 */
typedef void wf_normals_fn(const wf_solid *solid, const wf_plane *planes,
                           const wf_points *points, int count, wf_points *normals);

typedef void wf_intersect_fn(const wf_solid *solid, const wf_plane *planes, const wf_rays *rays,
                             wf_runs *runs);

/* A kind of solid in canonical form (scene.h). */
typedef struct wf_solid_type {
    const char *name;
    int most_runs; /* 1 or 2 */
    bool alike;    /* one is like any other in canonical form: loops look at rays alone */
    wf_bounds (*bounds)(const wf_solid *solid, const wf_plane *planes); /* holds all of it */
} wf_solid_type;

const wf_solid_type *wf_solid_type_of(wf_solid_kind kind);

/* Loops over packets, by kind. */
typedef struct wf_solid_ops {
    wf_intersect_fn *intersect[WF_SOLID_KINDS];
    wf_normals_fn *normals[WF_SOLID_KINDS];
} wf_solid_ops;

WF_ISA_DECLARE(wf_solid_ops);

#endif
