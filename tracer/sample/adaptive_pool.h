#ifndef WF_TRACER_SAMPLE_ADAPTIVE_POOL_H
#define WF_TRACER_SAMPLE_ADAPTIVE_POOL_H

#include "tracer/sample/adaptive_cells.h"

/* How wrong cells may be, as those about them say it, too: few samples of one cell can agree
 * where it is anything but even. */

/* What cells may be off, of the error asked for, before it is known how many are uncertain. */
#define WF_FIRST_CAUTION 0.4

/* Finds for the tile's cells, edges left out, what error their samples leave (`need`), and for
 * the tile how fast errors fall as samples become more (`fall`),
 * and what they may be off (`caution`). */
void wf_pool_errors(wf_adaptive *a);

#endif
