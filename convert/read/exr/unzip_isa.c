/* Undoes what OpenEXR's ZIP compression does to bytes before it deflates them.
 *
 * The differences of a chunk run through its even bytes and on into its odd ones:
 *     t[0] = d[0], t[i] = t[i-1] + d[i] - 128 (mod 256)
 * so t is the running sum of d, with the top bit flipped wherever i is odd. Both halves are
 * summed side by side: the sum with which the odd bytes start is found first, which costs less
 * than the second pass over memory that splitting the loop would. */
#include "convert/read/exr/unzip.h"

#include <string.h>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include "filters/base/isa_file.h"

/* Sum of bytes, modulo 256. */
static uint8_t byte_sum(const uint8_t *byte, size_t count) {
    unsigned sum = 0;
    for (size_t i = 0; i < count; i++) sum += byte[i];
    return (uint8_t)sum;
}

/* One of the two runs that are merged: its next bytes, their sum so far, and whether the index
 * in the whole of the next one is odd. */
typedef struct run {
    const uint8_t *next;
    uint8_t sum;
    bool odd;
} run;

static inline uint8_t step(run *r) {
    r->sum = (uint8_t)(r->sum + *r->next++);
    uint8_t value = (uint8_t)(r->sum ^ (r->odd ? 0x80 : 0));
    r->odd = !r->odd;
    return value;
}

/* Merges byte by byte from output byte `from` on. */
static bool merge_rest(uint8_t *out, size_t from, size_t count, run *even, run *odd) {
    bool seen = false;
    for (size_t i = from; i < count; i += 2) {
        out[i] = step(even);
        if (i + 1 >= count) break;
        out[i + 1] = step(odd);
        seen |= (out[i + 1] & 0x7c) == 0x7c;
    }
    return seen;
}

#if defined(__AVX512BW__)

#define BLOCK 64
typedef __m512i block;

/* Running sums inside 64 bytes: inside each lane of 16 by doubling shifts, then the lanes'
 * totals. */
static inline block scan(block x, block *carry) {
    x = _mm512_add_epi8(x, _mm512_bslli_epi128(x, 1));
    x = _mm512_add_epi8(x, _mm512_bslli_epi128(x, 2));
    x = _mm512_add_epi8(x, _mm512_bslli_epi128(x, 4));
    x = _mm512_add_epi8(x, _mm512_bslli_epi128(x, 8));
    const block last = _mm512_set1_epi8(15);
    block total = _mm512_shuffle_epi8(x, last);
    block one = _mm512_maskz_shuffle_i64x2(0xfc, total, total, 0x90); /* 0, T0, T1, T2 */
    block two = _mm512_maskz_shuffle_i64x2(0xf0, total, total, 0x40); /* 0, 0, T0, T1 */
    block three = _mm512_maskz_shuffle_i64x2(0xc0, total, total, 0x00);
    x = _mm512_add_epi8(
        x, _mm512_add_epi8(_mm512_add_epi8(one, two), _mm512_add_epi8(three, *carry)));
    total = _mm512_shuffle_epi8(x, last);
    *carry = _mm512_shuffle_i64x2(total, total, 0xff);
    return x;
}

static inline block load(const uint8_t *from) {
    return _mm512_loadu_si512(from);
}
static inline block spread(int byte) {
    return _mm512_set1_epi8((char)byte);
}
static inline block flips(bool odd) {
    return _mm512_set1_epi16(odd ? 0x0080 : (short)0x8000);
}
static inline block flip(block x, block which) {
    return _mm512_xor_si512(x, which);
}
static inline uint8_t last_of(block carry) {
    return (uint8_t)_mm_cvtsi128_si32(_mm512_castsi512_si128(carry));
}

/* Interleaves and stores 128 bytes; notes high bytes whose exponent bits are all set. */
static inline void put(uint8_t *out, block even, block odd, block *seen) {
    const block exponent = _mm512_set1_epi8(0x7c);
    block low = _mm512_unpacklo_epi8(even, odd), high = _mm512_unpackhi_epi8(even, odd);
    const block first = _mm512_set_epi64(11, 10, 3, 2, 9, 8, 1, 0);
    const block second = _mm512_set_epi64(15, 14, 7, 6, 13, 12, 5, 4);
    _mm512_storeu_si512(out, _mm512_permutex2var_epi64(low, first, high));
    _mm512_storeu_si512(out + 64, _mm512_permutex2var_epi64(low, second, high));
    __mmask64 hit = _mm512_cmpeq_epi8_mask(_mm512_and_si512(odd, exponent), exponent);
    *seen = _mm512_or_si512(*seen, _mm512_movm_epi8(hit));
}

