#ifndef WF_TRACER_RAYS_WALK_H
#define WF_TRACER_RAYS_WALK_H

#include "filters/base/isa.h"
#include "tracer/rays/solid.h"

/* Ways of rays through a tree of boxes, eight of which are tried at once: of single rays, and
 * of shafts that hold many. Boxes are met where rounding may let them be. */

#define WF_TREE_WIDTH 8

/* A box for each bit of `used`. Those that lie higher along an axis than most of the others
 * have a place with a bit for it: rays meet boxes about in the order of their places, but for
 * the bits of axes along which they go down. */
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

#define WF_TREE_DEPTH 12

/* All points o + s d, 0 <= s <= most, with o and d each in a box. */
typedef struct wf_shaft {
    wf_bounds o, d;
    double rise[3], fall[3]; /* 1 / d.high, 1 / d.low */
    double most;
} wf_shaft;

/* The rays of a packet as trees see them: along each axis what is less from the low and the
 * high planes of boxes, and one over the direction, never infinite. */
typedef struct wf_walk {
    _Alignas(64) double less_low[3][WF_PACKET], less_high[3][WF_PACKET], inverse[3][WF_PACKET];
    uint8_t down[WF_PACKET]; /* a bit for each axis along which the ray goes down */
} wf_walk;

/* So many rays are on their way at once, a step each in turn. */
#define WF_WAYS 64

/* Rays on their ways, and for each the nodes that it has yet to come to, the nearest last. */
#define WF_STOPS (WF_TREE_DEPTH * WF_TREE_WIDTH)
typedef struct wf_ways {
    int count;
    int ray[WF_WAYS];   /* of the walk */
    int stops[WF_WAYS]; /* that are left; 0: the way has ended */
    int row[WF_WAYS];   /* of near and node: a row for each way, and each that is free, once */
    double near[WF_WAYS][WF_STOPS]; /* no part of the node is met before this s */
    int32_t node[WF_WAYS][WF_STOPS];
} wf_ways;

/* Items that rays have come to: a guess and those of one node for each way, and a node more. */
#define WF_MET (WF_WAYS * (WF_TREE_WIDTH + 1) + WF_TREE_WIDTH)
typedef struct wf_met {
    int count;
    _Alignas(64) double near[WF_MET]; /* no part of the item is met before this s */
    int32_t item[WF_MET], ray[WF_MET];
} wf_met;

typedef struct wf_walk_ops {
    /* Has the rays of a packet, and those that pad it, set out for a tree. */
    void (*begin)(const wf_tree *tree, const wf_rays *rays, wf_walk *walk);
    /* Takes each way one node further; what lies beyond `most` of its ray is of no interest.
     * Appends those items whose boxes the rays may meet. */
    void (*step)(const wf_tree *tree, const wf_walk *walk, const double *most, wf_ways *ways,
                 wf_met *met);
    /* Appends to found, in no order, the items whose boxes the shaft may reach, and stops soon
     * after it has found more than `most`; found has space for every item. Returns how many. */
    int (*find)(const wf_tree *tree, const wf_shaft *shaft, int most, int *found);
} wf_walk_ops;

static inline void wf_ways_clear(wf_ways *ways) {
    ways->count = 0;
    for (int k = 0; k < WF_WAYS; k++) ways->row[k] = k;
}

/* Has a ray set out; there are less than WF_WAYS on their ways. */
static inline void wf_ways_add(const wf_tree *tree, int ray, wf_ways *ways) {
    int k = ways->count++;
    ways->ray[k] = ray;
    ways->stops[k] = tree->node_count > 0;
    ways->near[ways->row[k]][0] = 0;
    ways->node[ways->row[k]][0] = 0;
}

/* Takes one away, and has the last take its place. */
static inline void wf_ways_remove(int k, wf_ways *ways) {
    int last = --ways->count, row = ways->row[k];
    ways->ray[k] = ways->ray[last];
    ways->stops[k] = ways->stops[last];
    ways->row[k] = ways->row[last];
    ways->row[last] = row;
}

WF_ISA_DECLARE(wf_walk_ops);

#endif
