#ifndef WF_CONVERT_CHECK_VERIFY_CHECK_RASTER_H
#define WF_CONVERT_CHECK_VERIFY_CHECK_RASTER_H

#include "convert/check/verify/subject.h"

/* What the file says of its pictures, against its raster. */
wf_check_fn wf_check_raster, wf_check_size, wf_check_rate, wf_check_flags, wf_check_coded,
    wf_check_aspect, wf_check_colors;

#endif
