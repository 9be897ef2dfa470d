#ifndef WF_CONVERT_CHECK_HISTOGRAM_H
#define WF_CONVERT_CHECK_HISTOGRAM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* How many values that are not negative are spread: their RMS, and quantiles to 0.05 % of the
 * value, from a histogram whose bins are as fine as the upper bits of a float. Start with
 * wf_histogram_init. */
typedef struct wf_histogram {
    uint64_t *bin;
    uint64_t count, over; /* over: values above limit */
    double squares;
    float limit;
} wf_histogram;

bool wf_histogram_init(wf_histogram *spread, float limit); /* false: no memory */
void wf_histogram_free(wf_histogram *spread);
void wf_histogram_add(wf_histogram *spread, float value); /* NaN is not counted */

/* NaN of no values. share: of the values above limit. */
double wf_histogram_rms(const wf_histogram *spread);
double wf_histogram_share(const wf_histogram *spread);
double wf_histogram_quantile(const wf_histogram *spread, double share);

#endif
