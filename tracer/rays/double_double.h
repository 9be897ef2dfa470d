#ifndef WF_TRACER_RAYS_DOUBLE_DOUBLE_H
#define WF_TRACER_RAYS_DOUBLE_DOUBLE_H

#include <math.h>

/* Numbers of twice a double's digits, as sums of two (Dekker 1971, Knuth's exact sum), where a
 * sign hangs on what doubles cancel. */
typedef struct wf_double_double {
    double high, low;
} wf_double_double;

static inline wf_double_double wf_double_double_sum(wf_double_double a, wf_double_double b) {
    double sum = a.high + b.high, of_b = sum - a.high;
    double rest = (a.high - (sum - of_b)) + (b.high - of_b) + (a.low + b.low);
    double high = sum + rest;
    return (wf_double_double){high, rest - (high - sum)};
}

static inline wf_double_double wf_double_double_product(wf_double_double a,
                                                        wf_double_double b) {
    double product = a.high * b.high;
    double rest = fma(a.high, b.high, -product) + (a.high * b.low + a.low * b.high);
    double high = product + rest;
    return (wf_double_double){high, rest - (high - product)};
}

static inline wf_double_double wf_double_double_of(double v) {
    return (wf_double_double){v, 0};
}

static inline wf_double_double wf_double_double_minus(wf_double_double a) {
    return (wf_double_double){-a.high, -a.low};
}

#endif
