#ifndef WF_CONVERT_CONTAINER_H
#define WF_CONVERT_CONTAINER_H

#include "convert/outfile.h"
#include "filters/raster.h"

/* Mends in a finished file, before it gets its name, what libavformat 5.1 writes of its own
 * belief: in MXF (muxers "mxf" and "mxf_d10", SMPTE ST 377-1) the line map and the aspect ratio
 * of every picture descriptor become the raster's, which is as it is in the file. Of other
 * muxers nothing. */
weft_status wf_container_mend(wf_outfile *file, const char *muxer, const wf_raster *raster,
                              weft_error *err);

#endif
