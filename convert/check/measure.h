#ifndef WF_CONVERT_CHECK_MEASURE_H
#define WF_CONVERT_CHECK_MEASURE_H

#include "convert/check/figures.h"
#include "convert/check/measure_options.h"

/* Reads the video to its end and fills figures. WEFT_USAGE where what is asked does not fit
 * the file; WEFT_FAILED where the file is damaged, of odd height or of mixed sizes. */
weft_status wf_measure(const char *path, const wf_measure_options *options, wf_figures *figures,
                       weft_error *err);

#endif
