#ifndef WF_CONVERT_RUN_TIME_PICTURE_RATE_H
#define WF_CONVERT_RUN_TIME_PICTURE_RATE_H

#include "convert/job/job.h"

/* Pictures a second, held against what a raster shows. */

/* What film (--cadence) makes of the rate of its pictures, whose name for people `what` is:
 * film of 24 runs at 24000/1001 in 59.94 fields, and the other way round, a tenth of a percent
 * slower with no picture lost. WEFT_USAGE where a film frame is no whole number of pictures, or
 * the rate is {0, 0}, pictures of times of their own. */
weft_status wf_settle_film(const weft_job *job, const char *what, wf_rational *rate,
                           weft_error *err);

/* Pictures that last longer than a field are seen again by the next one: a warning. */
void wf_warn_of_few(const weft_job *job, double pictures_a_second);

#endif
