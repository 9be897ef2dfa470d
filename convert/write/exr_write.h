#ifndef WF_CONVERT_WRITE_EXR_WRITE_H
#define WF_CONVERT_WRITE_EXR_WRITE_H

#include "convert/media/picture_out.h"

/* OpenEXR (its file layout, version 2): float samples (bits 32) in scan lines, ZIP, both
 * windows the picture; alpha is premultiplied. Attributes are those of OpenEXR's
 * ImfStandardAttributes.h, and weft's own: weft:raster, weft:colorSpace, weft:field,
 * weft:subframeRate, weft:time. */
wf_encode_picture_fn wf_exr_encode;

#endif
