#ifndef WF_TRACER_TRACE_WIDE_H
#define WF_TRACER_TRACE_WIDE_H

#include "tracer/rays/walk.h"
#include "tracer/trace/bounds.h"

/* Makes a tree for single rays over items (whose order changes) of bounds, all of them finite.
 * False: no memory. */
bool wf_wide_new(const wf_bounds *bounds, int *items, int count, wf_walk_tree *out);
void wf_wide_free(wf_walk_tree *tree);

#endif
