/* 2:3 pulldown: which field shows which film frame, in closed form; and through whole jobs,
 * held against the progressive run of the same film. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>

#include "filters/raster/timing.h"
#include "tests/unit/support/exr_write.h"
#include "tests/unit/support/jobs.h"

/* ---- Timing ---- */

static wf_raster film_raster(const char *text) {
    wf_raster raster;
    char why[256];
    if (!wf_raster_parse(text, &raster, why, sizeof why)) fail_msg("%s", why);
    raster.pulldown = true;
    return raster;
}

/* Frames are AA BB BC CD DD, at field 0 as at field 10^9, and before 0. */
static void letters_of_fields(void **state) {
    (void)state;
    wf_raster raster = film_raster("525i");
    const char order[] = "AABBBCCDDD";
    for (int64_t cycle = -3; cycle < 100000000; cycle += cycle < 3 ? 1 : 99999990)
        for (int n = 0; n < 10; n++)
            assert_int_equal(wf_raster_instant(&raster, 10 * cycle + n),
                             4 * cycle + (order[n] - 'A'));
    for (int64_t film = -9; film < 9; film++) {
        int64_t first = wf_raster_first_field(&raster, film);
        assert_int_equal(wf_raster_instant(&raster, first), film);
        assert_int_equal(wf_raster_instant(&raster, first - 1), film - 1);
    }
}

/* All fields of a film frame see its own subframes and no others: no drift after 13 hours. */
static void windows_of_film_frames(void **state) {
    (void)state;
    const char *names[] = {"525i", "1080i59.94", "720p59.94", "1080i60"};
    for (size_t r = 0; r < sizeof names / sizeof *names; r++) {
        wf_raster raster = film_raster(names[r]);
        wf_rational film = wf_raster_film_rate(&raster);
        assert_int_equal(film.num, r < 3 ? 24000 : 24);
        wf_timing_desc desc = {.raster = &raster,
                               .subframe_rate = wf_ratio_mul(film, wf_ratio(8, 1)),
                               .subframes = INT64_C(1) << 40,
                               .width = {1, 2},
                               .skew = {0, 1}};
        wf_timing timing;
        char why[256];
        assert_true(wf_timing_init(&timing, &desc, why, sizeof why));
        for (int64_t n = 0; n < 2800000; n += n < 40 ? 1 : 99991) {
            wf_window window = wf_timing_window(&timing, n, 0);
            assert_int_equal(window.first, 8 * ((2 * n + 1) / 5));
            assert_int_equal(window.count, 4);
        }
    }
}

static void frames_of_film(void **state) {
    (void)state;
    wf_raster raster = film_raster("525i");
    const int64_t frames[] = {0, 1, 2, 3, 5, 6, 7, 8, 10};
    wf_timing_desc desc = {
        .raster = &raster, .subframe_rate = {24000, 1001}, .width = {1, 2}, .skew = {0, 1}};
    for (int64_t film = 0; film < 9; film++) {
        desc.subframes = film;
        assert_int_equal(wf_timing_frames(&desc), frames[film]);
        int64_t last_field = 2 * frames[film] - 1;
        if (film) assert_true(wf_raster_instant(&raster, last_field) < film);
    }
}

static void rasters_without_film(void **state) {
    (void)state;
    const char *names[] = {"625i", "1080psf29.97", "1080p29.97", "1080p23.976", "720p50"};
    for (size_t r = 0; r < sizeof names / sizeof *names; r++) {
        wf_raster raster = film_raster(names[r]);
        assert_false(wf_ratio_given(wf_raster_film_rate(&raster)));
    }
}

/* ---- Jobs ---- */

enum { WIDTH = 16, LINES = 12, EACH = 8, FILM = 13, FRAMES = 16 };

/* Light that changes from subframe to subframe and from column to column, and never down the
 * picture: what the vertical aperture does is not in question. */
static float stripes(const void *user, int channel, int x, int y) {
    const int *k = user;
    uint32_t bits = (uint32_t)(*k * 97 + x * 31 + channel * 7) * 2654435761u;
    (void)y;
    return (float)(bits >> 24) / 255;
}

