/* What the parts of weft measure share. */
#ifndef WF_CONVERT_PROGRAM_CMD_MEASURE_H
#define WF_CONVERT_PROGRAM_CMD_MEASURE_H

#include "convert/base/json.h"
#include "convert/check/measure.h"

/* ---- Output of 'weft measure' ---- */

/* Prints the figures of a file as lines for people, on standard output. */
void wf_measure_print(const char *path, const wf_measure_options *options,
                      const wf_figures *figures);

/* Adds an object with the figures of a file; a figure that could not be measured is null. If
 * error is not NULL, the object holds that message instead. */
void wf_measure_json(wf_json *json, const char *path, const wf_figures *figures,
                     const char *error);

/* ---- Limits ---- */

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
