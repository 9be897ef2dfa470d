#ifndef WF_CONVERT_CHECK_HISTOGRAM_H
#define WF_CONVERT_CHECK_HISTOGRAM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* How values that are not negative are distributed: their RMS exactly, and quantiles to 0.025 %
 * of the value. A bin holds the floats that share their exponent and the upper 11 bits of their
 * mantissa. Start with wf_histogram_init. */
typedef struct wf_histogram {
    uint64_t *bin;
    uint64_t count, over; /* values in all, and of those the ones above limit */
    double squares;       /* sum of the values' squares */
    float limit;
} wf_histogram;

bool wf_histogram_init(wf_histogram *h, float limit); /* false: no memory */
void wf_histogram_free(wf_histogram *h);

/* Negative values and NaN are not counted. */
void wf_histogram_add(wf_histogram *h, float value);
void wf_histogram_add_zeros(wf_histogram *h, uint64_t count); /* so many times 0 */

/* NaN where there are no values. share is that of the values above limit; the quantile of a
 * share, 0 to 1, is the value that so many do not exceed. */
double wf_histogram_rms(const wf_histogram *h);
double wf_histogram_share(const wf_histogram *h);
double wf_histogram_quantile(const wf_histogram *h, double share);

#endif
