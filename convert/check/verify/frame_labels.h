#ifndef WF_CONVERT_CHECK_VERIFY_FRAME_LABELS_H
#define WF_CONVERT_CHECK_VERIFY_FRAME_LABELS_H

#include "convert/base/fail.h"
#include "convert/base/values.h"
#include "filters/base/rational.h"

/* What the files of an image sequence say of their places in it (DPX: SMPTE ST 268-1, the
 * television header; EXR: timeCode). */
typedef struct wf_frame_labels {
    int64_t files, labeled;
    wf_timecode first;      /* of the first file that has one */
    int64_t wrong;          /* files whose label does not follow from the first's */
    wf_timecode is, should; /* of the first of those; its place is wrong_at */
    int64_t wrong_at;
    int interlace; /* DPX: 0 or 1 as all of them say, -1 as they say nothing or different things
                    */
} wf_frame_labels;

/* Reads the headers of a sequence, or of a single file, at `rate` frames a second; `fields` is
 * how many files a frame has. Files that cannot be read have no label. */
weft_status wf_frame_labels_read(const char *path, wf_rational rate, int fields,
                                 wf_frame_labels *out, weft_error *err);

#endif
