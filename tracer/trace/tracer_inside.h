#ifndef WF_TRACER_TRACE_TRACER_INSIDE_H
#define WF_TRACER_TRACE_TRACER_INSIDE_H

#include "tracer/rays/light.h"
#include "tracer/rays/packet.h"
#include "tracer/rays/texture.h"
#include "tracer/trace/cull.h"
#include "tracer/trace/grove.h"
#include "tracer/trace/tracer.h"
#include "tracer/trace/tree.h"

/* What a tracer and its scratch are made of, for the files that trace. */

/* What a part is filled with (`glass.h`). */
typedef struct wf_medium {
    double volume; /* at most */
    double index;  /* of refraction */
    bool clear;
} wf_medium;

struct wf_tracer {
    const wf_scene *scene;
    wf_view view;
    const wf_packet_ops *packet;
    const wf_csg_ops *csg;
    const wf_light_ops *light;
    const wf_walk_ops *walk;
    wf_intersect_fn *const *intersect;
    wf_normals_fn *const *normals;
    wf_texture_fn *const *textures;
    wf_part *parts;
    bool *sibling;        /* [object]: it has several parts */
    bool endless_sibling; /* of such an object a part has no end */
    bool *lit;            /* [part]: light falls on it, so that shadows do */
    bool *clear; /* [part]: it mirrors or lets light through: what is seen in it may be anywhere
                  */
    wf_medium *media; /* [part]; NULL: nothing is clear */
    int *object_of;   /* [solid], where something is clear */
    bool *lets_light; /* [object], where something is clear: a solid of it is */
    int part_count, most_stack;
    bool own_widths, lights_move, all_still;

    /* The window of time it looks at. */
    bool skip, looked;
    wf_window_of_time window;
    wf_ready_op *ops;                      /* [op] */
    wf_bounds *solid_bounds, *part_bounds; /* in the world, over the window */
    wf_bounds *stack;                      /* [most_stack] */
    int *moving, *endless;                 /* parts: bounded that move; unbounded */
    int moving_count, endless_count;
    int endless_still;        /* of the endless ones, which come first */
    int *movers, mover_count; /* all parts that move, seen in the window or not */
    wf_tree moving_tree;      /* of parts */
    wf_groves *groves;        /* what stands still, and what moves for single rays */
};

/* One packet in one operator's space. */
typedef struct wf_carried {
    wf_rays rays;
    wf_sincos spin;
    double dt_s[WF_PACKET];
    wf_shaft shaft; /* of the rays */
    int op;
} wf_carried;

/* Spaces that a packet has been carried into. */
typedef struct wf_spaces {
    wf_carried **carried;
    int *carried_of; /* [op]: index, if its entry says the same op */
    int carried_count, carried_capacity;
} wf_spaces;

/* A ray of a packet that may meet a part. */
typedef struct wf_waiting {
    const wf_leaf *leaf;
    double near;
    int ray;
} wf_waiting;

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
    double rgb[3][WF_PACKET], alpha[WF_PACKET];
    bool open; /* its rays come from the camera by way of what is clear: alpha counts */
} wf_trace_level;

struct wf_trace_scratch {
    wf_trace_counts counts;
    int *found;             /* [part_count] */
    wf_cull_operand *stack; /* [most_stack] */
    wf_csg_entry *in;       /* [most_stack + 1] */
    wf_culls tile;
    bool tile_few;         /* the tile's list is one */
    wf_trace_level *level; /* [depth_limit + 1] */
    int levels;
    bool failed; /* memory ran out while solids were looked at */

    wf_spaces of_packet, of_ray, *spaces; /* of the packet in hand, of one ray; those in use */
    wf_runs *runs;
    size_t runs_capacity;

    wf_packet ray;                  /* one of a packet */
    wf_culls alone, around, shadow; /* a part for some rays, those for a packet */

    /* Rays on their ways through a tree. */
    wf_walk walk;
    wf_ways ways;
    wf_met met;

    /* Rays that wait for others before a part of several solids is looked at. */
    wf_waiting *waiting;
    size_t waiting_count, waiting_capacity;

    /* Some of a packet's rays. */
    wf_packet some;
    wf_hits some_hits;

    /* Light on its way through what is clear, and places that are looked at. */
    wf_trace_level passage, probe;

    /* An object as the union that it is, for rays that start inside of it. */
    wf_culls joined;
    wf_csg_entry *joined_in;
    size_t joined_in_capacity;
};

#endif
