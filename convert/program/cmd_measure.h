#ifndef WF_CONVERT_PROGRAM_CMD_MEASURE_H
#define WF_CONVERT_PROGRAM_CMD_MEASURE_H

#include "convert/base/json.h"
#include "convert/check/measure.h"

/* ---- Output of 'weft measure' ---- */

/* Lines for people on standard output. */
void wf_measure_print(const char *path, const wf_measure_options *options,
                      const wf_figures *figures);

/* An object with the figures; null where there is none. error (if not NULL) is what went wrong
 * instead. */
void wf_measure_json(wf_json *json, const char *path, const wf_figures *figures,
                     const char *error);

/* ---- Limits ---- */

typedef struct wf_limit {
    const wf_figure_kind *kind; /* NULL: the order's verdict */
    double value;
    const char *verdict;
} wf_limit;

/* "flicker.rms=0.01", "difference.psnr=40", "order.verdict=tff". verdict borrows from text. */
weft_status wf_limit_parse(const char *text, wf_limit *out, weft_error *err);

/* WEFT_FAILED, saying so, where the figure exceeds the limit or could not be measured. */
weft_status wf_limit_check(const wf_limit *limit, const char *path, const wf_figures *figures,
                           weft_error *err);

#endif
