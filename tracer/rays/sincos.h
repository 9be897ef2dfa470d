#ifndef WF_TRACER_RAYS_SINCOS_H
#define WF_TRACER_RAYS_SINCOS_H

#include <math.h>

/* Cosine and sine of an angle in turns, without a branch or a call, so that loops over them
 * become vectors: exact reduction to an eighth of a turn (differences of near numbers are
 * exact), then the series, whose next terms are below 1e-17 there. Turns beyond 2^51 are whole.
 */
static inline void wf_sincos_turns(double turns, double *cosine, double *sine) {
    const double adjust = 0x1.8p52, tau = 6.283185307179586476925;
    double u = turns - ((turns + adjust) - adjust), quarter = (4 * u + adjust) - adjust;
    double x = (u - quarter / 4) * tau, q = x * x;
    double s =
        x +
        x * q *
            (-1. / 6 +
             q * (1. / 120 +
                  q * (-1. / 5040 +
                       q * (1. / 362880 + q * (-1. / 39916800 +
                                               q * (1. / 6227020800. - q / 1307674368000.))))));
    double c =
        1 + q * (-1. / 2 +
                 q * (1. / 24 +
                      q * (-1. / 720 +
                           q * (1. / 40320 + q * (-1. / 3628800 +
                                                  q * (1. / 479001600 - q / 87178291200.))))));
    double swap = quarter * quarter == 1 ? 1 : 0, half = quarter * quarter == 4 ? -1 : 1;
    double cs = swap != 0 ? -quarter * s : half * c, sn = swap != 0 ? quarter * c : half * s;
    *cosine = cs;
    *sine = sn;
}

#endif
