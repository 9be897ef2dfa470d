#ifndef WF_CONVERT_READ_SELECTION_H
#define WF_CONVERT_READ_SELECTION_H

#include "convert/base/names.h"
#include "convert/read/sequence.h"

/* Files with numbers, which of them a job takes, and how they are spoken of. Borrowed. */
typedef struct wf_candidates {
    const wf_numbered *entry; /* in the order of their numbers */
    size_t count;             /* at least 1 */
    const char *directory;    /* put before every name: "" or something that ends in '/' */
    const char *input;        /* what the user called them */
    int64_t most;             /* numbers that may be selected: WF_RANGE_MOST */
} wf_candidates;

/* Lists the subframes that the range frames (NULL: from the first number to the last) takes,
 * those without a file included. The step between numbers is wf_number_step's; where that is a
 * guess, out->notice says so, and a range is taken as it is written. Two files of one number, a
 * range that meets no file and more than `most` numbers are errors. On failure *out is empty.
 * Looks at no file. */
weft_status wf_select(const wf_candidates *from, const char *frames, wf_sequence *out,
                      weft_error *err);

/* The end of a path that is too long for a message, else the path. */
const char *wf_path_tail(const char *path);

#endif
