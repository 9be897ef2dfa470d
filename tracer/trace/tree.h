#ifndef WF_TRACER_TRACE_TREE_H
#define WF_TRACER_TRACE_TREE_H

#include "tracer/rays/walk.h"

/* A tree over items (copied) of an array of boxes, all of them finite: halved about the middle
 * along the axis on which the boxes lie widest apart, until there are eight in each node.
 * False: no memory. */
bool wf_tree_new(const wf_bounds *bounds, const int *items, int count, wf_tree *out);
void wf_tree_free(wf_tree *tree);

#endif
