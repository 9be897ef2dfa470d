/* Limits on figures, by which a pipeline stops at what is too bad. */
#ifndef WF_CONVERT_ASK_MEASURE_LIMIT_H
#define WF_CONVERT_ASK_MEASURE_LIMIT_H

#include "convert/check/measure.h"

typedef struct wf_limit {
    const wf_figure_kind *kind; /* NULL: the limit is on the verdict about field order */
    double value;
    const char *verdict;
} wf_limit;

/* Reads a limit such as "flicker.rms=0.01", "difference.psnr=40" or "order.verdict=tff". The
 * limit's verdict borrows from text. */
weft_status wf_limit_parse(const char *text, wf_limit *out, weft_error *err);

/* WEFT_FAILED, saying so, where the figure exceeds the limit or could not be measured. */
weft_status wf_limit_check(const wf_limit *limit, const char *path, const wf_figures *figures,
                           weft_error *err);

#endif
