/* The tone against its closed form, and rounding to the bits of an output. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "convert/sound/tone.h"

/* EBU R 68: a sine of 1 kHz, 18 dB below full scale. */
static void test_tone(void **state) {
    (void)state;
    static const int bits[] = {16, 24, 32};
    static const int64_t from[] = {0, 48048, INT64_C(1728000000), INT64_C(1) << 50};
    double pi = acos(-1), peak = pow(10, -18 / 20.0);
    for (size_t b = 0; b < 3; b++)
        for (size_t f = 0; f < 4; f++)
            for (int64_t n = from[f]; n < from[f] + 97; n++) {
                double right = peak * sin(2 * pi * (double)(n % 48) / 48);
                double got = wf_tone_sample(n, bits[b]) / 2147483648.0;
                assert_true(fabs(got - right) <= ldexp(0.5, 1 - bits[b]) + 1e-9);
                assert_int_equal(wf_tone_sample(n, bits[b]) &
                                     (int32_t)((1u << (32 - bits[b])) - 1) * (bits[b] < 32),
                                 0);
            }
}

static void test_level(void **state) {
    (void)state;
    double sum = 0;
    for (int n = 0; n < 48; n++) sum += pow(wf_tone_sample(n, 24) / 2147483648.0, 2);
    /* The sine of full scale has 1/2. */
    assert_true(fabs(10 * log10(sum / 48 / 0.5) + 18) < 1e-5);
    assert_int_equal(wf_tone_sample(0, 24), 0);
    assert_true(wf_tone_sample(1, 24) > 0);
}

static void test_rounding(void **state) {
    (void)state;
    static const struct {
        int32_t sample;
        int bits;
        int32_t right;
    } rows[] = {{0, 24, 0},
                {127, 24, 0},
                {128, 24, 256},
                {-128, 24, 0},
                {-129, 24, -256},
                {INT32_MAX, 32, INT32_MAX},
                {INT32_MAX, 24, 0x7fffff00},
                {INT32_MIN, 24, INT32_MIN},
                {INT32_MAX, 16, 0x7fff0000},
                {INT32_MIN, 16, INT32_MIN},
                {0x12345678, 24, 0x12345600},
                {0x12348000, 16, 0x12350000}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        assert_int_equal(wf_sample_rounded(rows[i].sample, rows[i].bits), rows[i].right);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_tone),
        cmocka_unit_test(test_level),
        cmocka_unit_test(test_rounding),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
