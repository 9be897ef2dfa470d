/* Rasters as the public header has them. */
#include "convert/job/raster_tell.h"

#include <string.h>

void wf_raster_tell(const wf_raster *raster, weft_raster *out) {
    *out = (weft_raster){
        .width_px = raster->width_px,
        .lines = raster->lines,
        .rate_num = raster->frame_rate.num,
        .rate_den = raster->frame_rate.den,
        .interlaced = raster->scan != WF_PROGRESSIVE,
        .segmented = raster->scan == WF_SEGMENTED,
        .top_first = raster->top_first,
        .pixel_aspect_num = raster->pixel_aspect.num,
        .pixel_aspect_den = raster->pixel_aspect.den,
        .matrix = wf_matrix_name(raster->matrix),
        .line1 = raster->line1,
        .line2 = raster->line2,
        .total_lines = raster->total_lines,
    };
    memcpy(out->name, raster->name, sizeof out->name);
}
