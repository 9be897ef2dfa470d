#ifndef WF_CONVERT_READ_TELEVISION_H
#define WF_CONVERT_READ_TELEVISION_H

#include "color/composite/composite.h"
#include "filters/raster/raster.h"

/* Completes tv (of which encoder and decoder are the caller's) with the raster's composite
 * system, size and line map: NTSC for 525 lines, PAL for 625. False if the raster has none:
 * only 720 samples of a map of 525 or 625 lines are 13.5 MHz. */
bool wf_television_of(const wf_raster *raster, wf_tv *tv);

#endif
