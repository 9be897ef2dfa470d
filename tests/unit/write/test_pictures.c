/* Pictures as files, EXR and PNG: read back by OpenEXR's core and by a reader of PNG written
 * here from its standard; what they say of themselves; writing that fails. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>
#include <libdeflate.h>
#include <openexr.h>

#include "convert/write/exr_write.h"
#include "convert/write/png_write.h"
#include "tests/unit/support/dice.h"
#include "tests/unit/support/jobs.h"

#define PAD 3 /* samples between the end of a line and the next one */

/* ---- Pictures ---- */

typedef struct made {
    wf_picture_out picture;
    void *plane[4];
} made;

/* Smooth, flat, busy and noisy regions, so that each filter is the best somewhere. */
static unsigned code_at(int x, int y, int c, unsigned noise) {
    switch (y / 8 % 6) {
    case 0:
        return 0;
    case 1:
        return (unsigned)(x * 257 + 11 * c);
    case 2:
        return (unsigned)x * (unsigned)x * 977 + (unsigned)c * 31;
    case 3:
        return (unsigned)((x * 400 + y * 300 + 5 * c) + (int)(noise % 64));
    case 4:
        return (unsigned)(x * 900 + y * 700);
    default:
        return noise;
    }
}

static made make(int width, int lines, int channels, int bits) {
    made m = {.picture = {.channels = channels,
                          .straight = bits < 32,
                          .width_px = width,
                          .lines = lines,
                          .bits = bits,
                          .pixel_aspect = {10, 11},
                          .frame_rate = {30000, 1001},
                          .interlaced = true,
                          .timecode = "01:02:03;04",
                          .color_space = bits < 32 ? "rec601-525" : "ACEScg",
                          .raster = "525i"}};
    dice_state = (unsigned)(width * 31 + lines);
    size_t stride = (size_t)width + PAD;
    for (int c = 0; c < channels; c++) {
        m.plane[c] = malloc(stride * (size_t)lines * sizeof(float));
        assert_non_null(m.plane[c]);
        for (int y = 0; y < lines; y++)
            for (int x = 0; x < (int)stride; x++) {
                unsigned code = code_at(x, y, c, (unsigned)dice(1 << 16));
                size_t at = (size_t)y * stride + (size_t)x;
                if (bits == 32)
                    ((float *)m.plane[c])[at] = (float)(int)code / 4096;
                else
                    ((uint16_t *)m.plane[c])[at] = (uint16_t)(code & ((1u << bits) - 1));
            }
        m.picture.plane[c] = m.plane[c];
        m.picture.line_stride[c] = stride;
    }
    return m;
}

static void free_made(made *m) {
    for (int c = 0; c < 4; c++) free(m->plane[c]);
}

/* ---- Where files go ---- */

typedef struct bytes {
    uint8_t *data;
    size_t used;
    int calls, fails_at; /* -1: never */
} bytes;

static weft_status take(void *user, const void *data, size_t count, weft_error *err) {
    bytes *b = user;
    if (b->calls++ == b->fails_at) {
        snprintf(err->text, sizeof err->text, "the disk is on fire");
        return WEFT_FAILED;
    }
    b->data = realloc(b->data, b->used + count + 1);
    assert_non_null(b->data);
    memcpy(b->data + b->used, data, count);
    b->used += count;
    return WEFT_OK;
}

static bytes encoded(wf_encode_picture_fn *encode, const made *m) {
    bytes b = {.fails_at = -1};
    weft_error err = {""};
    if (encode(&m->picture, take, &b, &err)) fail_msg("%s", err.text);
    assert_true(b.used > 0);
    return b;
}

