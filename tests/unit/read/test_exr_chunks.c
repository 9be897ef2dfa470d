/* Chunks of EXR decoded by weft itself, held to the library's reading of the same bytes: every
 * compression, type of sample, shape of chunk and kind of content. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>
#include <libdeflate.h>

#include "convert/read/exr/decode.h"
#include "convert/read/exr/half.h"
#include "tests/unit/support/exr_write.h"
#include "tests/unit/support/jobs.h"
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
    int levels;         /* of tiles that were gone through */
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

static void compare_level(both *b, int level_x, int level_y) {
    exr_chunk_info_t chunk;
    int tile_width, tile_height, width, height;
    exr_get_tile_sizes(b->exr, b->part, level_x, level_y, &tile_width, &tile_height);
    exr_get_level_sizes(b->exr, b->part, level_x, level_y, &width, &height);
    b->levels++;
    for (int j = 0; j * tile_height < height; j++)
        for (int i = 0; i * tile_width < width; i++) {
            exr_result_t found =
                exr_read_tile_chunk_info(b->exr, b->part, i, j, level_x, level_y, &chunk);
            compare_and_release(b, found, &chunk);
        }
}

static void compare_tiles(both *b) {
    int across, down;
    uint32_t width, height;
    exr_tile_level_mode_t levels;
    exr_tile_round_mode_t round;
    exr_get_tile_levels(b->exr, b->part, &across, &down);
    exr_get_tile_descriptor(b->exr, b->part, &width, &height, &levels, &round);
    bool all = levels == EXR_TILE_RIPMAP_LEVELS;
    for (int y = 0; y < down; y++)
        for (int x = all ? 0 : y; x < (all ? across : y + 1); x++) compare_level(b, x, y);
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

/* Returns what was compared. */
static both compare_all(const char *path) {
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
    return b;
}

static int compare_file(const char *path) {
    return compare_all(path).chunks;
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
        if (wf_exr_decode_of(compressions[c]))
            assert_true(compared[compressions[c]] > 90 / test_step(3));
}

/* ---- Fewer samples than pixels ---- */

static void subsampled_channels_are_as_the_library_has_them(void **state) {
    static const char *const channels[] = {"BY/2x1 RY/2x1 Y", "BY/2 RY/2 Y", "A/1x2 Y",
                                           "A B/4x2 Y"};
    char path[] = "/tmp/weft-chroma-XXXXXX";
    (void)state;
    close(mkstemp(path));
    for (size_t c = 0; c < sizeof compressions / sizeof *compressions; c++)
        for (size_t kind = 0; kind < 4; kind++) {
            both found = {0};
            for (size_t i = 0; i < 12; i++) {
                exr_part part = {.display = {0, 0, 40, 30},
                                 .data = {-4, 6, 64, 76},
                                 .channels = channels[kind],
                                 .type = i % 2 ? EXR_PIXEL_FLOAT : EXR_PIXEL_HALF,
                                 .compression = compressions[c],
                                 .value = contents[i / 2]};
                assert_true(exr_write(path, &part, 1));
                both b = compare_all(path);
                found.chunks += b.chunks, found.unread += b.unread;
            }
            assert_int_equal(found.unread, 0);
            if (wf_exr_decode_of(compressions[c])) assert_true(found.chunks >= 8);
        }
    unlink(path);
}

/* ---- Files of the other writer ---- */

static const char *at(const char *name) {
    static char path[512];
    job_path(path, name);
    return path;
}

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
    (void)state;
    for (size_t i = 0; i < sizeof made / sizeof *made; i++) {
        char arguments[512];
        snprintf(arguments, sizeof arguments,
                 "--pattern fill:topleft=1,0,0:topright=0,2,0:bottomleft=0,0,.5 201x131 3 "
                 "--noise:type=salt:value=1:portion=.03 %s",
                 made[i]);
        job_oiiotool(arguments);
        assert_true(compare_file(at("a.exr")) > 0);
    }
}

/* ---- DWA, which OpenEXRCore 3.1 does not read ---- */

