#ifndef WF_CONVERT_WRITE_PNG_WRITE_H
#define WF_CONVERT_WRITE_PNG_WRITE_H

#include "convert/media/picture_out.h"

/* PNG (ISO/IEC 15948, and cICP of its third edition): codes of 8 or 16 bits, alpha straight.
 * Beside the picture are its pixel aspect (pHYs), code points of its colors, and as text what
 * wrote it, its order of fields, weft:raster, weft:colorSpace, weft:timecode and weft:field. */
wf_encode_picture_fn wf_png_encode;

#endif
