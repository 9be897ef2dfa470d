#ifndef WF_CONVERT_RUN_SUM_GATHERED_LINE_H
#define WF_CONVERT_RUN_SUM_GATHERED_LINE_H

#include "convert/job/job.h"
#include "filters/gather/samples.h"

/* A line of a field whose samples have all been gathered. */
typedef struct wf_gathered_line {
    const weft_job *job;
    const wf_gather *gather;
    int64_t field;
    int line;           /* of the field */
    int called;         /* the number that an error calls it by */
    const char *remedy; /* what an error tells to set */
    float *alpha;       /* [width_px], to be filled; NULL: it is not gathered */
} wf_gathered_line;

/* Puts it into rgb as R, G, B of width_px scene-linear samples, and its alpha. A pixel that no
 * sample reached is an error or, with --on-empty nearest, what is nearest to it, and *filled
 * counts it. Any thread. */
weft_status wf_gathered_finish(const wf_gathered_line *line, float *const rgb[3],
                               int64_t *filled, weft_error *err);

#endif
