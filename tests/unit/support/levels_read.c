/* What is undone of the compressions of EXR, for test_isa.c. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "convert/read/exr/dct.h"
#include "convert/read/exr/half.h"
#include "convert/read/exr/huffman.h"
#include "convert/read/exr/unzip.h"
#include "convert/read/exr/wavelet.h"
#include "tests/unit/support/levels.h"

static void keep_answer(level_run *r, bool answer) {
    level_keep_bytes(r, &(uint8_t){answer}, 1);
}

/* OpenEXR's words: running sums of what was inflated, then even and odd bytes in turn. */
static bool merge_plainly(uint8_t *out, uint8_t *byte, size_t count) {
    size_t evens = (count + 1) / 2;
    bool odd = false;
    for (size_t i = 1; i < count; i++) byte[i] = (uint8_t)(byte[i] + byte[i - 1] - 128);
    for (size_t i = 0; i < count; i++) out[i] = byte[i % 2 ? evens + i / 2 : i / 2];
    for (size_t i = 1; i < count; i += 2) odd |= (out[i] & 0x7c) == 0x7c;
    return odd;
}

/* Half of the input is of finite halves, so that both answers come up. */
static void merge(level_run *r) {
    uint8_t *in = level_bytes(r, r->count), *out = level_bytes(r, r->count);
    bool tame = level_draw(r) % 2;
    for (size_t i = 0; tame && i < r->count; i++) in[i] = (uint8_t)(i ? 128 + i % 64 / 63 : 1);
    bool odd = r->plain ? merge_plainly(out, in, r->count)
                        : wf_unzip_ops_at(r->level)->merge(out, in, r->count);
    level_keep_bytes(r, out, r->count);
    keep_answer(r, odd);
}

/* At most one sample is not finite. */
static void odd_halves(level_run *r) {
    uint16_t *half = level_halves(r, r->count);
    bool odd = false, want = level_draw(r) % 2;
    size_t where = level_draw(r) % (r->count + 1);
    for (size_t i = 0; i < r->count; i++) {
        if ((half[i] & 0x7c00) == 0x7c00) half[i] = 0xfbff;
        if (want && i == where) half[i] = i % 2 ? 0xfc00 : 0x7e01;
        odd |= (half[i] & 0x7c00) == 0x7c00;
    }
    keep_answer(r, r->plain ? odd : wf_unzip_ops_at(r->level)->odd_halves(half, r->count));
}

static void odd_floats(level_run *r) {
    float *value = level_floats(r, r->count);
    bool odd = false, want = level_draw(r) % 2;
    size_t where = level_draw(r) % (r->count + 1);
    for (size_t i = 0; i < r->count; i++) {
        if (!isfinite(value[i])) value[i] = 3e38f;
        if (want && i == where) value[i] = i % 2 ? -INFINITY : NAN;
        odd |= !isfinite(value[i]);
    }
    keep_answer(r, r->plain ? odd : wf_unzip_ops_at(r->level)->odd_floats(value, r->count));
}

/* ---- Huffman codes ---- */

/* Bits that are written, the top bit of a byte first. */
typedef struct bit_writer {
    uint8_t *byte;
    size_t bits;
} bit_writer;

static void put_bits(bit_writer *w, uint32_t value, unsigned count) {
    while (count--) {
        uint8_t *to = &w->byte[w->bits / 8];
        if (w->bits % 8 == 0) *to = 0;
        *to = (uint8_t)(*to | (value >> count & 1) << (7 - w->bits % 8));
        w->bits++;
    }
}

/* Codes of 1, 2, .. n - 1 and n - 1 bits, which are 1, 01, 001 and so on, and at last 0..00. Of
 * the two longest the lower symbol is 0..00. */
typedef struct ladder {
    unsigned symbols, length[32];
    uint16_t first; /* symbol; they follow each other */
} ladder;

static ladder draw_ladder(level_run *r) {
    ladder l = {.symbols = 2 + level_draw(r) % 28, .first = (uint16_t)(level_draw(r) % 60000)};
    for (unsigned i = 0; i < l.symbols; i++) l.length[i] = i + 1 < l.symbols ? i + 1 : i;
    for (unsigned i = 0; i < l.symbols; i++) {
        unsigned j = level_draw(r) % l.symbols, swap = l.length[i];
        l.length[i] = l.length[j];
        l.length[j] = swap;
    }
    return l;
}

static void put_code(bit_writer *w, const ladder *l, unsigned symbol) {
    bool lower = false;
    for (unsigned i = symbol + 1; i < l->symbols; i++)
        lower |= l->length[i] == l->length[symbol];
    put_bits(w, !lower, l->length[symbol]);
}

static unsigned draw_symbol(level_run *r, const ladder *l) {
    unsigned length = 1;
    while (length < l->symbols - 1 && level_draw(r) % 4) length++;
    for (unsigned i = 0;; i++)
        if (l->length[i] == length) return i;
}

