#ifndef WF_CONVERT_SPREAD_H
#define WF_CONVERT_SPREAD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* How many values that are not negative are spread: their RMS, and quantiles to 0.05 % of the
 * value, from a histogram whose bins are as fine as the upper bits of a float. Start with
 * wf_spread_init. */
typedef struct wf_spread {
    uint64_t *bin;
    uint64_t count, over; /* over: values above limit */
    double squares;
    float limit;
} wf_spread;

bool wf_spread_init(wf_spread *spread, float limit); /* false: no memory */
void wf_spread_free(wf_spread *spread);
void wf_spread_add(wf_spread *spread, float value); /* NaN is not counted */

/* NaN of no values. share: of the values above limit. */
double wf_spread_rms(const wf_spread *spread);
double wf_spread_share(const wf_spread *spread);
double wf_spread_quantile(const wf_spread *spread, double share);

#endif
