#ifndef WF_CONVERT_MEDIA_EXR_REGION_H
#define WF_CONVERT_MEDIA_EXR_REGION_H

#include "convert/base/fail.h"
#include "convert/media/image.h"

/* weft:region of an EXR file: outside of it the samples of this subframe do not exist. It is a
 * box2i in the coordinates of the file's windows, its last pixels included, or text,
 * "x0,y0,x1,y1" from the display window's upper left corner, its last pixels not included, as
 * plans have it. *region is half-open and counted from that corner; *has is false where the
 * first header of the file has no such attribute, and for files of other formats. Only the
 * header is read, by itself: this is asked of every file of a sequence. WEFT_FAILED for a
 * region without a pixel of the display or data window, and for what is no region. */
weft_status wf_exr_region(const char *path, wf_box *region, bool *has, weft_error *err);

#endif
