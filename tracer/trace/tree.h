#ifndef WF_TRACER_TRACE_TREE_H
#define WF_TRACER_TRACE_TREE_H

#include "tracer/trace/bounds.h"

/* A tree of boxes over some of the items of an array of boxes. Immutable once made. */
typedef struct wf_tree_node {
    wf_bounds bounds;
    int first, count; /* items of a leaf; count 0: the children are first and first + 1 */
} wf_tree_node;

typedef struct wf_tree {
    wf_tree_node *nodes;
    int *items; /* indices into the array of boxes */
    int node_count, item_count;
} wf_tree;

/* A tree over items (copied) of bounds, all of them finite. False: no memory. */
bool wf_tree_new(const wf_bounds *bounds, const int *items, int count, wf_tree *out);
void wf_tree_free(wf_tree *tree);

/* Appends to found, in no order, the items whose boxes the shaft may reach, and stops soon
 * after it has found more than `most`; found has space for every item. Returns how many. */
int wf_tree_meet(const wf_tree *tree, const wf_bounds *bounds, const wf_shaft *shaft, int most,
                 int *found);

/* Puts those items first whose middles are smaller, along the axis on which the middles lie
 * widest apart: count / 2 of them. */
void wf_tree_halve(const wf_bounds *bounds, int *items, int count);

/* The box around the boxes of items. */
wf_bounds wf_tree_around(const wf_bounds *bounds, const int *items, int count);

#endif