/* The same picture twice, as DWA and as the library's reading of that, not compressed. */
typedef struct pair {
    exr_context_t dwa, plain;
    wf_exr_decoder own;
    int chunks;
} pair;

static exr_context_t open_quietly(const char *path) {
    exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
    exr_context_t exr = NULL;
    how.error_handler_fn = hush;
    assert_int_equal(exr_start_read(&exr, path, &how), 0);
    return exr;
}

static wf_exr_shape whole_shape(exr_context_t exr, const exr_chunk_info_t *chunk,
                                wf_exr_channel *channel) {
    const exr_attr_chlist_t *list = NULL;
    exr_get_channels(exr, 0, &list);
    wf_exr_shape shape = {channel, list->num_channels, chunk->start_y, chunk->height, 0};
    for (int c = 0; c < list->num_channels; c++) {
        const exr_attr_chlist_entry_t *from = &list->entries[c];
        size_t bytes = from->pixel_type == EXR_PIXEL_HALF ? 2 : 4, width = (size_t)chunk->width,
               lines = (size_t)chunk->height;
        channel[c] = (wf_exr_channel){.name = from->name.str,
                                      .type = (wf_exr_type)from->pixel_type,
                                      .bytes = bytes,
                                      .across = 1,
                                      .down = 1,
                                      .linear = from->p_linear,
                                      .width = width,
                                      .lines = lines,
                                      .line_bytes = width * bytes,
                                      .plane_bytes = width * lines * bytes};
        shape.bytes += channel[c].plane_bytes;
    }
    return shape;
}

static uint8_t *read_samples(pair *p, const exr_chunk_info_t *chunk) {
    wf_exr_channel channel[16];
    weft_error err = {""};
    wf_exr_shape shape = whole_shape(p->dwa, chunk, channel);
    uint8_t *packed = malloc(chunk->packed_size), *out = malloc(shape.bytes);
    assert_int_equal(exr_read_chunk(p->dwa, 0, chunk, packed), 0);
    if (chunk->packed_size == shape.bytes)
        memcpy(out, packed, shape.bytes);
    else if (wf_exr_decode_dwa(&p->own, &shape, packed, chunk->packed_size, out, &err))
        fail_msg("%s", err.text);
    else
        p->chunks++;
    free(packed);
    return out;
}

static void compare_dwa_lines(pair *p) {
    exr_attr_box2i_t data;
    exr_chunk_info_t chunk, line;
    int lines;
    exr_get_data_window(p->dwa, 0, &data);
    exr_get_scanlines_per_chunk(p->dwa, 0, &lines);
    for (int y = data.min.y; y <= data.max.y; y += lines) {
        assert_int_equal(exr_read_scanline_chunk_info(p->dwa, 0, y, &chunk), 0);
        uint8_t *out = read_samples(p, &chunk), *at_line = out;
        for (int i = 0; i < chunk.height; i++) {
            assert_int_equal(exr_read_scanline_chunk_info(p->plain, 0, y + i, &line), 0);
            uint8_t *plain = malloc(line.packed_size);
            assert_int_equal(exr_read_chunk(p->plain, 0, &line, plain), 0);
            assert_memory_equal(at_line, plain, line.packed_size);
            at_line += line.packed_size;
            free(plain);
        }
        free(out);
    }
}

static void compare_dwa_tiles(pair *p) {
    int tile_width, tile_height;
    exr_attr_box2i_t data;
    exr_chunk_info_t tile, same;
    exr_get_data_window(p->dwa, 0, &data);
    exr_get_tile_sizes(p->dwa, 0, 0, 0, &tile_width, &tile_height);
    for (int j = 0; j <= (data.max.y - data.min.y) / tile_height; j++)
        for (int i = 0; i <= (data.max.x - data.min.x) / tile_width; i++) {
            assert_int_equal(exr_read_tile_chunk_info(p->dwa, 0, i, j, 0, 0, &tile), 0);
            assert_int_equal(exr_read_tile_chunk_info(p->plain, 0, i, j, 0, 0, &same), 0);
            uint8_t *out = read_samples(p, &tile), *plain = malloc(same.packed_size);
            assert_int_equal(exr_read_chunk(p->plain, 0, &same, plain), 0);
            assert_memory_equal(out, plain, same.packed_size);
            free(out), free(plain);
        }
}