/* A failure of the file's is handed on as it is, and nothing follows it. */
static void failing_writes(wf_encode_picture_fn *encode, int bits) {
    made m = make(21, 19, 3, bits);
    bytes whole = encoded(encode, &m);
    for (int n = 0; n < whole.calls; n++) {
        bytes b = {.fails_at = n};
        weft_error err = {""};
        assert_int_equal(encode(&m.picture, take, &b, &err), WEFT_FAILED);
        assert_string_equal(err.text, "the disk is on fire");
        assert_int_equal(b.calls, n + 1);
        free(b.data);
    }
    free(whole.data);
    free_made(&m);
}

static void writing_fails(void **state) {
    (void)state;
    failing_writes(wf_exr_encode, 32);
    failing_writes(wf_png_encode, 8);
    failing_writes(wf_png_encode, 16);
}

/* ---- EXR ---- */

static void put_file(const char *path, const bytes *b) {
    FILE *file = fopen(path, "wb");
    assert_true(file && fwrite(b->data, 1, b->used, file) == b->used && !fclose(file));
}

static void hush(exr_const_context_t exr, exr_result_t code, const char *says) {
    (void)exr, (void)code, (void)says;
}

static exr_context_t open_exr(const bytes *b) {
    char path[512];
    exr_context_t exr;
    exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
    how.error_handler_fn = hush;
    job_path(path, "made.exr");
    put_file(path, b);
    assert_int_equal(exr_start_read(&exr, path, &how), EXR_ERR_SUCCESS);
    return exr;
}

static int plane_of(const char *name) {
    return *name == 'R' ? 0 : *name == 'G' ? 1 : *name == 'B' ? 2 : 3;
}

/* Every chunk as the library decodes it. */
static void check_samples(exr_context_t exr, const made *m) {
    const wf_picture_out *p = &m->picture;
    static float got[4][16 * 1024];
    for (int y = 0; y < p->lines; y += 16) {
        exr_chunk_info_t chunk;
        exr_decode_pipeline_t decode = {0};
        assert_int_equal(exr_read_scanline_chunk_info(exr, 0, y, &chunk), 0);
        assert_int_equal(chunk.compression, EXR_COMPRESSION_ZIP);
        assert_int_equal(exr_decoding_initialize(exr, 0, &chunk, &decode), 0);
        assert_int_equal(decode.channel_count, p->channels);
        for (int c = 0; c < decode.channel_count; c++) {
            exr_coding_channel_info_t *to = &decode.channels[c];
            assert_int_equal(to->data_type, EXR_PIXEL_FLOAT);
            to->decode_to_ptr = (uint8_t *)got[plane_of(to->channel_name)];
            to->user_pixel_stride = sizeof(float);
            to->user_line_stride = p->width_px * (int32_t)sizeof(float);
            to->user_bytes_per_element = sizeof(float);
            to->user_data_type = EXR_PIXEL_FLOAT;
        }
        assert_int_equal(exr_decoding_choose_default_routines(exr, 0, &decode), 0);
        assert_int_equal(exr_decoding_run(exr, 0, &decode), 0);
        exr_decoding_destroy(exr, &decode);
        for (int c = 0; c < p->channels; c++)
            for (int line = 0; line < chunk.height; line++)
                assert_memory_equal(got[c] + line * p->width_px,
                                    (const float *)m->plane[c] +
                                        (size_t)(y + line) * p->line_stride[c],
                                    (size_t)p->width_px * sizeof(float));
    }
}

