/* One step of PIZ's wavelet, and what comes before and after all of them.
 *
 * Down columns neighbors lie in different lines, so whole lines are one operation. Along lines
 * the pair is the two halves of a word of 32 bits, and both results are put together there. */
#include "convert/read/exr/wavelet.h"

#include <string.h>

#include "filters/base/isa_file.h"

/* The two that a low result l and a high one h were made of: a where l is, b where h is. */
static inline void undo_one(uint16_t l, uint16_t h, uint16_t *a, uint16_t *b, bool narrow) {
    if (narrow) { /* l = (a + b) >> 1, h = a - b, of numbers with signs */
        *a = (uint16_t)(l + (h & 1) + (uint16_t)((int16_t)h >> 1));
        *b = (uint16_t)(*a - h);
    } else { /* the same modulo 2^16, with 2^15 added to the one that became a */
        *b = (uint16_t)(l - (h >> 1));
        *a = (uint16_t)(h + *b - 0x8000);
    }
}

/* ---- Vectors ---- */

#if defined(__AVX512BW__)
#include <immintrin.h>

#define WORDS 32
typedef __m512i block;

static inline block load(const uint16_t *from) {
    return _mm512_loadu_si512(from);
}
static inline void store(uint16_t *to, block x) {
    _mm512_storeu_si512(to, x);
}
static inline block add(block a, block b) {
    return _mm512_add_epi16(a, b);
}
static inline block sub(block a, block b) {
    return _mm512_sub_epi16(a, b);
}
static inline block spread(int word) {
    return _mm512_set1_epi16((short)word);
}
static inline block low_bit(block x) {
    return _mm512_and_si512(x, _mm512_set1_epi16(1));
}
static inline block halve_signed(block x) {
    return _mm512_srai_epi16(x, 1);
}
static inline block halve(block x) {
    return _mm512_srli_epi16(x, 1);
}
static inline block down(block x) { /* what is at odd words to even ones, others 0 */
    return _mm512_srli_epi32(x, 16);
}
static inline block up(block x) {
    return _mm512_slli_epi32(x, 16);
}
static inline block mix(block even, block odd) {
    return _mm512_mask_blend_epi16(0xaaaaaaaa, even, odd);
}
static inline block widen(const uint16_t *from) {
    return _mm512_cvtepu16_epi32(_mm256_loadu_si256((const __m256i *)from));
}
static inline void store_evens(uint16_t *to, block x) {
    _mm256_storeu_si256((__m256i *)to, _mm512_cvtepi32_epi16(x));
}

#elif defined(__AVX2__)
#include <immintrin.h>

#define WORDS 16
typedef __m256i block;

static inline block load(const uint16_t *from) {
    return _mm256_loadu_si256((const block *)from);
}
static inline void store(uint16_t *to, block x) {
    _mm256_storeu_si256((block *)to, x);
}
static inline block add(block a, block b) {
    return _mm256_add_epi16(a, b);
}
static inline block sub(block a, block b) {
    return _mm256_sub_epi16(a, b);
}
static inline block spread(int word) {
    return _mm256_set1_epi16((short)word);
}
static inline block low_bit(block x) {
    return _mm256_and_si256(x, _mm256_set1_epi16(1));
}
static inline block halve_signed(block x) {
    return _mm256_srai_epi16(x, 1);
}
static inline block halve(block x) {
    return _mm256_srli_epi16(x, 1);
}
static inline block down(block x) { /* what is at odd words to even ones, others 0 */
    return _mm256_srli_epi32(x, 16);
}
static inline block up(block x) {
    return _mm256_slli_epi32(x, 16);
}
static inline block mix(block even, block odd) {
    return _mm256_blend_epi16(even, odd, 0xaa);
}
static inline block widen(const uint16_t *from) {
    return _mm256_cvtepu16_epi32(_mm_loadu_si128((const __m128i *)from));
}
static inline void store_evens(uint16_t *to, block x) {
    block low = _mm256_and_si256(x, _mm256_set1_epi32(0xffff));
    block packed = _mm256_permute4x64_epi64(_mm256_packus_epi32(low, low), 0x08);
    _mm_storeu_si128((__m128i *)to, _mm256_castsi256_si128(packed));
}

#elif defined(__SSE2__)
#include <emmintrin.h>

#define WORDS 8
typedef __m128i block;

