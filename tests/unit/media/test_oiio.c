/* Pictures that are read through the OpenImageIO module: what was written comes back, and files
 * cut short or changed are errors that name them, never other pictures. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>
#include <libdeflate.h>

#include "convert/base/module.h"
#include "convert/media/oiio/oiio.h"
#include "convert/write/exr_write.h"
#include "convert/write/png_write.h"
#include "tests/unit/support/exr_write.h"
#include "tests/unit/support/jobs.h"

#define WIDTH  37
#define LINES  21
#define MEMORY ((size_t)1 << 30)

static wf_oiio_probe_fn *probe;
static wf_oiio_read_fn *read_planes;
static wf_encode_picture_fn *write_dpx, *write_tiff;

static int find_module(void **state) {
    static const char *const names[] = {"wf_oiio_probe", "wf_oiio_read", "wf_oiio_dpx",
                                        "wf_oiio_tiff"};
    void *symbol[4];
    weft_error err;
    for (int i = 0; i < 4; i++)
        if (wf_module_symbol("oiio", names[i], "a picture", &symbol[i], &err)) {
            print_message("skipped: %s\n", err.text);
            exit(77);
        }
    memcpy(&probe, &symbol[0], sizeof probe);
    memcpy(&read_planes, &symbol[1], sizeof read_planes);
    memcpy(&write_dpx, &symbol[2], sizeof write_dpx);
    memcpy(&write_tiff, &symbol[3], sizeof write_tiff);
    return job_make_directory(state);
}

static const char *at(const char *name) {
    static char path[512];
    job_path(path, name);
    return path;
}

/* ---- Pictures ---- */

typedef struct picture {
    wf_image_info info;
    float *planes; /* [3][lines][width] */
    size_t samples;
    int channels;
} picture;

/* Reads R G B; what fails leaves planes NULL and the message in err. */
static weft_status read_rgb(const char *name, picture *p, weft_error *err) {
    static const int channel[3] = {0, 1, 2};
    char *names = NULL;
    *p = (picture){0};
    weft_status status = probe(at(name), -1, MEMORY, &p->info, &p->channels, &names, err);
    free(names);
    if (status) return status;
    const wf_box *d = &p->info.data;
    p->samples = (size_t)(d->x1 - d->x0) * (size_t)(d->y1 - d->y0);
    if (p->channels < 3) return WEFT_FAILED;
    p->planes = calloc(3 * p->samples, sizeof *p->planes);
    assert_non_null(p->planes);
    status = read_planes(at(name), -1, channel, 3, d, p->planes, err);
    if (!status) return WEFT_OK;
    free(p->planes);
    p->planes = NULL;
    return status;
}

static picture must_read(const char *name) {
    picture p;
    weft_error err = {""};
    if (read_rgb(name, &p, &err)) fail_msg("%s", err.text);
    return p;
}

static weft_status to_file(void *user, const void *data, size_t bytes, weft_error *err) {
    (void)err;
    return fwrite(data, 1, bytes, user) == bytes ? WEFT_OK : WEFT_FAILED;
}

/* Smooth enough to be compressed, busy enough that a lost line shows. */
static unsigned code_at(size_t i, int c, int bits) {
    return (unsigned)(i * 97 + i / 5 * (size_t)(c + 1) * 31 + 1) & ((1u << bits) - 1);
}

static wf_encode_picture_fn *encoder_of(const char *format) {
    return !strcmp(format, "dpx")    ? write_dpx
           : !strcmp(format, "tiff") ? write_tiff
           : !strcmp(format, "png")  ? wf_png_encode
                                     : wf_exr_encode;
}