static void exr_holds_the_samples(void **state) {
    (void)state;
    static const int sizes[][2] = {{1, 1}, {53, 14}, {7, 16}, {1000, 37}, {128, 96}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        for (int channels = 3; channels <= 4; channels++) {
            made m = make(sizes[i][0], sizes[i][1], channels, 32);
            bytes b = encoded(wf_exr_encode, &m);
            exr_context_t exr = open_exr(&b);
            check_samples(exr, &m);
            exr_finish(&exr);
            free(b.data);
            free_made(&m);
        }
}

/* The attributes by name, as words; "type" is the library's own. */
static const char *text_of(exr_context_t exr, const char *name, char text[128]) {
    const exr_attribute_t *a;
    if (exr_get_attribute_by_name(exr, 0, name, &a)) return "absent";
    const exr_attr_chromaticities_t *xy = a->chromaticities;
    switch (a->type) {
    case EXR_ATTR_STRING:
        snprintf(text, 128, "\"%s\"", a->string->str);
        break;
    case EXR_ATTR_INT:
        snprintf(text, 128, "%d", a->i);
        break;
    case EXR_ATTR_FLOAT:
        snprintf(text, 128, "%.6g", (double)a->f);
        break;
    case EXR_ATTR_RATIONAL:
        snprintf(text, 128, "%d/%u", a->rational->num, a->rational->denom);
        break;
    case EXR_ATTR_TIMECODE:
        snprintf(text, 128, "%08x %u", a->timecode->time_and_flags, a->timecode->user_data);
        break;
    case EXR_ATTR_BOX2I:
        snprintf(text, 128, "%d %d %d %d", a->box2i->min.x, a->box2i->min.y, a->box2i->max.x,
                 a->box2i->max.y);
        break;
    case EXR_ATTR_CHROMATICITIES:
        snprintf(text, 128, "%.5g %.5g %.5g %.5g %.5g %.5g %.5g %.5g", (double)xy->red_x,
                 (double)xy->red_y, (double)xy->green_x, (double)xy->green_y,
                 (double)xy->blue_x, (double)xy->blue_y, (double)xy->white_x,
                 (double)xy->white_y);
        break;
    default:
        snprintf(text, 128, "of type %d", (int)a->type);
    }
    return text;
}

static void says(const made *m, const char *name, const char *expected) {
    char text[128];
    bytes b = encoded(wf_exr_encode, m);
    exr_context_t exr = open_exr(&b);
    if (strcmp(text_of(exr, name, text), expected))
        fail_msg("%s is %s, not %s", name, text_of(exr, name, text), expected);
    exr_finish(&exr);
    free(b.data);
}

static void exr_says_what_it_is(void **state) {
    (void)state;
    made m = make(9, 6, 3, 32);
    wf_picture_out *p = &m.picture;
    says(&m, "Software", "\"weft " WEFT_VERSION "\"");
    says(&m, "capDate", "\"\"");
    says(&m, "Orientation", "1");
    says(&m, "comments", "\"525i, bottom first\"");
    says(&m, "framesPerSecond", "30000/1001");
    says(&m, "pixelAspectRatio", "0.909091");
    says(&m, "screenWindowWidth", "1");
    says(&m, "dataWindow", "0 0 8 5");
    says(&m, "displayWindow", "0 0 8 5");
    says(&m, "timeCode", "01020344 0");
    says(&m, "chromaticities", "0.713 0.293 0.165 0.83 0.128 0.044 0.32168 0.33767");
    says(&m, "weft:raster", "\"525i\"");
    says(&m, "weft:colorSpace", "\"ACEScg\"");
    says(&m, "weft:field", "absent");
    says(&m, "weft:subframeRate", "absent");
    says(&m, "weft:time", "absent");
    p->field = 2, p->top_lines = true, p->frame_rate = wf_ratio(60000, 1001);
    p->subframe_rate = wf_ratio(400, 1), p->time_s = wf_ratio(0, 1);
    p->color_space = p->timecode = "";
    says(&m, "comments", "\"525i, top field 2\"");
    says(&m, "weft:field", "2");
    says(&m, "weft:subframeRate", "400/1");
    says(&m, "weft:time", "0/1");
    says(&m, "weft:colorSpace", "absent");
    says(&m, "chromaticities", "absent");
    says(&m, "timeCode", "absent");
    p->raster = "1000000x1000000@119.88p,par=1234567:7654321";
    says(&m, "comments", "\"1000000x1000000@11, top field 2\"");
    p->chromaticities[0] = .5, p->chromaticities[7] = .25;
    says(&m, "chromaticities", "0.5 0 0 0 0 0 0 0.25");
    p->time_s = wf_ratio(1, (int64_t)1 << 40);
    says(&m, "weft:time", "absent");
    free_made(&m);
}

/* ---- PNG ---- */

static uint32_t number(const uint8_t *b) {
    return (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3];
}

/* A file's chunks in words, "IHDR cICP .. IEND", with their sums held to what they cover; the
 * packed picture is put together. */
static char *read_chunks(const bytes *b, uint8_t *packed, size_t *packed_bytes, char *words) {
    *packed_bytes = 0;
    *words = '\0';
    assert_memory_equal(b->data, "\x89PNG\r\n\x1a\n", 8);
    for (size_t at = 8; at < b->used;) {
        const uint8_t *chunk = b->data + at;
        size_t size = number(chunk);
        assert_true(at + 12 + size <= b->used);
        assert_int_equal(number(chunk + 8 + size), libdeflate_crc32(0, chunk + 4, size + 4));
        sprintf(words + strlen(words), "%.4s ", (const char *)chunk + 4);
        if (!memcmp(chunk + 4, "IDAT", 4)) {
            memcpy(packed + *packed_bytes, chunk + 8, size);
            *packed_bytes += size;
        }
        at += 12 + size;
    }
    return words;
}

/* Takes the filter off a line whose first byte names it, in place. */
static void unfilter(uint8_t *line, const uint8_t *above, size_t count, size_t step) {
    for (size_t x = 1; x <= count; x++) {
        int a = x > step ? line[x - step] : 0, b = above ? above[x] : 0;
        int c = x > step && above ? above[x - step] : 0, p = a + b - c;
        int near = abs(p - a) <= abs(p - b) && abs(p - a) <= abs(p - c) ? a
                   : abs(p - b) <= abs(p - c)                           ? b
                                                                        : c;
        const int guess[5] = {0, a, b, (a + b) / 2, near};
        line[x] = (uint8_t)(line[x] + guess[line[0]]);
    }
}

static void check_codes(const made *m, uint8_t *all, unsigned *filters_seen) {
    const wf_picture_out *p = &m->picture;
    size_t sample = (size_t)p->bits / 8, step = sample * (size_t)p->channels;
    size_t count = step * (size_t)p->width_px;
    for (int y = 0; y < p->lines; y++) {
        uint8_t *line = all + (size_t)y * (1 + count);
        assert_true(line[0] < 5);
        *filters_seen |= 1u << line[0];
        unfilter(line, y ? line - 1 - count : NULL, count, step);
        for (size_t i = 0; i < (size_t)p->width_px * (size_t)p->channels; i++) {
            size_t c = i % (size_t)p->channels, x = i / (size_t)p->channels;
            unsigned code = line[1 + sample * i];
            if (sample == 2) code = code << 8 | line[2 + sample * i];
            assert_int_equal(
                code, ((const uint16_t *)m->plane[c])[(size_t)y * p->line_stride[c] + x]);
        }
    }
}

static void check_png(const made *m, unsigned *filters_seen) {
    const wf_picture_out *p = &m->picture;
    bytes b = encoded(wf_png_encode, m);
    size_t row = 1 + (size_t)p->width_px * (size_t)(p->channels * p->bits / 8), packed_bytes;
    uint8_t *packed = malloc(b.used), *all = malloc(row * (size_t)p->lines);
    char words[512];
    struct libdeflate_decompressor *how = libdeflate_alloc_decompressor();
    assert_true(packed && all && how);
    assert_non_null(strstr(read_chunks(&b, packed, &packed_bytes, words), "IDAT IEND "));
    assert_int_equal(libdeflate_zlib_decompress(how, packed, packed_bytes, all,
                                                row * (size_t)p->lines, NULL),
                     LIBDEFLATE_SUCCESS);
    assert_true(number(b.data + 16) == (unsigned)p->width_px &&
                number(b.data + 20) == (unsigned)p->lines && b.data[24] == p->bits &&
                b.data[25] == (p->channels == 4 ? 6 : 2) && !b.data[26] && !b.data[27] &&
                !b.data[28]);
    check_codes(m, all, filters_seen);
    libdeflate_free_decompressor(how);
    free(packed), free(all), free(b.data);
}

static void png_holds_the_codes(void **state) {
    (void)state;
    static const int sizes[][2] = {{1, 1}, {53, 14}, {2, 48}, {900, 48}};
    unsigned seen = 0;
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        for (int channels = 3; channels <= 4; channels++)
            for (int bits = 8; bits <= 16; bits += 8) {
                made m = make(sizes[i][0], sizes[i][1], channels, bits);
                check_png(&m, &seen);
                free_made(&m);
            }
    assert_int_equal(seen, 31); /* every filter was tried */
}

/* Pictures larger than one chunk of the file. */
static void png_of_many_chunks(void **state) {
    (void)state;
    char words[512];
    size_t packed_bytes;
    unsigned seen = 0;
    made m = make(2000, 300, 4, 16);
    for (int c = 0; c < 4; c++)
        for (size_t i = 0; i < 300 * (size_t)(2000 + PAD); i++)
            ((uint16_t *)m.plane[c])[i] = (uint16_t)dice(1 << 16);
    bytes b = encoded(wf_png_encode, &m);
    uint8_t *packed = malloc(b.used);
    assert_non_null(packed);
    assert_non_null(strstr(read_chunks(&b, packed, &packed_bytes, words),
                           "IDAT IDAT IDAT IDAT IDAT IEND "));
    check_png(&m, &seen);
    free(packed), free(b.data), free_made(&m);
}

/* Whether the file has these bytes, as a whole chunk. */
static bool has(const bytes *b, const char *chunk, size_t size) {
    for (size_t at = 8; at + 12 <= b->used; at += 12 + number(b->data + at))
        if (number(b->data + at) + 4 == size && !memcmp(b->data + at + 4, chunk, size))
            return true;
    return false;
}

#define HAS(b, chunk) has(b, chunk, sizeof chunk - 1)

static void png_says_what_it_is(void **state) {
    (void)state;
    made m = make(9, 6, 3, 16);
    m.picture.primaries = 6, m.picture.transfer = 1;
    bytes b = encoded(wf_png_encode, &m);
    assert_true(HAS(&b, "cICP\6\1\0\0"));
    assert_true(HAS(&b, "oFFs\0\0\0\0\0\0\0\0\0"));
    assert_true(HAS(&b, "pHYs\0\0\x19\xc8\0\0\x17\x70\0")); /* 6600, 6000 */
    assert_true(HAS(&b, "tEXtSoftware\0weft " WEFT_VERSION));
    assert_true(HAS(&b, "tEXtDescription\0"
                        "525i, bottom first"));
    assert_true(HAS(&b, "tEXtweft:raster\0"
                        "525i"));
    assert_true(HAS(&b, "tEXtweft:colorSpace\0rec601-525"));
    assert_true(HAS(&b, "tEXtweft:timecode\0"
                        "01:02:03;04"));
    free(b.data);
    m.picture.transfer = 0, m.picture.field = 1, m.picture.timecode = "";
    char words[512];
    size_t packed_bytes;
    uint8_t packed[1024];
    b = encoded(wf_png_encode, &m);
    assert_true(HAS(&b, "tEXtweft:field\0"
                        "1"));
    assert_string_equal(read_chunks(&b, packed, &packed_bytes, words),
                        "IHDR oFFs pHYs tEXt tEXt tEXt tEXt tEXt IDAT IEND ");
    free(b.data), free_made(&m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(writing_fails),       cmocka_unit_test(exr_holds_the_samples),
        cmocka_unit_test(exr_says_what_it_is), cmocka_unit_test(png_holds_the_codes),
        cmocka_unit_test(png_of_many_chunks),  cmocka_unit_test(png_says_what_it_is),
    };
    return cmocka_run_group_tests(tests, job_make_directory, job_remove_directory);
}