/* Words and how they are packed; every now and then one is repeated. */
static size_t pack_words(level_run *r, const ladder *l, uint16_t *word, bit_writer *w) {
    size_t count = 0;
    while (count < r->count) {
        size_t times = level_draw(r) % 40;
        bool run = count && level_draw(r) % 8 == 0 && times <= r->count - count;
        unsigned symbol = run ? l->symbols - 1 : draw_symbol(r, l);
        if (!run && symbol == l->symbols - 1) continue;
        put_code(w, l, symbol);
        if (run) put_bits(w, (uint32_t)times, 8);
        for (size_t i = 0; run && i < times; i++, count++) word[count] = word[count - 1];
        if (!run) word[count++] = (uint16_t)(l->first + symbol);
    }
    return count;
}

static void put_little(uint8_t *to, uint32_t value) {
    for (int i = 0; i < 4; i++) to[i] = (uint8_t)(value >> 8 * i);
}

/* A packed stream in memory that ends where it ends; what it should become goes to `word`. */
static uint8_t *draw_stream(level_run *r, uint16_t *word, size_t *size) {
    ladder l = draw_ladder(r);
    bit_writer w = {.byte = malloc(64 + 8 * r->count)};
    if (!w.byte) abort();
    memset(w.byte, 0, 20);
    put_little(w.byte, l.first);
    put_little(w.byte + 4, l.first + l.symbols - 1);
    w.bits = 8 * 20;
    for (unsigned i = 0; i < l.symbols; i++) put_bits(&w, l.length[i], 6);
    w.bits = (w.bits + 7) / 8 * 8;
    size_t before = w.bits;
    pack_words(r, &l, word, &w);
    put_little(w.byte + 12, (uint32_t)(w.bits - before));
    *size = (w.bits + 7) / 8;
    uint8_t *packed = level_buffer(r, *size);
    memcpy(packed, w.byte, *size);
    free(w.byte);
    return packed;
}

static void huffman_decode(level_run *r) {
    size_t size;
    wf_huffman_codes *codes = malloc(sizeof *codes);
    if (!codes) abort();
    uint16_t *word = level_halves(r, r->count), *made = level_halves(r, r->count);
    uint8_t *packed = draw_stream(r, word, &size);
    wf_huffman_stream stream = {.word = made, .words = r->count};
    bool good = !wf_huffman_open(codes, packed, size, &stream);
    if (!r->plain && good) good = wf_huffman_ops_at(r->level)->decode(&stream);
    level_keep_codes(r, r->plain ? word : made, r->count);
    keep_answer(r, good);
    free(codes);
}

/* ---- PIZ's wavelet ---- */

/* Numbers with signs, of 16 bits, and modulo 2^16, as the format defines them. */
static void apart(int l, int h, uint16_t *a, uint16_t *b, bool narrow) {
    if (narrow) {
        int sum = (int16_t)l + ((int16_t)h & 1) + (int)floor((int16_t)h / 2.0);
        *a = (uint16_t)sum;
        *b = (uint16_t)(sum - (int16_t)h);
    } else {
        *b = (uint16_t)(l - h / 2);
        *a = (uint16_t)(h + *b + 0x8000);
    }
}

static void undo_plainly(uint16_t *w, size_t width, size_t lines, const uint16_t *mean,
                         bool narrow) {
    for (size_t y = 0; y + 1 < lines; y += 2)
        for (size_t x = 0; x + 1 < width; x += 2)
            w[y * width + x] = mean[y / 2 * (width / 2) + x / 2];
    for (size_t y = 0; y + 1 < lines; y += 2)
        for (size_t x = 0; x < width; x++) {
            uint16_t *top = w + y * width + x;
            apart(top[0], top[width], top, top + width, narrow);
        }
    for (size_t y = 0; y < lines; y++)
        for (size_t x = 0; x + 1 < width; x += 2) {
            uint16_t *left = w + y * width + x;
            apart(left[0], left[1], left, left + 1, narrow);
        }
}

static void wavelet_undo(level_run *r) {
    size_t lines = 1 + level_draw(r) % 5, width = r->count / lines;
    bool narrow = level_draw(r) % 2;
    uint16_t *mean = level_halves(r, (width / 2) * (lines / 2));
    uint16_t *word = level_halves(r, width * lines);
    if (r->plain)
        undo_plainly(word, width, lines, mean, narrow);
    else
        wf_wavelet_ops_at(r->level)->undo(word, width, width, lines, mean, narrow);
    level_keep_codes(r, word, width * lines);
}

static void wavelet_evens(level_run *r) {
    uint16_t *from = level_halves(r, 2 * r->count), *to = level_halves(r, r->count);
    if (!r->plain) wf_wavelet_ops_at(r->level)->evens(to, from, r->count);
    for (size_t i = 0; r->plain && i < r->count; i++) to[i] = from[2 * i];
    level_keep_codes(r, to, r->count);
}

static void wavelet_look_up(level_run *r) {
    uint16_t *from = level_halves(r, r->count), *table = level_halves(r, 65536);
    uint16_t *to = level_halves(r, r->count);
    if (!r->plain) wf_wavelet_ops_at(r->level)->look_up((uint8_t *)to, from, table, r->count);
    for (size_t i = 0; r->plain && i < r->count; i++) to[i] = table[from[i]];
    level_keep_codes(r, to, r->count);
}

