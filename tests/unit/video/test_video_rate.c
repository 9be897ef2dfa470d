/* How many pictures a second video has, and when they are shown: closed forms of timestamps
 * that are rounded, uneven, repeated or absurd; and pipes, whose times come one by one. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "convert/video/arrivals.h"
#include "convert/video/rate.h"

enum { MOST = 1200 };

/* Pictures at k/rate, rounded to ticks. */
static wf_video_info rounded(int64_t times[MOST], int64_t frames, double rate,
                             int64_t ticks_a_second, wf_rational stated) {
    for (int64_t k = 0; k < frames; k++)
        times[k] = 7000 + (int64_t)((double)k / rate * (double)ticks_a_second + 0.5);
    return (wf_video_info){
        .times = times, .frames = frames, .rate = stated, .tick_s = {1, ticks_a_second}};
}

static void within_a_tick(void **state) {
    (void)state;
    const wf_video_info ms = {.tick_s = {1, 1000}};
    const struct {
        wf_rational rate;
        int64_t picture, ticks;
        bool in_step;
    } cases[] = {{{100, 1}, 3, 30, true},
                 {{100, 1}, 3, 29, true},
                 {{100, 1}, 3, 31, true},
                 {{100, 1}, 3, 28, false},
                 {{100, 1}, 3, 32, false},
                 {{3, 1}, 1, 333, true},
                 {{3, 1}, 1, 334, true},
                 {{3, 1}, 1, 332, false},
                 {{3, 1}, 1, 335, false},
                 {{60000, 1001}, 600, 10010, true},
                 {{60000, 1001}, 600, 10011, true},
                 {{60000, 1001}, 600, 10000, false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        if (wf_video_in_step(&ms, cases[i].rate, cases[i].picture, cases[i].ticks) !=
            cases[i].in_step)
            fail_msg("case %zu", i);
}

static void rates_that_are_found(void **state) {
    (void)state;
    const struct {
        double rate;
        int64_t ticks;
        wf_rational stated, found;
    } cases[] = {{50, 1000, {50, 1}, {50, 1}},
                 {60 / 1.001, 1000, {60, 1}, {60000, 1001}},
                 {60 / 1.001, 1000, {0, 0}, {60000, 1001}},
                 {240 / 1.001, 90000, {239, 1}, {240000, 1001}},
                 {48, 1000, {47952, 1000}, {48, 1}},
                 {25, 90000, {50, 1}, {25, 1}},
                 {12.5, 90000, {25, 1}, {25, 2}}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        int64_t times[MOST];
        wf_rational rate;
        wf_video_info info =
            rounded(times, MOST, cases[i].rate, cases[i].ticks, cases[i].stated);
        assert_int_equal(wf_video_rate(&info, "video", &rate, NULL), WEFT_OK);
        if (!wf_ratio_equal(rate, cases[i].found))
            fail_msg("case %zu: %lld/%lld", i, (long long)rate.num, (long long)rate.den);
    }
}

static void one_picture_out_of_step(void **state) {
    (void)state;
    for (int64_t late = 1; late < MOST; late += MOST - 2) {
        int64_t times[MOST];
        wf_rational rate;
        wf_video_info info = rounded(times, MOST, 100, 1000, (wf_rational){100, 1});
        times[late] += 2;
        assert_int_equal(wf_video_rate(&info, "video", &rate, NULL), WEFT_OK);
        assert_false(wf_ratio_given(rate));
    }
}

static void rates_that_cannot_be(void **state) {
    (void)state;
    const wf_rational rates[] = {{0, 0}, {1000000000, 1}, {1, 1000000}};
    const weft_status statuses[] = {WEFT_USAGE, WEFT_FAILED, WEFT_FAILED};
    for (int i = 0; i < 3; i++) {
        const wf_video_info info = {.rate = rates[i], .frames = -1};
        wf_rational rate;
        weft_error err = {""};
        assert_int_equal(wf_video_rate(&info, "video", &rate, &err), statuses[i]);
        assert_non_null(strstr(err.text, "--subframe-rate"));
    }
}

/* ---- When they are shown ---- */

static void check_shown(const wf_video_info *info, int64_t first, int64_t step, int64_t count,
                        const int64_t *ms) {
    wf_rational *times_s;
    assert_int_equal(wf_video_shown(info, "video", first, step, count, &times_s, NULL),
                     WEFT_OK);
    for (int64_t k = 0; k <= count; k++)
        if (!wf_ratio_equal(times_s[k], wf_ratio(ms[k], 1000)))
            fail_msg("picture %lld", (long long)k);
    free(times_s);
}

static void the_last_picture(void **state) {
    (void)state;
    int64_t times[] = {500, 503, 510, 516, 530};
    wf_video_info info = {.times = times, .frames = 5, .tick_s = {1, 1000}, .last_ticks = 4};
    check_shown(&info, 0, 1, 5, (int64_t[]){0, 3, 10, 16, 30, 34});
    check_shown(&info, 1, 1, 2, (int64_t[]){0, 7, 13});
    check_shown(&info, 0, 2, 3, (int64_t[]){0, 10, 30, 34});
    check_shown(&info, 1, 2, 2, (int64_t[]){0, 13, 31});
    info.last_ticks = 0; /* as long as the one before it */
    check_shown(&info, 0, 1, 5, (int64_t[]){0, 3, 10, 16, 30, 44});
}

static void times_that_will_not_do(void **state) {
    (void)state;
    int64_t times[] = {0, 10, 10, 30};
    wf_video_info info = {.times = times, .frames = 4, .tick_s = {1, 1000}, .rate = {100, 1}};
    wf_rational *times_s;
    weft_error err = {""};
    assert_int_equal(wf_video_shown(&info, "video", 0, 1, 4, &times_s, &err), WEFT_FAILED);
    assert_non_null(strstr(err.text, "pictures 1 and 2 are both shown at 0.010 s"));
    times[2] = 20, times[3] = 3600021;
    assert_int_equal(wf_video_shown(&info, "video", 0, 1, 4, &times_s, &err), WEFT_FAILED);
    assert_non_null(strstr(err.text, "picture 2, at 0.020 s, would be shown for 3600 s"));
    times[3] = 3600020;
    assert_int_equal(wf_video_shown(&info, "video", 0, 1, 4, &times_s, &err), WEFT_OK);
    free(times_s);
    info.back = 3;
    assert_int_equal(wf_video_shown(&info, "video", 0, 1, 4, &times_s, &err), WEFT_FAILED);
    assert_non_null(strstr(err.text, "before picture 3 (0.030 s)"));
}

/* ---- As they come ---- */

static wf_arrivals *arrivals_of(bool center) {
    const wf_arrivals_desc desc = {.path = "pipe",
                                   .rate = {100, 1},
                                   .tick_s = {1, 1000},
                                   .period_s = {1, 50},
                                   .center = center};
    wf_arrivals *a;
    assert_int_equal(wf_arrivals_new(&desc, &a, NULL), WEFT_OK);
    return a;
}

static void check_edges(const wf_arrivals *a, const int64_t *half_ms, int64_t count) {
    int64_t from;
    const wf_rational *edges = wf_arrivals_edges(a, &from);
    for (int64_t k = from; k < count; k++)
        if (!wf_ratio_equal(edges[k - from], wf_ratio(half_ms[k], 40)))
            fail_msg("edge %lld", (long long)k);
}

static void arrivals_are_times(void **state) {
    (void)state;
    const int64_t ticks[] = {500, 510, 523, 530, 560};
    const int64_t edges[2][6] = {{0, 20, 46, 60, 120, 128}, {-10, 10, 33, 53, 90, 124}};
    for (int center = 0; center < 2; center++) {
        wf_arrivals *a = arrivals_of(center);
        for (int k = 0; k < 5; k++) {
            assert_int_equal(wf_arrivals_add(a, ticks[k], 4, NULL), WEFT_OK);
            assert_int_equal(wf_arrivals_uneven(a), k >= 2); /* 523 is 3 ms late */
            wf_arrivals_forget(a, k - 2);
        }
        check_edges(a, edges[center], 5);
        assert_int_equal(wf_arrivals_end(a, NULL), WEFT_OK);
        check_edges(a, edges[center], 6);
        assert_true(wf_ratio_equal(wf_arrivals_shown(a, 5), wf_ratio(64, 20)));
        wf_arrivals_free(a);
    }
}

/* What was decided by the rate stays; what comes is by its time, and edges ascend. */
static void arrivals_after_a_decision(void **state) {
    (void)state;
    wf_arrivals *a = arrivals_of(false);
    const int64_t ticks[] = {0, 9, 19, 20, 31}, edges[] = {0, 20, 40, 41, 62};
    weft_error err = {""};
    for (int k = 0; k < 5; k++) {
        assert_int_equal(wf_arrivals_add(a, ticks[k], 0, NULL), WEFT_OK);
        if (k == 2) wf_arrivals_decide(a);
    }
    check_edges(a, edges, 5);
    assert_int_equal(wf_arrivals_add(a, 31, 0, &err), WEFT_FAILED);
    assert_non_null(
        strstr(err.text, "picture 5 is shown at 0.031 s, and the one before it at 0.031"));
    assert_int_equal(wf_arrivals_add(a, 3600032, 0, &err), WEFT_FAILED);
    assert_non_null(strstr(err.text, "picture 4, at 0.031 s, would be shown for 3600 s"));
    wf_arrivals_free(a);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(within_a_tick),           cmocka_unit_test(rates_that_are_found),
        cmocka_unit_test(one_picture_out_of_step), cmocka_unit_test(rates_that_cannot_be),
        cmocka_unit_test(the_last_picture),        cmocka_unit_test(times_that_will_not_do),
        cmocka_unit_test(arrivals_are_times),      cmocka_unit_test(arrivals_after_a_decision),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
