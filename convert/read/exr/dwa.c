/* DWA: a chunk's header, and its four streams. */
#include "convert/read/exr/dwa.h"

#include <libdeflate.h>
#include <stdlib.h>
#include <string.h>

#include "convert/base/reserve.h"
#include "convert/read/exr/decode.h"
#include "convert/read/exr/little.h"
#include "convert/read/exr/rle.h"

/* The header: numbers of eight bytes. Sizes are bytes, counts are of words. */
enum {
    VERSION,
    DEFLATED_BYTES,
    DEFLATED_PACKED,
    AC_PACKED,
    DC_PACKED,
    RUNS_PACKED,
    RUNS_INFLATED,
    RUNS_BYTES,
    AC_COUNT,
    DC_COUNT,
    AC_HOW,
    NUMBERS
};

enum { AC_HUFFMAN, AC_DEFLATE };

/* A chunk in hand. */
typedef struct chunk {
    wf_exr_decoder *d;
    const wf_exr_shape *shape;
    uint64_t header[NUMBERS];
    const uint8_t *deflated, *ac, *dc, *runs; /* packed */
    wf_dwa_plan plan;
    wf_dwa_streams streams;
    size_t deflated_bytes, runs_bytes, blocks; /* that the channels of each way have */
} chunk;

/* ---- Header ---- */

/* Finds the streams in what follows the header and the rules. */
static const char *find_streams(chunk *k, const uint8_t *next, size_t left) {
    static const int order[4] = {DEFLATED_PACKED, AC_PACKED, DC_PACKED, RUNS_PACKED};
    const uint8_t **stream[4] = {&k->deflated, &k->ac, &k->dc, &k->runs};
    for (int i = 0; i < 4; i++) {
        if (k->header[order[i]] > left) return "its streams are cut off";
        *stream[i] = next;
        next += k->header[order[i]];
        left -= (size_t)k->header[order[i]];
    }
    return NULL;
}

/* Reads the header and settles what way each channel went; `memory` is the plan's. */
static const char *read_header(chunk *k, const uint8_t *packed, size_t size, void *memory) {
    const size_t before = 8 * NUMBERS;
    if (size < before) return "its header is cut off";
    for (int i = 0; i < NUMBERS; i++) k->header[i] = wf_little64(packed + 8 * i);
    if (k->header[VERSION] > 2) return "it is of a version of DWA that weft does not know";
    const uint8_t *rules = NULL, *next = packed + before;
    size_t rule_bytes = 0;
    if (k->header[VERSION] == 2) {
        rule_bytes = size < before + 2 ? 0 : wf_little16(next);
        if (rule_bytes < 2 || rule_bytes > size - before) return "its rules are cut off";
        rules = next + 2;
    }
    const char *wrong =
        wf_dwa_plan_make(&k->plan, memory, k->shape, rules, rules ? rule_bytes - 2 : 0);
    return wrong ? wrong : find_streams(k, next + rule_bytes, size - before - rule_bytes);
}

static void measure(chunk *k) {
    for (int i = 0; i < k->shape->channels; i++) {
        const wf_exr_channel *c = &k->shape->channel[i];
        if (k->plan.way[i] == WF_DWA_LOSSY)
            k->blocks += wf_dwa_blocks(c->width) * wf_dwa_blocks(c->lines);
        else if (k->plan.way[i] == WF_DWA_RUNS)
            k->runs_bytes += c->plane_bytes;
        else
            k->deflated_bytes += c->plane_bytes;
    }
}

/* A block has 63 coefficients after its first, and runs of zeros only make fewer words. */
static const char *check_sizes(const chunk *k) {
    const uint64_t *h = k->header;
    if ((k->deflated_bytes && h[DEFLATED_BYTES] != k->deflated_bytes) ||
        (k->runs_bytes && h[RUNS_BYTES] != k->runs_bytes) ||
        h[RUNS_INFLATED] > 2 * k->runs_bytes || h[AC_COUNT] > 63 * k->blocks ||
        h[DC_COUNT] != k->blocks)
        return "its streams are not of the size of its channels";
    return h[AC_HOW] > AC_DEFLATE
               ? "its coefficients are packed in a way that weft does not know"
               : NULL;
}

/* ---- Streams ---- */

static bool inflate(const chunk *k, const uint8_t *packed, uint64_t size, void *to,
                    size_t bytes) {
    return !bytes || libdeflate_zlib_decompress(k->d->inflate, packed, (size_t)size, to, bytes,
                                                NULL) == LIBDEFLATE_SUCCESS;
}

static const char *expand_ac(chunk *k, uint16_t *to) {
    const uint64_t *h = k->header;
    size_t words = (size_t)h[AC_COUNT];
    k->streams.ac = to;
    k->streams.ac_end = to + words;
    if (!words) return NULL;
    if (h[AC_HOW] == AC_DEFLATE)
        return inflate(k, k->ac, h[AC_PACKED], to, 2 * words)
                   ? NULL
                   : "its coefficients do not inflate to their size";
    wf_huffman_stream stream = {.word = to, .words = words};
    const char *wrong = wf_huffman_open(k->d->codes, k->ac, (size_t)h[AC_PACKED], &stream);
    if (wrong) return wrong;
    return k->d->huffman->decode(&stream) ? NULL
                                          : "its codes do not become as many words as it says";
}

