/* Windows and cells of time: closed forms, exactness at field 10^7, and what is nearest to
 * nothing. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <cmocka.h>

#include "filters/raster/timing.h"

static wf_raster raster_of(const char *text) {
    wf_raster raster;
    char why[256];
    if (!wf_raster_parse(text, &raster, why, sizeof why)) fail_msg("%s", why);
    return raster;
}

static wf_timing timing_of(const wf_timing_desc *desc) {
    wf_timing timing;
    char why[512];
    if (!wf_timing_init(&timing, desc, why, sizeof why)) fail_msg("%s", why);
    return timing;
}

static wf_timing_desc eight_a_field(const wf_raster *raster) {
    return (wf_timing_desc){.raster = raster,
                            .subframe_rate = {480000, 1001},
                            .subframes = INT64_C(1) << 40,
                            .width = {1, 1},
                            .skew = {0, 1}};
}

static void a_field_of_eight_subframes(void **state) {
    (void)state;
    wf_raster raster = raster_of("525i");
    wf_timing_desc desc = eight_a_field(&raster);
    wf_timing timing = timing_of(&desc);
    const int64_t fields[] = {0, 1, 15, 10000000, 100000000};
    for (int n = 0; n < 5; n++) {
        wf_window window = wf_timing_window(&timing, fields[n], 0);
        assert_int_equal(window.first, 8 * fields[n]);
        assert_int_equal(window.count, 8);
        assert_false(window.alone);
        for (int64_t k = 0; k < 8; k++) {
            double q0, q1;
            wf_timing_cell(&timing, fields[n], 0, window.first + k, &q0, &q1);
            assert_true(q0 == (double)k / 8 - 0.5 && q1 == (double)(k + 1) / 8 - 0.5);
        }
    }
}

static void positions_and_widths(void **state) {
    (void)state;
    wf_raster raster = raster_of("525i");
    wf_timing_desc desc = eight_a_field(&raster);
    const struct {
        wf_position position;
        wf_rational width;
        bool center;
        int64_t first, count; /* of field 10 */
    } cases[] = {
        {WF_START, {1, 2}, false, 80, 4}, {WF_CENTER, {1, 2}, false, 78, 4},
        {WF_END, {1, 2}, false, 76, 4},   {WF_START, {2, 1}, false, 80, 16},
        {WF_START, {1, 2}, true, 80, 5},  {WF_CENTER, {1, 2}, true, 78, 5},
        {WF_START, {0, 1}, false, 80, 1}, {WF_END, {0, 1}, true, 80, 1},
        {WF_START, {1, 3}, false, 80, 3}, {WF_CENTER, {1, 1000}, false, 79, 2},
    };
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        desc.position = cases[n].position;
        desc.width = cases[n].width;
        desc.subframe_center = cases[n].center;
        wf_timing timing = timing_of(&desc);
        wf_window window = wf_timing_window(&timing, 10, 0);
        assert_int_equal(window.first, cases[n].first);
        assert_int_equal(window.count, cases[n].count);
    }
}

/* What the cells of a window cover adds up to the window, at every ratio of rates. */
static void cells_fill_the_window(void **state) {
    (void)state;
    const char *rasters[] = {"525i", "1080i50", "1080psf23.976", "720p60", "64x48@17i,bff"};
    const wf_rational rates[] = {{24, 1},   {240, 1},      {480000, 1001},
                                 {1000, 7}, {60000, 1001}, {97, 3}};
    for (size_t r = 0; r < 5; r++)
        for (size_t s = 0; s < 6; s++) {
            wf_raster raster = raster_of(rasters[r]);
            wf_timing_desc desc = {.raster = &raster,
                                   .subframe_rate = rates[s],
                                   .subframes = 100000,
                                   .width = {7, 5},
                                   .skew = {1, 3},
                                   .position = WF_CENTER};
            wf_timing timing = timing_of(&desc);
            for (int64_t field = 2; field < 40; field += 5)
                for (int line = 0; line < 40; line += 13) {
                    wf_window window = wf_timing_window(&timing, field, line);
                    double sum = 0;
                    for (int64_t k = window.first; k < window.first + window.count; k++) {
                        double q0, q1;
                        wf_timing_cell(&timing, field, line, k, &q0, &q1);
                        assert_true(q1 > q0);
                        sum += q1 - q0;
                    }
                    assert_true(fabs(sum - 1.4) < 1e-12);
                }
        }
}

static void scan_skew_delays_lines(void **state) {
    (void)state;
    wf_raster raster = raster_of("525i");
    wf_timing_desc desc = eight_a_field(&raster);
    desc.width = (wf_rational){0, 1};
    desc.skew = (wf_rational){1, 1};
    wf_timing timing = timing_of(&desc);
    for (int line = 0; line < 486; line++)
        assert_int_equal(wf_timing_window(&timing, 3, line).first, 24 + line * 8 / 486);
    assert_int_equal(wf_timing_field(&timing, 3, 486).count, 8);
}