/* Returns how many chunks were not stored as they are. */
static int compare_dwa(void) {
    pair p = {.dwa = open_quietly(at("dwa.exr")), .plain = open_quietly(at("plain.exr"))};
    exr_storage_t storage;
    assert_true(wf_exr_decoder_init(&p.own));
    exr_get_storage(p.dwa, 0, &storage);
    if (storage == EXR_STORAGE_TILED)
        compare_dwa_tiles(&p);
    else
        compare_dwa_lines(&p);
    exr_finish(&p.dwa), exr_finish(&p.plain);
    wf_exr_decoder_free(&p.own);
    return p.chunks;
}

static const char *const dwa_kinds[] = {
    "--compression dwaa",
    "--compression dwab",
    "--compression dwaa:0",
    "--compression dwaa:2000",
    "--compression dwab --tile 40 24",
    "--compression dwaa -d float",
    "--compression dwab --origin -17-300",
    "--compression dwaa --attrib openexr:lineOrder decreasingY",
    "--compression dwaa --chnames Albedo.R,Albedo.G,Albedo.B,A,B,G,R,Z",
    "--compression dwab --chnames R,G,B,u.R,u.G,u.B,id.A,Y",
    "--compression dwaa --chnames left.Y,BY,RY,R,G,alpha,z.z,n.X",
    "--compression dwaa -d half -d Z=float -d u.B=float --chnames R,G,B,u.R,u.G,u.B,A,Z",
};

/* Eight channels, which the writer gets from a file of our own; contents and sizes take turns.
 */
static void dwa_is_as_the_library_has_it(void **state) {
    static const wf_box sizes[] = {
        {0, 0, 100, 75}, {3, -5, 12, 300}, {0, 0, 65, 9}, {0, 0, 1, 1}, {-70, 0, 80, 33}};
    const size_t kinds = sizeof dwa_kinds / sizeof *dwa_kinds;
    int compared = 0;
    (void)state;
    for (size_t i = 0; i < 2 * kinds; i += (size_t)test_step(5)) {
        exr_part part = {.display = {0, 0, 90, 300},
                         .data = sizes[i % 5],
                         .channels = "a b c d e f g h",
                         .type = EXR_PIXEL_FLOAT,
                         .compression = EXR_COMPRESSION_NONE,
                         .value = contents[(i + 1 + i / kinds) % 6]};
        const char *kind = dwa_kinds[i % kinds];
        bool named = strstr(kind, "chnames") || strstr(kind, "float");
        char arguments[256];
        assert_true(exr_write(at("in.exr"), &part, 1));
        snprintf(arguments, sizeof arguments, "in.exr %s %s -o dwa.exr",
                 named ? "" : "-d half --ch R=a,G=b,B=c,A=d", kind);
        job_oiiotool(arguments);
        job_oiiotool("dwa.exr --compression none -o plain.exr");
        compared += compare_dwa();
    }
    assert_true(compared > 10);
}

/* ---- Levels of tiles, of which OpenEXRCore 3.1 does not find all ---- */

/* A tile as it stands in a file. */
typedef struct tile {
    int32_t place[4]; /* across, down, level across, level down */
    const uint8_t *data;
    size_t bytes;
} tile;

typedef struct tiles {
    uint8_t *file;
    const uint8_t *next, *end;
    int width, lines; /* of a tile */
    int sides[2];     /* of the picture */
    bool up;          /* levels are rounded up */
} tiles;

