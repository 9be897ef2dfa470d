#ifndef WF_TRACER_SAMPLE_ADAPTIVE_H
#define WF_TRACER_SAMPLE_ADAPTIVE_H

#include "tracer/sample/sampling_inside.h"

/* How many cells about a tile are looked at, too, to each side. */
int wf_adaptive_about(const wf_sampling *s);

/* Samples rows first <= j < end of a tile as its error asks, hands them to the receiver, and
 * adds what error is left to the scratch's. empty: nothing but background is seen. False: no
 * memory. */
bool wf_adaptive_tile(const wf_tile *tile, int first, int end, bool empty);

#endif
