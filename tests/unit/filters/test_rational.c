/* Exact ratios against 128-bit arithmetic, and what texts mean. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "filters/base/rational.h"

__extension__ typedef __int128 wide;

static uint64_t random_next(uint64_t *state) {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return *state;
}

/* Numbers of every size, the ends of the range among them. */
static int64_t random_term(uint64_t *state) {
    static const int64_t ends[] = {INT64_MIN, INT64_MIN + 1, -1,       0,
                                   1,         INT64_MAX - 1, INT64_MAX};
    if (random_next(state) % 8 == 0) return ends[random_next(state) % 7];
    return (int64_t)random_next(state) >> random_next(state) % 63;
}

static wide gcd(wide a, wide b) {
    while (b) {
        wide rest = a % b;
        a = b, b = rest;
    }
    return a < 0 ? -a : a;
}

static bool fits(wide n) {
    return n >= INT64_MIN && n <= INT64_MAX;
}

/* r must be num/den in lowest terms where those fit, and not given where they do not. */
static void assert_ratio(wf_rational r, wide num, wide den) {
    wide divisor = gcd(num, den) * (den < 0 ? -1 : 1);
    bool given = den != 0 && fits(num / divisor) && fits(den / divisor);
    assert_int_equal(wf_ratio_given(r), given);
    if (!given) return;
    assert_true(r.num == num / divisor && r.den == den / divisor);
}

static void ratios_are_reduced(void **state) {
    (void)state;
    uint64_t seed = 1;
    for (int i = 0; i < 200000; i++) {
        int64_t num = random_term(&seed), den = random_term(&seed);
        assert_ratio(wf_ratio(num, den), num, den);
    }
    assert_true(wf_ratio_equal(wf_ratio(-6, -4), (wf_rational){3, 2}));
    assert_true(wf_ratio(0, -7).den == 1);
}

static void products_and_quotients_are_exact(void **state) {
    (void)state;
    uint64_t seed = 2;
    int given = 0;
    for (int i = 0; i < 200000; i++) {
        wf_rational a = wf_ratio(random_term(&seed), random_term(&seed));
        wf_rational b = wf_ratio(random_term(&seed), random_term(&seed));
        if (!a.den || !b.den) continue;
        assert_ratio(wf_ratio_mul(a, b), (wide)a.num * b.num, (wide)a.den * b.den);
        assert_ratio(wf_ratio_div(a, b), (wide)a.num * b.den, (wide)a.den * b.num);
        given += wf_ratio_given(wf_ratio_mul(a, b));
    }
    assert_true(given > 10000); /* the cases are not all overflows */
    assert_false(wf_ratio_given(wf_ratio_mul((wf_rational){0, 0}, wf_ratio(1, 2))));
    assert_false(wf_ratio_given(wf_ratio_div(wf_ratio(1, 2), (wf_rational){0, 0})));
}

static void floors_are_exact(void **state) {
    (void)state;
    uint64_t seed = 3;
    for (int i = 0; i < 100000; i++) {
        int64_t num = random_term(&seed) & INT64_MAX, n = random_term(&seed) & INT64_MAX;
        wf_rational a = wf_ratio(num, (random_term(&seed) & INT64_MAX) | 1);
        wide product = (wide)a.num * n / a.den;
        assert_true(wf_ratio_floor_mul(a, n) == (fits(product) ? (int64_t)product : INT64_MAX));
    }
    /* 480000/1001 a second: subframe 8 10^7 starts with field 10^7, not one before it. */
    assert_int_equal(
        wf_ratio_floor_mul(
            wf_ratio_div((wf_rational){480000, 1001}, (wf_rational){60000, 1001}), 10000000),
        80000000);
}