/* Tiles are gone through in the order in which they stand, from the first one on. */
static tiles open_tiles(const char *name) {
    tiles t = {0};
    size_t size;
    exr_chunk_info_t first;
    exr_attr_box2i_t data;
    uint32_t width, lines;
    exr_tile_level_mode_t levels;
    exr_tile_round_mode_t round;
    exr_context_t exr = open_quietly(at(name));
    assert_int_equal(exr_read_tile_chunk_info(exr, 0, 0, 0, 0, 0, &first), 0);
    exr_get_tile_descriptor(exr, 0, &width, &lines, &levels, &round);
    exr_get_data_window(exr, 0, &data);
    exr_finish(&exr);
    t.file = job_file(name, &size);
    t.next = t.file + first.data_offset - sizeof(int32_t[5]);
    t.end = t.file + size;
    t.width = (int)width, t.lines = (int)lines, t.up = round == EXR_TILE_ROUND_UP;
    t.sides[0] = data.max.x - data.min.x + 1, t.sides[1] = data.max.y - data.min.y + 1;
    return t;
}

static bool next_tile(tiles *from, tile *t) {
    int32_t bytes;
    if (from->next >= from->end) return false;
    memcpy(t->place, from->next, sizeof t->place);
    memcpy(&bytes, from->next + sizeof t->place, sizeof bytes);
    t->data = from->next + sizeof t->place + sizeof bytes;
    t->bytes = (size_t)bytes;
    from->next = t->data + bytes;
    return true;
}

/* How much of a tile there is along a side: what is left of its level, which is at least 1. */
static size_t extent(int side, int level, bool up, int each, int number) {
    int whole = up ? (side + (1 << level) - 1) >> level : side >> level;
    int left = (whole ? whole : 1) - number * each;
    return (size_t)(left < each ? left : each);
}

/* Four channels of halves. */
static wf_exr_shape tile_shape(const tiles *of, const tile *t, wf_exr_channel channel[4]) {
    static const char *const names[] = {"A", "B", "G", "R"};
    size_t width = extent(of->sides[0], t->place[2], of->up, of->width, t->place[0]);
    size_t lines = extent(of->sides[1], t->place[3], of->up, of->lines, t->place[1]);
    for (int c = 0; c < 4; c++)
        channel[c] = (wf_exr_channel){.name = names[c],
                                      .type = WF_EXR_HALF,
                                      .bytes = 2,
                                      .across = 1,
                                      .down = 1,
                                      .width = width,
                                      .lines = lines,
                                      .line_bytes = 2 * width,
                                      .plane_bytes = 2 * width * lines};
    return (wf_exr_shape){channel, 4, t->place[1] * of->lines, (int)lines, 8 * width * lines};
}

/* DWA loses a little, which is held to the library's reading above. */
static void expect_near(const uint8_t *got, const uint8_t *expected, size_t bytes) {
    for (size_t i = 0; i < bytes; i += 2) {
        uint16_t half[2];
        memcpy(half, got + i, 2), memcpy(half + 1, expected + i, 2);
        assert_true(fabsf(wf_float_of_half(half[0]) - wf_float_of_half(half[1])) < 0.05f);
    }
}

/* Returns whether it was compressed. */
static bool compare_tile(wf_exr_decoder *own, exr_compression_t how, const tiles *of,
                         const tile *t, const tile *plain) {
    wf_exr_channel channel[4];
    weft_error err = {""};
    wf_exr_shape shape = tile_shape(of, t, channel);
    assert_memory_equal(t->place, plain->place, sizeof t->place);
    assert_int_equal(plain->bytes, shape.bytes);
    if (t->bytes == shape.bytes) return false;
    uint8_t *out = malloc(shape.bytes);
    if (wf_exr_decode_of(how)(own, &shape, t->data, t->bytes, out, &err))
        fail_msg("%d %d of level %d %d: %s", t->place[0], t->place[1], t->place[2], t->place[3],
                 err.text);
    if (how == EXR_COMPRESSION_DWAA || how == EXR_COMPRESSION_DWAB)
        expect_near(out, plain->data, shape.bytes);
    else
        assert_memory_equal(out, plain->data, shape.bytes);
    free(out);
    return true;
}

