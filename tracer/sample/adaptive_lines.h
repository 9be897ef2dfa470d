#ifndef WF_TRACER_SAMPLE_ADAPTIVE_LINES_H
#define WF_TRACER_SAMPLE_ADAPTIVE_LINES_H

#include "tracer/sample/adaptive_cells.h"

/* Most lines that a cell is integrated over. */
#define WF_MOST_LINES 256

/* Hands over the cells whose edges were found, each with the weight 1. False: no memory. */
bool wf_edges_emit(const wf_adaptive *a);

#endif
