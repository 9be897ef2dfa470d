#ifndef WF_CONVERT_MEDIA_EXR_TIMES_H
#define WF_CONVERT_MEDIA_EXR_TIMES_H

#include <openexr.h>

#include "convert/media/image.h"

/* Rates and times in EXR headers, of whatever type renderers write them. */

/* An attribute of a part as a ratio: a rational, two whole numbers, a whole number, a float or
 * double (wf_rate_near, of either sign), or text that reads as one, with or without "fps".
 * {0, 0}: it is not there, or no ratio. */
wf_rational wf_exr_ratio(exr_const_context_t exr, int part, const char *name);

/* Fills rate, frames, time_s, counts_files and no_rate of what a part says of itself. */
void wf_exr_read_times(exr_const_context_t exr, int part, wf_image_info *info);

#endif
