#ifndef WF_TRACER_RAYS_LIGHT_H
#define WF_TRACER_RAYS_LIGHT_H

#include "filters/base/isa.h"
#include "tracer/rays/packet.h"

/* What the rays of a packet see, each its own. Rays that see nothing, or what is unlit, take no
 * light: their lit is 0. */
typedef struct wf_surfaces {
    const wf_material *material[WF_PACKET]; /* NULL: the background */
    _Alignas(64) double color[3][WF_PACKET];
    _Alignas(64) double lit[WF_PACKET], ambient[WF_PACKET], diffuse[WF_PACKET],
        specular[WF_PACKET], shininess[WF_PACKET];
    _Alignas(64) double light[3][WF_PACKET], shine[3][WF_PACKET];
} wf_surfaces;

/* Light on packets, compiled for each instruction set; `count` is how many rays there are,
 * where no rays are given. */
typedef struct wf_light_ops {
    /* Normals turned toward where rays come from: inner surfaces show their back. */
    void (*face)(const wf_rays *rays, wf_points *normals);
    /* Copies those lanes of `from` whose hit is of the solid. */
    void (*choose)(const int64_t *hit, int64_t solid, const double *from, int count,
                   double *to);
    /* How far off the surface rays start: share of the numbers' size. */
    void (*off_surface)(const wf_rays *rays, const double *s, double share, double *off);
    /* Turns directions, in place and to length 1, to where rays go on: mirrored by normals that
     * face them, or, where ratio is given, bent by Snell's law, ratio being the index before
     * the surface over that behind. side: 1 where they stay before it, -1 where they do not. */
    void (*turn)(wf_points *directions, const wf_points *normals, const double *ratio,
                 int count, double *side);
    /* The way from points to a light: to its place, or against the direction it shines in. */
    void (*ways)(const wf_points *points, const wf_points *place, int count, wf_points *ways);
    void (*against)(const wf_points *direction, int count, wf_points *ways);
    /* 1 where the light is before the surface and the surface takes light, else 0. */
    void (*faces_light)(const double *lit, const wf_points *normals, const wf_points *ways,
                        int count, double *share);
    /* Adds Lambert's and Blinn's light; ways of any length. */
    void (*add)(const wf_rays *rays, const wf_points *normals, const wf_points *ways,
                const double *share, const float color[3], bool shines, wf_surfaces *surfaces);
    /* What is seen: color * light + shine, the color itself, or the background. */
    void (*sum)(const wf_surfaces *surfaces, const double *seen, const float background[3],
                int count, double rgb[3][WF_PACKET]);
} wf_light_ops;

WF_ISA_DECLARE(wf_light_ops);

#endif
