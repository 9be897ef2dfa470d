/* Rasters as the public header has them. */
#ifndef WF_CONVERT_JOB_RASTER_TELL_H
#define WF_CONVERT_JOB_RASTER_TELL_H

#include "convert/weft.h"
#include "filters/raster/raster.h"

void wf_raster_tell(const wf_raster *raster, weft_raster *out);

#endif