/* levels.exr, compressed, beside plain.exr. Returns how many tiles were compressed. */
static int compare_levels(exr_compression_t how) {
    tiles packed = open_tiles("levels.exr"), plain = open_tiles("plain.exr");
    tile one, other;
    int compressed = 0, deepest[2] = {0, 0};
    wf_exr_decoder own;
    assert_true(wf_exr_decoder_init(&own));
    while (next_tile(&packed, &one)) {
        assert_true(next_tile(&plain, &other));
        compressed += compare_tile(&own, how, &packed, &one, &other);
        for (int i = 0; i < 2; i++)
            if (one.place[2 + i] > deepest[i]) deepest[i] = one.place[2 + i];
    }
    assert_false(next_tile(&plain, &other));
    for (int i = 0; i < 2; i++)
        assert_true(extent(packed.sides[i], deepest[i], packed.up, 2, 0) == 1);
    wf_exr_decoder_free(&own);
    free(packed.file), free(plain.file);
    return compressed;
}

static void make_levels(const char *levels, const char *round, const char *how,
                        const char *name) {
    char command[512];
    snprintf(command, sizeof command, "cd %s && exrmaketiled %s %s -t 16 12 -z %s in.exr %s",
             job_directory, levels, round, how, name);
    if (system(command)) fail_msg("%s", command);
}

/* OpenEXR's own tool writes them, compressed and not. */
static void levels_are_as_their_writer_had_them(void **state) {
    static const struct {
        const char *name;
        exr_compression_t how;
    } rows[] = {{"rle", EXR_COMPRESSION_RLE},   {"zip", EXR_COMPRESSION_ZIP},
                {"piz", EXR_COMPRESSION_PIZ},   {"pxr24", EXR_COMPRESSION_PXR24},
                {"dwaa", EXR_COMPRESSION_DWAA}, {"dwab", EXR_COMPRESSION_DWAB}};
    static const wf_box sizes[] = {
        {0, 0, 37, 21}, {-3, 5, 62, 70}, {0, 0, 1, 19}, {2, 2, 66, 66}};
    int compressed[sizeof rows / sizeof *rows] = {0};
    (void)state;
    if (system("command -v exrmaketiled >/dev/null")) {
        print_message("skipped: no exrmaketiled, which is in the package openexr\n");
        skip();
    }
    for (int kind = 0; kind < 16; kind += test_step(3)) {
        const char *levels = kind & 1 ? "-r" : "-m", *round = kind & 2 ? "-u" : "-d";
        exr_part part = {.display = {0, 0, 40, 30},
                         .data = sizes[(kind / 4 + kind) % 4],
                         .channels = "A B G R",
                         .type = EXR_PIXEL_HALF,
                         .compression = EXR_COMPRESSION_NONE,
                         .value = kind / 4 % 2 ? smooth : flat};
        assert_true(exr_write(at("in.exr"), &part, 1));
        make_levels(levels, round, "none", "plain.exr");
        for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
            make_levels(levels, round, rows[i].name, "levels.exr");
            compressed[i] += compare_levels(rows[i].how);
        }
    }
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        assert_true(compressed[i] > 200 / test_step(3));
    assert_ptr_equal(wf_exr_decode_of(EXR_COMPRESSION_ZIPS), /* which the tool has not */
                     wf_exr_decode_of(EXR_COMPRESSION_ZIP));
}

/* ---- Chroma under DWA, which no writer here makes ---- */

static void put_number(uint8_t *to, uint64_t value) {
    for (int i = 0; i < 8; i++) to[i] = (uint8_t)(value >> 8 * i);
}

/* Deflates words, of which the first coefficients are split and differenced as ZIP's are. */
static size_t deflate(uint8_t *to, const uint16_t *word, size_t count, bool differences) {
    uint8_t apart[256], plain[256];
    memcpy(plain, word, 2 * count);
    for (size_t i = 0; differences && i < 2 * count; i++)
        apart[i % 2 ? count + i / 2 : i / 2] = plain[i];
    for (size_t i = 2 * count; differences && --i > 0;)
        apart[i] = (uint8_t)(apart[i] - apart[i - 1] + 128);
    struct libdeflate_compressor *c = libdeflate_alloc_compressor(6);
    size_t size = libdeflate_zlib_compress(c, differences ? apart : plain, 2 * count, to, 512);
    libdeflate_free_compressor(c);
    return size;
}

