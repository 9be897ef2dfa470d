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

/* What waits to be looked at: a node, or ~place of an item. */
typedef struct wf_stop {
    double near; /* no part of it is met before this s */
    int32_t what;
} wf_stop;

/* A ray on its way: along each axis, which plane of a box it meets first, and what is less from
 * that plane and the last. */
typedef struct wf_walk {
    double most; /* what lies beyond this s is of no interest; may be lowered at any time */
    double first[3], last[3], inverse[3];
    int first_plane[3], last_plane[3];
    int count; /* of stops; 0: the way has ended */
    wf_stop stop[WF_TREE_DEPTH * WF_TREE_WIDTH];
} wf_walk;

typedef struct wf_walk_ops {
    /* Begins a walk from o along d. */
    void (*begin)(const wf_tree *tree, const double o[3], const double d[3], double most,
                  wf_walk *walk);
    /* The next item whose box the ray may meet, about the nearest first. False: there is none.
     */
    bool (*next)(const wf_tree *tree, wf_walk *walk, wf_stop *item);
    /* Appends to found, in no order, the items whose boxes the shaft may reach, and stops soon
     * after it has found more than `most`; found has space for every item. Returns how many. */
    int (*find)(const wf_tree *tree, const wf_shaft *shaft, int most, int *found);
} wf_walk_ops;

WF_ISA_DECLARE(wf_walk_ops);

#endif
