/* Rasters against a table typed from the standards once more; orders against line maps. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "convert/weft.h"
#include "filters/raster/raster.h"
#include "filters/raster/raster_alias.h"

typedef struct row {
    const char *name;
    int width_px, lines;
    wf_rational rate;
    int line1, line2, total;
    const char *order;
    wf_rational aspect;
    const char *matrix;
} row;

#define NTSC                                                                                   \
    { 30000, 1001 }
static const row table[] = {
    {"525i", 720, 486, NTSC, 21, 283, 525, "bottom first", {10, 11}, "601-525"},
    {"525i-imx", 720, 486, NTSC, 20, 283, 525, "top first", {10, 11}, "601-525"},
    {"525i-dv", 720, 480, NTSC, 23, 285, 525, "bottom first", {10, 11}, "601-525"},
    {"525i-rp202", 720, 480, NTSC, 23, 286, 525, "top first", {10, 11}, "601-525"},
    {"625i", 720, 576, {25, 1}, 23, 336, 625, "top first", {12, 11}, "601-625"},
    {"625i-dv", 720, 576, {25, 1}, 23, 335, 625, "bottom first", {12, 11}, "601-625"},
    {"525i-wide", 720, 486, NTSC, 21, 283, 525, "bottom first", {40, 33}, "601-525"},
    {"525i-imx-wide", 720, 486, NTSC, 20, 283, 525, "top first", {40, 33}, "601-525"},
    {"525i-dv-wide", 720, 480, NTSC, 23, 285, 525, "bottom first", {40, 33}, "601-525"},
    {"525i-rp202-wide", 720, 480, NTSC, 23, 286, 525, "top first", {40, 33}, "601-525"},
    {"625i-wide", 720, 576, {25, 1}, 23, 336, 625, "top first", {16, 11}, "601-625"},
    {"625i-dv-wide", 720, 576, {25, 1}, 23, 335, 625, "bottom first", {16, 11}, "601-625"},
    {"1080i50", 1920, 1080, {25, 1}, 21, 584, 1125, "top first", {1, 1}, "709"},
    {"1080i59.94", 1920, 1080, NTSC, 21, 584, 1125, "top first", {1, 1}, "709"},
    {"1080i60", 1920, 1080, {30, 1}, 21, 584, 1125, "top first", {1, 1}, "709"},
    {"1080psf23.976", 1920, 1080, {24000, 1001}, 21, 584, 1125, "one instant", {1, 1}, "709"},
    {"1080psf24", 1920, 1080, {24, 1}, 21, 584, 1125, "one instant", {1, 1}, "709"},
    {"1080psf25", 1920, 1080, {25, 1}, 21, 584, 1125, "one instant", {1, 1}, "709"},
    {"1080psf29.97", 1920, 1080, NTSC, 21, 584, 1125, "one instant", {1, 1}, "709"},
    {"1080psf30", 1920, 1080, {30, 1}, 21, 584, 1125, "one instant", {1, 1}, "709"},
};
#define ROWS (sizeof table / sizeof *table)

static const struct {
    const char *name;
    int width_px, lines;
    const char *matrix;
} sizes[] = {
    {"720p", 1280, 720, "709"}, {"1080p", 1920, 1080, "709"}, {"2160p", 3840, 2160, "2020"}};
static const struct {
    const char *name;
    wf_rational rate;
} rates[] = {{"23.976", {24000, 1001}}, {"24", {24, 1}}, {"25", {25, 1}},
             {"29.97", NTSC},           {"30", {30, 1}}, {"50", {50, 1}},
             {"59.94", {60000, 1001}},  {"60", {60, 1}}};

static wf_raster parse(const char *text) {
    wf_raster raster;
    char why[512];
    if (!wf_raster_parse(text, &raster, why, sizeof why)) fail_msg("%s", why);
    return raster;
}

static void assert_row(const row *want) {
    wf_raster r = parse(want->name);
    bool same = !strcmp(r.name, want->name) && r.width_px == want->width_px &&
                r.lines == want->lines && wf_ratio_equal(r.frame_rate, want->rate) &&
                r.line1 == want->line1 && r.line2 == want->line2 &&
                r.total_lines == want->total && !strcmp(wf_raster_order(&r), want->order) &&
                wf_ratio_equal(r.pixel_aspect, want->aspect) &&
                !strcmp(wf_matrix_name(r.matrix), want->matrix);
    if (!same)
        fail_msg("%s: %dx%d at %lld/%lld, {%d,%d} of %d, %s", r.name, r.width_px, r.lines,
                 (long long)r.frame_rate.num, (long long)r.frame_rate.den, r.line1, r.line2,
                 r.total_lines, wf_raster_order(&r));
}

static void rows_of_the_table(void **state) {
    (void)state;
    for (size_t i = 0; i < ROWS; i++) assert_row(&table[i]);
    for (size_t s = 0; s < 3; s++)
        for (size_t r = 0; r < 8; r++) {
            char name[32];
            snprintf(name, sizeof name, "%s%s", sizes[s].name, rates[r].name);
            assert_row(&(row){name,
                              sizes[s].width_px,
                              sizes[s].lines,
                              rates[r].rate,
                              0,
                              0,
                              0,
                              "progressive",
                              {1, 1},
                              sizes[s].matrix});
        }
}

/* What is listed is what is above, so that no row goes untested. */
static void nothing_else_is_listed(void **state) {
    (void)state;
    size_t listed = 0, wide = 6;
    for (const wf_raster *r; (r = wf_raster_at(listed)); listed++) {
        assert_string_equal(parse(r->name).name, r->name);
        for (size_t other = 0; other < listed; other++)
            assert_string_not_equal(wf_raster_at(other)->name, r->name);
    }
    assert_int_equal(listed, ROWS - wide + 3 * 8);
    assert_null(wf_raster_at(SIZE_MAX));
}

