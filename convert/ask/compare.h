/* Pages of one job done several times, through an aperture or flicker held each. */
#ifndef WF_CONVERT_ASK_COMPARE_H
#define WF_CONVERT_ASK_COMPARE_H

#include "convert/page/page.h"

/* Runs the job once for each entry of `list` and shows what comes out on one page, which the
 * job's output names; its video lies in $TMPDIR, else /tmp, while it is looked at, one clip at
 * a time. An entry is an aperture and what is held, and names its clip: "box", "least:4",
 * "line+limit=.06", "line+weight=2+limit=visible:1". Of the request title, max_bytes,
 * max_memory_bytes, progress, warning and their users are looked at. WEFT_DEGRADED where a run
 * was. */
weft_status wf_ask_compare(weft_job *job, const char *list, const wf_page_request *request,
                           weft_error *err);

#endif
