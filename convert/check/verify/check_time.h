#ifndef WF_CONVERT_CHECK_VERIFY_CHECK_TIME_H
#define WF_CONVERT_CHECK_VERIFY_CHECK_TIME_H

#include "convert/check/verify/subject.h"

/* Labels of time, how many frames there are and how much sound. */
wf_check_fn wf_check_timecode, wf_check_labels, wf_check_interlace, wf_check_base,
    wf_check_frames, wf_check_sound;

#endif
