/* Sample buffers in deep EXR: what is written comes back, and what is damaged is refused. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>

#include "convert/read/deep_read.h"
#include "convert/read/source.h"
#include "convert/write/deep_write.h"

#define WIDTH 24
#define LINES 10
#define MOST  16

static char folder[] = "/tmp/weft-deep-XXXXXX";
static char path[64];

static int make_folder(void **state) {
    (void)state;
    if (!mkdtemp(folder)) return -1;
    snprintf(path, sizeof path, "%s/samples.exr", folder);
    return 0;
}

static int remove_folder(void **state) {
    (void)state;
    unlink(path);
    return rmdir(folder);
}

static wf_raster make_raster(void) {
    wf_raster raster;
    char why[256];
    assert_true(wf_raster_parse("24x10@30i", &raster, why, sizeof why));
    return raster;
}

/* Some pixels have no samples, some many. */
static int count_at(int i, int j) {
    return (7 * i + 5 * j) % MOST;
}

static float value_at(int channel, int i, int j, int k) {
    if (channel == WF_DEEP_X) return (float)i + (float)k / MOST;
    if (channel == WF_DEEP_Y) return (float)j + (float)(MOST - 1 - k) / MOST;
    return (float)(channel + 1) * 0.25f + (float)(i * j) - (float)k * 0.125f;
}

static void fill_line(int j, wf_deep_line *line) {
    int total = 0;
    line->upto = malloc(WIDTH * sizeof *line->upto);
    for (int i = 0; i < WIDTH; i++) line->upto[i] = total += count_at(i, j);
    for (int c = WF_DEEP_B; c <= WF_DEEP_Y; c++) {
        float *v = line->channel[c] = malloc((size_t)(total + 1) * sizeof *v);
        for (int i = 0; i < WIDTH; i++)
            for (int k = 0; k < count_at(i, j); k++) *v++ = value_at(c, i, j, k);
    }
}

static void write_file(void) {
    wf_raster raster = make_raster();
    wf_deep_writer *writer;
    weft_error err;
    assert_int_equal(wf_deep_writer_new(path, &raster, "ACEScg", false, true, &writer, &err),
                     WEFT_OK);
    for (int j = 0; j < LINES; j++) {
        wf_deep_line line = {0};
        wf_deep_packed packed;
        fill_line(j, &line);
        assert_int_equal(wf_deep_pack(WIDTH, &line, &packed, &err), WEFT_OK);
        assert_int_equal(wf_deep_write(writer, j, &packed, &err), WEFT_OK);
        wf_deep_packed_free(&packed);
        free(line.upto);
        for (int c = 0; c < WF_DEEP_CHANNELS; c++) free(line.channel[c]);
    }
    assert_int_equal(wf_deep_commit(writer, &err), WEFT_OK);
}

static void there_and_back(void **state) {
    wf_raster raster = make_raster();
    wf_deep_file *file;
    wf_deep_buffers buffers = {0};
    weft_error err;
    (void)state;
    write_file();
    bool deep = false;
    assert_int_equal(wf_deep_is(path, &deep, &err), WEFT_OK);
    assert_true(deep);
    if (wf_deep_open(path, &raster, &file, &err)) fail_msg("%s", err.text);
    assert_string_equal(wf_deep_raster(file), "24x10@30i");
    assert_string_equal(wf_deep_space(file), "ACEScg");
    for (int j = LINES - 1; j >= 0; j--) {
        if (wf_deep_read(file, &buffers, j, &err)) fail_msg("%s", err.text);
        for (int i = 0, at = 0; i < WIDTH; i++) {
            assert_int_equal(buffers.line.upto[i] - at, count_at(i, j));
            for (int k = 0; k < count_at(i, j); k++, at++)
                for (int c = WF_DEEP_B; c <= WF_DEEP_Y; c++)
                    assert_true(buffers.line.channel[c][at] == value_at(c, i, j, k));
        }
        assert_null(buffers.line.channel[WF_DEEP_WEIGHT]);
    }
    wf_deep_buffers_free(&buffers);
    wf_deep_close(file);
}

static void another_raster(void **state) {
    wf_raster raster = make_raster();
    wf_deep_file *file;
    weft_error err;
    (void)state;
    raster.lines = 12;
    assert_int_equal(wf_deep_open(path, &raster, &file, &err), WEFT_FAILED);
    assert_non_null(strstr(err.text, "24x10"));
}

/* The file says that it has another compression. */
static void relabel(int compression) {
    static const char before[] = "compression\0compression\0\1\0\0"; /* and its 0 */
    uint8_t bytes[4096];
    FILE *f = fopen(path, "r+b");
    assert_non_null(f);
    size_t got = fread(bytes, 1, sizeof bytes, f);
    const uint8_t *found = memmem(bytes, got, before, sizeof before);
    assert_non_null(found);
    assert_int_equal(fseek(f, (long)(found - bytes) + (long)sizeof before, SEEK_SET), 0);
    fputc(compression, f);
    assert_int_equal(fclose(f), 0);
}

static void other_compressions_are_named(void **state) {
    static const struct {
        int number;
        const char *says;
    } rows[] = {{3, "none, RLE or ZIPS"}, /* ZIP, which is of pictures */
                {8, "none, RLE or ZIPS"},
                {10, "HTJ2K256, of OpenEXR 3.4"},
                {11, "HTJ2K32, of OpenEXR 3.4"},
                {12, "Zstd, of OpenEXR 3.5"},
                {13, "number 13"}};
    const wf_source_options options = {.max_memory_bytes = (size_t)64 << 20};
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        wf_subframe *s = NULL;
        weft_error err = {""};
        write_file();
        relabel(rows[i].number);
        assert_int_equal(wf_subframe_open(path, -1, &options, &s, &err), WEFT_FAILED);
        if (!strstr(err.text, rows[i].says)) fail_msg("%d: %s", rows[i].number, err.text);
        assert_null(strstr(err.text, "damaged"));
    }
    write_file();
}

/* Every byte in turn is another one, and the file ends anywhere: it is read, or refused with
 * the file's name, and nothing worse. */
static void damage(void **state) {
    wf_raster raster = make_raster();
    uint8_t bytes[65536];
    size_t refused = 0;
    (void)state;
    FILE *f = fopen(path, "rb");
    size_t size = fread(bytes, 1, sizeof bytes, f);
    fclose(f);
    assert_true(size > 1000 && size < sizeof bytes);
    for (size_t n = 0; n < size; n += 3) {
        bool cut = n % 2;
        uint8_t was = bytes[n];
        bytes[n] ^= (uint8_t)(1u << n % 8 | 0x80);
        f = fopen(path, "wb");
        fwrite(bytes, 1, cut ? n : size, f);
        fclose(f);
        bytes[n] = was;
        wf_deep_file *file = NULL;
        wf_deep_buffers buffers = {0};
        weft_error err = {""};
        weft_status status = wf_deep_open(path, &raster, &file, &err);
        for (int j = 0; !status && j < LINES; j++)
            status = wf_deep_read(file, &buffers, j, &err);
        if (!file) status = WEFT_FAILED;
        if (status) {
            refused++;
            assert_non_null(strstr(err.text, path));
        }
        wf_deep_buffers_free(&buffers);
        wf_deep_close(file);
    }
    assert_true(refused > size / 12);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(there_and_back), cmocka_unit_test(another_raster),
        cmocka_unit_test(other_compressions_are_named), cmocka_unit_test(damage)};
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