static void make(const char *name, const char *format, int bits) {
    static uint16_t code[3][WIDTH * LINES];
    static float linear[3][WIDTH * LINES];
    wf_picture_out p = {.channels = 3,
                        .width_px = WIDTH,
                        .lines = LINES,
                        .bits = bits,
                        .pixel_aspect = {1, 1},
                        .frame_rate = {25, 1},
                        .timecode = "10:00:00:00",
                        .color_space = "rec709",
                        .raster = "test"};
    weft_error err = {""};
    for (int c = 0; c < 3; c++) {
        for (size_t i = 0; i < WIDTH * LINES; i++) {
            code[c][i] = (uint16_t)code_at(i, c, bits & 31 ? bits : 16);
            linear[c][i] = (float)code[c][i] / 256;
        }
        p.plane[c] = bits == 32 ? (const void *)linear[c] : code[c];
        p.line_stride[c] = WIDTH;
    }
    FILE *file = fopen(at(name), "wb");
    assert_non_null(file);
    if (encoder_of(format)(&p, to_file, file, &err)) fail_msg("%s", err.text);
    assert_int_equal(fclose(file), 0);
}

static const struct {
    const char *name, *format;
    int bits;
} made[] = {{"8.dpx", "dpx", 8},   {"10.dpx", "dpx", 10}, {"12.dpx", "dpx", 12},
            {"16.dpx", "dpx", 16}, {"8.tif", "tiff", 8},  {"16.tif", "tiff", 16},
            {"8.png", "png", 8},   {"16.png", "png", 16}, {"32.exr", "openexr", 32}};

static void what_is_written_is_read(void **state) {
    (void)state;
    for (size_t k = 0; k < sizeof made / sizeof *made; k++) {
        make(made[k].name, made[k].format, made[k].bits);
        picture p = must_read(made[k].name);
        assert_true(p.samples == WIDTH * LINES && p.channels == 3 && !p.info.has_alpha &&
                    p.info.whole);
        for (int c = 0; c < 3; c++)
            for (size_t i = 0; i < p.samples; i++) {
                unsigned code = code_at(i, c, made[k].bits & 31 ? made[k].bits : 16);
                double got = (double)p.planes[(size_t)c * p.samples + i];
                if (made[k].bits == 32)
                    assert_true(got == (double)((float)code / 256));
                else
                    assert_int_equal((int)(got * ((1 << made[k].bits) - 1) + 0.5), code);
            }
        free(p.planes);
    }
}

/* Equal pictures are equal files, whenever they are written: dates in files have seconds. */
static void no_clock_in_files(void **state) {
    (void)state;
    enum { KINDS = sizeof made / sizeof *made };
    uint8_t *first[KINDS];
    size_t size[KINDS];
    for (size_t k = 0; k < KINDS; k++) {
        make(made[k].name, made[k].format, made[k].bits);
        first[k] = job_file(made[k].name, &size[k]);
    }
    usleep(1100000);
    for (size_t k = 0; k < KINDS; k++) {
        make(made[k].name, made[k].format, made[k].bits);
        job_same(made[k].name, first[k], size[k]);
        free(first[k]);
    }
}

/* ---- Damage ---- */

static void put_file(const char *name, const uint8_t *bytes, size_t size) {
    FILE *file = fopen(at(name), "wb");
    assert_true(file && fwrite(bytes, 1, size, file) == size && !fclose(file));
}

/* Cut anywhere, a file is refused or still holds the same picture. */
static void check_cuts(const char *name) {
    size_t size;
    uint8_t *bytes = job_file(name, &size);
    picture whole = must_read(name), cut;
    size_t step = size / 150 + 1;
    for (size_t length = 0;
         length<size; length += length + 40> size || length < 40 ? 1 : step) {
        weft_error err = {""};
        put_file("cut", bytes, length);
        if (!read_rgb("cut", &cut, &err)) {
            if (cut.samples != whole.samples ||
                memcmp(cut.planes, whole.planes, 3 * whole.samples * sizeof(float)))
                fail_msg("%s cut to %zu of %zu bytes is read as another picture", name, length,
                         size);
        } else if (!strstr(err.text, at("cut"))) {
            fail_msg("'%s' does not name the file", err.text);
        }
        free(cut.planes);
    }
    free(whole.planes);
    free(bytes);
}

static void files_cut_short(void **state) {
    (void)state;
    for (size_t k = 0; k < sizeof made / sizeof *made; k++) {
        make(made[k].name, made[k].format, made[k].bits);
        check_cuts(made[k].name);
    }
}

