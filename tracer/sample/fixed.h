#ifndef WF_TRACER_SAMPLE_FIXED_H
#define WF_TRACER_SAMPLE_FIXED_H

#include "tracer/sample/sampling_inside.h"

/* Rows first <= j < end of a tile with as many samples a cell as the description says, traced
 * and handed to the receiver. False: no memory. */
bool wf_fixed_rows(const wf_tile *tile, int first, int end);

/* The same where the window is an instant that goes down the picture: each line has one of its
 * own, and samples of its own. */
bool wf_fixed_instants(const wf_tile *tile, int first, int end);

#endif