/* |L2 - N/2 - L1| = 1/2: the first lines of the fields are half a line apart in the frame, and
 * the one above is the one whose field has the smaller number once field 2 is moved up by N/2.
 */
static void line_maps(void **state) {
    (void)state;
    for (size_t i = 0; wf_raster_at(i); i++) {
        const wf_raster *r = wf_raster_at(i);
        if (!r->total_lines) continue;
        double apart = r->line2 - r->total_lines / 2.0 - r->line1;
        assert_true(apart == 0.5 || apart == -0.5);
        assert_true(wf_raster_map_valid(r->line1, r->line2, r->total_lines));
        assert_int_equal(wf_raster_map_top_first(r->line1, r->line2, r->total_lines),
                         apart > 0);
        assert_int_equal(r->top_first, apart > 0);
    }
    for (int l1 = 1; l1 < 40; l1++)
        for (int l2 = 250; l2 < 360; l2++)
            for (int n = 500; n < 640; n += 5) {
                double apart = l2 - n / 2.0 - l1;
                bool valid = apart == 0.5 || apart == -0.5;
                assert_int_equal(wf_raster_map_valid(l1, l2, n), valid);
                assert_int_equal(wf_raster_map_top_first(l1, l2, n), valid && apart > 0);
            }
}

/* 486 lines to 480 by dropping lines above and below: each dropped line at the top
 * makes the other field's line the top one. */
static void windows_of_480_lines(void **state) {
    (void)state;
    const struct {
        const char *from, *to;
        int above, below;
    } cuts[] = {{"525i", "525i-dv", 4, 2},
                {"525i", "525i-rp202", 5, 1},
                {"525i-imx", "525i-dv", 5, 1},
                {"525i-imx", "525i-rp202", 6, 0}};
    for (size_t i = 0; i < 4; i++) {
        wf_raster from = parse(cuts[i].from), to = parse(cuts[i].to);
        assert_int_equal(from.lines - cuts[i].above - cuts[i].below, to.lines);
        assert_int_equal(from.top_first ^ (cuts[i].above % 2), to.top_first);
        assert_int_equal(from.line1 + (cuts[i].above + from.top_first) / 2, to.line1);
        assert_int_equal(from.line2 + (cuts[i].above + !from.top_first) / 2, to.line2);
    }
}