static void files_of_others_cut_short(void **state) {
    (void)state;
    static const char *const arguments[] = {
        "16.tif --compression none -o other.tif",
        "16.tif --compression lzw -o other.tif",
        "8.tif --compression packbits -o other.tif",
        "8.tif --tile 16 16 --compression zip -o other.tif",
        "8.tif --planarconfig separate -o other.tif",
        "8.tif --compression jpeg -o other.tif",
        "8.png -o other.jpg",
        "8.png --attrib jpeg:progressive 1 -o other.jpg",
        "32.exr --compression dwaa -o other.exr",
        "32.exr --compression dwab -d half -o other.exr",
        "32.exr --tile 16 16 --compression dwaa -o other.exr"};
    make("8.tif", "tiff", 8), make("16.tif", "tiff", 16);
    make("8.png", "png", 8), make("32.exr", "openexr", 32);
    for (size_t i = 0; i < sizeof arguments / sizeof *arguments; i++) {
        job_oiiotool(arguments[i]);
        check_cuts(strstr(arguments[i], "other"));
    }
}

/* PNG has sums: no bit of a file may change but in what they do not cover (nothing). */
static void changed_bits_of_png(void **state) {
    (void)state;
    size_t size;
    make("8.png", "png", 8);
    uint8_t *bytes = job_file("8.png", &size);
    for (size_t i = 0; i < size; i += 1 + i / 64) {
        weft_error err = {""};
        picture p;
        bytes[i] ^= (uint8_t)(1 << i % 8);
        put_file("changed", bytes, size);
        if (!read_rgb("changed", &p, &err)) fail_msg("byte %zu changed is not seen", i);
        bytes[i] ^= (uint8_t)(1 << i % 8);
    }
    free(bytes);
}

/* Other formats cannot tell; they are not to crash or to take memory the file does not warrant.
 */
static void changed_bits_of_others(void **state) {
    (void)state;
    for (size_t k = 0; k < sizeof made / sizeof *made; k++) {
        size_t size;
        make(made[k].name, made[k].format, made[k].bits);
        uint8_t *bytes = job_file(made[k].name, &size);
        for (size_t i = 0; i < size && i < 2200; i += 1 + i / 24) {
            weft_error err = {""};
            picture p;
            uint8_t before = bytes[i];
            bytes[i] = (uint8_t)(i % 3 ? before ^ 1 << i % 8 : 255 - before);
            put_file("changed", bytes, size);
            if (!read_rgb("changed", &p, &err))
                free(p.planes);
            else if (*err.text)
                assert_non_null(strstr(err.text, at("changed")));
            bytes[i] = before;
        }
        free(bytes);
    }
}

/* ---- Refusals ---- */

static void refused(const char *name, size_t memory, const char *word) {
    wf_image_info info;
    weft_error err = {""};
    char *names = NULL;
    int count;
    assert_int_not_equal(probe(at(name), -1, memory, &info, &count, &names, &err), WEFT_OK);
    assert_null(names);
    if (!strstr(err.text, word) || !strstr(err.text, at(name)))
        fail_msg("'%s' does not say '%s'", err.text, word);
}

static void put_u32(uint8_t *bytes, uint32_t value) {
    for (int i = 0; i < 4; i++) bytes[i] = (uint8_t)(value >> (24 - 8 * i));
}

static void what_cannot_be_read(void **state) {
    (void)state;
    size_t size;
    make("8.dpx", "dpx", 8), make("8.png", "png", 8);
    refused("absent.png", MEMORY, "No such file");
    put_file("text.png", (const uint8_t *)"just some text, no picture", 26);
    refused("text.png", MEMORY, "it is text");
    refused("8.png", 4 * 3 * WIDTH * LINES - 1, "--max-memory");
    uint8_t *dpx = job_file("8.dpx", &size);
    put_u32(dpx + 32, 0x7fffffff); /* user data */
    put_file("user.dpx", dpx, size);
    refused("user.dpx", MEMORY, "user data");
    put_u32(dpx + 32, 0);
    put_u32(dpx + 772, 0x40000000), put_u32(dpx + 776, 0x40000000);
    put_file("huge.dpx", dpx, size);
    refused("huge.dpx", SIZE_MAX, "ends before its picture");
    free(dpx);
}