static void segmented_fields_share_an_instant(void **state) {
    (void)state;
    wf_raster raster = raster_of("1080psf25");
    wf_timing_desc desc = {.raster = &raster,
                           .subframe_rate = {200, 1},
                           .subframes = 80,
                           .width = {1, 2},
                           .skew = {0, 1}};
    wf_timing timing = timing_of(&desc);
    for (int64_t m = 0; m < 10; m++)
        for (int64_t n = 2 * m; n < 2 * m + 2; n++) {
            assert_int_equal(wf_timing_window(&timing, n, 0).first, 8 * m);
            assert_int_equal(wf_timing_window(&timing, n, 0).count, 4);
        }
}

static void windows_beyond_the_sequence_take_the_nearest(void **state) {
    (void)state;
    wf_raster raster = raster_of("525i");
    wf_timing_desc desc = eight_a_field(&raster);
    desc.subframes = 16;
    desc.position = WF_END;
    wf_timing timing = timing_of(&desc);
    wf_window before = wf_timing_window(&timing, 0, 0),
              after = wf_timing_window(&timing, 99, 0);
    assert_true(before.alone && before.first == 0 && before.count == 1);
    assert_true(after.alone && after.first == 15 && after.count == 1);
}

static void frames_of_a_sequence(void **state) {
    (void)state;
    const struct {
        const char *raster;
        wf_rational rate, width, skew;
        bool center;
        int64_t subframes, frames;
        wf_position position;
    } cases[] = {
        {"525i", {480000, 1001}, {1, 2}, {0, 1}, false, 128, 8, WF_START},
        {"525i", {480000, 1001}, {1, 2}, {0, 1}, false, 124, 8, WF_START}, /* 15.5 fields */
        {"525i", {480000, 1001}, {1, 2}, {0, 1}, false, 123, 7, WF_START},
        {"525i", {480000, 1001}, {1, 2}, {1, 4}, false, 126, 8, WF_START}, /* the last
                                                                              line 15.75 - */
        {"525i", {480000, 1001}, {1, 2}, {1, 4}, false, 125, 7, WF_START},
        {"525i", {480000, 1001}, {0, 1}, {0, 1}, false, 121, 8, WF_START}, /* 15.125, and the
                                                                            * instant 15
                                                                            */
        {"525i", {480000, 1001}, {0, 1}, {0, 1}, false, 120, 7, WF_START},
        {"525i", {480000, 1001}, {0, 1}, {0, 1}, true, 120, 7, WF_START},
        {"525i", {480000, 1001}, {1, 1}, {0, 1}, false, 128, 8, WF_START},
        {"525i", {480000, 1001}, {1, 1}, {0, 1}, true, 128, 8, WF_START}, /* the time that it is
                                                                             shown */
        {"525i", {480000, 1001}, {2, 1}, {0, 1}, false, 128, 8, WF_START},
        {"525i", {480000, 1001}, {1, 2}, {0, 1}, true, 124, 7, WF_START}, /* its cells end
                                                                             at 15.4375 */
        {"1080i50", {200, 1}, {1, 2}, {0, 1}, false, 128, 16, WF_START},
        {"1080i50", {200, 1}, {1, 4}, {0, 1}, false, 5, 1, WF_START},
        {"720p60", {24, 1}, {1, 2}, {0, 1}, false, 24, 60, WF_START},
        {"525i", {480000, 1001}, {1, 2}, {0, 1}, false, 11, 0, WF_START},
        {"1080psf23.976", {24000, 1001}, {1, 2}, {0, 1}, false, 100000, 100000, WF_START},
        {"1080psf25", {200, 1}, {1, 2}, {0, 1}, false, 12, 2, WF_START}, /* 1.5 frames, one
                                                                          * instant each
                                                                          */
        /* The window of frame 4 ends by then, and its instant is not before. */
        {"720p50", {50, 1}, {1, 1}, {0, 1}, false, 4, 4, WF_END},
        {"720p50", {200, 1}, {1, 1}, {0, 1}, false, 17, 5, WF_END},
    };
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        wf_raster raster = raster_of(cases[n].raster);
        wf_timing_desc desc = {.raster = &raster,
                               .subframe_rate = cases[n].rate,
                               .subframes = cases[n].subframes,
                               .subframe_center = cases[n].center,
                               .width = cases[n].width,
                               .position = cases[n].position,
                               .skew = cases[n].skew};
        int64_t frames = wf_timing_frames(&desc);
        if (frames != cases[n].frames) fail_msg("case %zu: %lld frames", n, (long long)frames);
    }
}

