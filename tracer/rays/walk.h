#ifndef WF_TRACER_RAYS_WALK_H
#define WF_TRACER_RAYS_WALK_H

#include "filters/base/isa.h"
#include "tracer/rays/solid.h"

/* Ways of rays through a tree of boxes, eight of which are tried at once: of single rays, and
 * of shafts that hold many. Boxes are met where rounding may let them be. */

#define WF_TREE_WIDTH 8

/* As many boxes as `used` has bits. */
typedef struct wf_tree_node {
    _Alignas(64) double plane[6][WF_TREE_WIDTH]; /* low x, y, z and high x, y, z */
    int32_t child[WF_TREE_WIDTH]; /* all nodes, or all ~place, of the tree's items */
    uint32_t used;
} wf_tree_node;

/* A tree whose root is node 0; no nodes: nothing is in it. It is no deeper than WF_TREE_DEPTH
 * nodes. Immutable once made. */
typedef struct wf_tree {
    wf_tree_node *nodes;
    int *items;
    int node_count, item_count;
    double size; /* no box has a larger number */
} wf_tree;

#define WF_TREE_DEPTH 32

/* All points o + s d, 0 <= s <= most, with o and d each in a box. */
typedef struct wf_shaft {
    wf_bounds o, d;
    double rise[3], fall[3]; /* 1 / d.high, 1 / d.low */
    double most;
} wf_shaft;

typedef struct wf_walk {
    double o[3], d[3]; /* the ray */
    double most;       /* what lies beyond this s is of no interest; `meet` may lower it */
    /* Called with the places of items whose boxes the ray may meet, about the nearest first;
     * near: no part of the item is met before this s. False ends the walk. */
    bool (*meet)(void *user, struct wf_walk *walk, int place, double near);
    void *user;
} wf_walk;

typedef struct wf_walk_ops {
    /* False: `meet` said so. */
    bool (*go)(const wf_tree *tree, wf_walk *walk);
    /* Appends to found, in no order, the items whose boxes the shaft may reach, and stops soon
     * after it has found more than `most`; found has space for every item. Returns how many. */
    int (*find)(const wf_tree *tree, const wf_shaft *shaft, int most, int *found);
} wf_walk_ops;

WF_ISA_DECLARE(wf_walk_ops);

#endif
