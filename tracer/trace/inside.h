#ifndef WF_TRACER_TRACE_INSIDE_H
#define WF_TRACER_TRACE_INSIDE_H

#include "tracer/trace/cull.h"
#include "tracer/trace/light.h"
#include "tracer/trace/packet.h"
#include "tracer/trace/texture.h"
#include "tracer/trace/tracer.h"
#include "tracer/trace/tree.h"

/* Between the tracer's files. */

struct wf_tracer {
    const wf_scene *scene;
    wf_view view;
    const wf_packet_ops *packet;
    const wf_csg_ops *csg;
    const wf_light_ops *light;
    wf_intersect_fn *const *intersect;
    wf_normals_fn *const *normals;
    wf_texture_fn *const *textures;
    wf_part *parts;
    bool *sibling; /* [object]: it has several parts */
    bool *lit;     /* [part]: light falls on it, so that shadows do */
    bool *clear; /* [part]: it mirrors or lets light through: what is seen in it may be anywhere
                  */
    int part_count, most_stack;
    bool own_widths, lights_move, all_still;

    /* The window of time it looks at. */
    bool skip, looked;
    wf_window_of_time window;
    wf_ready_op *ops;                      /* [op] */
    wf_bounds *solid_bounds, *part_bounds; /* in the world, over the window */
    wf_bounds *stack;                      /* [most_stack] */
    int *still, *moving, *endless;         /* parts: bounded that stand, that move; unbounded */
    int still_count, moving_count, endless_count;
    int endless_still;        /* of the endless ones, which come first */
    int *movers, mover_count; /* all parts that move, seen in the window or not */
    wf_tree still_tree, moving_tree;
};

/* One packet in one operator's space. */
typedef struct wf_carried {
    wf_rays rays;
    wf_sincos spin;
    double dt_s[WF_PACKET];
    wf_shaft shaft; /* of the rays */
    int op;
} wf_carried;

/* A packet on its way: its rays in the world, and when they look. */
typedef struct wf_packet {
    wf_rays rays;
    _Alignas(64) double f[WF_PACKET];
    double late_s;
} wf_packet;

/* What each depth of reflection needs for itself. */
typedef struct wf_trace_level {
    wf_packet packet, shadow;
    wf_hits hits;
    wf_culls culls;
    wf_points point, normal;
    double rgb[3][WF_PACKET];
} wf_trace_level;

struct wf_trace_scratch {
    wf_trace_counts counts;
    int *found;             /* [part_count] */
    wf_cull_operand *stack; /* [most_stack] */
    wf_csg_entry *in;       /* [most_stack + 1] */
    wf_culls tile;
    wf_trace_level *level; /* [depth_limit + 1] */
    int levels;
    bool failed; /* memory ran out while solids were looked at */

    /* Spaces that the packet in hand has been carried into. */
    wf_carried **carried;
    int *carried_of, carried_count,
        carried_room; /* [op]: index, if its entry says the same op */
    wf_runs *runs;
    size_t runs_room;
};

/* ---- camera.c ---- */

/* Rays of samples, from the eye; s counts in units of the view's forward direction. */
void wf_camera_rays(const wf_tracer *tracer, const double *x, const double *y,
                    wf_packet *packet);

/* A shaft that holds the rays of all samples of a rectangle at any time of the window. */
wf_shaft wf_camera_shaft(const wf_tracer *tracer, const double x[2], const double y[2]);

/* ---- carry.c ---- */

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
                      wf_points *normals);

/* ---- nearest.c ---- */

/* Finds what a packet within the shaft may meet; packet NULL: any in the window of time. The
 * packet's carrying has begun. */
bool wf_find(const wf_tracer *tracer, wf_trace_scratch *scratch, const wf_packet *packet,
             const wf_shaft *shaft, wf_culls *out);

/* The same among what was found for a wider shaft. */
bool wf_find_again(const wf_tracer *tracer, wf_trace_scratch *scratch, const wf_packet *packet,
                   const wf_shaft *shaft, const wf_culls *from, wf_culls *out);

/* Nearest hits of a packet, before those that hits already hold, among culled parts. whole:
 * rays may start inside an object, whose inner surfaces are then none. */
bool wf_nearest(const wf_tracer *tracer, wf_trace_scratch *scratch, const wf_packet *packet,
                const wf_culls *culls, bool whole, wf_hits *hits);

/* ---- shade.c ---- */

/* Light along the packet's rays, whose nearest hits are known: into the level's rgb. */
bool wf_shade(const wf_tracer *tracer, wf_trace_scratch *scratch, int level);

/* Light along the rays of a level's packet, which has begun to be carried. */
bool wf_look_along(const wf_tracer *tracer, wf_trace_scratch *scratch, int level,
                   const wf_culls *culls);

#endif
