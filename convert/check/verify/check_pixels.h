#ifndef WF_CONVERT_CHECK_VERIFY_CHECK_PIXELS_H
#define WF_CONVERT_CHECK_VERIFY_CHECK_PIXELS_H

#include "convert/check/verify/subject.h"

/* What is in the pixels, whatever the file says. */
wf_check_fn wf_check_order, wf_check_reading, wf_check_levels, wf_check_reserved;

#endif