static const char *expand_others(chunk *k, uint16_t *dc, uint8_t *deflated, uint8_t *runs,
                                 uint8_t *spare) {
    const uint64_t *h = k->header;
    k->streams.dc = dc;
    k->streams.deflated = deflated;
    k->streams.runs = runs;
    if (!inflate(k, k->dc, h[DC_PACKED], spare, 2 * k->blocks))
        return "its first coefficients do not inflate to their size";
    if (k->blocks) k->d->unzip->merge((uint8_t *)dc, spare, 2 * k->blocks);
    if (!inflate(k, k->deflated, h[DEFLATED_PACKED], deflated, k->deflated_bytes))
        return "its deflated channels do not inflate to their size";
    if (!k->runs_bytes) return NULL;
    size_t inflated = (size_t)h[RUNS_INFLATED];
    if (!inflate(k, k->runs, h[RUNS_PACKED], spare, inflated) ||
        !wf_exr_expand_runs(spare, inflated, runs, k->runs_bytes))
        return "its runs do not expand to their size";
    return NULL;
}

static size_t padded(size_t bytes) {
    return (bytes + 63) / 64 * 64;
}

/* All streams expanded, in one block of memory. */
static weft_status expand(chunk *k, weft_error *err) {
    wf_exr_decoder *d = k->d;
    size_t ac = padded(2 * (size_t)k->header[AC_COUNT]), dc = padded(2 * k->blocks);
    size_t deflated = padded(k->deflated_bytes), runs = padded(k->runs_bytes);
    size_t spare = 2 * (k->blocks > k->runs_bytes ? k->blocks : k->runs_bytes);
    if (!wf_reserve(&d->inflated, &d->inflated_capacity, ac + dc + deflated + runs + spare))
        return wf_exr_no_memory(err);
    uint8_t *at = d->inflated;
    const char *wrong = expand_ac(k, (uint16_t *)(void *)at);
    if (!wrong)
        wrong = expand_others(k, (uint16_t *)(void *)(at + ac), at + ac + dc,
                              at + ac + dc + deflated, at + ac + dc + deflated + runs);
    return wrong ? wf_fail(err, WEFT_FAILED, "%s", wrong) : WEFT_OK;
}

/* ---- Lines ---- */

static void find_lines(const wf_exr_shape *shape, uint8_t *out, const wf_dwa_lines *lines) {
    size_t count = 0;
    for (int i = 0; i < shape->channels; i++) {
        lines->first[i] = count;
        count += shape->channel[i].lines;
    }
    for (int y = 0; y < shape->lines; y++)
        for (int i = 0; i < shape->channels; i++) {
            const wf_exr_channel *c = &shape->channel[i];
            if (!wf_exr_has_line(c, shape->y0 + y)) continue;
            lines->line[lines->first[i] + (size_t)(y / c->down)] = out;
            out += c->line_bytes;
        }
}

/* Bytes of samples lie apart: first those that are the lowest, of all samples. */
static void put_runs(const wf_exr_channel *c, uint8_t *const *line, const uint8_t *from) {
    size_t samples = c->width * c->lines;
    for (size_t y = 0; y < c->lines; y++, from += c->width)
        for (size_t x = 0; x < c->width; x++)
            for (size_t b = 0; b < c->bytes; b++)
                line[y][x * c->bytes + b] = from[b * samples + x];
}

static void put_others(chunk *k, const wf_dwa_lines *lines) {
    wf_dwa_streams *s = &k->streams;
    for (int i = 0; i < k->shape->channels; i++) {
        const wf_exr_channel *c = &k->shape->channel[i];
        uint8_t *const *line = lines->line + lines->first[i];
        if (k->plan.way[i] == WF_DWA_RUNS) {
            put_runs(c, line, s->runs);
            s->runs += c->plane_bytes;
        } else if (k->plan.way[i] == WF_DWA_DEFLATED) {
            for (size_t y = 0; y < c->lines; y++, s->deflated += c->line_bytes)
                memcpy(line[y], s->deflated, c->line_bytes);
        }
    }
}

/* ---- A chunk ---- */

static bool prepare(wf_exr_decoder *d, const wf_exr_shape *shape, wf_dwa_lines *lines,
                    void **plan) {
    size_t count = 0, channels = (size_t)shape->channels;
    for (size_t i = 0; i < channels; i++) count += shape->channel[i].lines;
    if (!d->codes) d->codes = malloc(sizeof *d->codes);
    if (!d->linear) {
        d->linear = malloc(65536 * sizeof *d->linear);
        if (d->linear) wf_dwa_make_linear(d->linear);
    }
    if (!d->codes || !d->linear ||
        !wf_reserve(&d->words, &d->words_capacity,
                    count * sizeof *lines->line + channels * sizeof *lines->first +
                        wf_dwa_plan_bytes(shape->channels)))
        return false;
    lines->line = (uint8_t **)(void *)d->words;
    lines->first = (size_t *)(lines->line + count);
    *plan = lines->first + channels;
    return true;
}

weft_status wf_exr_decode_dwa(wf_exr_decoder *d, const wf_exr_shape *shape,
                              const uint8_t *packed, size_t size, uint8_t *out,
                              weft_error *err) {
    chunk k = {.d = d, .shape = shape};
    wf_dwa_lines lines;
    void *plan;
    if (!prepare(d, shape, &lines, &plan)) return wf_exr_no_memory(err);
    const char *wrong = read_header(&k, packed, size, plan);
    if (!wrong) {
        measure(&k);
        wrong = check_sizes(&k);
    }
    if (wrong) return wf_fail(err, WEFT_FAILED, "%s", wrong);
    weft_status status = expand(&k, err);
    if (status) return status;
    k.streams.linear = d->linear;
    find_lines(shape, out, &lines);
    put_others(&k, &lines);
    if (!wf_dwa_decode_lossy(shape, &k.plan, &k.streams, &lines))
        return wf_fail(err, WEFT_FAILED, "coefficients of its blocks are missing");
    d->suspect = true;
    return WEFT_OK;
}
