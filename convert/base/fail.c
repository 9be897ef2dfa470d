/* Messages for people, and the status that goes with them. */
#include "convert/base/fail.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Names of files may hold line breaks, and what terminals obey. */
static void keep_to_one_line(char *text) {
    for (; *text; text++)
        if ((unsigned char)*text < ' ' || *text == 0x7f) *text = '?';
}

weft_status wf_fail(weft_error *err, weft_status status, const char *format, ...) {
    if (err) {
        va_list args;
        va_start(args, format);
        vsnprintf(err->text, sizeof err->text, format, args);
        va_end(args);
        keep_to_one_line(err->text);
    }
    return status;
}

void wf_error_rename(weft_error *err, const char *from, const char *to) {
    const weft_error old = err ? *err : (weft_error){""};
    const char *at = *from ? strstr(old.text, from) : NULL;
    if (!at) return;
    wf_fail(err, WEFT_OK, "%.*s%s%s", (int)(at - old.text), old.text, to, at + strlen(from));
}
