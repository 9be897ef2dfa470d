/* Where timecode starts: what inputs say of it, seen in the bytes of DPX files. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "tests/unit/support/exr_write.h"
#include "tests/unit/support/jobs.h"

enum { SUBFRAMES = 6 };

static float gray(const void *user, int channel, int x, int y) {
    (void)user, (void)channel, (void)x, (void)y;
    return 0.25f;
}

/* The k-th file's label has k frames more. */
static void write_subframes(const char *rate, uint32_t timecode) {
    job_clean();
    for (uint32_t k = 0; k < SUBFRAMES; k++) {
        char path[512], name[64];
        exr_part p = {.display = {0, 0, 4, 4},
                      .data = {0, 0, 4, 4},
                      .channels = "B G R",
                      .type = EXR_PIXEL_HALF,
                      .rate = rate,
                      .timecode = timecode ? timecode + k : 0,
                      .value = gray};
        snprintf(name, sizeof name, "in.%04u.exr", k);
        job_path(path, name);
        assert_true(exr_write(path, &p, 1));
    }
}

/* ST 268-1: the television header's time code. */
static uint32_t label_of(const char *name) {
    size_t size;
    uint8_t *bytes = job_file(name, &size), *at = bytes + 1920;
    assert_true(size > 2048);
    uint32_t word =
        (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
    free(bytes);
    return word;
}

#define RASTER "raster=4x4@29.97i subframe-rate=60000/1001 "
#define DROP   0x40u
#define MARK   0x8000u

static void labels_of_inputs(void **state) {
    (void)state;
    const struct {
        const char *rate;
        uint32_t timecode;
        const char *options;
        uint32_t label;
    } cases[] = {
        {NULL, 0, RASTER, 0},
        {"30000/1001", 0x01000028 | DROP, RASTER, 0x01000028 | DROP},
        {"30000/1001", 0x01000025, RASTER "frames=3-5", 0x01000028},
        {"30000/1001", 0x01000028, RASTER "timecode=02:00:00;00", 0x02000000 | DROP},
        {"30000/1001", 0x01000028 | DROP, "raster=4x4@25i subframe-rate=60", 0x01000023},
        {"24000/1001", 0x10000012, "raster=4x4@29.97i cadence=2:3", 0x10000015},
        {"24/1", 0x10000012, "raster=4x4@29.97i cadence=2:3", 0x10000015},
        /* subframes are counted as such: the label counts film, or the raster's frames */
        {"192/1", 0x10000012, "raster=4x4@29.97i cadence=2:3 subframe-rate=24", 0x10000015},
        {"480000/1001", 0x00595929, RASTER, 0x00595929},
        /* a label of two frames, and its field mark */
        {"60000/1001", 0x01000014 | MARK, "raster=4x4@29.97i", 0x01000014},
        {"60000/1001", 0x01000014 | MARK, "raster=4x4@59.94p", 0x01000014 | MARK},
        /* none of its rate */
        {"24000/1001", 0x10000027, RASTER, 0},
        {"30000/1001", 0x00010000 | DROP, RASTER, 0},
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        write_subframes(cases[c].rate, cases[c].timecode);
        job_done(cases[c].options, "o.####.dpx", NULL);
        assert_int_equal(label_of("o.0000.dpx"), cases[c].label);
    }
}

static void chunks_count_from_the_same_label(void **state) {
    (void)state;
    write_subframes("30000/1001", 0x01000028);
    job_done(RASTER "chunk=3/3", "o.####.dpx", NULL);
    assert_int_equal(label_of("o.0002.dpx"), 0x01000100);
}

static void count_warnings(const char *text, void *user) {
    int *count = user;
    *count += strstr(text, "timecode") != NULL;
}

static void what_was_taken_is_said(void **state) {
    (void)state;
    const struct {
        uint32_t timecode;
        const char *option, *value;
        int said;
    } cases[] = {{0, NULL, NULL, 0},
                 {0x10000012, NULL, NULL, 1},
                 {0x10000013, NULL, NULL, 2}, /* and that no A frame is there */
                 {0x10000012, "timecode", "01:00:00:05", 0},
                 {0x10000012, "timecode", "01:00:00:07", 1},
                 {0x10000012, "timecode", "01:00:00;07", 0}};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        char path[512];
        int said = 0;
        weft_job *job = weft_job_new();
        assert_non_null(job);
        write_subframes("24000/1001", cases[c].timecode);
        job_path(path, "in.####.exr");
        assert_int_equal(weft_job_add_input(job, path, NULL), WEFT_OK);
        job_path(path, "o.y4m");
        assert_int_equal(weft_job_set_output(job, path, NULL), WEFT_OK);
        assert_int_equal(weft_job_set(job, "cadence", "2:3", NULL), WEFT_OK);
        assert_int_equal(weft_job_set(job, "raster", "4x4@29.97i", NULL), WEFT_OK);
        if (cases[c].option)
            assert_int_equal(weft_job_set(job, cases[c].option, cases[c].value, NULL), WEFT_OK);
        weft_job_on_warning(job, count_warnings, &said);
        assert_int_equal(weft_job_run(job, NULL), WEFT_OK);
        assert_int_equal(said, cases[c].said);
        weft_job_free(job);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(labels_of_inputs),
        cmocka_unit_test(chunks_count_from_the_same_label),
        cmocka_unit_test(what_was_taken_is_said),
    };
    return cmocka_run_group_tests(tests, job_make_directory, job_remove_directory);
}
