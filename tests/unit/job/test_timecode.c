/* Labels and frames: every label of a day at every rate, against a clock that counts one by
 * one. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <cmocka.h>

#include "convert/job/timecode.h"

#define LENGTH(array) (sizeof(array) / sizeof *(array))

static const struct {
    wf_rational rate;
    bool drop;
    int base;
    int64_t ten_minutes, day;
} clocks[] = {
    {{24, 1}, false, 24, 14400, 2073600},      {{24000, 1001}, false, 24, 14400, 2073600},
    {{25, 1}, false, 25, 15000, 2160000},      {{30000, 1001}, false, 30, 18000, 2592000},
    {{30000, 1001}, true, 30, 17982, 2589408}, {{30, 1}, false, 30, 18000, 2592000},
    {{50, 1}, false, 50, 30000, 4320000},      {{60000, 1001}, false, 60, 36000, 5184000},
    {{60000, 1001}, true, 60, 35964, 5178816},
};

/* The standard's own words: a counter of labels that passes over the ones left out. */
static void tick(wf_timecode *label, int base) {
    if (++label->frames < base) return;
    label->frames = 0;
    if (++label->seconds < 60) return;
    label->seconds = 0;
    if (++label->minutes == 60) {
        label->minutes = 0;
        if (++label->hours == 24) label->hours = 0;
    }
    if (label->drop_frame && label->minutes % 10) label->frames = base / 15;
}

static bool same(const wf_timecode *a, const wf_timecode *b) {
    return a->hours == b->hours && a->minutes == b->minutes && a->seconds == b->seconds &&
           a->frames == b->frames && a->drop_frame == b->drop_frame;
}

static void every_label_of_a_day(void **state) {
    (void)state;
    for (size_t c = 0; c < LENGTH(clocks); c++) {
        wf_rational rate = clocks[c].rate;
        wf_timecode counted = {.drop_frame = clocks[c].drop};
        char why[256];
        assert_int_equal(wf_timecode_base(rate), clocks[c].base);
        for (int64_t frame = 0; frame < clocks[c].day;
             frame++, tick(&counted, clocks[c].base)) {
            wf_timecode label = wf_timecode_label(frame, rate, clocks[c].drop);
            if (!same(&label, &counted) || wf_timecode_frame(&label, rate) != frame ||
                !wf_timecode_check(&label, rate, why, sizeof why))
                fail_msg("clock %zu, frame %lld: %02d:%02d:%02d %02d", c, (long long)frame,
                         label.hours, label.minutes, label.seconds, label.frames);
        }
        assert_true(same(&counted, &(wf_timecode){.drop_frame = clocks[c].drop}));
        assert_int_equal(wf_timecode_day(rate, clocks[c].drop), clocks[c].day);
    }
}

static void ten_minutes(void **state) {
    (void)state;
    for (size_t c = 0; c < LENGTH(clocks); c++)
        for (int n = 0; n < 144; n++) {
            wf_timecode label = {
                .hours = n / 6, .minutes = n % 6 * 10, .drop_frame = clocks[c].drop};
            assert_int_equal(wf_timecode_frame(&label, clocks[c].rate),
                             n * clocks[c].ten_minutes);
        }
}

/* What a drop-frame clock is for: within ten minutes it strays by two frames of 29.97, and a
 * day is 86.4 ms, or 2.6 of them, too long. Without drop frame it would be 86.4 s. */
static void drop_frame_keeps_time(void **state) {
    (void)state;
    const wf_rational rates[] = {{30000, 1001}, {60000, 1001}};
    for (size_t r = 0; r < LENGTH(rates); r++)
        for (int64_t frame = 0; frame < 2589408; frame += 997) {
            wf_timecode label = wf_timecode_label(frame, rates[r], true);
            int base = wf_timecode_base(rates[r]);
            double shown = label.hours * 3600 + label.minutes * 60 + label.seconds +
                           (double)label.frames / base;
            double off = (shown - (double)frame / wf_ratio_value(rates[r])) * base;
            assert_true(off > -4.6 * base / 30 && off < 4.6 * base / 30);
        }
}