static void write_film(const char *rate, int each) {
    job_clean();
    for (int k = 0; k < FILM * each; k++) {
        char path[512], name[64];
        exr_part p = {.display = {0, 0, WIDTH, 2 * LINES},
                      .data = {0, 0, WIDTH, 2 * LINES},
                      .channels = "B G R",
                      .type = EXR_PIXEL_HALF,
                      .compression = EXR_COMPRESSION_ZIP,
                      .rate = rate,
                      .value = stripes,
                      .user = &k};
        snprintf(name, sizeof name, "in.%04d.exr", k);
        job_path(path, name);
        assert_true(exr_write(path, &p, 1));
    }
}

static const uint8_t *frame_of(const uint8_t *y4m, int frame) {
    size_t bytes = 2 * WIDTH * LINES * sizeof(uint16_t);
    const char *end = strchr((const char *)y4m, '\n');
    return (const uint8_t *)end + 1 + (size_t)frame * (bytes + 6) + 6;
}

/* Line y of the planes of a frame: Y, Cb, Cr. */
static const uint8_t *line_of(const uint8_t *frame, int plane, int y) {
    size_t width = plane ? WIDTH : 2 * WIDTH, before = (size_t)(plane + (plane > 0)) * WIDTH;
    return frame + before * LINES + (size_t)y * width;
}

static void same_line(const uint8_t *woven, const uint8_t *film, int y) {
    for (int plane = 0; plane < 3; plane++)
        assert_memory_equal(line_of(woven, plane, y), line_of(film, plane, 0),
                            plane ? WIDTH : 2 * WIDTH);
}

#define FILM_RASTER "raster=16x12@23.976p "

/* Each field is, code for code, the film frame of its letter. */
static void fields_show_film(void **state) {
    (void)state;
    const struct {
        const char *rate, *raster, *options;
        int each;
        bool top;
    } cases[] = {
        {"24000/1001", "raster=16x12@29.97i,bff ", "", 1, false},
        {"192000/1001", "raster=16x12@29.97i,tff ", "", EACH, true},
        {"192000/1001", "raster=16x12@29.97i,bff ", "temporal-width=1", EACH, false},
        {"192000/1001", "raster=16x12@29.97i,bff ", "temporal-width=0", EACH, false},
        {"192000/1001", "raster=16x12@29.97i,tff ", "shutter-angle=432 skip=off", EACH, true},
        {"192000/1001", "raster=16x12@29.97i,tff ", "shutter-position=center", EACH, true},
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        char options[256];
        size_t size, film_size;
        write_film(cases[c].rate, cases[c].each);
        snprintf(options, sizeof options, "cadence=2:3 aperture=box %s%s", cases[c].raster,
                 cases[c].options);
        job_done(options, "woven.y4m", NULL);
        snprintf(options, sizeof options, FILM_RASTER "aperture=box %s", cases[c].options);
        job_done(options, "film.y4m", NULL);
        uint8_t *woven = job_file("woven.y4m", &size), *film = job_file("film.y4m", &film_size);
        for (int field = 0; field < 2 * FRAMES; field++)
            for (int y = (field % 2 == 0) == cases[c].top ? 0 : 1; y < LINES; y += 2)
                same_line(frame_of(woven, field / 2), frame_of(film, (2 * field + 1) / 5), y);
        assert_int_equal(frame_of(woven, FRAMES) - 6 - woven, size);
        free(woven);
        free(film);
    }
}

/* Both fields of a segmented frame show one window, which is the progressive frame's. */
static void segmented_frames_show_one_instant(void **state) {
    (void)state;
    const char *more[] = {"", " temporal-width=1", " temporal-width=2.5 skip=off"};
    write_film("192000/1001", EACH);
    for (size_t c = 0; c < sizeof more / sizeof *more; c++) {
        char options[256];
        size_t size, film_size;
        snprintf(options, sizeof options, "overwrite aperture=box raster=16x12@23.976psf%s",
                 more[c]);
        job_done(options, "psf.y4m", NULL);
        snprintf(options, sizeof options, "overwrite aperture=box " FILM_RASTER "%s", more[c]);
        job_done(options, "film.y4m", NULL);
        uint8_t *psf = job_file("psf.y4m", &size), *film = job_file("film.y4m", &film_size);
        assert_int_equal(size, film_size);
        assert_non_null(memmem(psf, 100, " Ip", 3));
        for (int frame = 0; frame < FILM; frame++)
            for (int y = 0; y < LINES; y++)
                same_line(frame_of(psf, frame), frame_of(film, frame), y);
        free(psf);
        free(film);
    }
}

