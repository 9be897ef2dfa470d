/* PIZ: samples as words of 16 bits, those that occur numbered without gaps, through a wavelet
 * and into Huffman codes. */
#include <stdlib.h>
#include <string.h>

#include "convert/base/reserve.h"
#include "convert/read/exr/decode.h"
#include "convert/read/exr/little.h"

#define MAP_BYTES 8192 /* a bit for each of 65536 words */
#define WORDS     65536

/* What a chunk begins with: which words occur. */
typedef struct value_map {
    uint8_t bits[MAP_BYTES];
    size_t values;  /* that occur, 0 always */
    bool odd_words; /* some are NaN or Inf where samples are halves */
} value_map;

/* ---- Words that occur ---- */

/* Returns the bytes that the map takes, 0 of one that is damaged. */
static size_t read_map(value_map *map, const uint8_t *packed, size_t size) {
    memset(map, 0, sizeof *map);
    if (size < 4) return 0;
    size_t first = wf_little16(packed), last = wf_little16(packed + 2);
    if (last >= MAP_BYTES) return 0;
    if (first > last) return 4; /* no value but 0 */
    size_t bytes = last - first + 1;
    if (size < 4 + bytes) return 0;
    memcpy(map->bits + first, packed + 4, bytes);
    return 4 + bytes;
}

static bool any_of(const uint8_t *byte, size_t count) {
    bool any = false;
    for (size_t i = 0; i < count; i++) any |= byte[i] != 0;
    return any;
}

/* The table from numbers to words. */
static void number_values(value_map *map, uint16_t *table) {
    map->odd_words = any_of(map->bits + 0x7c00 / 8, 128) || any_of(map->bits + 0xfc00 / 8, 128);
    map->bits[0] |= 1;
    map->values = 0;
    for (size_t i = 0; i < MAP_BYTES; i += 8)
        for (uint64_t left = wf_little64(map->bits + i); left; left &= left - 1)
            table[map->values++] = (uint16_t)(8 * i + (size_t)__builtin_ctzll(left));
    memset(table + map->values, 0, (WORDS - map->values) * sizeof *table);
}

/* ---- Planes ---- */

/* Samples of four bytes are two planes of words, whose words take turns. */
static void split(uint16_t *to, const uint16_t *from, size_t count) {
    for (size_t i = 0; i < count; i++) to[i] = from[2 * i], to[count + i] = from[2 * i + 1];
}

static void join(uint16_t *to, const uint16_t *from, size_t count) {
    for (size_t i = 0; i < count; i++) to[2 * i] = from[i], to[2 * i + 1] = from[count + i];
}

/* Words that undoing the wavelet of a channel takes besides its own. */
static size_t scratch_words(const wf_exr_channel *c) {
    size_t step = wf_wavelet_scratch(c->width, c->lines);
    return c->bytes == 4 ? step + c->plane_bytes / 2 : step;
}

static void undo_wavelet(const wf_wavelet_ops *ops, const wf_exr_channel *c, uint16_t *words,
                         bool narrow, uint16_t *scratch) {
    size_t samples = c->width * c->lines;
    if (c->bytes == 2) {
        wf_wavelet_undo(ops, words, c->width, c->lines, narrow, scratch);
        return;
    }
    split(scratch, words, samples);
    for (size_t half = 0; half < 2; half++)
        wf_wavelet_undo(ops, scratch + half * samples, c->width, c->lines, narrow,
                        scratch + 2 * samples);
    join(words, scratch, samples);
}

/* Lines of all channels in turn, from a plane for each. */
static void put_lines(const wf_exr_decoder *d, const wf_exr_shape *shape, const uint16_t *words,
                      uint8_t *out) {
    for (int y = 0; y < shape->lines; y++) {
        const uint16_t *plane = words;
        for (int i = 0; i < shape->channels; i++) {
            const wf_exr_channel *c = &shape->channel[i];
            size_t count = c->line_bytes / 2;
            if (wf_exr_has_line(c, shape->y0 + y)) {
                d->wavelet->look_up(out, plane + (size_t)(y / c->down) * count, d->table,
                                    count);
                out += c->line_bytes;
            }
            plane += c->plane_bytes / 2;
        }
    }
}

/* ---- A chunk ---- */

static bool prepare(wf_exr_decoder *d, const wf_exr_shape *shape) {
    size_t scratch = 0;
    for (int i = 0; i < shape->channels; i++) {
        size_t words = scratch_words(&shape->channel[i]);
        scratch = words > scratch ? words : scratch;
    }
    if (!d->codes) d->codes = malloc(sizeof *d->codes);
    if (!d->table) d->table = malloc(WORDS * sizeof *d->table);
    return d->codes && d->table &&
           wf_reserve(&d->words, &d->words_capacity,
                      (shape->bytes / 2 + scratch) * sizeof *d->words);
}

/* Opens the Huffman codes that follow the map. */
static const char *open_codes(wf_exr_decoder *d, const uint8_t *packed, size_t size,
                              wf_huffman_stream *stream) {
    if (size < 4 || wf_little32(packed) > size - 4) return "its codes are cut off";
    return wf_huffman_open(d->codes, packed + 4, wf_little32(packed), stream);
}

weft_status wf_exr_decode_piz(wf_exr_decoder *d, const wf_exr_shape *shape,
                              const uint8_t *packed, size_t size, uint8_t *out,
                              weft_error *err) {
    value_map map;
    if (!prepare(d, shape)) return wf_exr_no_memory(err);
    size_t before = read_map(&map, packed, size);
    if (!before) return wf_fail(err, WEFT_FAILED, "its map of values is cut off");
    wf_huffman_stream stream = {.word = d->words, .words = shape->bytes / 2};
    const char *wrong = open_codes(d, packed + before, size - before, &stream);
    if (wrong) return wf_fail(err, WEFT_FAILED, "%s", wrong);
    if (!d->huffman->decode(&stream))
        return wf_fail(err, WEFT_FAILED, "its codes do not become as many samples as it has");
    number_values(&map, d->table);
    d->suspect |= map.odd_words;
    uint16_t *plane = d->words, *scratch = d->words + shape->bytes / 2;
    for (int i = 0; i < shape->channels; plane += shape->channel[i++].plane_bytes / 2)
        undo_wavelet(d->wavelet, &shape->channel[i], plane, map.values <= 1 << 14, scratch);
    put_lines(d, shape, d->words, out);
    return WEFT_OK;
}