static void adding(void **state) {
    (void)state;
    const wf_rational ntsc = {30000, 1001}, pal = {25, 1};
    const struct {
        const char *from;
        int64_t frames;
        wf_rational rate;
        const char *to;
    } cases[] = {
        {"00:00:59;29", 1, ntsc, "00:01:00;02"},
        {"00:01:00;02", -1, ntsc, "00:00:59;29"},
        {"00:09:59;29", 1, ntsc, "00:10:00;00"},
        {"23:59:59;29", 1, ntsc, "00:00:00;00"},
        {"00:00:00;00", -1, ntsc, "23:59:59;29"},
        {"01:00:00;00", 17982, ntsc, "01:10:00;00"},
        {"10:00:00:00", 25 * 60, pal, "10:01:00:00"},
        {"23:59:59:24", 1, pal, "00:00:00:00"},
        {"00:00:00:00", -2160000 * 5 - 1, pal, "23:59:59:24"},
        {"00:00:59:29", 1, ntsc, "00:01:00:00"},
        {"00:00:59;59", 1, {60000, 1001}, "00:01:00;04"},
        {"12:34:56:07", INT64_MAX / 2160000 * 2160000, pal, "12:34:56:07"},
    };
    for (size_t i = 0; i < LENGTH(cases); i++) {
        wf_timecode label;
        char text[WF_TIMECODE_SIZE];
        assert_true(wf_parse_timecode(cases[i].from, &label));
        label = wf_timecode_add(&label, cases[i].frames, cases[i].rate);
        assert_string_equal(wf_timecode_text(&label, text), cases[i].to);
    }
}

static void labels_that_a_rate_has_not(void **state) {
    (void)state;
    const struct {
        const char *label;
        wf_rational rate;
        const char *says; /* NULL: it has */
    } cases[] = {
        {"00:00:00:24", {24, 1}, "00 to 23"},
        {"00:00:00:23", {24, 1}, NULL},
        {"00:00:00:24", {24000, 1001}, "00 to 23"},
        {"00:00:00:25", {25, 1}, "00 to 24"},
        {"00:00:00:29", {30000, 1001}, NULL},
        {"00:00:00:30", {30000, 1001}, "00 to 29"},
        {"00:00:00:59", {60000, 1001}, NULL},
        {"00:00:00;00", {25, 1}, "write :"},
        {"00:00:00;00", {30, 1}, "write :"},
        {"00:00:00;00", {24000, 1001}, "write :"},
        {"00:01:00;00", {30000, 1001}, "00:01:00;02"},
        {"00:01:00;01", {30000, 1001}, "00:01:00;02"},
        {"00:01:00;02", {30000, 1001}, NULL},
        {"00:10:00;00", {30000, 1001}, NULL},
        {"00:01:00:00", {30000, 1001}, NULL},
        {"09:59:00;03", {60000, 1001}, "09:59:00;04"},
        {"09:59:00;04", {60000, 1001}, NULL},
    };
    for (size_t i = 0; i < LENGTH(cases); i++) {
        wf_timecode label;
        char why[256] = "";
        assert_true(wf_parse_timecode(cases[i].label, &label));
        assert_int_equal(wf_timecode_check(&label, cases[i].rate, why, sizeof why),
                         !cases[i].says);
        if (cases[i].says && !strstr(why, cases[i].says))
            fail_msg("%s: %s", cases[i].label, why);
    }
    assert_false(wf_timecode_check(&(wf_timecode){.hours = 24}, (wf_rational){25, 1},
                                   (char[256]){""}, 256));
}