static inline block load(const uint16_t *from) {
    return _mm_loadu_si128((const block *)from);
}
static inline void store(uint16_t *to, block x) {
    _mm_storeu_si128((block *)to, x);
}
static inline block add(block a, block b) {
    return _mm_add_epi16(a, b);
}
static inline block sub(block a, block b) {
    return _mm_sub_epi16(a, b);
}
static inline block spread(int word) {
    return _mm_set1_epi16((short)word);
}
static inline block low_bit(block x) {
    return _mm_and_si128(x, _mm_set1_epi16(1));
}
static inline block halve_signed(block x) {
    return _mm_srai_epi16(x, 1);
}
static inline block halve(block x) {
    return _mm_srli_epi16(x, 1);
}
static inline block down(block x) { /* what is at odd words to even ones, others 0 */
    return _mm_srli_epi32(x, 16);
}
static inline block up(block x) {
    return _mm_slli_epi32(x, 16);
}
static inline block mix(block even, block odd) {
    const block evens = _mm_set1_epi32(0xffff);
    return _mm_or_si128(_mm_and_si128(evens, even), _mm_andnot_si128(evens, odd));
}
static inline block widen(const uint16_t *from) {
    return _mm_unpacklo_epi16(_mm_loadl_epi64((const block *)from), _mm_setzero_si128());
}
static inline void store_evens(uint16_t *to, block x) {
    /* With signs, since there is no packing without before SSE4.1. */
    block low = _mm_srai_epi32(_mm_slli_epi32(x, 16), 16);
    _mm_storel_epi64((block *)to, _mm_packs_epi32(low, low));
}

#endif

#if defined(WORDS)

static inline void undo_words(block l, block h, block *a, block *b, bool narrow) {
    if (narrow) {
        *a = add(add(l, low_bit(h)), halve_signed(h));
        *b = sub(*a, h);
    } else {
        *b = sub(l, halve(h));
        *a = sub(add(h, *b), spread(0x8000));
    }
}

/* Pairs within words of 32 bits: l in the lower half, h in the upper one. */
static inline block undo_pairs(block x, bool narrow) {
    block a, b;
    undo_words(x, down(x), &a, &b, narrow);
    return mix(a, up(b));
}

/* Two lines at columns first .. end, as far as whole blocks go; returns where they end. */
static inline size_t undo_lines_in_blocks(uint16_t *top, uint16_t *bottom, const uint16_t *mean,
                                          size_t width, bool narrow) {
    size_t x = 0;
    for (; x + WORDS <= width; x += WORDS) {
        block low = mix(widen(mean + x / 2), load(top + x)), a, b;
        undo_words(low, load(bottom + x), &a, &b, narrow);
        store(top + x, undo_pairs(a, narrow));
        store(bottom + x, undo_pairs(b, narrow));
    }
    return x;
}

static size_t evens_in_blocks(uint16_t *to, const uint16_t *from, size_t count) {
    size_t i = 0;
    for (; i + WORDS / 2 <= count; i += WORDS / 2) store_evens(to + i, load(from + 2 * i));
    return i;
}

#else

static inline size_t undo_lines_in_blocks(uint16_t *top, uint16_t *bottom, const uint16_t *mean,
                                          size_t width, bool narrow) {
    (void)top, (void)bottom, (void)mean, (void)width, (void)narrow;
    return 0;
}

static size_t evens_in_blocks(uint16_t *to, const uint16_t *from, size_t count) {
    (void)to, (void)from, (void)count;
    return 0;
}

#endif

/* ---- A step ---- */

static inline void undo_lines(uint16_t *top, uint16_t *bottom, const uint16_t *mean,
                              size_t width, bool narrow) {
    size_t x = undo_lines_in_blocks(top, bottom, mean, width, narrow);
    for (; x + 2 <= width; x += 2) {
        uint16_t a, b, c, d;
        undo_one(mean[x / 2], bottom[x], &a, &b, narrow);
        undo_one(top[x + 1], bottom[x + 1], &c, &d, narrow);
        undo_one(a, c, &top[x], &top[x + 1], narrow);
        undo_one(b, d, &bottom[x], &bottom[x + 1], narrow);
    }
    if (x < width) undo_one(top[x], bottom[x], &top[x], &bottom[x], narrow);
}

static inline void undo_plane(uint16_t *high, size_t stride, size_t width, size_t lines,
                              const uint16_t *mean, bool narrow) {
    size_t y = 0;
    for (; y + 2 <= lines; y += 2)
        undo_lines(high + y * stride, high + (y + 1) * stride, mean + y / 2 * (width / 2),
                   width, narrow);
    uint16_t *last = high + y * stride;
    for (size_t x = 0; y < lines && x + 2 <= width; x += 2)
        undo_one(last[x], last[x + 1], &last[x], &last[x + 1], narrow);
}

static void undo(uint16_t *high, size_t stride, size_t width, size_t lines,
                 const uint16_t *mean, bool narrow) {
    if (narrow)
        undo_plane(high, stride, width, lines, mean, true);
    else
        undo_plane(high, stride, width, lines, mean, false);
}

static void evens(uint16_t *to, const uint16_t *from, size_t count) {
    for (size_t i = evens_in_blocks(to, from, count); i < count; i++) to[i] = from[2 * i];
}

static void look_up(uint8_t *to, const uint16_t *from, const uint16_t *table, size_t count) {
    for (size_t i = 0; i < count; i++) memcpy(to + 2 * i, table + from[i], 2);
}

const wf_wavelet_ops WF_ISA_TABLE(wf_wavelet_ops) = {
    .undo = undo,
    .evens = evens,
    .look_up = look_up,
};