static const level_row unzip_rows[] = {
    {"unzip.merge", merge, true, 0},
    {"unzip.odd_halves", odd_halves, true, 0},
    {"unzip.odd_floats", odd_floats, true, 0},
};

/* ---- Blocks of DWA ---- */

/* By the definition of the transform: a sum over all coefficients of products of cosines. */
static void inverse_plainly(const double *c, float *sample) {
    for (int i = 0; i < 64; i++) {
        double sum = 0;
        for (int k = 0; k < 64; k++) {
            double scale = (k % 8 ? 1 : sqrt(0.5)) * (k / 8 ? 1 : sqrt(0.5)) / 4;
            sum += scale * c[k] * cos((2 * (i % 8) + 1) * (k % 8) * M_PI / 16) *
                   cos((2 * (i / 8) + 1) * (k / 8) * M_PI / 16);
        }
        sample[i] = (float)sum;
    }
}

static void dct_inverse(level_run *r) {
    int rows = 1 + (int)(level_draw(r) % 8);
    uint16_t *coefficient = level_halves(r, 64);
    double exact[64];
    float *sample = level_floats(r, 64);
    for (int i = 0; i < 64; i++) {
        uint16_t finite =
            (coefficient[i] & 0x7c00) >= 0x4c00 ? coefficient[i] & 0xbfff : coefficient[i];
        coefficient[i] = i < 8 * rows ? finite : 0;
        exact[i] = (double)wf_float_of_half(coefficient[i]);
    }
    if (r->plain)
        inverse_plainly(exact, sample);
    else
        wf_dct_ops_at(r->level)->inverse(coefficient, rows, sample);
    level_keep_floats(r, sample, 64);
}

static void dct_rgb(level_run *r) {
    float *ycc[3];
    for (int c = 0; c < 3; c++) ycc[c] = level_floats(r, 64);
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < 64; i++)
            ycc[c][i] = fabsf(ycc[c][i]) < 1e4f ? ycc[c][i] : (float)i; /* NaN too */
    if (!r->plain) wf_dct_ops_at(r->level)->rgb(ycc[0], ycc[1], ycc[2]);
    for (int i = 0; r->plain && i < 64; i++) {
        double y = (double)ycc[0][i], blue = (double)ycc[1][i], red = (double)ycc[2][i];
        ycc[0][i] = (float)(y + 1.5747 * red);
        ycc[1][i] = (float)(y - 0.1873 * blue - 0.4682 * red);
        ycc[2][i] = (float)(y + 1.8556 * blue);
    }
    for (int c = 0; c < 3; c++) level_keep_floats(r, ycc[c], 64);
}

/* The half that is nearest, found among all; of two the even one. */
static uint16_t nearest_half(float value) {
    uint16_t low = 0, high = 0x7c00, sign = signbit(value) ? 0x8000 : 0;
    double size = fabs((double)value);
    if (isnan(value)) return wf_half_of_float(value);
    while (high - low > 1) {
        uint16_t middle = (uint16_t)((low + high) / 2);
        if ((double)wf_float_of_half(middle) <= size)
            low = middle;
        else
            high = middle;
    }
    double below = (double)wf_float_of_half(low), above = (double)wf_float_of_half(high);
    if (high == 0x7c00) above = 65536;
    bool up = size - below > above - size || (size - below >= above - size && low % 2);
    return sign | (up ? high : low);
}

static void dct_halves(level_run *r) {
    float *from = level_floats(r, 64);
    uint16_t *to = level_halves(r, 64);
    for (int i = 0; i < 64; i += 3) from[i] *= (float)exp2(floor(level_uniform(r, -26, 15)));
    for (int i = 1; i < 64; i += 3) /* between two halves */
        from[i] = (float)(2049 + 2 * (int)(level_draw(r) % 1000)) * 0x1p-26f;
    if (!r->plain) wf_dct_ops_at(r->level)->halves(to, from);
    for (int i = 0; r->plain && i < 64; i++) to[i] = nearest_half(from[i]);
    level_keep_codes(r, to, 64);
}

static const level_row dct_rows[] = {
    {"dct.inverse", dct_inverse, true, 1e-5},
    {"dct.rgb", dct_rgb, true, 2e-7},
    {"dct.halves", dct_halves, true, 0},
};

static const level_row huffman_rows[] = {
    {"huffman.decode", huffman_decode, true, 0},
};

static const level_row wavelet_rows[] = {
    {"wavelet.undo", wavelet_undo, true, 0},
    {"wavelet.evens", wavelet_evens, true, 0},
    {"wavelet.look_up", wavelet_look_up, true, 0},
};

const level_table level_read[] = {
    LEVEL_TABLE("convert/read/exr/unzip_isa.c", wf_unzip_ops, unzip_rows),
    LEVEL_TABLE("convert/read/exr/dct_isa.c", wf_dct_ops, dct_rows),
    LEVEL_TABLE("convert/read/exr/huffman_isa.c", wf_huffman_ops, huffman_rows),
    LEVEL_TABLE("convert/read/exr/wavelet_isa.c", wf_wavelet_ops, wavelet_rows),
    {.file = NULL},
};
