#ifndef WF_TRACER_SAMPLE_ADAPTIVE_SPECKS_H
#define WF_TRACER_SAMPLE_ADAPTIVE_SPECKS_H

#include "tracer/sample/adaptive_cells.h"

/* Finds in which cells there may be something that first samples can miss, as the scene says;
 * how many samples of a quarter those are to have (`first`), and which of them can learn
 * nothing of it from others (`rare`). They have had their first samples. */
void wf_specks_find(wf_adaptive *a);

#endif
