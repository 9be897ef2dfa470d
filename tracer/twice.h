#ifndef WF_TRACER_TWICE_H
#define WF_TRACER_TWICE_H

#include <math.h>

/* Numbers of twice a double's digits, as sums of two (Dekker 1971, Knuth's exact sum), where a
 * sign hangs on what doubles cancel. */
typedef struct wf_twice {
    double high, low;
} wf_twice;

static inline wf_twice wf_twice_sum(wf_twice a, wf_twice b) {
    double sum = a.high + b.high, of_b = sum - a.high;
    double rest = (a.high - (sum - of_b)) + (b.high - of_b) + (a.low + b.low);
    double high = sum + rest;
    return (wf_twice){high, rest - (high - sum)};
}

static inline wf_twice wf_twice_product(wf_twice a, wf_twice b) {
    double product = a.high * b.high;
    double rest = fma(a.high, b.high, -product) + (a.high * b.low + a.low * b.high);
    double high = product + rest;
    return (wf_twice){high, rest - (high - product)};
}

static inline wf_twice wf_twice_of(double v) {
    return (wf_twice){v, 0};
}

static inline wf_twice wf_twice_minus(wf_twice a) {
    return (wf_twice){-a.high, -a.low};
}

#endif
