/* DWA's rounded channels: blocks of cosine coefficients become samples. */
#include <math.h>
#include <string.h>

#include "convert/read/exr/dct.h"
#include "convert/read/exr/dwa.h"
#include "convert/read/exr/half.h"

/* One channel, or three that are Y', Cb and Cr of a color, on their way. */
typedef struct plane_set {
    const wf_exr_channel *channel[3];
    uint8_t *const *line[3]; /* where each one's lines go */
    const uint16_t *dc[3];
    int count;
    const uint16_t *linear; /* NULL: samples are what was rounded */
} plane_set;

/* Where the coefficients of a block belong, in the order in which they are stored: along
 * diagonals. */
static const uint8_t place[64] = {
    0,  1,  8,  16, 9,  2,  3,  10, 17, 24, 32, 25, 18, 11, 4,  5,  12, 19, 26, 33, 40, 48,
    41, 34, 27, 20, 13, 6,  7,  14, 21, 28, 35, 42, 49, 56, 57, 50, 43, 36, 29, 22, 15, 23,
    30, 37, 44, 51, 58, 59, 52, 45, 38, 31, 39, 46, 53, 60, 61, 54, 47, 55, 62, 63};

/* How many rows of a block coefficients up to the n-th, in that order, reach. */
static const uint8_t rows_of[64] = {1, 1, 2, 3, 3, 3, 3, 3, 3, 4, 5, 5, 5, 5, 5, 5,
                                    5, 5, 5, 5, 6, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7,
                                    7, 7, 7, 8, 8, 8, 8, 8, 8, 8, 8, 8, 8, 8, 8, 8,
                                    8, 8, 8, 8, 8, 8, 8, 8, 8, 8, 8, 8, 8, 8, 8, 8};

/* Reads all coefficients of a block but the first, whose place is left; the others are 0
 * before. *last: the last that is none of a run of zeros. False at the end of the stream. */
static bool read_block(wf_dwa_streams *s, uint16_t *block, unsigned *last) {
    unsigned n = 1;
    const uint16_t *ac = s->ac;
    *last = 0;
    while (n < 64) {
        if (ac == s->ac_end) return false;
        unsigned value = *ac++, zeros = value & 0xff;
        bool run = value >= 0xff00;
        block[place[n]] = run ? 0 : (uint16_t)value;
        *last = run ? *last : n;
        n += run ? zeros ? zeros : 64 : 1;
    }
    s->ac = ac;
    return true;
}

/* The halves of a block of every channel of a set. */
static bool decode_block(const wf_dct_ops *ops, plane_set *set, wf_dwa_streams *s,
                         uint16_t half[3][64]) {
    float sample[3][64];
    for (int c = 0; c < set->count; c++) {
        uint16_t block[64] = {0};
        unsigned last;
        block[0] = *set->dc[c]++;
        if (!read_block(s, block, &last)) return false;
        ops->inverse(block, rows_of[last], sample[c]);
    }
    if (set->count == 3) ops->rgb(sample[0], sample[1], sample[2]);
    for (int c = 0; c < set->count; c++) ops->halves(half[c], sample[c]);
    return true;
}

/* Puts the part of a block that the channel covers into its lines, from column x on. */
static void put_block(const plane_set *set, int c, const uint16_t *half, size_t x, size_t y) {
    const wf_exr_channel *channel = set->channel[c];
    size_t width = channel->width - x < 8 ? channel->width - x : 8;
    size_t lines = channel->lines - y < 8 ? channel->lines - y : 8;
    for (size_t j = 0; j < lines; j++) {
        uint8_t *to = set->line[c][y + j] + x * channel->bytes;
        uint16_t value[8];
        for (size_t i = 0; i < 8; i++)
            value[i] = set->linear ? set->linear[half[8 * j + i]] : half[8 * j + i];
        if (channel->type == WF_EXR_HALF && width == 8)
            memcpy(to, value, 16);
        else if (channel->type == WF_EXR_HALF)
            memcpy(to, value, 2 * width);
        for (size_t i = 0; channel->type == WF_EXR_FLOAT && i < width; i++) {
            float wide = wf_float_of_half(value[i]);
            memcpy(to + 4 * i, &wide, sizeof wide);
        }
    }
}

static bool decode_set(const wf_dct_ops *ops, plane_set *set, wf_dwa_streams *s) {
    size_t width = set->channel[0]->width, lines = set->channel[0]->lines;
    uint16_t half[3][64];
    for (size_t y = 0; y < lines; y += 8)
        for (size_t x = 0; x < width; x += 8) {
            if (!decode_block(ops, set, s, half)) return false;
            for (int c = 0; c < set->count; c++) put_block(set, c, half[c], x, y);
        }
    return true;
}

static void add_channel(plane_set *set, const wf_exr_shape *shape, int channel,
                        wf_dwa_streams *s, const wf_dwa_lines *lines) {
    const wf_exr_channel *c = &shape->channel[channel];
    set->channel[set->count] = c;
    set->line[set->count] = lines->line + lines->first[channel];
    set->dc[set->count++] = s->dc;
    s->dc += wf_dwa_blocks(c->width) * wf_dwa_blocks(c->lines);
}

bool wf_dwa_decode_lossy(const wf_exr_shape *shape, const wf_dwa_plan *plan, wf_dwa_streams *s,
                         const wf_dwa_lines *lines) {
    const wf_dct_ops *ops = wf_dct_ops_best();
    for (int i = 0; i < plan->colors; i++) {
        plane_set set = {.linear = s->linear};
        for (int p = 0; p < 3; p++) add_channel(&set, shape, plan->color[i][p], s, lines);
        if (!decode_set(ops, &set, s)) return false;
    }
    for (int i = 0; i < shape->channels; i++) {
        if (plan->way[i] != WF_DWA_LOSSY || plan->colored[i]) continue;
        plane_set set = {.linear = shape->channel[i].linear ? NULL : s->linear};
        add_channel(&set, shape, i, s, lines);
        if (!decode_set(ops, &set, s)) return false;
    }
    return true;
}

void wf_dwa_make_linear(uint16_t *table) {
    const float base = 9.02501329156f; /* e^2.2 */
    memset(table, 0, 65536 * sizeof *table);
    for (unsigned i = 1; i < 0x7c00; i++) {
        float x = wf_float_of_half((uint16_t)i);
        table[i] = wf_half_of_float(x <= 1 ? powf(x, 2.2f) : powf(base, x - 1));
        table[i | 0x8000] = table[i] | 0x8000;
    }
}