static void texts_that_are_ratios(void **state) {
    (void)state;
    const struct {
        const char *text;
        wf_rational is;
    } cases[] = {
        {"240", {240, 1}},
        {"480000/1001", {480000, 1001}},
        {"10:11", {10, 11}},
        {"20:22", {10, 11}},
        {"0.25", {1, 4}},
        {".5", {1, 2}},
        {"0", {0, 1}},
        {"0/5", {0, 1}},
        {"007", {7, 1}},
        {"29.970000000", {2997, 100}},
        {"0.000000001", {1, 1000000000}},
        {"9223372036854775807", {INT64_MAX, 1}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        wf_rational r = {0, 0};
        if (!wf_ratio_parse(cases[i].text, &r)) fail_msg("%s was refused", cases[i].text);
        assert_true(r.num == cases[i].is.num && r.den == cases[i].is.den);
    }
}

static void texts_that_are_not(void **state) {
    (void)state;
    const char *const wrong[] = {"",
                                 " 1",
                                 "1 ",
                                 "+1",
                                 "-1",
                                 "1/",
                                 "/2",
                                 "1/0",
                                 "1:0",
                                 "1/2/3",
                                 "1.",
                                 ".",
                                 "1..2",
                                 "1e3",
                                 "nan",
                                 "inf",
                                 "0x10",
                                 "1,5",
                                 "1.000000000a",
                                 "1/-2",
                                 "9223372036854775808",
                                 "99999999999999999999/3",
                                 "1/9223372036854775808",
                                 "9223372036854775807.5",
                                 "1.5/2"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        wf_rational r = {12, 34};
        if (wf_ratio_parse(wrong[i], &r)) fail_msg("'%s' was taken", wrong[i]);
        assert_true(r.num == 12 && r.den == 34); /* untouched */
        assert_false(wf_rate_parse(wrong[i], &r));
        assert_true(r.num == 12 && r.den == 34);
    }
}

/* Every finite decimal is taken, and what is long is the simplest ratio of its double. */
static void decimals_of_any_length(void **state) {
    (void)state;
    const struct {
        const char *text;
        wf_rational is;
    } cases[] = {
        {"0.3333333333333333", {1, 3}},
        {"2.6666666666666665", {8, 3}},
        {"1.00000000000000000000000000", {1, 1}},
        {"0.9999999999999999999999999999", {1, 1}},
        {"59.94005994005994", {60000, 1001}},
        {"0.0000000000000000000000000001", {0, 1}},
        {"9223372036854775807.0000000000", {INT64_MAX, 1}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        wf_rational r = {0, 0};
        if (!wf_ratio_parse(cases[i].text, &r)) fail_msg("%s was refused", cases[i].text);
        if (!wf_ratio_equal(r, cases[i].is))
            fail_msg("%s is %lld/%lld", cases[i].text, (long long)r.num, (long long)r.den);
    }
    uint64_t seed = 5;
    for (int i = 0; i < 20000; i++) {
        char text[80];
        double value = (double)(random_term(&seed) & 0xffffffffffff) / (double)(1LL << i % 48);
        snprintf(text, sizeof text, "%.*f", 10 + i % 30, value);
        wf_rational r = {0, 0};
        if (!wf_ratio_parse(text, &r)) fail_msg("%s was refused", text);
        assert_true(fabs(wf_ratio_value(r) - strtod(text, NULL)) <= 3e-16 * value + 2e-18);
    }
}

/* Printing and reading is the identity. */
static void texts_round_trip(void **state) {
    (void)state;
    uint64_t seed = 4;
    for (int i = 0; i < 20000; i++) {
        wf_rational a = wf_ratio(random_term(&seed) & INT64_MAX,
                                 random_term(&seed) & INT64_MAX),
                    b;
        if (!a.den) continue;
        char text[64];
        snprintf(text, sizeof text, "%lld/%lld", (long long)a.num, (long long)a.den);
        assert_true(wf_ratio_parse(text, &b));
        assert_true(wf_ratio_equal(a, b));
    }
}

static void rates_by_their_short_names(void **state) {
    (void)state;
    const struct {
        const char *text;
        wf_rational is;
    } cases[] = {
        {"23.976", {24000, 1001}},  {"23.98", {24000, 1001}},  {"29.97", {30000, 1001}},
        {"59.94", {60000, 1001}},   {"59.940", {60000, 1001}}, {"47.95", {48000, 1001}},
        {"119.88", {120000, 1001}}, {"2997/100", {2997, 100}}, /* who writes a ratio means it */
        {"29.98", {1499, 50}},      {"25", {25, 1}},           {"12.5", {25, 2}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        wf_rational r;
        assert_true(wf_rate_parse(cases[i].text, &r));
        if (!wf_ratio_equal(r, cases[i].is))
            fail_msg("%s is %lld/%lld", cases[i].text, (long long)r.num, (long long)r.den);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ratios_are_reduced),
        cmocka_unit_test(products_and_quotients_are_exact),
        cmocka_unit_test(floors_are_exact),
        cmocka_unit_test(texts_that_are_ratios),
        cmocka_unit_test(texts_that_are_not),
        cmocka_unit_test(decimals_of_any_length),
        cmocka_unit_test(texts_round_trip),
        cmocka_unit_test(rates_by_their_short_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
