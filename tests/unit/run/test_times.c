/* Whole jobs over sequences whose pictures have times of their own, or rates, or gaps: what
 * fields hold of their light, in closed form. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "convert/read/source.h"
#include "tests/unit/support/exr_write.h"
#include "tests/unit/support/jobs.h"

enum { WIDTH = 16, LINES = 12 };

/* ---- Pictures ---- */

static float level_of(const void *user, int channel, int x, int y) {
    (void)channel, (void)x, (void)y;
    return *(const float *)user;
}

static void write_level(const char *name, float level, const char *frames, const char *time) {
    char path[512];
    const exr_part p = {.display = {0, 0, WIDTH, LINES},
                        .data = {0, 0, WIDTH, LINES},
                        .channels = "B G R",
                        .type = EXR_PIXEL_FLOAT,
                        .compression = EXR_COMPRESSION_NONE,
                        .rate = frames,
                        .time = time,
                        .value = level_of,
                        .user = &level};
    job_path(path, name);
    assert_true(exr_write(path, &p, 1));
}

/* Picture k of the sequence, shown from num/den s on. */
static void write_timed(int k, float level, int64_t num, int64_t den) {
    char name[32], time[48];
    snprintf(name, sizeof name, "in.%04d.exr", k);
    snprintf(time, sizeof time, "%lld/%lld", (long long)num, (long long)den);
    write_level(name, level, NULL, time);
}

/* The level of line y of frame n of out.####.exr. */
static double level_at(int n, int y) {
    char name[32], path[512];
    const wf_source_options options = {.max_memory_bytes = 1 << 24};
    wf_subframe *frame;
    wf_reader *reader;
    wf_rows rows;
    weft_error err = {""};
    snprintf(name, sizeof name, "out.%04d.exr", n);
    job_path(path, name);
    if (wf_subframe_open(path, -1, &options, &frame, &err)) fail_msg("%s", err.text);
    assert_int_equal(wf_reader_new(&options, &reader, &err), WEFT_OK);
    assert_int_equal(wf_reader_rows(reader, frame, y, y + 1, &rows, &err), WEFT_OK);
    double level = (double)((const float *)rows.plane[0])[WIDTH / 2];
    wf_reader_free(reader);
    wf_subframe_close(frame);
    return level;
}

static void check_level(int field, double wanted) {
    double level = level_at(field / 2, LINES / 2 + field % 2);
    if (!(fabs(level - wanted) <= 1e-6))
        fail_msg("field %d is %.9g, not %.9g", field, level, wanted);
}

/* ---- Times ---- */

#define RASTER "raster=16x12@25i,tff aperture=box "

/* White for 3/10 of each field, black for the rest: the first lasts 3/500 s, the other 7/500.
 */
static void three_tenths_of_each_field(void **state) {
    (void)state;
    char report[JOB_REPORT];
    job_clean();
    for (int k = 0; k < 40; k++)
        write_timed(k, k % 2 ? 0 : 1, 10 * (k / 2) + (k % 2 ? 3 : 0), 500);
    /* The last would last as long as the white one, 3/500 s: one more black one says when it
     * ends. */
    write_timed(40, 0, 200, 500);
    job_done(RASTER "temporal-width=1", "out.####.exr", report);
    assert_non_null(strstr(report, "\"irregular\""));
    assert_true(job_number(report, "frames") == 10);
    for (int n = 0; n < 20; n++) check_level(n, 0.3);
    job_done(RASTER "temporal-width=1 shutter-position=center overwrite", "out.####.exr", NULL);
    for (int n = 1; n < 20; n++) check_level(n, 0.3); /* the last 15/100, the first 15/100 */
    job_done(RASTER "temporal-width=1/2 overwrite", "out.####.exr", NULL);
    for (int n = 0; n < 20; n++) check_level(n, 0.6);
    job_done(RASTER "temporal-width=0 overwrite", "out.####.exr", NULL);
    for (int n = 0; n < 20; n++) check_level(n, 1);
}