/* 24 runs at 24000/1001, and at 24 where fields are 60. */
static void film_runs_at_the_rasters_speed(void **state) {
    (void)state;
    size_t size;
    write_film(NULL, 1);
    job_done("cadence=2:3 subframe-rate=24000/1001", "a.y4m", NULL);
    uint8_t *bytes = job_file("a.y4m", &size);
    job_done("cadence=2:3 subframe-rate=24", "b.y4m", NULL);
    job_same("b.y4m", bytes, size);
    free(bytes);
    job_done("cadence=2:3 subframe-rate=24 raster=16x12@30i", "c.y4m", NULL);
    bytes = job_file("c.y4m", &size);
    job_done("cadence=2:3 subframe-rate=23.976 raster=16x12@30i", "d.y4m", NULL);
    job_same("d.y4m", bytes, size);
    free(bytes);
}

static void append(uint8_t *all, size_t *used, const char *name) {
    size_t size;
    uint8_t *part = job_file(name, &size);
    memcpy(all + *used, part, size);
    *used += size;
    free(part);
}

/* Chunks begin in the middle of film frames, and join bit for bit; and so does one thread. */
static void chunks_join(void **state) {
    (void)state;
    const char *more[] = {"", " temporal-width=2.5", " skip=off shutter-position=end"};
    write_film("192000/1001", EACH);
    for (size_t c = 0; c < sizeof more / sizeof *more; c++) {
        char options[256], name[32];
        size_t size, used = 0;
        snprintf(options, sizeof options,
                 "cadence=2:3 overwrite raster=16x12@29.97i,bff threads=1%s", more[c]);
        job_done(options, "all.y4m", NULL);
        uint8_t *all = job_file("all.y4m", &size), *joined = malloc(2 * size);
        assert_non_null(joined);
        for (int i = 1; i <= 5; i++) {
            snprintf(options, sizeof options,
                     "cadence=2:3 overwrite raster=16x12@29.97i,bff chunk=%d/5%s", i, more[c]);
            snprintf(name, sizeof name, "part%d.y4m", i);
            job_done(options, name, NULL);
            append(joined, &used, name);
        }
        assert_int_equal(used, size);
        assert_memory_equal(joined, all, size);
        free(joined);
        free(all);
    }
}

static void resuming_makes_the_same(void **state) {
    (void)state;
    char path[512];
    size_t size;
    write_film("192000/1001", EACH);
    job_done("cadence=2:3 raster=16x12@29.97i,bff", "o.####.dpx", NULL);
    uint8_t *bytes = job_file("o.0002.dpx", &size);
    job_path(path, "o.0002.dpx");
    assert_int_equal(unlink(path), 0);
    job_done("cadence=2:3 raster=16x12@29.97i,bff resume", "o.####.dpx", NULL);
    job_same("o.0002.dpx", bytes, size);
    free(bytes);
}

static void what_is_refused(void **state) {
    (void)state;
    write_film("25", 1);
    job_refused("cadence=2:3", "o.y4m", WEFT_USAGE, "24 or 23.976");
    job_refused("cadence=2:3 raster=625i", "o.y4m", WEFT_USAGE, "525i");
    job_refused("cadence=2:3 raster=1080psf23.976", "o.y4m", WEFT_USAGE, "525i");
    job_refused("cadence=3:2", "o.y4m", WEFT_USAGE, "2:3");
    job_refused("cadence=2:3 subframe-rate=60000/1001", "o.y4m", WEFT_USAGE, "film");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(letters_of_fields),
        cmocka_unit_test(windows_of_film_frames),
        cmocka_unit_test(frames_of_film),
        cmocka_unit_test(rasters_without_film),
        cmocka_unit_test(fields_show_film),
        cmocka_unit_test(segmented_frames_show_one_instant),
        cmocka_unit_test(film_runs_at_the_rasters_speed),
        cmocka_unit_test(chunks_join),
        cmocka_unit_test(resuming_makes_the_same),
        cmocka_unit_test(what_is_refused),
    };
    return cmocka_run_group_tests(tests, job_make_directory, job_remove_directory);
}