/* Words as ST 12-1 has them: the digits can be read off in hexadecimal. */
static void words(void **state) {
    (void)state;
    const struct {
        const char *label;
        wf_rational rate;
        uint32_t word;
    } cases[] = {
        {"01:23:45:19", {25, 1}, 0x01234519},       {"23:59:59:29", {30, 1}, 0x23595929},
        {"07:32:54;18", {30000, 1001}, 0x07325458}, {"07:32:54:18", {30000, 1001}, 0x07325418},
        {"01:02:03:48", {50, 1}, 0x01020324},       {"01:02:03:49", {50, 1}, 0x01028324},
        {"01:02:03;59", {60000, 1001}, 0x01028369}, {"00:00:00:38", {39, 1}, 0x38},
    };
    for (size_t i = 0; i < LENGTH(cases); i++) {
        wf_timecode label;
        assert_true(wf_parse_timecode(cases[i].label, &label));
        assert_int_equal(wf_timecode_bcd(&label, cases[i].rate), cases[i].word);
    }
}

/* Seconds stay where they are, frames keep their share. */
static void other_rates(void **state) {
    (void)state;
    const wf_rational film = {24000, 1001}, ntsc = {30000, 1001}, pal = {25, 1},
                      fast = {60000, 1001};
    const struct {
        wf_rational from, to;
        const char *given, *label; /* NULL: it is none */
    } cases[] = {
        {film, ntsc, "10:00:00:12", "10:00:00:15"}, {film, ntsc, "10:00:00:23", "10:00:00:28"},
        {film, ntsc, "10:00:00:24", NULL},          {ntsc, ntsc, "00:01:00;02", "00:01:00;02"},
        {ntsc, ntsc, "00:01:00;01", NULL},          {ntsc, pal, "00:01:00;29", "00:01:00:24"},
        {ntsc, fast, "00:01:00;02", "00:01:00;04"}, {fast, ntsc, "00:01:00;05", "00:01:00;02"},
        {pal, film, "23:59:59:24", "23:59:59:23"},  {pal, ntsc, "23:59:59;24", "23:59:59:28"},
    };
    for (size_t c = 0; c < LENGTH(cases); c++) {
        wf_timecode label;
        char text[WF_TIMECODE_SIZE], why[256];
        assert_true(wf_parse_timecode(cases[c].given, &label));
        bool is = wf_timecode_convert(label, cases[c].from, cases[c].to, &label);
        assert_true(is == (cases[c].label != NULL));
        if (!is) continue;
        assert_string_equal(wf_timecode_text(&label, text), cases[c].label);
        assert_true(wf_timecode_check(&label, cases[c].to, why, sizeof why));
    }
}

/* Every day that the C library knows is one, and no other. */
static void dates(void **state) {
    (void)state;
    static const char *const no[] = {"2026-02-29",
                                     "2100-01-01",
                                     "1969-12-31",
                                     "2026-13-01",
                                     "2026-00-10",
                                     "2026-04-31",
                                     "2026-1-1",
                                     "2026-11-30T",
                                     "2026-11-30T10:20:30",
                                     "2026-11-30 10:20:30Z",
                                     "",
                                     "2026-11-30T24:00:00Z",
                                     "2026-11-30T10:60:00Z",
                                     "2026-11-30T10:20:60Z",
                                     "2026-11-30T10:20:30Zz"};
    for (time_t t = 0; t < (time_t)4102444800; t += 86400) { /* 2100-01-01 */
        char text[32];
        struct tm day;
        wf_date d;
        gmtime_r(&t, &day);
        strftime(text, sizeof text, "%Y-%m-%dT23:59:07Z", &day);
        assert_true(wf_parse_date(text, &d));
        assert_true(d.year == 1900 + day.tm_year && d.month == 1 + day.tm_mon &&
                    d.day == day.tm_mday && d.hours == 23 && d.minutes == 59 && d.seconds == 7);
    }
    for (size_t i = 0; i < LENGTH(no); i++) {
        wf_date d = {.year = 7};
        assert_false(wf_parse_date(no[i], &d));
        assert_int_equal(d.year, 7);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_label_of_a_day),
        cmocka_unit_test(ten_minutes),
        cmocka_unit_test(drop_frame_keeps_time),
        cmocka_unit_test(adding),
        cmocka_unit_test(labels_that_a_rate_has_not),
        cmocka_unit_test(words),
        cmocka_unit_test(dates),
        cmocka_unit_test(other_rates),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
