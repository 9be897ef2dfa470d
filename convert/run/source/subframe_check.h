#ifndef WF_CONVERT_RUN_SOURCE_SUBFRAME_CHECK_H
#define WF_CONVERT_RUN_SOURCE_SUBFRAME_CHECK_H

#include "convert/job/job.h"
#include "convert/read/source.h"

/* What the first subframe is, which all others must be too. */
typedef struct wf_first_subframe {
    wf_image_info info;
    wf_pick pick;
    wf_file_colors colors;
    char part_name[WF_LAYER_SIZE];
} wf_first_subframe;

wf_first_subframe wf_first_subframe_of(const wf_subframe *subframe);

/* Refuses a subframe of another size, pixel aspect (unless --input-par gives all of them one),
 * kind of channels, layer, part or (unless --from names one for all) color space than the
 * first: it would be shown as what it is not. Alpha may come and go, and each file's own
 * counts. own_part: parts are subframes, and so differ. */
weft_status wf_check_subframe(const weft_job *job, const wf_first_subframe *first,
                              const char *path, bool own_part, const wf_subframe *subframe,
                              weft_error *err);

#endif
