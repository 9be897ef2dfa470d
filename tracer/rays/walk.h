#ifndef WF_TRACER_RAYS_WALK_H
#define WF_TRACER_RAYS_WALK_H

#include "filters/base/isa.h"
#include "tracer/rays/solid.h"

/* One ray's way through a tree of boxes, eight of which are tried at once: what rays that have
 * nothing in common cost the logarithm of. */

#define WF_WALK_WIDTH 8

/* Boxes, of which those that hold nothing have low = +inf, high = -inf. */
typedef struct wf_walk_node {
    _Alignas(64) double low[3][WF_WALK_WIDTH], high[3][WF_WALK_WIDTH];
    int32_t child[WF_WALK_WIDTH]; /* a node, or ~item */
} wf_walk_node;

/* A tree whose root is node 0; no nodes: nothing is in it. It is no deeper than WF_WALK_DEPTH
 * nodes. */
typedef struct wf_walk_tree {
    wf_walk_node *nodes;
    int node_count;
    double size; /* no box has a larger number */
} wf_walk_tree;

#define WF_WALK_DEPTH 32

typedef struct wf_walk {
    double o[3], d[3]; /* the ray */
    double most;       /* what lies beyond this s is of no interest; `meet` may lower it */
    /* Called with items whose boxes the ray may meet, about the nearest first; near: no part of
     * the item is met before this s. False ends the walk. */
    bool (*meet)(void *user, struct wf_walk *walk, int item, double near);
    void *user;
} wf_walk;

typedef struct wf_walk_ops {
    /* Boxes are taken a little wider than they are, by 2^-38 of the numbers' size, as shafts
     * are. False: `meet` said so. */
    bool (*go)(const wf_walk_tree *tree, wf_walk *walk);
} wf_walk_ops;

WF_ISA_DECLARE(wf_walk_ops);

#endif
