/* Chunks of EXR decoded by weft itself, held to OpenEXRCore's reading of the same bytes: every
 * compression, type of sample, shape of chunk and kind of content. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "convert/read/exr/decode.h"
#include "tests/unit/support/exr_write.h"
#include "tests/unit/support/sizes.h"

/* ---- Contents ---- */

static uint32_t scramble(uint32_t x) {
    x = (x ^ x >> 16) * 0x7feb352du;
    x = (x ^ x >> 15) * 0x846ca68bu;
    return x ^ x >> 16;
}

static uint32_t draw_at(int channel, int x, int y) {
    return scramble((uint32_t)x * 3 + scramble((uint32_t)y + scramble((uint32_t)channel)));
}

static float flat(const void *user, int channel, int x, int y) {
    (void)user, (void)x, (void)y;
    return (float)channel;
}

static float smooth(const void *user, int channel, int x, int y) {
    (void)user;
    return sinf((float)(x * (channel + 1)) / 40) + (float)y / 50;
}

static float grainy(const void *user, int channel, int x, int y) {
    return smooth(user, channel, x, y) + (float)(draw_at(channel, x, y) % 256) / 1024;
}

/* Any 32 bits: NaN, Inf, denormals, and numbers that no half holds. */
static float anything(const void *user, int channel, int x, int y) {
    (void)user;
    uint32_t bits = draw_at(channel, x, y);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* Numbers that halves hold, most words of 16 bits among them. */
static float wide(const void *user, int channel, int x, int y) {
    (void)user;
    uint32_t r = draw_at(channel, x, y);
    return ldexpf((float)(r % 2048), (int)(r >> 11) % 30 - 20) * (r >> 31 ? -1.0f : 1.0f);
}

/* Long runs of one value, with something else now and then. */
static float runs(const void *user, int channel, int x, int y) {
    uint32_t r = draw_at(channel, x, y);
    return r % 300 ? 0.5f : anything(user, channel, x, y);
}

static float (*const contents[])(const void *, int, int, int) = {flat, smooth,   grainy,
                                                                 wide, anything, runs};

/* ---- Chunks by both ---- */

typedef struct both {
    exr_context_t exr;
    int part;
    wf_exr_decoder own;
    exr_decode_pipeline_t core;
    const uint8_t *expected; /* what the library unpacks to, while it has it */
    uint64_t bytes;
    int chunks, unread; /* that were compared; that the library itself does not read */
} both;

static void hush(exr_const_context_t exr, exr_result_t code, const char *message) {
    (void)exr, (void)code, (void)message;
}

static exr_result_t grab(exr_decode_pipeline_t *pipeline) {
    both *b = pipeline->decoding_user_data;
    b->expected = pipeline->unpacked_buffer;
    b->bytes = pipeline->chunk.unpacked_size;
    return EXR_ERR_SUCCESS;
}

static wf_exr_shape shape_of(const both *b, wf_exr_channel *channel) {
    const exr_decode_pipeline_t *p = &b->core;
    const exr_attr_chlist_t *list = NULL;
    exr_get_channels(b->exr, b->part, &list);
    wf_exr_shape shape = {channel, p->channel_count, p->chunk.start_y, p->chunk.height, 0};
    for (int c = 0; c < p->channel_count; c++) {
        const exr_coding_channel_info_t *from = &p->channels[c];
        size_t bytes = (size_t)from->bytes_per_element, width = (size_t)from->width,
               lines = (size_t)from->height;
        channel[c] = (wf_exr_channel){from->channel_name,
                                      (wf_exr_type)from->data_type,
                                      bytes,
                                      from->x_samples,
                                      from->y_samples,
                                      from->p_linear,
                                      width,
                                      lines,
                                      width * bytes,
                                      width * lines * bytes};
        shape.bytes += channel[c].plane_bytes;
    }
    return shape;
}

/* False where the library does not read what it has written itself. */
static bool compare(both *b, const exr_chunk_info_t *chunk) {
    wf_exr_channel channel[16];
    weft_error err = {""};
    wf_exr_decode_fn *decode = wf_exr_decode_of((exr_compression_t)chunk->compression);
    assert_int_equal(exr_decoding_initialize(b->exr, b->part, chunk, &b->core), 0);
    assert_int_equal(exr_decoding_choose_default_routines(b->exr, b->part, &b->core), 0);
    b->core.unpack_and_convert_fn = grab;
    b->core.decoding_user_data = b;
    if (exr_decoding_run(b->exr, b->part, &b->core)) return false;
    wf_exr_shape shape = shape_of(b, channel);
    assert_int_equal(shape.bytes, b->bytes);
    if (decode && chunk->packed_size < b->bytes) {
        uint8_t *packed = malloc(chunk->packed_size), *out = malloc(b->bytes);
        assert_int_equal(exr_read_chunk(b->exr, b->part, chunk, packed), 0);
        weft_status status = decode(&b->own, &shape, packed, chunk->packed_size, out, &err);
        if (status) fail_msg("%s", err.text);
        assert_memory_equal(out, b->expected, b->bytes);
        free(packed), free(out);
        b->chunks++;
    }
    return true;
}

static void compare_and_release(both *b, exr_result_t found, const exr_chunk_info_t *chunk) {
    if (found || !compare(b, chunk)) b->unread++;
    exr_decoding_destroy(b->exr, &b->core);
    b->core = (exr_decode_pipeline_t)EXR_DECODE_PIPELINE_INITIALIZER;
}

static void compare_level(both *b, int across, int down, int level_x, int level_y) {
    exr_chunk_info_t chunk;
    for (int j = 0; j < down; j++)
        for (int i = 0; i < across; i++) {
            exr_result_t found =
                exr_read_tile_chunk_info(b->exr, b->part, i, j, level_x, level_y, &chunk);
            compare_and_release(b, found, &chunk);
        }
}

static void compare_tiles(both *b) {
    int levels_x, levels_y, tile_width, tile_height, width, height;
    exr_get_tile_levels(b->exr, b->part, &levels_x, &levels_y);
    for (int l = 0; l < levels_x; l++) {
        exr_get_tile_sizes(b->exr, b->part, l, l, &tile_width, &tile_height);
        exr_get_level_sizes(b->exr, b->part, l, l, &width, &height);
        compare_level(b, (width + tile_width - 1) / tile_width,
                      (height + tile_height - 1) / tile_height, l, l);
    }
}

static void compare_lines(both *b) {
    exr_attr_box2i_t data;
    exr_chunk_info_t chunk;
    int lines;
    exr_get_data_window(b->exr, b->part, &data);
    exr_get_scanlines_per_chunk(b->exr, b->part, &lines);
    for (int y = data.min.y; y <= data.max.y; y += lines) {
        exr_result_t found = exr_read_scanline_chunk_info(b->exr, b->part, y, &chunk);
        compare_and_release(b, found, &chunk);
    }
}

/* Returns how many chunks were compared. */
static int compare_file(const char *path) {
    both b = {.core = EXR_DECODE_PIPELINE_INITIALIZER};
    exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
    int parts;
    how.error_handler_fn = hush;
    assert_true(wf_exr_decoder_init(&b.own));
    assert_int_equal(exr_start_read(&b.exr, path, &how), 0);
    exr_get_count(b.exr, &parts);
    for (b.part = 0; b.part < parts; b.part++) {
        exr_storage_t storage;
        exr_get_storage(b.exr, b.part, &storage);
        if (storage == EXR_STORAGE_TILED)
            compare_tiles(&b);
        else
            compare_lines(&b);
    }
    exr_finish(&b.exr);
    wf_exr_decoder_free(&b.own);
    return b.chunks;
}

/* ---- Files ---- */

static const exr_compression_t compressions[] = {
    EXR_COMPRESSION_RLE,   EXR_COMPRESSION_ZIPS, EXR_COMPRESSION_ZIP, EXR_COMPRESSION_PIZ,
    EXR_COMPRESSION_PXR24, EXR_COMPRESSION_B44,  EXR_COMPRESSION_B44A};

typedef struct form {
    const char *channels;
    wf_box data;
    int tile_width, tile_height;
} form;

static const form forms[] = {
    {"B G R", {0, 0, 200, 70}, 0, 0},          {"A B G R", {-13, -9, 50, 61}, 0, 0},
    {"B G R id#", {3, 5, 4, 80}, 0, 0},        {"B G R", {-2, -1, 99, 0}, 0, 0},
    {"BY/2 RY/2 Y", {-4, -6, 60, 64}, 0, 0},   {"Y mask/4 z#", {0, 0, 64, 36}, 0, 0},
    {"A B G R", {-5, 7, 90, 80}, 32, 16},      {"Y", {0, 0, 33, 257}, 17, 64},
    {"A B G R id# u v z", {0, 0, 9, 9}, 0, 0}, {"B G R", {0, 0, 1, 1}, 0, 0},
};

static void every_compression_is_as_the_library_has_it(void **state) {
    char path[] = "/tmp/weft-chunks-XXXXXX";
    int compared[16] = {0};
    (void)state;
    close(mkstemp(path));
    const size_t kinds = sizeof forms / sizeof *forms,
                 fills = sizeof contents / sizeof *contents;
    for (size_t i = 0; i < kinds * fills * 2; i += (size_t)test_step(3)) {
        const form *f = &forms[i % kinds];
        for (size_t c = 0; c < sizeof compressions / sizeof *compressions; c++) {
            exr_part part = {.display = {0, 0, 40, 30},
                             .data = f->data,
                             .channels = f->channels,
                             .type = i / kinds / fills ? EXR_PIXEL_FLOAT : EXR_PIXEL_HALF,
                             .compression = compressions[c],
                             .tile_width = f->tile_width,
                             .tile_height = f->tile_height,
                             .value = contents[i / kinds % fills]};
            exr_part parts[2] = {part, part};
            parts[1].value = contents[(i / kinds + 1) % fills];
            if (!exr_write(path, parts, 1 + (int)(i % 4 == 3))) continue;
            compared[compressions[c]] += compare_file(path);
        }
    }
    unlink(path);
    for (size_t c = 0; c < sizeof compressions / sizeof *compressions; c++)
        if (wf_exr_decode_of(compressions[c])) assert_true(compared[compressions[c]] > 100);
}

/* ---- Files of the other writer ---- */

static void other_files_are_as_the_library_has_them(void **state) {
    static const char *const made[] = {
        "-d half --compression piz -o a.exr",
        "-d float --compression piz -o a.exr",
        "-d half --attrib openexr:lineOrder decreasingY --compression piz -o a.exr",
        "-d half --compression piz --tile 32 32 -otex:resize=0 a.exr",
        "-d half --compression zips -otex a.exr",
        "-d half --origin -30-7 --compression piz -o a.exr",
        "-d half --compression rle --tile 24 32 -o a.exr",
        "-d float --compression pxr24 -o a.exr",
    };
    char folder[] = "/tmp/weft-chunks-XXXXXX", command[512];
    (void)state;
    if (system("command -v oiiotool >/dev/null")) {
        print_message("skipped: no oiiotool\n");
        skip();
    }
    assert_non_null(mkdtemp(folder));
    for (size_t i = 0; i < sizeof made / sizeof *made; i++) {
        snprintf(
            command, sizeof command,
            "cd %s && oiiotool --pattern fill:topleft=1,0,0:topright=0,2,0:bottomleft=0,0,.5 "
            "201x131 3 --noise:type=salt:value=1:portion=.03 %s",
            folder, made[i]);
        assert_int_equal(system(command), 0);
        snprintf(command, sizeof command, "%s/a.exr", folder);
        assert_true(compare_file(command) > 0);
        unlink(command);
    }
    rmdir(folder);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_compression_is_as_the_library_has_it),
        cmocka_unit_test(other_files_are_as_the_library_has_them),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
