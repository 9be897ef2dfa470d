/* The response of a box. */
#ifndef WF_FILTERS_BASE_SINC_H
#define WF_FILTERS_BASE_SINC_H

#include <math.h>

/* sin(pi z) / (pi z), the response of a box of width 1. */
static inline double wf_sinc(double z) {
    return z == 0 ? 1 : sin(M_PI * z) / (M_PI * z);
}

#endif