static void descriptions(void **state) {
    (void)state;
    const struct {
        row want;
        wf_scan scan;
        bool top_first;
    } cases[] = {
        {{"180x122@30i,tff", 180, 122, {30, 1}, 0, 0, 0, "top first", {1, 1}, "709"},
         WF_INTERLACED,
         true},
        {{"180x122@30i", 180, 122, {30, 1}, 0, 0, 0, "top first", {1, 1}, "709"},
         WF_INTERLACED,
         true},
        {{"720x486@29.97i,bff,par=160:177,601-525",
          720,
          486,
          NTSC,
          0,
          0,
          0,
          "bottom first",
          {160, 177},
          "601-525"},
         WF_INTERLACED,
         false},
        {{"720x576@25psf,601-625,par=59:54",
          720,
          576,
          {25, 1},
          0,
          0,
          0,
          "one instant",
          {59, 54},
          "601-625"},
         WF_SEGMENTED,
         true},
        {{"4096x2160@24000/1001p,2020",
          4096,
          2160,
          {24000, 1001},
          0,
          0,
          0,
          "progressive",
          {1, 1},
          "2020"},
         WF_PROGRESSIVE,
         false},
        {{"97x61@12.5p", 97, 61, {25, 2}, 0, 0, 0, "progressive", {1, 1}, "709"},
         WF_PROGRESSIVE,
         false},
        {{"1x2@1000i,bff", 1, 2, {1000, 1}, 0, 0, 0, "bottom first", {1, 1}, "709"},
         WF_INTERLACED,
         false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_row(&cases[i].want);
        wf_raster r = parse(cases[i].want.name);
        assert_int_equal(r.scan, cases[i].scan);
        assert_int_equal(r.top_first, cases[i].top_first);
    }
}

/* ---- Other names ---- */

/* What each other name means, typed here once more: lines, and fields or frames a second. */
static void other_names_are_the_right_rasters(void **state) {
    (void)state;
    const struct {
        const char *text, *name;
        int lines;
        double frames_a_second;
    } cases[] = {
        {"pal", "625i", 576, 25},
        {"PAL", "625i", 576, 25},
        {"576i", "625i", 576, 25},
        {"576i50", "625i", 576, 25},
        {"576i25", "625i", 576, 25},
        {"576i/50", "625i", 576, 25},
        {"ntsc", "525i", 486, 30000.0 / 1001},
        {"486i", "525i", 486, 30000.0 / 1001},
        {"1080i25", "1080i50", 1080, 25},
        {"1080i/25", "1080i50", 1080, 25},
        {"1080i29.97", "1080i59.94", 1080, 30000.0 / 1001},
        {"1080i5994", "1080i59.94", 1080, 30000.0 / 1001},
        {"1080i30", "1080i60", 1080, 30},
        {"1080I50", "1080i50", 1080, 25},
        {"720p5994", "720p59.94", 720, 60000.0 / 1001},
        {"1080i/50", "1080i50", 1080, 25},
        {"1080i 50 Hz", "1080i50", 1080, 25},
        {"1080i_59.94", "1080i59.94", 1080, 30000.0 / 1001},
        {"1080i59", "1080i59.94", 1080, 30000.0 / 1001},
        {"NTSC-J", "525i", 486, 30000.0 / 1001},
        {"PAL-SD", "625i", 576, 25},
        {"sd pal", "625i", 576, 25},
        {"PAL 16:9", "625i-wide", 576, 25},
        {"pal-m", "525i", 486, 30000.0 / 1001},
        {"SECAM-L", "625i", 576, 25},
        {"480i29.97-bff", "525i-dv", 480, 30000.0 / 1001},
        {"1080sf25", "1080psf25", 1080, 25},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        wf_raster r = parse(cases[i].text);
        assert_string_equal(r.name, cases[i].name);
        assert_int_equal(r.lines, cases[i].lines);
        assert_float_equal(wf_ratio_value(r.frame_rate), cases[i].frames_a_second, 1e-9);
    }
}

static void every_other_name_is_of_a_raster_and_of_none_itself(void **state) {
    const wf_raster_other_name *other;
    (void)state;
    for (size_t i = 0; (other = wf_raster_alias_at(i)); i++) {
        wf_raster r = parse(other->alias);
        assert_string_equal(r.name, other->name);
        size_t digits = strspn(other->alias, "0123456789");
        bool interlaced = digits < 3 || other->alias[digits] == 'i';
        assert_int_equal(r.scan == WF_INTERLACED, interlaced);
        for (size_t k = 0; wf_raster_at(k); k++)
            assert_string_not_equal(wf_raster_at(k)->name, other->alias);
    }
}

static bool suggested(const char *why, const char *name) {
    const char *at = strstr(why, name);
    return at && !isalnum((unsigned char)at[strlen(name)]) && at[strlen(name)] != '.';
}

/* Any size, scan and rate that is no raster: what is suggested has that scan and size. */
static void nothing_of_another_scan_or_size_is_suggested(void **state) {
    static const char *const lines_said[] = {"480", "486", "525",  "576",
                                             "625", "720", "1080", "2160"};
    static const char *const scans_said[] = {"i", "p", "psf"};
    static const char *const rates_said[] = {"",   "23",   "24",  "25.5", "26",  "29",  "29.98",
                                             "31", "48",   "49",  "50.1", "51",  "59",  "59.4",
                                             "61", "5995", "100", "119",  "2.5", "499", "60.0"};
    char text[32], why[512];
    wf_raster r;
    (void)state;
    for (size_t n = 0; n < 8 * 3 * 21; n++) {
        const char *size = lines_said[n / 63], *scan = scans_said[n / 21 % 3];
        snprintf(text, sizeof text, "%s%s%s", size, scan, rates_said[n % 21]);
        if (wf_raster_parse(text, &r, why, sizeof why)) continue;
        const char *meant = strstr(why, "did you mean ");
        if (!meant) continue;
        for (size_t k = 0; wf_raster_at(k); k++) {
            const wf_raster *raster = wf_raster_at(k);
            if (!suggested(meant, raster->name)) continue;
            if ((raster->scan == WF_INTERLACED) != !strcmp(scan, "i") ||
                (raster->scan == WF_PROGRESSIVE) != !strcmp(scan, "p"))
                fail_msg("%s: %s", text, why);
            if (atoi(size) >= 720 && raster->lines != atoi(size)) fail_msg("%s: %s", text, why);
            double rate = atof(rates_said[n % 21]), own = wf_ratio_value(raster->frame_rate);
            if (rate > 1000) rate /= 100;
            bool near = fabs(rate - own) <= 1 || fabs(rate - 2 * own) <= 1 ||
                        fabs(2 * rate - 2 * own) <= 1;
            if (rate > 0 && !near) fail_msg("%s: %s", text, why);
        }
    }
}

static void names_that_say_too_little_are_told_what_lacks(void **state) {
    (void)state;
    const struct {
        const char *text, *says;
    } cases[] = {
        {"480i", "525i-dv"},      {"480i59.94", "525i-rp202"}, {"1080i", "1080i50"},
        {"1080i24", "1080psf24"}, {"525i60", "59.94"},         {"hd", "1080i59.94"},
        {"1080p", "1080p25"},     {"576p50", "720x576@50p"},   {"4K", "2160p50"},
        {"1080", "1080i50"},      {"HDTV", "1080i59.94"},      {"sd", "625i"},
        {"720", "720p50"},        {"720i50", "720p50"},        {"625", "625i"},
        {"480", "525i-rp202"},    {"25i", "1080i50"},          {"59.94i", "525i"},
        {"60i", "1080i59.94"},    {"dv", "625i-dv"},           {"1125i", "1080i59.94"},
        {"525p", "720x480"},      {"dvd-ntsc", "525i-rp202"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char why[512];
        wf_raster r;
        assert_false(wf_raster_parse(cases[i].text, &r, why, sizeof why));
        if (!strstr(why, cases[i].says)) fail_msg("%s: %s", cases[i].text, why);
        if (strstr(why, "did you mean")) fail_msg("%s: %s", cases[i].text, why);
    }
}

static void refusals_say_what_is_right(void **state) {
    (void)state;
    const struct {
        const char *text, *says;
    } cases[] = {
        {"", "WxH@RATE"},
        {"526i", "did you mean 525i?"},
        {"525i-win", "did you mean 525i"},
        {"625i-wid", "did you mean 625i-wide?"},
        {"1080i59.95", "did you mean 1080i59.94?"},
        {"1080i50-wide", "weft rasters"},
        {"1080i48", "such as 1920x1080@25i"},
        {"1250i", "weft rasters"},
        {"nonsense", "weft rasters"},
        {"180x121@30i", "even"},
        {"180x121@30psf", "even"},
        {"180@30i", "WxH@RATE"},
        {"0x10@30i", "1 to 32768"},
        {"32769x10@30i", "1 to 32768"},
        {"99999999999999999999x10@30i", "1 to 32768"},
        {"-180x122@30i", "WxH@RATE"},
        {"180x122@30", "i, p or psf"},
        {"180x122@i", "i, p or psf"},
        {"180x122@0i", "above 0"},
        {"180x122@1001i", "up to 1000"},
        {"180x122@30x", "i, p or psf"},
        {"180x122@30i,", "cannot stand here"},
        {"180x122@30i,top", "'top' cannot stand here"},
        {"180x122@30p,tff", "'tff' cannot stand here"},
        {"180x122@30i,tff,bff", "'bff' cannot stand here"},
        {"180x122@30i,709,2020", "'2020' cannot stand here"},
        {"180x122@30i,par=0:1", "'par=0:1' cannot stand here"},
        {"180x122@30i,par=", "par="},
        {"180x122@30i,601", "601-525"},
        {"180x122@30i,par=00000000000000000000000000000000000000000000000001:1",
         "63 characters"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        wf_raster r = {.width_px = 7};
        char why[512] = "";
        if (wf_raster_parse(cases[i].text, &r, why, sizeof why))
            fail_msg("'%s' was taken", cases[i].text);
        assert_int_equal(r.width_px, 7); /* untouched */
        if (!strstr(why, cases[i].says)) fail_msg("'%s': %s", cases[i].text, why);
        assert_false(wf_raster_parse(cases[i].text, &r, why, 8)); /* a short buffer is enough */
    }
}

/* Every line of a frame belongs to one of its fields, and the fields follow each other by
 * order. */
static void fields_make_frames(void **state) {
    (void)state;
    const char *const names[] = {"525i",    "525i-imx",  "1080i50", "1080psf25",
                                 "1080p25", "97x61@25p", "8x2@25i"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        wf_raster r = parse(names[i]);
        int fields = wf_raster_fields_per_frame(&r), lines = 0;
        assert_int_equal(fields, r.scan == WF_PROGRESSIVE ? 1 : 2);
        assert_int_equal(wf_raster_line_step(&r), fields);
        for (int64_t n = INT64_C(1) << 40; n < (INT64_C(1) << 40) + fields; n++)
            lines += wf_raster_field_lines(&r, wf_raster_parity(&r, n));
        assert_int_equal(lines, r.lines);
        if (fields == 2) assert_int_equal(wf_raster_parity(&r, 0), r.top_first ? 0 : 1);
        if (fields == 2) assert_int_not_equal(wf_raster_parity(&r, 0), wf_raster_parity(&r, 1));
    }
}

/* Tf: half a frame when interlaced, a whole one for segmented and progressive frames. */
static void field_periods(void **state) {
    (void)state;
    const struct {
        const char *name;
        wf_rational period_s;
    } cases[] = {{"525i", {1001, 60000}},
                 {"1080i50", {1, 50}},
                 {"1080psf25", {1, 25}},
                 {"720p59.94", {1001, 60000}}};
    for (size_t i = 0; i < 4; i++) {
        wf_raster r = parse(cases[i].name);
        assert_true(wf_ratio_equal(wf_raster_field_period(&r), cases[i].period_s));
    }
}

static void public_view(void **state) {
    (void)state;
    weft_raster a, b;
    weft_error err = {""};
    size_t count = 0;
    for (; weft_raster_at(count, &a); count++) {
        assert_int_equal(weft_raster_parse(a.name, &b, &err), WEFT_OK);
        assert_string_equal(a.name, b.name);
        assert_string_equal(a.matrix, b.matrix);
        assert_true(a.lines == b.lines && a.rate_num == b.rate_num &&
                    a.top_first == b.top_first);
        assert_int_equal(a.interlaced, !strchr(a.name, 'p') || strstr(a.name, "psf") ||
                                           strstr(a.name, "rp202"));
        assert_int_equal(a.segmented, strstr(a.name, "psf") != NULL);
    }
    assert_non_null(wf_raster_at(count - 1));
    assert_null(wf_raster_at(count));
    assert_int_equal(weft_raster_parse("526i", &b, &err), WEFT_USAGE);
    assert_non_null(strstr(err.text, "525i"));
    assert_int_equal(weft_raster_parse("526i", &b, NULL), WEFT_USAGE);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_of_the_table),
        cmocka_unit_test(nothing_else_is_listed),
        cmocka_unit_test(line_maps),
        cmocka_unit_test(windows_of_480_lines),
        cmocka_unit_test(descriptions),
        cmocka_unit_test(other_names_are_the_right_rasters),
        cmocka_unit_test(every_other_name_is_of_a_raster_and_of_none_itself),
        cmocka_unit_test(nothing_of_another_scan_or_size_is_suggested),
        cmocka_unit_test(names_that_say_too_little_are_told_what_lacks),
        cmocka_unit_test(refusals_say_what_is_right),
        cmocka_unit_test(fields_make_frames),
        cmocka_unit_test(field_periods),
        cmocka_unit_test(public_view),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