static uint32_t random_state = 7;
static int below(int end) {
    random_state = random_state * 1664525 + 1013904223;
    return (int)((uint64_t)random_state * (uint64_t)end >> 32);
}

/* Random levels and gaps against the mean of overlaps in double; cells that run between
 * midpoints too. */
static void random_times(void **state) {
    (void)state;
    for (int trial = 0; trial < 12; trial++) {
        enum { COUNT = 50 };
        float level[COUNT];
        double t[COUNT + 1], edge[COUNT + 1];
        bool center = trial % 2;
        int64_t at = 90000, units = trial % 3 ? 90000 : 24000;
        int frames = 0;
        job_clean();
        for (int k = 0; k < COUNT; k++) {
            level[k] = (float)below(1000) / 1000;
            write_timed(k, level[k], at, units);
            t[k] = (double)(at - 90000) / (double)units;
            at += 1 + below((int)units / (below(3) ? 150 : 20));
        }
        t[COUNT] = 2 * t[COUNT - 1] - t[COUNT - 2];
        edge[0] = t[0] - (center ? (t[1] - t[0]) / 2 : 0);
        for (int k = 1; k <= COUNT; k++) edge[k] = center ? (t[k - 1] + t[k]) / 2 : t[k];
        char report[JOB_REPORT];
        job_done(center ? RASTER "temporal-width=1 subframe-time=center"
                        : RASTER "temporal-width=1",
                 "out.####.exr", report);
        frames = (int)job_number(report, "frames");
        assert_true(frames >= (int)(t[COUNT] * 25) && frames <= (int)(t[COUNT] * 25) + 1);
        for (int n = 0; n < 2 * frames; n++) {
            double sum = 0, length = 0;
            for (int k = 0; k < COUNT; k++) {
                double overlap = fmin(edge[k + 1], (n + 1) / 50.0) - fmax(edge[k], n / 50.0);
                if (overlap <= 0) continue;
                sum += overlap * (double)level[k];
                length += overlap;
            }
            if (length > 1e-9) check_level(n, sum / length);
        }
    }
}

/* Even times are a rate, which nobody has to give; an option counts for more. */
static void even_times(void **state) {
    (void)state;
    char report[JOB_REPORT];
    job_clean();
    for (int k = 0; k < 16; k++) write_timed(k, 0.5f, 1000 + k, 200);
    job_done(RASTER "temporal-width=1", "out.####.exr", report);
    assert_non_null(strstr(report, "\"200\""));
    assert_true(job_number(report, "frames") == 2);
    job_done(RASTER "temporal-width=1 subframe-rate=100 overwrite", "out.####.exr", report);
    assert_non_null(strstr(report, "\"option\""));
    assert_true(job_number(report, "frames") == 4);
    /* A range asks for numbers that are not there. */
    job_refused(RASTER "temporal-width=1 frames=8-47 overwrite", "out.####.exr", WEFT_FAILED,
                "subframe 16 is missing");
    char command[600];
    snprintf(command, sizeof command, "rm '%s/in.0005.exr'", job_directory);
    assert_int_equal(system(command), 0);
    job_refused(RASTER "temporal-width=1 overwrite", "out.####.exr", WEFT_FAILED,
                "subframe 5 is missing");
}

/* One picture that is late is enough for times of their own: the second, or the last but one.
 */
static void one_late_picture(void **state) {
    (void)state;
    char report[JOB_REPORT];
    for (int late = 1; late < 16; late += 13) {
        job_clean();
        for (int k = 0; k < 16; k++)
            write_timed(k, k == late ? 1 : 0, 10 * k + (k == late ? 4 : 0), 2000);
        job_done(RASTER "temporal-width=1", "out.####.exr", report);
        assert_non_null(strstr(report, "\"irregular\""));
        if (late == 1) check_level(0, 0.15); /* 6/10 of a quarter of a field */
    }
}