/* 32x16 pixels of Y, 8 blocks, and chroma for every second, 2 blocks each, all of them even:
 * the first coefficient is eight times what was rounded, and no other is there. */
static size_t even_chunk(uint8_t *to) {
    static const uint8_t rules[] = {16, 0, 'Y', 0, 4, 1, 'B', 'Y', 0, 4, 1, 'R', 'Y', 0, 4, 1};
    uint16_t ac[12], dc[12];
    for (int i = 0; i < 12; i++) ac[i] = 0xff00;
    for (int i = 0; i < 12; i++) dc[i] = i < 2 ? 0x4000 : i < 4 ? 0xbc00 : 0x4400; /* 2 -1 4 */
    uint8_t *next = to + 88;
    memset(to, 0, 88);
    memcpy(next, rules, sizeof rules);
    to[88] = sizeof rules;
    next += sizeof rules;
    size_t first = deflate(next, ac, 12, false);
    size_t second = deflate(next + first, dc, 12, true);
    put_number(to, 2);
    put_number(to + 8 * 3, first), put_number(to + 8 * 4, second);
    put_number(to + 8 * 8, 12), put_number(to + 8 * 9, 12), put_number(to + 8 * 10, 1);
    return (size_t)(next - to) + first + second;
}

static void even_chroma_under_dwa(void **state) {
    static const float light[3] = {0.25f, -0.125f, 0.5f};
    wf_exr_channel c[3] = {{.name = "BY", .across = 2, .down = 2, .width = 16, .lines = 8},
                           {.name = "RY", .across = 2, .down = 2, .width = 16, .lines = 8},
                           {.name = "Y", .across = 1, .down = 1, .width = 32, .lines = 16}};
    wf_exr_shape shape = {c, 3, -4, 16, 0};
    wf_exr_decoder own;
    uint8_t packed[1024];
    uint16_t out[768];
    weft_error err = {""};
    (void)state;
    for (int i = 0; i < 3; i++) {
        c[i].type = WF_EXR_HALF, c[i].bytes = 2;
        c[i].line_bytes = 2 * c[i].width, c[i].plane_bytes = c[i].line_bytes * c[i].lines;
        shape.bytes += c[i].plane_bytes;
    }
    size_t size = even_chunk(packed), at = 0;
    assert_true(wf_exr_decoder_init(&own));
    if (wf_exr_decode_dwa(&own, &shape, packed, size, (uint8_t *)out, &err))
        fail_msg("%s", err.text);
    for (int y = 0; y < 16; y++)
        for (int i = y % 2 ? 2 : 0; i < 3; i++)
            for (size_t x = 0; x < c[i].width; x++) {
                float expected = copysignf(powf(fabsf(light[i]), 2.2f), light[i]);
                assert_int_equal(out[at++], wf_half_of_float(expected));
            }
    assert_int_equal(2 * at, shape.bytes);
    for (size_t cut = 0; cut < size; cut++) /* and no part of it is taken for the whole */
        assert_int_equal(wf_exr_decode_dwa(&own, &shape, packed, cut, (uint8_t *)out, &err),
                         WEFT_FAILED);
    wf_exr_decoder_free(&own);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_compression_is_as_the_library_has_it),
        cmocka_unit_test(levels_are_as_their_writer_had_them),
        cmocka_unit_test(subsampled_channels_are_as_the_library_has_them),
        cmocka_unit_test(other_files_are_as_the_library_has_them),
        cmocka_unit_test(dwa_is_as_the_library_has_it),
        cmocka_unit_test(even_chroma_under_dwa),
    };
    return cmocka_run_group_tests(tests, job_make_directory, job_remove_directory);
}