/* ---- Pictures with times of their own ---- */

static uint32_t random_state = 1;
static int below(int end) {
    random_state = random_state * 1664525 + 1013904223;
    return (int)((uint64_t)random_state * (uint64_t)end >> 32);
}

enum { PICTURES = 60 };

/* Random pictures, some longer than a field and some far shorter, counted in units of which a
 * second has `units`. */
static void random_times(int64_t units, wf_rational times[PICTURES + 1], double t_s[]) {
    int64_t at = below(1000);
    for (int k = 0; k <= PICTURES; k++) {
        times[k] = wf_ratio(at, units);
        t_s[k] = (double)(at - times[0].num * (units / times[0].den)) / (double)units;
        at += 1 + below(below(4) ? (int)(units / 200) : (int)(units / 20));
    }
}

/* Overlaps of cells and windows in plain double, by the definition. */
static void overlaps_of_irregular_cells(void **state) {
    (void)state;
    const char *rasters[] = {"525i", "1080i50", "1080psf25", "720p60"};
    const wf_rational widths[] = {{1, 1}, {1, 2}, {3, 10}, {2, 1}};
    for (int trial = 0; trial < 160; trial++) {
        wf_raster raster = raster_of(rasters[trial % 4]);
        double tf = wf_ratio_value(wf_raster_field_period(&raster)), t_s[PICTURES + 1];
        bool center = below(2), skewed = below(2);
        wf_rational times[PICTURES + 1], edges[PICTURES + 1];
        random_times(trial % 3 ? 90000 : 1000, times, t_s);
        char why[256];
        assert_true(wf_timing_edges(&raster, times, PICTURES, center, edges, why, sizeof why));
        wf_timing_desc desc = {.raster = &raster,
                               .subframes = PICTURES,
                               .edges = edges,
                               .shown = wf_ratio(1, 1),
                               .width = widths[below(4)],
                               .position = (wf_position)below(3),
                               .skew = skewed ? wf_ratio(1, 2) : wf_ratio(0, 1)};
        wf_timing timing = timing_of(&desc);
        double tau = wf_ratio_value(desc.width);
        for (int64_t n = 0; n < 30; n++) {
            int line = below(raster.lines);
            double from = (double)wf_raster_instant(&raster, n) +
                          (skewed ? 0.5 * line / raster.lines : 0) -
                          wf_position_anchor(desc.position) * tau;
            wf_window window = wf_timing_window(&timing, n, line);
            for (int k = 0; k < PICTURES && !window.alone; k++) {
                double a = t_s[k], b = t_s[k + 1], q0, q1;
                if (center) {
                    a = k ? (t_s[k - 1] + t_s[k]) / 2 : t_s[0] - (t_s[1] - t_s[0]) / 2;
                    b = (t_s[k] + t_s[k + 1]) / 2;
                }
                double low = fmax(a / tf, from), high = fmin(b / tf, from + tau);
                bool seen = k >= window.first && k < window.first + window.count;
                if (high - low > 1e-9) assert_true(seen);
                if (seen) {
                    wf_timing_cell(&timing, n, line, k, &q0, &q1);
                    assert_true(q1 > q0);
                    assert_true(fabs(q0 - (low - from - tau / 2)) < 1e-9);
                    assert_true(fabs(q1 - (high - from - tau / 2)) < 1e-9);
                }
            }
            if (window.alone) assert_int_equal(window.count, 1);
        }
    }
}

/* Edges that are found out one by one, and forgotten, leave windows as they are with all. */
static void edges_as_they_come(void **state) {
    (void)state;
    wf_raster raster = raster_of("1080i50");
    const wf_rational widths[] = {{1, 1}, {0, 1}, {3, 10}, {2, 1}};
    for (int trial = 0; trial < 160; trial++) {
        wf_rational times[PICTURES + 1], edges[PICTURES + 1];
        double t_s[PICTURES + 1];
        char why[256];
        random_times(1000, times, t_s);
        assert_true(
            wf_timing_edges(&raster, times, PICTURES, trial % 2, edges, why, sizeof why));
        wf_timing_desc desc = {.raster = &raster,
                               .subframes = PICTURES,
                               .edges = edges,
                               .shown = wf_ratio(1, 1),
                               .width = widths[below(4)],
                               .position = (wf_position)below(3),
                               .skew = wf_ratio(0, 1)};
        wf_timing all = timing_of(&desc);
        int64_t known = 1, forgotten = 0;
        desc.subframes = 1;
        for (int64_t n = 0; n < 20; n++) {
            wf_window window = wf_timing_window(&all, n, 0), found = {0, 0, false};
            if (window.first + window.count >= PICTURES) break;
            wf_timing some = timing_of(&desc);
            wf_rational held[PICTURES + 2];
            for (known = known < 1 ? 1 : known;; known++) {
                for (int64_t k = forgotten; k < known; k++) held[k - forgotten] = edges[k];
                held[known - forgotten] = WF_EDGE_UNKNOWN;
                assert_true(wf_timing_set_edges(&some, held, forgotten, known));
                found = wf_timing_window(&some, n, 0);
                if (found.first + found.count < known) break;
                assert_true(known < PICTURES);
            }
            assert_int_equal(found.first, window.first);
            assert_int_equal(found.count, window.count);
            assert_int_equal(found.alone, window.alone);
            for (int64_t k = found.first; k < found.first + found.count && !found.alone; k++) {
                double p0, p1, q0, q1;
                wf_timing_cell(&all, n, 0, k, &p0, &p1);
                wf_timing_cell(&some, n, 0, k, &q0, &q1);
                assert_true(p0 == q0 && p1 == q1);
            }
            forgotten = found.first;
        }
    }
}

