/* Exact ratios: rates, times, widths, aspects. */
#ifndef WF_FILTERS_BASE_RATIONAL_H
#define WF_FILTERS_BASE_RATIONAL_H

#include <stdbool.h>
#include <stdint.h>

/* An exact ratio, den > 0 and reduced; den == 0 means "not given". Rates, times and widths are
 * ratios so that field 10^7 of a 60000/1001 raster starts where it should. */
typedef struct wf_rational {
    int64_t num, den;
} wf_rational;

/* floor(a / b), b > 0. */
static inline int64_t wf_floor_div(int64_t a, int64_t b) {
    return a / b - (a % b < 0);
}

/* num/den reduced, den made positive; {0, 0} if den is 0 or the result does not fit. */
wf_rational wf_ratio(int64_t num, int64_t den);

double wf_ratio_value(wf_rational r);
bool wf_ratio_given(wf_rational r);
bool wf_ratio_equal(wf_rational a, wf_rational b);

/* a + b and a - b; {0, 0} where one is not given or the result does not fit in 64 bits. */
wf_rational wf_ratio_sum(wf_rational a, wf_rational b);
wf_rational wf_ratio_difference(wf_rational a, wf_rational b);

/* a * b and a / b; {0, 0} where the result does not fit in 64 bits or b is zero. */
wf_rational wf_ratio_mul(wf_rational a, wf_rational b);
wf_rational wf_ratio_div(wf_rational a, wf_rational b);

/* floor(a * n), exact; n >= 0, a >= 0 and given. INT64_MAX where it does not fit. */
int64_t wf_ratio_floor_mul(wf_rational a, int64_t n);

/* "240", "480000/1001", "0.25", "10:11". Up to nine decimals are exact; more are the simplest
 * ratio that is the same double, so that 0.3333333333333333 is 1/3. False if text is anything
 * else or does not fit; *out is then untouched. */
bool wf_ratio_parse(const char *text, wf_rational *out);

/* As wf_ratio_parse, and the broadcast abbreviations 23.976 (23.98), 29.97, 47.95, 59.94,
 * 119.88 mean the /1001 rates. */
bool wf_rate_parse(const char *text, wf_rational *out);

/* The simplest ratio that a rate as a float stands for, to seven digits: 12.5 is 25/2, and the
 * broadcast abbreviations and 23.976024 mean the /1001 rates. {0, 0} for what is not finite or
 * not between 1/1000 and 10^6. */
wf_rational wf_rate_near(double rate);

#endif
