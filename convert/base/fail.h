#ifndef WF_CONVERT_BASE_FAIL_H
#define WF_CONVERT_BASE_FAIL_H

#include "convert/weft.h"

/* Writes the message into err (if not NULL) and returns status, so that a function reports and
 * returns in one statement. The message says what was wrong, where, and what would be right. */
weft_status wf_fail(weft_error *err, weft_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Has the message (if err is not NULL) call what it calls `from` by another name, once. */
void wf_error_rename(weft_error *err, const char *from, const char *to);

#endif
