/* Writes pictures of codes as PNG. */
#include "convert/write/png_write.h"

#include <libdeflate.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/base/big_endian.h"

enum { DEFLATE_LEVEL = 4, CHUNK_BYTES = 1 << 20, MOST_TEXT = 1024 };

/* Where the file goes, with the first failure. */
typedef struct output {
    wf_bytes_fn *write;
    void *user;
    weft_error *err;
    weft_status status;
} output;

static void put(output *o, const void *data, size_t bytes) {
    if (!o->status && bytes) o->status = o->write(o->user, data, bytes, o->err);
}

/* ---- Chunks ---- */

static void put_chunk(output *o, const char *type, const void *data, size_t bytes) {
    uint8_t head[8], sum[4];
    wf_put_big_endian(head, bytes, 4);
    memcpy(head + 4, type, 4);
    uint32_t crc = libdeflate_crc32(0, head + 4, 4);
    wf_put_big_endian(sum, bytes ? libdeflate_crc32(crc, data, bytes) : crc, 4);
    put(o, head, sizeof head);
    put(o, data, bytes);
    put(o, sum, sizeof sum);
}

static void put_header(output *o, const wf_picture_out *p) {
    enum { TRUECOLOR = 2, WITH_ALPHA = 6 };
    uint8_t data[13] = {0};
    wf_put_big_endian(data, (uint64_t)p->width_px, 4);
    wf_put_big_endian(data + 4, (uint64_t)p->lines, 4);
    data[8] = (uint8_t)p->bits;
    data[9] = p->channels == 4 ? WITH_ALPHA : TRUECOLOR;
    put_chunk(o, "IHDR", data, sizeof data);
}

/* Primaries and transfer, no matrix, and whether codes are of full range. */
static void put_colors(output *o, const wf_picture_out *p) {
    const uint8_t data[4] = {(uint8_t)p->primaries, (uint8_t)p->transfer, 0, p->full_range};
    if (p->transfer) put_chunk(o, "cICP", data, sizeof data);
}

/* The pixel aspect is a ratio of two densities, which are whole numbers; 6600 = 600 x 11 keeps
 * the elevenths of 525 and 625 lines exact. */
static void put_density(output *o, const wf_picture_out *p) {
    uint8_t data[9] = {0}; /* of no unit */
    wf_put_big_endian(data, 6600, 4);
    wf_put_big_endian(data + 4, (uint64_t)lround(6600 * wf_ratio_value(p->pixel_aspect)), 4);
    put_chunk(o, "pHYs", data, sizeof data);
}

static void put_place(output *o) {
    const uint8_t corner[9] = {0}; /* x, y, in pixels */
    put_chunk(o, "oFFs", corner, sizeof corner);
}

static void put_text(output *o, const char *key, const char *text) {
    char data[MOST_TEXT];
    int length = snprintf(data, sizeof data, "%s%c%s", key, '\0', text);
    if (!*text) return;
    put_chunk(o, "tEXt", data, length < MOST_TEXT ? (size_t)length : MOST_TEXT - 1);
}

static void put_words(output *o, const wf_picture_out *p) {
    char words[WF_PICTURE_WORDS_SIZE], field[2] = {p->field ? (char)('0' + p->field) : '\0'};
    put_text(o, "Software", WF_PICTURE_SOFTWARE);
    if (*p->raster) put_text(o, "Description", wf_picture_words(p, words));
    put_text(o, "weft:raster", p->raster);
    put_text(o, "weft:colorSpace", p->color_space);
    put_text(o, "weft:timecode", p->timecode);
    put_text(o, "weft:field", field);
}

/* ---- Filters (ISO/IEC 15948, 9.2) ---- */

/* Each foretells byte x of a line of count bytes from the byte of the pixel before, `step`
 * bytes back, and from those of the line above, and keeps the difference. Before the first
 * pixel and above the first line all are 0: lines begin after `step` such bytes. */
typedef void filter_fn(const uint8_t *line, const uint8_t *above, size_t count, size_t step,
                       uint8_t *to);

static void filter_none(const uint8_t *line, const uint8_t *above, size_t count, size_t step,
                        uint8_t *to) {
    (void)above, (void)step;
    memcpy(to, line, count);
}

static void filter_sub(const uint8_t *line, const uint8_t *above, size_t count, size_t step,
                       uint8_t *restrict to) {
    const uint8_t *before = line - step;
    (void)above;
    for (size_t x = 0; x < count; x++) to[x] = (uint8_t)(line[x] - before[x]);
}

static void filter_up(const uint8_t *line, const uint8_t *above, size_t count, size_t step,
                      uint8_t *restrict to) {
    (void)step;
    for (size_t x = 0; x < count; x++) to[x] = (uint8_t)(line[x] - above[x]);
}

static void filter_average(const uint8_t *line, const uint8_t *above, size_t count, size_t step,
                           uint8_t *restrict to) {
    const uint8_t *before = line - step;
    for (size_t x = 0; x < count; x++) to[x] = (uint8_t)(line[x] - (before[x] + above[x]) / 2);
}

