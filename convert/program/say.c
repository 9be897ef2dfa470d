/* What commands print: messages on standard error, JSON on standard output. */
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "convert/base/fail.h"
#include "convert/program/cmd.h"

weft_status wf_cmd_print_json(char *text, weft_error *err) {
    if (!text) return wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    fputs(text, stdout);
    free(text);
    return WEFT_OK;
}

void wf_cmd_say(const char *kind, const char *text) {
    const char *no_color = getenv("NO_COLOR");
    bool color = *kind && isatty(STDERR_FILENO) && !(no_color && *no_color);
    if (color)
        fprintf(stderr, "weft: \033[1m%s\033[0m%s\n", kind, text);
    else
        fprintf(stderr, "weft: %s%s\n", kind, text);
}
