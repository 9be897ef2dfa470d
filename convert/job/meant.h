#ifndef WF_CONVERT_JOB_MEANT_H
#define WF_CONVERT_JOB_MEANT_H

#include <stddef.h>

/* What is meant by words of other programs, where letters do not tell. */
typedef struct wf_meant {
    const char *option; /* whose value it is; "": said is an option's name itself */
    const char *said;   /* in lower case */
    const char
        *right; /* what to write: an option with its dashes, or a value; else a sentence */
} wf_meant;

/* What `said`, in any case, means as a value of an option ("": as an option); NULL: it is not
 * known. Static storage. */
const char *wf_meant_by(const char *option, const char *said);

/* The rows, for tests; NULL past the last. */
const wf_meant *wf_meant_at(size_t index);

#endif
