#ifndef WF_CONVERT_CHECK_VERIFY_CHECK_WHOLE_H
#define WF_CONVERT_CHECK_VERIFY_CHECK_WHOLE_H

#include "convert/check/verify/subject.h"

/* Checks: whether all of the file is there, and whether it says which material it is.
 * wf_check_fn (subject.h) says what they do. */
wf_check_fn wf_check_whole, wf_check_header, wf_check_durations, wf_check_identity;

/* How long the picture is that is there, in seconds: repeated fields are shown, too. */
double wf_picture_s(const wf_subject *subject);

#endif
