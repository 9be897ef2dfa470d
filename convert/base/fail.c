/* Messages for people, and the status that goes with them. */
#include "convert/base/fail.h"

#include <stdarg.h>
#include <stdio.h>

weft_status wf_fail(weft_error *err, weft_status status, const char *format, ...) {
    if (err) {
        va_list args;
        va_start(args, format);
        vsnprintf(err->text, sizeof err->text, format, args);
        va_end(args);
    }
    return status;
}
