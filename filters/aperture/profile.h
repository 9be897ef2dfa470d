#ifndef WF_FILTERS_APERTURE_PROFILE_H
#define WF_FILTERS_APERTURE_PROFILE_H

#include "filters/aperture/aperture.h"

/* h itself, unnormalised, for samples that the window sees (|q| <= tau / 2): for each of count
 * pairs v, q one height, that of all |u| <= half_u. Arrays of [count]. */
typedef void wf_profile_fn(const wf_aperture *a, double tau, int count, const double *v,
                           const double *q, double *height, double *half_u);

/* By wf_profile, the fastest that this processor runs; all give the same bits. */
wf_profile_fn *const *wf_profiles_best(void);

/* Coefficients of 6 m(v) by powers of |v|, in |v| < 1 and 1 <= |v| < 2. */
void wf_mitchell_poly(const wf_aperture *a, double near[4], double far[4]);

#endif