/* The one of the three neighbors that is nearest to left + above - corner. */
static void filter_paeth(const uint8_t *line, const uint8_t *above, size_t count, size_t step,
                         uint8_t *restrict to) {
    const uint8_t *before = line - step, *corner = above - step;
    for (size_t x = 0; x < count; x++) {
        int16_t a = before[x], b = above[x], c = corner[x];
        int16_t left = (int16_t)abs(b - c), up = (int16_t)abs(a - c);
        int16_t both = (int16_t)abs(a + b - 2 * c);
        int16_t other = up <= both ? b : c;
        to[x] = (uint8_t)(line[x] - (left <= up && left <= both ? a : other));
    }
}

static filter_fn *const filters[] = {filter_none, filter_sub, filter_up, filter_average,
                                     filter_paeth};
enum { FILTERS = sizeof filters / sizeof *filters };

/* How much is left, each byte taken as a number around 0. */
static uint64_t size_of(const uint8_t *line, size_t count) {
    uint64_t sum = 0;
    for (size_t x = 0; x < count; x++) sum += (uint64_t)abs((int8_t)line[x]);
    return sum;
}

/* ---- Lines ---- */

/* Lines as they are deflated, each after the number of its filter, and room to make them. */
typedef struct lines {
    size_t count, step;        /* bytes of a line and of a pixel */
    uint8_t *two;              /* [2][step + count]: the one that is made, and the one before */
    uint8_t *filtered;         /* [FILTERS][count] */
    uint8_t *all, *packed;     /* [lines][1 + count] */
    size_t bytes, packed_room; /* of these */
} lines;

static bool make_lines(const wf_picture_out *p, struct libdeflate_compressor *how, lines *l) {
    size_t step = (size_t)p->channels * (p->bits > 8 ? 2 : 1);
    *l = (lines){.count = step * (size_t)p->width_px, .step = step};
    l->bytes = (1 + l->count) * (size_t)p->lines;
    l->packed_room = libdeflate_zlib_compress_bound(how, l->bytes);
    l->two = calloc(2, step + l->count);
    l->filtered = malloc(FILTERS * l->count);
    l->all = malloc(l->bytes);
    l->packed = malloc(l->packed_room);
    return l->two && l->filtered && l->all && l->packed;
}

static void free_lines(lines *l) {
    free(l->two);
    free(l->filtered);
    free(l->all);
    free(l->packed);
}

static void gather(const wf_picture_out *p, int y, uint8_t *to) {
    size_t channels = (size_t)p->channels, width = (size_t)p->width_px;
    for (size_t c = 0; c < channels; c++) {
        const uint16_t *code = p->plane[c];
        code += (size_t)y * p->line_stride[c];
        for (size_t x = 0; p->bits <= 8 && x < width; x++)
            to[channels * x + c] = (uint8_t)code[x];
        for (size_t x = 0; p->bits > 8 && x < width; x++) {
            to[2 * (channels * x + c)] = (uint8_t)(code[x] >> 8);
            to[2 * (channels * x + c) + 1] = (uint8_t)code[x];
        }
    }
}

/* Of all filters the one that leaves least. */
static void filter_line(lines *l, const uint8_t *line, const uint8_t *above, uint8_t *to) {
    int best = 0;
    uint64_t least = UINT64_MAX;
    for (int f = 0; f < FILTERS; f++) {
        uint8_t *made = l->filtered + (size_t)f * l->count;
        filters[f](line, above, l->count, l->step, made);
        uint64_t size = size_of(made, l->count);
        if (size < least) least = size, best = f;
    }
    to[0] = (uint8_t)best;
    memcpy(to + 1, l->filtered + (size_t)best * l->count, l->count);
}

static void filter_lines(const wf_picture_out *p, lines *l) {
    uint8_t *even = l->two + l->step, *odd = even + l->count + l->step;
    for (int y = 0; y < p->lines; y++) {
        uint8_t *line = y % 2 ? odd : even, *above = y % 2 ? even : odd;
        gather(p, y, line);
        filter_line(l, line, above, l->all + (size_t)y * (1 + l->count));
    }
}

static void put_picture(output *o, const uint8_t *packed, size_t bytes) {
    for (size_t at = 0; at < bytes; at += CHUNK_BYTES)
        put_chunk(o, "IDAT", packed + at, bytes - at < CHUNK_BYTES ? bytes - at : CHUNK_BYTES);
}

/* ---- Pictures ---- */

static void put_file(output *o, const wf_picture_out *p, const uint8_t *packed, size_t bytes) {
    put(o, "\x89PNG\r\n\x1a\n", 8);
    put_header(o, p);
    put_colors(o, p);
    put_place(o);
    put_density(o, p);
    put_words(o, p);
    put_picture(o, packed, bytes);
    put_chunk(o, "IEND", NULL, 0);
}

weft_status wf_png_encode(const wf_picture_out *picture, wf_bytes_fn *write, void *user,
                          weft_error *err) {
    output o = {write, user, err, WEFT_OK};
    lines l = {.count = 0};
    struct libdeflate_compressor *how = libdeflate_alloc_compressor(DEFLATE_LEVEL);
    if (how && make_lines(picture, how, &l)) {
        filter_lines(picture, &l);
        size_t bytes = libdeflate_zlib_compress(how, l.all, l.bytes, l.packed, l.packed_room);
        put_file(&o, picture, l.packed, bytes);
    } else {
        o.status = wf_fail(err, WEFT_NO_MEMORY, "no memory to encode it as PNG");
    }
    if (how) libdeflate_free_compressor(how);
    free_lines(&l);
    return o.status;
}
