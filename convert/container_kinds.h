#ifndef WF_CONVERT_CONTAINER_KINDS_H
#define WF_CONVERT_CONTAINER_KINDS_H

#include "convert/container.h"

/* Inside the mending of containers: what each kind of file needs. */
weft_status wf_container_mend_mov(wf_outfile *file, const wf_raster *raster, weft_error *err);
weft_status wf_container_mend_mxf(wf_outfile *file, const wf_raster *raster, weft_error *err);

#endif
