/* Values of apertures, in loops. */
#ifndef WF_FILTERS_APERTURE_PROFILE_H
#define WF_FILTERS_APERTURE_PROFILE_H

#include "filters/aperture/aperture.h"
#include "filters/base/isa.h"

/* h itself, unnormalized, for samples that the window sees (|q| <= tau / 2): for each of count
 * pairs v, q the height that it has for all |u| <= half_u. Arrays of [count]. */
typedef void wf_profile_fn(const wf_aperture *a, double tau, int count, const double *v,
                           const double *q, double *height, double *half_u);

typedef struct wf_profile_ops {
    wf_profile_fn *of[WF_PROFILES]; /* by wf_profile */
} wf_profile_ops;

WF_ISA_DECLARE(wf_profile_ops);

/* Coefficients of 6 m(v) by powers of |v|, in |v| < 1 and 1 <= |v| < 2. */
void wf_mitchell_poly(const wf_aperture *a, double near[4], double far[4]);

#endif