/* Times that happen to be even give what a rate gives, to the last bit. */
static void even_times_are_a_rate(void **state) {
    (void)state;
    wf_raster raster = raster_of("525i");
    wf_rational times[PICTURES + 1], edges[PICTURES + 1];
    char why[256];
    for (int k = 0; k <= PICTURES; k++) times[k] = wf_ratio(1001 * k + 77, 480000);
    for (int center = 0; center < 2; center++) {
        wf_timing_desc desc = eight_a_field(&raster);
        desc.subframes = PICTURES;
        desc.width = (wf_rational){1, 2};
        desc.subframe_center = center;
        wf_timing rate = timing_of(&desc);
        int64_t frames = wf_timing_frames(&desc);
        assert_true(wf_timing_edges(&raster, times, PICTURES, center, edges, why, sizeof why));
        desc.edges = edges;
        desc.shown = wf_ratio(PICTURES, 8);
        wf_timing irregular = timing_of(&desc);
        assert_int_equal(wf_timing_frames(&desc), frames);
        for (int64_t n = 0; n < 12; n++) {
            wf_window a = wf_timing_window(&rate, n, 0), b = wf_timing_window(&irregular, n, 0);
            assert_true(a.first == b.first && a.count == b.count && a.alone == b.alone);
            for (int64_t k = a.first; k < a.first + a.count && !a.alone; k++) {
                double p0, p1, q0, q1;
                wf_timing_cell(&rate, n, 0, k, &p0, &p1);
                wf_timing_cell(&irregular, n, 0, k, &q0, &q1);
                assert_true(p0 == q0 && p1 == q1);
            }
        }
    }
}

static void times_that_will_not_do(void **state) {
    (void)state;
    wf_raster raster = raster_of("1080i50");
    const wf_rational repeats[] = {{0, 1}, {1, 50}, {1, 50}, {3, 50}};
    const wf_rational back[] = {{0, 1}, {2, 50}, {1, 50}, {3, 50}};
    const wf_rational fine[] = {{0, 1}, {1, INT64_MAX}, {2, INT64_MAX - 1}, {3, 50}};
    wf_rational edges[4];
    char why[256];
    assert_false(wf_timing_edges(&raster, repeats, 3, false, edges, why, sizeof why));
    assert_false(wf_timing_edges(&raster, back, 3, false, edges, why, sizeof why));
    assert_false(wf_timing_edges(&raster, fine, 3, true, edges, why, sizeof why));
}

static void ratios_too_fine_are_refused(void **state) {
    (void)state;
    wf_raster raster = raster_of("1080i59.94");
    wf_timing_desc desc = eight_a_field(&raster);
    desc.subframe_rate = (wf_rational){INT64_C(1) << 40, 999999937};
    desc.width = (wf_rational){1, 999999937};
    desc.skew = (wf_rational){1, 999999929};
    wf_timing timing;
    char why[512] = "";
    assert_false(wf_timing_init(&timing, &desc, why, sizeof why));
    assert_true(why[0]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_field_of_eight_subframes),
        cmocka_unit_test(positions_and_widths),
        cmocka_unit_test(cells_fill_the_window),
        cmocka_unit_test(scan_skew_delays_lines),
        cmocka_unit_test(segmented_fields_share_an_instant),
        cmocka_unit_test(windows_beyond_the_sequence_take_the_nearest),
        cmocka_unit_test(frames_of_a_sequence),
        cmocka_unit_test(overlaps_of_irregular_cells),
        cmocka_unit_test(edges_as_they_come),
        cmocka_unit_test(even_times_are_a_rate),
        cmocka_unit_test(times_that_will_not_do),
        cmocka_unit_test(ratios_too_fine_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
