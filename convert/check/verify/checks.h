#ifndef WF_CONVERT_CHECK_VERIFY_CHECKS_H
#define WF_CONVERT_CHECK_VERIFY_CHECKS_H

#include <stddef.h>

#include "convert/check/verify/subject.h"

/* Findings that a verification has capacity for: at least the rows of `checks` (checks.c). */
#define WF_FINDINGS_MOST 64

/* Puts the file to every check that applies to it and that its profile asks for. Returns how
 * many findings there are in finding. */
size_t wf_run_checks(const wf_subject *subject, wf_finding finding[WF_FINDINGS_MOST]);

#endif
