#ifndef WF_TRACER_RAYS_PACKET_H
#define WF_TRACER_RAYS_PACKET_H

#include "filters/base/isa.h"
#include "tracer/rays/csg.h"
#include "tracer/scene/motion.h"

/* What is done to whole packets, compiled for each instruction set; all give the same bits.
 * Where no rays are given that have one, `count` is how many there are. */

/* Cosine and sine of how far an operator has rotated by each ray's time. */
typedef struct wf_sincos {
    _Alignas(64) double cos[WF_PACKET], sin[WF_PACKET];
} wf_sincos;

typedef struct wf_packet_ops {
    /* Rays through an affine map. */
    void (*place)(const wf_affine *map, const wf_rays *from, wf_rays *to);
    /* Some of the rays, one or more, each through a map of its own. */
    void (*place_each)(const wf_affine *const *map, const wf_rays *from, const int *ray,
                       int count, wf_rays *to);
    /* Rays into an operator's space, at dt_s seconds from its base for each ray. */
    void (*drift_in)(const wf_ready_op *op, const double *dt_s, const wf_rays *from,
                     wf_rays *to);
    void (*spin_in)(const wf_ready_op *op, const wf_sincos *spin, const wf_rays *from,
                    wf_rays *to);
    void (*find_sincos)(const wf_ready_op *op, const double *dt_s, int count, wf_sincos *spin);
    /* Directions out of an operator's space, in place. */
    void (*spin_out)(const wf_ready_op *op, const wf_sincos *spin, int count,
                     wf_points *directions);
    /* Normals through the map whose inverse is given, in place. */
    void (*place_normals)(const wf_affine *inverse, int count, wf_points *normals);
    /* The same, each through a map of its own. */
    void (*place_normals_each)(const wf_affine *const *inverse, int count, wf_points *normals);
    /* Where rays are at s. */
    void (*reach)(const wf_rays *rays, const double *s, wf_points *points);
    /* Hits of one solid alone, of which each ray has up to most_runs, nearer than those there
     * are, or as near and of a solid that comes before. */
    void (*nearer)(const wf_runs *runs, int most_runs, const double *rounding, int solid,
                   int count, wf_hits *hits);
    /* The same of rays of the hits, one or more, which the runs in their order are of, each
     * with a solid of its own. rounding is that of all rays. */
    void (*nearer_each)(const wf_runs *runs, int most_runs, const double *rounding,
                        const int *solid, const int *ray, int count, wf_hits *hits);
    void (*unit)(int count, wf_points *directions);
    /* How far rounding may reach along each ray for the size of where it starts: a share of
     * origin over direction. */
    void (*rounding)(const wf_rays *rays, double share, double *rounding);
    double (*farthest)(const double *s, int count); /* s aligned as in hits */
    void (*no_second_run)(wf_runs *runs, int count);
    /* The boxes of all origins and directions. */
    void (*box)(const wf_rays *rays, wf_bounds *o, wf_bounds *d);
} wf_packet_ops;

WF_ISA_DECLARE(wf_packet_ops);

#endif