/* Where half of the numbers are there, the others are missing, and times tell which. */
static void half_of_the_numbers(void **state) {
    (void)state;
    job_clean();
    for (int k = 0; k < 8; k++)
        if (k == 0 || k == 3 || k == 5 || k == 7) write_timed(k, 0.5f, k, 200);
    job_refused(RASTER "temporal-width=1", "out.####.exr", WEFT_FAILED,
                "subframe 1 is missing");
}

static void times_that_will_not_do(void **state) {
    (void)state;
    job_clean();
    for (int k = 0; k < 16; k++) write_timed(k, 0.5f, k == 7 ? 6 : k, 200);
    job_refused(RASTER, "out.####.exr", WEFT_FAILED, "in.0007.exr");
    for (int k = 0; k < 16; k++) write_timed(k, 0.5f, 20 - k, 200);
    job_refused(RASTER, "out.####.exr", WEFT_FAILED, "in.0001.exr");
    for (int k = 0; k < 16; k++) write_timed(k, 0.5f, k * k, 2000);
    job_refused("raster=525i cadence=2:3", "out.####.exr", WEFT_USAGE, "irregular");
    write_level("in.0009.exr", 0.5f, NULL, NULL); /* not all of them have times */
    job_refused(RASTER, "out.####.exr", WEFT_USAGE, "--subframe-rate");
}

/* ---- Frames ---- */

/* Subframes that no window needs are left out: no frame is lost and nothing is missing. */
static void what_no_window_needs(void **state) {
    (void)state;
    char report[JOB_REPORT], name[32];
    job_clean();
    for (int k = 0; k < 64; k++) {
        snprintf(name, sizeof name, "in.%04d.exr", k);
        if (k % 8 < 4) write_level(name, (float)(k / 8) / 8, NULL, NULL);
    }
    job_done(RASTER "subframe-rate=400", "out.####.exr", report);
    assert_true(job_number(report, "frames") == 4);
    assert_non_null(strstr(report, "\"missing\": []"));
    for (int n = 0; n < 8; n++) check_level(n, n / 8.0);
    job_refused(RASTER "subframe-rate=400 temporal-width=1 overwrite", "out.####.exr",
                WEFT_FAILED, "subframe 4 is missing (24 of");
}

/* The frames named are those of the whole run, under their numbers. */
static void output_frames(void **state) {
    (void)state;
    char report[JOB_REPORT], name[32];
    size_t size;
    job_clean();
    for (int k = 0; k < 64; k++) {
        snprintf(name, sizeof name, "in.%04d.exr", k + 1001);
        write_level(name, (float)k / 64, "400", NULL);
    }
    job_done(RASTER "temporal-width=1", "out.####.exr", report);
    uint8_t *whole = job_file("out.0002.exr", &size);
    job_clean();
    for (int k = 0; k < 64; k++) {
        snprintf(name, sizeof name, "in.%04d.exr", k + 1001);
        if (k < 1 || k >= 32) write_level(name, (float)k / 64, "400", NULL);
    }
    job_done(RASTER "temporal-width=1 output-frames=2-3", "out.####.exr", report);
    assert_true(job_number(report, "frames") == 2);
    assert_non_null(strstr(report, "\"missing\": []"));
    job_same("out.0002.exr", whole, size);
    check_level(7, (56 + 3.5) / 64);
    job_refused(RASTER "output-frames=2-4 overwrite", "out.####.exr", WEFT_USAGE,
                "frames 0 to 3");
    job_refused(RASTER "output-frames=3-2", "out.####.exr", WEFT_USAGE, "--output-frames");
    free(whole);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(three_tenths_of_each_field),
        cmocka_unit_test(random_times),
        cmocka_unit_test(even_times),
        cmocka_unit_test(one_late_picture),
        cmocka_unit_test(half_of_the_numbers),
        cmocka_unit_test(times_that_will_not_do),
        cmocka_unit_test(what_no_window_needs),
        cmocka_unit_test(output_frames),
    };
    return cmocka_run_group_tests(tests, job_make_directory, job_remove_directory);
}