static void parts_that_are_absent(void **state) {
    (void)state;
    wf_image_info info;
    weft_error err = {""};
    char *names = NULL;
    int count;
    make("8.png", "png", 8);
    assert_int_equal(probe(at("8.png"), 1, MEMORY, &info, &count, &names, &err), WEFT_FAILED);
    assert_non_null(strstr(err.text, "no part 1"));
}

static void pictures_that_lie_on_their_side(void **state) {
    (void)state;
    make("8.tif", "tiff", 8);
    job_oiiotool("8.tif --orientation 6 -o turned.tif");
    refused("turned.tif", MEMORY, "orientation is 6");
}

static void a_file_that_changes(void **state) {
    (void)state;
    static const int channel[3] = {0, 1, 2};
    static float planes[3 * (WIDTH + 1) * LINES];
    weft_error err = {""};
    make("8.png", "png", 8);
    const wf_box other = {0, 0, WIDTH + 1, LINES};
    assert_int_equal(read_planes(at("8.png"), -1, channel, 3, &other, planes, &err),
                     WEFT_FAILED);
    assert_non_null(strstr(err.text, "no longer"));
    const int beyond[1] = {3};
    const wf_box data = {0, 0, WIDTH, LINES};
    assert_int_equal(read_planes(at("8.png"), -1, beyond, 1, &data, planes, &err), WEFT_FAILED);
}

/* ---- Through the source ---- */

static float soft(const void *user, int channel, int x, int y) {
    (void)user;
    return (float)(channel * 100 + x * 3 + y) / 64;
}

/* All rows of a file as the source gives them. */
static float *source_rows(const char *name, wf_image_info *info) {
    const wf_source_options options = {.nan_fix = WF_NAN_NONE, .max_memory_bytes = MEMORY};
    wf_subframe *s;
    wf_reader *reader;
    wf_rows rows;
    weft_error err = {""};
    if (wf_subframe_open(at(name), -1, &options, &s, &err)) fail_msg("%s", err.text);
    *info = *wf_subframe_info(s);
    if (wf_reader_new(&options, &reader, &err)) fail_msg("%s", err.text);
    if (wf_reader_rows(reader, s, info->data.y0, info->data.y1, &rows, &err))
        fail_msg("%s", err.text);
    size_t width = (size_t)(rows.x1 - rows.x0), lines = (size_t)(rows.y1 - rows.y0);
    float *all = malloc(3 * width * lines * sizeof *all);
    assert_true(all && rows.type == WF_FLOAT && rows.channels == 3);
    for (size_t c = 0; c < 3; c++)
        for (size_t y = 0; y < lines; y++)
            memcpy(all + (c * lines + y) * width,
                   (const float *)rows.plane[c] + y * rows.line_stride, width * sizeof *all);
    wf_reader_free(reader);
    wf_subframe_close(s);
    return all;
}

/* A data window that sticks out on two sides, and a file oiiotool has decoded from it. */
static void dwa_is_what_other_readers_see(void **state) {
    (void)state;
    static const char *const kinds[] = {"dwaa", "dwab", "dwaa --tile 32 32"};
    exr_part part = {.display = {0, 0, 90, 300},
                     .data = {-5, 10, 70, 310},
                     .channels = "B G R",
                     .type = EXR_PIXEL_FLOAT,
                     .compression = EXR_COMPRESSION_ZIP,
                     .rate = "48000/1001",
                     .pixel_aspect = 1.5f,
                     .value = soft};
    assert_true(exr_write(at("zip.exr"), &part, 1));
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        char arguments[128];
        wf_image_info dwa_info, plain_info;
        snprintf(arguments, sizeof arguments, "zip.exr --compression %s -o dwa.exr", kinds[i]);
        job_oiiotool(arguments);
        job_oiiotool("dwa.exr --compression none -o plain.exr");
        float *dwa = source_rows("dwa.exr", &dwa_info),
              *plain = source_rows("plain.exr", &plain_info);
        assert_memory_equal(&dwa_info.data, &part.data, sizeof part.data);
        assert_memory_equal(&dwa_info.display, &part.display, sizeof part.display);
        assert_true(wf_ratio_equal(dwa_info.rate, wf_ratio(48000, 1001)) &&
                    dwa_info.pixel_aspect == 1.5);
        assert_memory_equal(dwa, plain, 3 * 75 * 300 * sizeof *dwa);
        for (int x = 0; x < 75; x++) /* lossy, but the same picture */
            assert_true(dwa[x] > soft(NULL, 2, x - 5, 10) - 0.2f &&
                        dwa[x] < soft(NULL, 2, x - 5, 10) + 0.2f);
        free(dwa), free(plain);
    }
}

