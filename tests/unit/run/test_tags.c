/* What picture files say of their colors, by their own bytes. */
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

static float ramp(const void *user, int channel, int x, int y) {
    (void)user;
    return (float)(x + 8 * y + channel) / 64;
}

static int setup(void **state) {
    if (job_make_directory(state)) return 1;
    exr_part p = {.display = {0, 0, 8, 8},
                  .data = {0, 0, 8, 8},
                  .channels = "B G R",
                  .type = EXR_PIXEL_HALF,
                  .rate = "25/1",
                  .value = ramp};
    char path[512];
    job_path(path, "in.0000.exr");
    return !exr_write(path, &p, 1);
}

/* Spaces with their code points of ITU-T H.273, the code of ST 268-1 and two primaries. */
static const struct {
    const char *option;
    uint8_t primaries, transfer, dpx;
    float red_x, green_y;
} spaces[] = {
    {"raster=8x8@25i,709", 1, 1, 6, .64f, .6f},
    {"raster=8x8@25i,601-525", 6, 1, 8, .63f, .595f},
    {"raster=8x8@25i,601-625", 5, 1, 7, .64f, .6f},
    {"raster=8x8@25psf,2020", 9, 14, 0, .708f, .797f},
    {"raster=8x8@25p,2020 to=rec2100-pq", 9, 16, 0, .708f, .797f},
    {"raster=8x8@25i,2020 to=rec2100-hlg", 9, 18, 0, .708f, .797f},
    {"raster=8x8@25i,709 to=rec2100-hlg", 9, 18, 0, .708f, .797f},
};

#define SPACES (sizeof spaces / sizeof *spaces)

static uint8_t *made(size_t space, const char *more, const char *name, size_t *size) {
    char options[256];
    snprintf(options, sizeof options, "overwrite %s %s", spaces[space].option, more);
    job_done(options, name, NULL);
    return job_file(name, size);
}

/* cICP stands right behind IHDR: primaries, transfer, matrix 0, full range. */
static void png_has_code_points(void **state) {
    (void)state;
    for (size_t n = 0; n < SPACES; n++)
        for (uint8_t full = 0; full < 2; full++) {
            size_t size;
            uint8_t *png = made(n, full ? "" : "range=narrow bits=8", "o.png", &size);
            const uint8_t wanted[] = {
                0, 0,   0, 4, 'c', 'I', 'C', 'P', spaces[n].primaries, spaces[n].transfer,
                0, full};
            assert_true(size > 64);
            assert_memory_equal(png + 33, wanted, sizeof wanted);
            if (n == 4 && full) /* by zlib's crc32 of these bytes */
                assert_memory_equal(png + 45, "\x4d\x23\x23\xfe", 4);
            free(png);
        }
}

/* Rec. 2020 and 2100 have no codes in ST 268-1 and are user-defined; the project's name tells.
 */
static void dpx_has_what_there_is(void **state) {
    (void)state;
    for (size_t n = 0; n < SPACES; n++) {
        size_t size;
        uint8_t *dpx = made(n, "", "o.dpx", &size);
        const char *to = strstr(spaces[n].option, "to=");
        assert_true(size > 2048);
        assert_int_equal(dpx[801], spaces[n].dpx);
        assert_int_equal(dpx[802], spaces[n].dpx);
        if (to) assert_string_equal((const char *)dpx + 260, to + 3);
        free(dpx);
    }
}

static float little_float(const uint8_t *at) {
    uint32_t bits =
        at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static void exr_has_primaries(void **state) {
    (void)state;
    for (size_t n = 0; n < SPACES; n++) {
        size_t size;
        const char *to = strstr(spaces[n].option, "to=");
        if (!to) continue; /* linear, in the input's space */
        uint8_t *exr = made(n, "", "o.exr", &size);
        const uint8_t *name = memmem(exr, size, "chromaticities\0chromaticities", 30);
        assert_non_null(name);
        assert_true(little_float(name + 34) == spaces[n].red_x);
        assert_true(little_float(name + 34 + 12) == spaces[n].green_y);
        assert_non_null(memmem(exr, size, to + 3, strlen(to + 3)));
        free(exr);
    }
    size_t size;
    job_done("overwrite from=ACEScg raster=8x8@25i", "o.exr", NULL);
    uint8_t *exr = job_file("o.exr", &size);
    const uint8_t *name = memmem(exr, size, "chromaticities\0chromaticities", 30);
    assert_non_null(name);
    assert_true(little_float(name + 34) == .713f);
    free(exr);
}

static void tiff_says_it_in_words(void **state) {
    (void)state;
    size_t size;
    uint8_t *tiff = made(5, "", "o.tif", &size);
    assert_non_null(memmem(tiff, size, "rec2100-hlg", 11));
    free(tiff);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(png_has_code_points),
        cmocka_unit_test(dpx_has_what_there_is),
        cmocka_unit_test(exr_has_primaries),
        cmocka_unit_test(tiff_says_it_in_words),
    };
    return cmocka_run_group_tests(tests, setup, job_remove_directory);
}
