#ifndef WF_TRACER_SAMPLE_ADAPTIVE_PACKETS_H
#define WF_TRACER_SAMPLE_ADAPTIVE_PACKETS_H

#include "tracer/sample/adaptive_cells.h"

/* Finds the light of all samples from the first on. False: no memory. */
bool wf_points_trace(const wf_adaptive *a, wf_adaptive_samples *samples, size_t first);

void wf_packet_order_free(wf_packet_order *order);

#endif
