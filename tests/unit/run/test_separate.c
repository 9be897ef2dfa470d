/* Fields in files of their own: woven again they are the frames of the woven run, and each file
 * says which field it is. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>

#include "convert/read/source.h"
#include "tests/unit/support/exr_write.h"
#include "tests/unit/support/jobs.h"

enum { WIDTH = 20, LINES = 14, FRAMES = 3 };

static float noise(const void *user, int channel, int x, int y) {
    const int *k = user;
    uint32_t bits = (uint32_t)(*k * 977 + y * 311 + x * 31 + channel * 7) * 2654435761u;
    return (float)(bits >> 24) / 255;
}

static void write_subframes(void) {
    job_clean();
    for (int k = 0; k < 4 * FRAMES; k++) {
        char path[512], name[64];
        exr_part p = {.display = {0, 0, WIDTH, 2 * LINES},
                      .data = {0, 0, WIDTH, 2 * LINES},
                      .channels = "B G R",
                      .type = EXR_PIXEL_HALF,
                      .compression = EXR_COMPRESSION_ZIP,
                      .rate = "120000/1001",
                      .value = noise,
                      .user = &k};
        snprintf(name, sizeof name, "in.%04d.exr", k);
        job_path(path, name);
        assert_true(exr_write(path, &p, 1));
    }
}

/* A picture as floats, [3][lines][WIDTH]. */
typedef struct picture {
    wf_image_info info;
    int lines;
    float *value;
} picture;

static picture read_picture(const char *name) {
    const wf_source_options options = {.nan_fix = WF_NAN_ERROR, .max_memory_bytes = 1 << 28};
    char path[512];
    weft_error err = {""};
    wf_subframe *subframe;
    wf_reader *reader;
    wf_rows rows;
    job_path(path, name);
    if (wf_subframe_open(path, -1, &options, &subframe, &err)) fail_msg("%s", err.text);
    picture p = {.info = *wf_subframe_info(subframe)};
    p.lines = p.info.data.y1;
    assert_int_equal(p.info.data.x1, WIDTH);
    assert_int_equal(wf_reader_new(&options, &reader, &err), WEFT_OK);
    assert_int_equal(wf_reader_rows(reader, subframe, 0, p.lines, &rows, &err), WEFT_OK);
    assert_int_equal(rows.type, WF_FLOAT);
    p.value = malloc(3 * WIDTH * (size_t)p.lines * sizeof *p.value);
    assert_non_null(p.value);
    for (int c = 0; c < 3; c++)
        for (int y = 0; y < p.lines; y++)
            memcpy(p.value + (c * p.lines + y) * WIDTH,
                   (const float *)rows.plane[c] + (size_t)y * rows.line_stride,
                   WIDTH * sizeof *p.value);
    wf_reader_free(reader);
    wf_subframe_close(subframe);
    return p;
}

static void check_lines(const picture *frame, const picture *field, int parity) {
    assert_int_equal(field->lines, LINES / 2);
    assert_int_equal(frame->lines, LINES);
    for (int c = 0; c < 3; c++)
        for (int y = 0; y < field->lines; y++)
            assert_memory_equal(field->value + (c * field->lines + y) * WIDTH,
                                frame->value + (c * LINES + 2 * y + parity) * WIDTH,
                                WIDTH * sizeof(float));
}

static void check_field(const char *ending, int field, bool top_first) {
    char name[64];
    snprintf(name, sizeof name, "woven.%04d.%s", field / 2, ending);
    picture frame = read_picture(name);
    snprintf(name, sizeof name, "field.%04d.%s", field, ending);
    picture lone = read_picture(name);
    check_lines(&frame, &lone, (field % 2 == 0) == top_first ? 0 : 1);
    double ratio = lone.info.pixel_aspect / frame.info.pixel_aspect;
    if (fabs(ratio - 0.5) > 1e-6)
        fail_msg("%s: pixel aspect %.9g of %.9g", name, lone.info.pixel_aspect,
                 frame.info.pixel_aspect);
    assert_string_equal(lone.info.timecode, frame.info.timecode);
    if (!strcmp(ending, "exr") || !strcmp(ending, "dpx"))
        assert_string_equal(lone.info.timecode, field < 2   ? "01:02:03;04"
                                                : field < 4 ? "01:02:03;05"
                                                            : "01:02:03;06");
    free(frame.value);
    free(lone.value);
}

#define RASTER "raster=20x14@29.97i,par=10:11 timecode=01:02:03;04 "

