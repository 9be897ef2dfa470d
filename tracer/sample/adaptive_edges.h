#ifndef WF_TRACER_SAMPLE_ADAPTIVE_EDGES_H
#define WF_TRACER_SAMPLE_ADAPTIVE_EDGES_H

#include "tracer/sample/adaptive_cells.h"

/* Looks for one edge through each cell in question: where its samples differ, or where that
 * of a neighbor goes on. False: no memory. */
bool wf_edges_find(wf_adaptive *a);
bool wf_edges_follow(wf_adaptive *a);

void wf_edges_free(wf_edge_scratch *scratch);

#endif
