#ifndef WF_CONVERT_BASE_OUTPLACE_H
#define WF_CONVERT_BASE_OUTPLACE_H

#include "convert/base/fail.h"

/* Where a file is to appear and where it is until then: without a name in the same directory
 * (O_TMPFILE), or, where the file system has no such files, beside it as .NAME.PID.N.tmp. A
 * link at the end of the path is followed, and what it leads to is replaced. */
typedef struct wf_outplace {
    char *path;      /* as it was asked for, for messages */
    char *target;    /* links followed */
    char *temporary; /* NULL: without a name */
    bool overwrite;
} wf_outplace;

/* Opens a new file for what is to become `path`, mode 0666 less the umask. An existing file is
 * an error unless overwrite, a directory always. Whatever the status, wf_outplace_forget
 * releases. */
weft_status wf_outplace_open(const char *path, bool overwrite, wf_outplace *out, int *fd,
                             weft_error *err);

/* Gives the file, which is whole and synced, its name, syncs the directory, and closes fd in
 * any case. On failure nothing new stands at the name. */
weft_status wf_outplace_publish(wf_outplace *place, int fd, weft_error *err);

/* Frees, and removes the temporary file if it is still there. */
void wf_outplace_forget(wf_outplace *place);

#endif
