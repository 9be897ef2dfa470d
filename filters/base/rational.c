/* Exact ratios of 64-bit numbers, worked out in 128 bits. */
#include "filters/base/rational.h"

#include <string.h>

__extension__ typedef __int128 wide;

static const wf_rational not_given = {0, 0};

#define EXACT_DECIMALS 9
#define DECIMALS_UNIT  1000000000000000000 /* 10^18 */
#define SAME_DOUBLE    0x1p-53L            /* off by so much of a number and less */

static wide common_divisor(wide a, wide b) {
    while (b) {
        wide rest = a % b;
        a = b;
        b = rest;
    }
    return a < 0 ? -a : a;
}

static bool fits(wide value) {
    return value >= INT64_MIN && value <= INT64_MAX;
}

static wf_rational reduced(wide num, wide den) {
    if (den == 0) return not_given;
    wide divisor = common_divisor(num, den);
    if (den < 0) divisor = -divisor;
    num /= divisor;
    den /= divisor;
    return fits(num) && fits(den) ? (wf_rational){(int64_t)num, (int64_t)den} : not_given;
}

wf_rational wf_ratio(int64_t num, int64_t den) {
    return reduced(num, den);
}

double wf_ratio_value(wf_rational r) {
    return (double)r.num / (double)r.den;
}

bool wf_ratio_given(wf_rational r) {
    return r.den != 0;
}

bool wf_ratio_equal(wf_rational a, wf_rational b) {
    return (wide)a.num * b.den == (wide)b.num * a.den && (a.den == 0) == (b.den == 0);
}

wf_rational wf_ratio_sum(wf_rational a, wf_rational b) {
    return reduced((wide)a.num * b.den + (wide)b.num * a.den, (wide)a.den * b.den);
}

wf_rational wf_ratio_difference(wf_rational a, wf_rational b) {
    return reduced((wide)a.num * b.den - (wide)b.num * a.den, (wide)a.den * b.den);
}

wf_rational wf_ratio_mul(wf_rational a, wf_rational b) {
    return reduced((wide)a.num * b.num, (wide)a.den * b.den);
}

wf_rational wf_ratio_div(wf_rational a, wf_rational b) {
    return a.den && b.den ? reduced((wide)a.num * b.den, (wide)a.den * b.num) : not_given;
}

int64_t wf_ratio_floor_mul(wf_rational a, int64_t n) {
    wide product = (wide)a.num * n / a.den;
    return fits(product) ? (int64_t)product : INT64_MAX;
}

/* Reads digits onto *value; returns how many there were, or -1 if they do not fit. */
static int read_digits(const char **text, int64_t *value) {
    int count = 0;
    for (; **text >= '0' && **text <= '9'; ++*text, count++)
        if (__builtin_mul_overflow(*value, 10, value) ||
            __builtin_add_overflow(*value, **text - '0', value))
            return -1;
    return count;
}

/* Reads digits behind a point as *part of 10^18, more of which there are no use for; returns
 * how many there were. */
static int read_decimals(const char **text, int64_t *part) {
    int64_t place = DECIMALS_UNIT;
    int count = 0;
    for (*part = 0; **text >= '0' && **text <= '9'; ++*text, count++)
        *part += (place /= 10) * (**text - '0');
    return count;
}

/* The simplest ratio that is the same double as whole + part / 10^18, by continued fractions:
 * what `below` has left is how far num/den is off, times den. {0, 0} where it does not fit. */
static wf_rational near_decimal(int64_t whole, int64_t part) {
    wide above = part, below = DECIMALS_UNIT, num[2] = {1, 0}, den[2] = {0, 1};
    long double size = (long double)whole * DECIMALS_UNIT + (long double)part;
    while ((long double)below > (long double)den[0] * size * SAME_DOUBLE) {
        wide times = above / below, rest = above - times * below;
        wide next[2] = {times * num[0] + num[1], times * den[0] + den[1]};
        num[1] = num[0];
        den[1] = den[0];
        num[0] = next[0];
        den[0] = next[1];
        above = below;
        below = rest;
    }
    return reduced(whole * den[0] + num[0], den[0]);
}

/* Up to nine decimals are exact. */
static wf_rational exact_decimal(int64_t whole, int64_t part, int decimals) {
    int64_t unit = 1;
    while (decimals--) unit *= 10;
    return reduced((wide)whole * unit + part / (DECIMALS_UNIT / unit), unit);
}

bool wf_ratio_parse(const char *text, wf_rational *out) {
    int64_t num = 0, den = 1, part;
    int digits = read_digits(&text, &num);
    wf_rational ratio;
    if (digits > 0 && (*text == '/' || *text == ':')) {
        text++;
        den = 0;
        if (read_digits(&text, &den) < 1) return false;
        ratio = wf_ratio(num, den);
    } else if (digits >= 0 && *text == '.') {
        text++;
        int decimals = read_decimals(&text, &part);
        if (decimals < 1) return false;
        ratio = decimals <= EXACT_DECIMALS ? exact_decimal(num, part, decimals)
                                           : near_decimal(num, part);
    } else {
        if (digits < 1) return false;
        ratio = wf_ratio(num, den);
    }
    if (*text || !wf_ratio_given(ratio)) return false;
    *out = ratio;
    return true;
}

/* What 29.97 stands for, if a rate is such an abbreviation, else the rate. */
static wf_rational broadcast_rate(wf_rational rate) {
    static const struct {
        wf_rational said, meant;
    } abbreviations[] = {
        {{23976, 1000}, {24000, 1001}}, {{2398, 100}, {24000, 1001}},
        {{2997, 100}, {30000, 1001}},   {{4795, 100}, {48000, 1001}},
        {{47952, 1000}, {48000, 1001}}, {{5994, 100}, {60000, 1001}},
        {{11988, 100}, {120000, 1001}},
    };
    for (size_t i = 0; i < sizeof abbreviations / sizeof *abbreviations; i++)
        if (wf_ratio_equal(rate, abbreviations[i].said)) return abbreviations[i].meant;
    return rate;
}

bool wf_rate_parse(const char *text, wf_rational *out) {
    if (!wf_ratio_parse(text, out)) return false;
    if (strchr(text, '.')) *out = broadcast_rate(*out);
    return true;
}

/* The ratio of the first denominator from low to high that gives the rate to `off` of itself.
 */
static wf_rational ratio_near(double rate, int64_t low, int64_t high, double off) {
    for (int64_t den = low; den <= high; den++) {
        double num = rate * (double)den, whole = (double)(int64_t)(num + 0.5);
        if (whole >= 1 && num - whole < off * num && whole - num < off * num)
            return wf_ratio((int64_t)whole, den);
    }
    return not_given;
}

/* Of rates over 1001 a float holds too few digits to tell them from others with as large a
 * denominator, and files have them as 29.97, which is off by a millionth. */
wf_rational wf_rate_near(double rate) {
    if (!(rate >= 1e-3 && rate <= 1e6)) return not_given;
    wf_rational found = ratio_near(rate, 1, 50, 1e-7);
    if (wf_ratio_given(found)) return broadcast_rate(found);
    found = ratio_near(rate * 1.001, 1, 1, 2e-6);
    if (wf_ratio_given(found)) return wf_ratio_mul(found, wf_ratio(1000, 1001));
    found = ratio_near(rate, 51, 1001, 1e-7);
    return wf_ratio_given(found) ? found : wf_ratio((int64_t)(rate * 1e6 + 0.5), 1000000);
}