static void fields_weave_to_the_frames(void **state) {
    (void)state;
    const struct {
        const char *ending, *options;
        bool top_first;
    } cases[] = {
        {"exr", RASTER, true},
        {"dpx", RASTER, true},
        {"dpx", "raster=20x14@29.97i,bff timecode=01:02:03;04 bits=16 overwrite", false},
        {"dpx", "raster=20x14@29.97psf timecode=01:02:03;04 bits=8 overwrite", true},
        {"tif", RASTER, true},
        {"png", RASTER "bits=8", true},
    };
    write_subframes();
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        char options[256], output[64];
        snprintf(output, sizeof output, "woven.####.%s", cases[c].ending);
        job_done(cases[c].options, output, NULL);
        snprintf(options, sizeof options, "%s fields=separate", cases[c].options);
        snprintf(output, sizeof output, "field.####.%s", cases[c].ending);
        job_done(options, output, NULL);
        for (int n = 0; n < 2 * FRAMES; n++)
            check_field(cases[c].ending, n, cases[c].top_first);
    }
}

/* ---- DPX, by its bytes ---- */

static uint32_t big_word(const uint8_t *at) {
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

static float big_float(const uint8_t *at) {
    uint32_t bits = big_word(at);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* ST 268-1: in the television header at 1920 time code and user bits, at 1928 interlace (1:
 * 2:1) and field number, at 1940 the rate. The second field has the field mark, bit 15. */
static void check_dpx(const char *name, uint32_t code, int interlace, int field, double rate) {
    bool field_only = rate > 50;
    size_t size;
    uint8_t *bytes = job_file(name, &size);
    assert_true(size > 2048);
    assert_memory_equal(bytes, "SDPX", 4);
    assert_int_equal(big_word(bytes + 1920), code);
    assert_int_equal(big_word(bytes + 1924), 0);
    assert_int_equal(bytes[1928], interlace);
    assert_int_equal(bytes[1929], field);
    assert_int_equal(bytes[1628 + 3], field_only ? 5 : 10);
    assert_int_equal(bytes[1632 + 3], 11);
    assert_true(fabs((double)big_float(bytes + 1940) - rate) < 1e-5);
    free(bytes);
}

static void dpx_headers(void **state) {
    (void)state;
    write_subframes();
    job_done("raster=20x14@29.97i,bff,par=10:11 timecode=01:02:03;04", "w.####.dpx", NULL);
    check_dpx("w.0000.dpx", 0x01020344, 1, 2, 30000.0 / 1001);
    check_dpx("w.0002.dpx", 0x01020346, 1, 2, 30000.0 / 1001);
    job_done("raster=20x14@29.97i,bff,par=10:11 timecode=01:02:03;04 fields=separate",
             "f.####.dpx", NULL);
    check_dpx("f.0000.dpx", 0x01020344, 1, 1, 60000.0 / 1001);
    check_dpx("f.0005.dpx", 0x01028346, 1, 2, 60000.0 / 1001);
    job_done("raster=20x14@25psf,par=10:11 timecode=23:59:59:24", "p.####.dpx", NULL);
    check_dpx("p.0000.dpx", 0x23595924, 0, 1, 25);
    check_dpx("p.0001.dpx", 0, 0, 1, 25);
}

/* ---- Running ---- */

static void chunks_and_resuming(void **state) {
    (void)state;
    char path[512];
    size_t size;
    write_subframes();
    job_done(RASTER "fields=separate", "a.####.dpx", NULL);
    job_done(RASTER "fields=separate chunk=1/2", "b.####.dpx", NULL);
    job_path(path, "b.0002.dpx");
    assert_int_not_equal(access(path, F_OK), 0);
    job_done(RASTER "fields=separate chunk=2/2", "b.####.dpx", NULL);
    job_path(path, "b.0003.dpx");
    assert_int_equal(unlink(path), 0);
    job_refused(RASTER "fields=separate", "b.####.dpx", WEFT_FAILED, "exists");
    job_done(RASTER "fields=separate resume", "b.####.dpx", NULL);
    for (int n = 0; n < 2 * FRAMES; n++) {
        char name[64];
        snprintf(name, sizeof name, "a.%04d.dpx", n);
        uint8_t *bytes = job_file(name, &size);
        *name = 'b';
        job_same(name, bytes, size);
        free(bytes);
    }
    job_path(path, "b.0006.dpx");
    assert_int_not_equal(access(path, F_OK), 0);
}

static void what_is_refused(void **state) {
    (void)state;
    write_subframes();
    job_refused(RASTER "fields=separate", "o.y4m", WEFT_USAGE, "image sequences");
    job_refused("raster=20x14@30p fields=separate", "o.####.dpx", WEFT_USAGE, "progressive");
    job_refused(RASTER "fields=separate", "o.dpx", WEFT_USAGE, "fields");
    job_refused(RASTER "fields=apart", "o.####.dpx", WEFT_USAGE, "woven|separate");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fields_weave_to_the_frames),
        cmocka_unit_test(dpx_headers),
        cmocka_unit_test(chunks_and_resuming),
        cmocka_unit_test(what_is_refused),
    };
    return cmocka_run_group_tests(tests, job_make_directory, job_remove_directory);
}
