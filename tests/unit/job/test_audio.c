/* What --audio is read as, and how samples are shared out to frames: for ten hours and more,
 * against arithmetic of 128 bits. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "convert/job/audio.h"

/* ---- Samples of frames ---- */

__extension__ typedef __int128 wide;

static const wf_rational rates[] = {{24000, 1001},  {24, 1}, {25, 1},       {30000, 1001},
                                    {30, 1},        {50, 1}, {60000, 1001}, {60, 1},
                                    {120000, 1001}, {15, 2}, {12345, 677}};
#define RATES (sizeof rates / sizeof *rates)

/* Twice the distance of a count from the exact 48000 n den / num, in parts of 1 / num. */
static wide off(wf_rational rate, int64_t n, int64_t samples) {
    wide twice = 2 * ((wide)samples * rate.num - (wide)n * 48000 * rate.den);
    return twice < 0 ? -twice : twice;
}

static void test_ten_hours(void **state) {
    (void)state;
    for (size_t i = 0; i < RATES; i++) {
        int64_t frames = 36000 * rates[i].num / rates[i].den + 1, before = 0;
        int64_t least = 48000 * rates[i].den / rates[i].num, sum = 0;
        for (int64_t n = 1; n <= frames; n++) {
            int64_t samples = wf_sound_samples(rates[i], n);
            assert_true(off(rates[i], n, samples) <= rates[i].num);
            assert_in_range(samples - before, least, least + 1);
            sum += samples - before;
            before = samples;
        }
        assert_int_equal(sum, wf_sound_samples(rates[i], frames));
    }
}

static void test_cadence(void **state) {
    (void)state;
    static const int64_t at_29_97[] = {1602, 1601, 1602, 1601, 1602},
                         at_59_94[] = {801, 801, 800, 801, 801};
    for (int64_t n = 0; n < 5000; n++) {
        assert_int_equal(wf_sound_samples(rates[3], n + 1) - wf_sound_samples(rates[3], n),
                         at_29_97[n % 5]);
        assert_int_equal(wf_sound_samples(rates[6], n + 1) - wf_sound_samples(rates[6], n),
                         at_59_94[n % 5]);
    }
    assert_int_equal(wf_sound_samples(rates[2], 7), 7 * 1920);
    int64_t far = INT64_C(1) << 40; /* products of this with 48000 * 1001 leave 64 bits */
    assert_true(off(rates[3], far, wf_sound_samples(rates[3], far)) <= rates[3].num);
}

/* ---- Words ---- */

static void test_words(void **state) {
    (void)state;
    static const struct {
        const char *text, *offset;
        bool right;
        wf_audio_kind kind;
        int tracks;
        size_t length;
    } rows[] = {
        {"none", NULL, true, WF_AUDIO_NONE, 0, 0},
        {"copy", NULL, true, WF_AUDIO_COPY, 0, 0},
        {"silent:1", NULL, true, WF_AUDIO_SILENT, 1, 0},
        {"tone:16", NULL, true, WF_AUDIO_TONE, 16, 0},
        {"a.wav", NULL, true, WF_AUDIO_FILE, 0, 5},
        {"a.wav:1.5", "1.5", true, WF_AUDIO_FILE, 0, 5},
        {"a.wav:-1.5", "-1.5", true, WF_AUDIO_FILE, 0, 5},
        {"a.wav:01:02:03.5", "01:02:03.5", true, WF_AUDIO_FILE, 0, 5},
        {"a.wav:01:02:03:29", "01:02:03:29", true, WF_AUDIO_FILE, 0, 5},
        {"take:2.wav", NULL, true, WF_AUDIO_FILE, 0, 10},
        {"take:2.wav:3", "3", true, WF_AUDIO_FILE, 0, 10},
        {"./take", NULL, true, WF_AUDIO_FILE, 0, 6},
        {"/dir/take:2", "2", true, WF_AUDIO_FILE, 0, 9},
        {"dir/a.wav", NULL, true, WF_AUDIO_FILE, 0, 9},
        {"dir.d/take", NULL, false, WF_AUDIO_NONE, 0, 0},
        {"1/0", NULL, false, WF_AUDIO_NONE, 0, 0},
        {"0.5", NULL, false, WF_AUDIO_NONE, 0, 0},
        {"../take:1.5", "1.5", true, WF_AUDIO_FILE, 0, 7},
        {"silent:0", NULL, false, WF_AUDIO_NONE, 0, 0},
        {"silent:17", NULL, false, WF_AUDIO_NONE, 0, 0},
        {"silent:", NULL, false, WF_AUDIO_NONE, 0, 0},
        {"silent:2.5", NULL, false, WF_AUDIO_NONE, 0, 0},
        {"silent", NULL, false, WF_AUDIO_NONE, 0, 0},
        {"tone:-1", NULL, false, WF_AUDIO_NONE, 0, 0},
        {"tone:x", NULL, false, WF_AUDIO_NONE, 0, 0},
        {"loud", NULL, false, WF_AUDIO_NONE, 0, 0},
        {"loud:1.5", NULL, false, WF_AUDIO_NONE, 0, 0},
        {"", NULL, false, WF_AUDIO_NONE, 0, 0},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        wf_audio audio;
        if (wf_audio_parse(rows[i].text, &audio) != rows[i].right) fail_msg("%s", rows[i].text);
        if (!rows[i].right) continue;
        assert_int_equal(audio.kind, rows[i].kind);
        assert_int_equal(audio.tracks, rows[i].tracks);
        assert_int_equal(audio.path_length, rows[i].length);
        if (rows[i].offset)
            assert_string_equal(audio.offset, rows[i].offset);
        else
            assert_null(audio.offset);
    }
}

static void test_offsets(void **state) {
    (void)state;
    static const struct {
        const char *text;
        wf_rational rate, seconds; /* {0, 0}: it is none */
    } rows[] = {
        {"0", {25, 1}, {0, 1}},
        {"1.5", {25, 1}, {3, 2}},
        {"-0.000000001", {25, 1}, {-1, 1000000000}},
        {"90", {25, 1}, {90, 1}},
        {"01:30", {25, 1}, {90, 1}},
        {"1:00:00.25", {25, 1}, {14401, 4}},
        {"00:00:01:05", {25, 1}, {6, 5}},
        {"00:00:01:05", {30000, 1001}, {35 * 1001, 30000}},
        {"-00:00:01:05", {25, 1}, {-6, 5}},
        {"00:01:00;02", {30000, 1001}, {1800 * 1001, 30000}},
        {"00:00:00:25", {25, 1}, {0, 0}},
        {"1.5:00", {25, 1}, {0, 0}},
        {"1:2:3:4:5", {25, 1}, {0, 0}},
        {"", {25, 1}, {0, 0}},
        {"-", {25, 1}, {0, 0}},
        {"1e3", {25, 1}, {0, 0}},
        {"1.5s", {25, 1}, {0, 0}},
        {"12345678901234567890", {25, 1}, {0, 0}},
        {"--1", {25, 1}, {0, 0}},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        wf_rational got = {7, 7};
        bool right = wf_audio_offset(rows[i].text, rows[i].rate, &got);
        if (right != (rows[i].seconds.den != 0)) fail_msg("%s", rows[i].text);
        if (right && !wf_ratio_equal(got, wf_ratio(rows[i].seconds.num, rows[i].seconds.den)))
            fail_msg("%s is %lld/%lld", rows[i].text, (long long)got.num, (long long)got.den);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ten_hours),
        cmocka_unit_test(test_cadence),
        cmocka_unit_test(test_words),
        cmocka_unit_test(test_offsets),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