static void pictures_are_subframes(void **state) {
    (void)state;
    for (size_t k = 0; k < sizeof made / sizeof *made; k++) {
        wf_image_info info;
        make(made[k].name, made[k].format, made[k].bits);
        float *rows = source_rows(made[k].name, &info);
        picture p = must_read(made[k].name);
        assert_memory_equal(rows, p.planes, 3 * p.samples * sizeof *rows);
        free(rows), free(p.planes);
    }
}

static uint8_t *put_chunk(uint8_t *to, const char *name, const uint8_t *data, uint32_t bytes) {
    put_u32(to, bytes);
    memcpy(to + 4, name, 4);
    memcpy(to + 8, data, bytes);
    put_u32(to + 8 + bytes, libdeflate_crc32(0, to + 4, bytes + 4));
    return to + 12 + bytes;
}

/* A PNG of one line: two pixels R G B A, 8 bits. */
static void make_alpha_png(const char *name, const uint8_t rgba[8]) {
    uint8_t file[256] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'}, packed[64],
            line[9] = {0};
    const uint8_t header[13] = {0, 0, 0, 2, 0, 0, 0, 1, 8, 6};
    struct libdeflate_compressor *deflate = libdeflate_alloc_compressor(1);
    assert_non_null(deflate);
    memcpy(line + 1, rgba, 8);
    size_t bytes = libdeflate_zlib_compress(deflate, line, sizeof line, packed, sizeof packed);
    libdeflate_free_compressor(deflate);
    uint8_t *end = put_chunk(file + 8, "IHDR", header, sizeof header);
    end = put_chunk(end, "IDAT", packed, (uint32_t)bytes);
    end = put_chunk(end, "IEND", header, 0);
    put_file(name, file, (size_t)(end - file));
}

/* Alpha stays what it is and changes nothing: samples are as in the file. */
static void alpha_is_not_multiplied(void **state) {
    (void)state;
    static const uint8_t rgba[8] = {200, 100, 50, 128, 10, 250, 0, 0};
    static const int channel[4] = {3, 0, 1, 2};
    float planes[4 * 2];
    wf_image_info info;
    char *names = NULL;
    int count;
    weft_error err = {""};
    make_alpha_png("alpha.png", rgba);
    if (probe(at("alpha.png"), -1, MEMORY, &info, &count, &names, &err))
        fail_msg("%s", err.text);
    assert_true(count == 4 && info.has_alpha);
    assert_memory_equal(names, "R\0G\0B\0A", 8);
    free(names);
    if (read_planes(at("alpha.png"), -1, channel, 4, &info.data, planes, &err))
        fail_msg("%s", err.text);
    for (int c = 0; c < 4; c++)
        for (int x = 0; x < 2; x++)
            assert_int_equal((int)(planes[2 * c + x] * 255 + 0.5f), rgba[4 * x + channel[c]]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_written_is_read),
        cmocka_unit_test(no_clock_in_files),
        cmocka_unit_test(files_cut_short),
        cmocka_unit_test(files_of_others_cut_short),
        cmocka_unit_test(changed_bits_of_png),
        cmocka_unit_test(changed_bits_of_others),
        cmocka_unit_test(what_cannot_be_read),
        cmocka_unit_test(parts_that_are_absent),
        cmocka_unit_test(pictures_that_lie_on_their_side),
        cmocka_unit_test(a_file_that_changes),
        cmocka_unit_test(dwa_is_what_other_readers_see),
        cmocka_unit_test(pictures_are_subframes),
        cmocka_unit_test(alpha_is_not_multiplied),
    };
    return cmocka_run_group_tests(tests, find_module, job_remove_directory);
}
