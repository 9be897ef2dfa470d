#ifndef WF_CONVERT_MEDIA_COLOR_TAGS_H
#define WF_CONVERT_MEDIA_COLOR_TAGS_H

#include "convert/base/fail.h"
#include "convert/media/image.h"

/* Reads what a picture file of that format (wf_format_of) says of its colors where OpenImageIO
 * does not tell: chunks of PNG (ISO/IEC 15948: cICP, sRGB, gAMA, cHRM, iCCP) and WebP (ICCP),
 * fields of DPX (SMPTE ST 268-1), PRIMARIES of Radiance's HDR, tags of TIFF, inks of JPEG. Adds
 * to *said. WEFT_FAILED if the system cannot read the file; what is damaged is not said. */
weft_status wf_read_color_tags(const char *path, const char *format, wf_color_said *said,
                               weft_error *err);

#endif