static inline bool any(block seen) {
    return _mm512_test_epi8_mask(seen, seen) != 0;
}

#elif defined(__SSE2__)

#define BLOCK 16
typedef __m128i block;

static inline block last_byte(block x) {
#if defined(__SSSE3__)
    return _mm_shuffle_epi8(x, _mm_set1_epi8(15));
#else
    x = _mm_unpackhi_epi8(x, x);
    x = _mm_shufflehi_epi16(x, 0xff);
    return _mm_shuffle_epi32(x, 0xff);
#endif
}

static inline block scan(block x, block *carry) {
    x = _mm_add_epi8(x, _mm_slli_si128(x, 1));
    x = _mm_add_epi8(x, _mm_slli_si128(x, 2));
    x = _mm_add_epi8(x, _mm_slli_si128(x, 4));
    x = _mm_add_epi8(x, _mm_slli_si128(x, 8));
    x = _mm_add_epi8(x, *carry);
    *carry = last_byte(x);
    return x;
}

static inline block load(const uint8_t *from) {
    return _mm_loadu_si128((const block *)from);
}
static inline block spread(int byte) {
    return _mm_set1_epi8((char)byte);
}
static inline block flips(bool odd) {
    return _mm_set1_epi16(odd ? 0x0080 : (short)0x8000);
}
static inline block flip(block x, block which) {
    return _mm_xor_si128(x, which);
}
static inline uint8_t last_of(block carry) {
    return (uint8_t)_mm_cvtsi128_si32(carry);
}

static inline void put(uint8_t *out, block even, block odd, block *seen) {
    const block exponent = _mm_set1_epi8(0x7c);
    _mm_storeu_si128((block *)out, _mm_unpacklo_epi8(even, odd));
    _mm_storeu_si128((block *)(out + 16), _mm_unpackhi_epi8(even, odd));
    *seen = _mm_or_si128(*seen, _mm_cmpeq_epi8(_mm_and_si128(odd, exponent), exponent));
}

static inline bool any(block seen) {
    return _mm_movemask_epi8(seen) != 0;
}

#endif

#if defined(BLOCK)

/* Whole blocks of both runs; returns the output bytes written. */
static size_t merge_blocks(uint8_t *out, size_t pairs, run *even, run *odd, bool *seen) {
    block even_sum = spread(even->sum), odd_sum = spread(odd->sum), hits = spread(0);
    const block even_flips = flips(even->odd), odd_flips = flips(odd->odd);
    size_t i = 0;
    for (; i + BLOCK <= pairs; i += BLOCK) {
        block a = flip(scan(load(even->next + i), &even_sum), even_flips);
        block b = flip(scan(load(odd->next + i), &odd_sum), odd_flips);
        put(out + 2 * i, a, b, &hits);
    }
    even->next += i, odd->next += i;
    even->sum = last_of(even_sum), odd->sum = last_of(odd_sum);
    *seen = any(hits);
    return 2 * i;
}

#else

static size_t merge_blocks(uint8_t *out, size_t pairs, run *even, run *odd, bool *seen) {
    (void)out, (void)pairs, (void)even, (void)odd;
    *seen = false;
    return 0;
}

#endif

static bool merge(uint8_t *restrict out, const uint8_t *restrict inflated, size_t count) {
    size_t evens = (count + 1) / 2;
    run even = {.next = inflated};
    run odd = {inflated + evens, byte_sum(inflated, evens), evens % 2 == 1};
    bool seen;
    size_t done = merge_blocks(out, count / 2, &even, &odd, &seen);
    return merge_rest(out, done, count, &even, &odd) || seen;
}

static bool odd_halves(const uint16_t *half, size_t count) {
    uint16_t seen = 0;
    for (size_t i = 0; i < count; i++) seen |= (half[i] & 0x7c00) == 0x7c00;
    return seen;
}

static bool odd_floats(const float *value, size_t count) {
    uint32_t seen = 0;
    for (size_t i = 0; i < count; i++) {
        uint32_t bits;
        memcpy(&bits, value + i, sizeof bits);
        seen |= (bits & 0x7f800000) == 0x7f800000;
    }
    return seen;
}

const wf_unzip_ops WF_ISA_TABLE(wf_unzip_ops) = {
    .merge = merge,
    .odd_halves = odd_halves,
    .odd_floats = odd_floats,
};
