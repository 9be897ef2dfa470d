/* Vectors of floats as wide as the instruction set has them: what hot loops of color/ share
 * that look things up, which compilers do not make vectors of. */
#ifndef WF_COLOR_LINE_LANES_H
#define WF_COLOR_LINE_LANES_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* For *_isa.c alone. Every lane is computed by itself, so that all levels give the same bits.
 */
#if defined(__AVX512F__)
#define LANES 16
#elif defined(__AVX2__)
#define LANES 8
#else
#define LANES 4
#endif

#if defined(__AVX512F__) || defined(__AVX2__) || defined(__SSE2__)
#include <immintrin.h>
#endif

typedef float lanes __attribute__((vector_size(4 * LANES), may_alias));
typedef int32_t whole_lanes __attribute__((vector_size(4 * LANES), may_alias));

/* Vectors are passed between functions of one file only, which are inlined. */
#pragma GCC diagnostic ignored "-Wpsabi"

static inline lanes lanes_at(const float *from) {
    lanes v;
    memcpy(&v, from, sizeof v);
    return v;
}

/* v, which is in a register from here on: without it compilers load what is used twice from
 * memory twice, and vectors that lie across two lines of the cache take their time. */
static inline lanes loaded(lanes v) {
#if defined(__AVX512F__)
    __asm__("" : "+v"(v));
#elif defined(__SSE2__)
    __asm__("" : "+x"(v));
#endif
    return v;
}

static inline void put_lanes(float *to, lanes v) {
    memcpy(to, &v, sizeof v);
}

static inline lanes lanes_of_bytes(const uint8_t *from) {
#if defined(__AVX512F__)
    return (lanes)_mm512_cvtepi32_ps(
        _mm512_cvtepu8_epi32(_mm_loadu_si128((const __m128i *)from)));
#elif defined(__AVX2__)
    return (lanes)_mm256_cvtepi32_ps(
        _mm256_cvtepu8_epi32(_mm_loadl_epi64((const __m128i *)from)));
#else
    lanes v;
    for (int i = 0; i < LANES; i++) v[i] = (float)from[i];
    return v;
#endif
}

/* The whole numbers of v, from 0 to 65535, what follows the point being left off. */
static inline void put_codes(uint16_t *to, lanes v) {
#if defined(__AVX512F__)
    __m256i codes = _mm512_cvtepi32_epi16(_mm512_cvttps_epi32((__m512)v));
    _mm256_storeu_si256((__m256i *)to, codes);
#elif defined(__AVX2__)
    __m256i whole = _mm256_cvttps_epi32((__m256)v);
    whole = _mm256_permute4x64_epi64(_mm256_packus_epi32(whole, whole), 0x08);
    _mm_storeu_si128((__m128i *)to, _mm256_castsi256_si128(whole));
#else
    for (int i = 0; i < LANES; i++) to[i] = (uint16_t)(int32_t)v[i];
#endif
}

static inline lanes lanes_of(float x) {
    return x - (lanes){0};
}

/* a > b ? a : b in each lane, which is b where a is NaN; smaller likewise. */
static inline lanes larger(lanes a, lanes b) {
#if defined(__AVX512F__)
    return (lanes)_mm512_max_ps((__m512)a, (__m512)b);
#elif defined(__AVX2__)
    return (lanes)_mm256_max_ps((__m256)a, (__m256)b);
#elif defined(__SSE2__)
    return (lanes)_mm_max_ps((__m128)a, (__m128)b);
#else
    for (int i = 0; i < LANES; i++) a[i] = a[i] > b[i] ? a[i] : b[i];
    return a;
#endif
}

static inline lanes smaller(lanes a, lanes b) {
#if defined(__AVX512F__)
    return (lanes)_mm512_min_ps((__m512)a, (__m512)b);
#elif defined(__AVX2__)
    return (lanes)_mm256_min_ps((__m256)a, (__m256)b);
#elif defined(__SSE2__)
    return (lanes)_mm_min_ps((__m128)a, (__m128)b);
#else
    for (int i = 0; i < LANES; i++) a[i] = a[i] < b[i] ? a[i] : b[i];
    return a;
#endif
}

/* x, but 0 where it is NaN. */
static inline lanes numbers(lanes x) {
#if defined(__AVX512F__)
    __mmask16 good = _mm512_cmp_ps_mask((__m512)x, (__m512)x, _CMP_ORD_Q);
    return (lanes)_mm512_maskz_mov_ps(good, (__m512)x);
#else
    return (lanes)((whole_lanes)x & (whole_lanes)(x == x));
#endif
}

/* Whether x < limit in any lane. */
static inline int any_below(lanes x, lanes limit) {
#if defined(__AVX512F__)
    return _mm512_cmp_ps_mask((__m512)x, (__m512)limit, _CMP_LT_OQ) != 0;
#elif defined(__AVX2__)
    return _mm256_movemask_ps(_mm256_cmp_ps((__m256)x, (__m256)limit, _CMP_LT_OQ)) != 0;
#elif defined(__SSE2__)
    return _mm_movemask_ps(_mm_cmplt_ps((__m128)x, (__m128)limit)) != 0;
#else
    int any = 0;
    for (int i = 0; i < LANES; i++) any |= x[i] < limit[i];
    return any;
#endif
}

/* x < limit ? below : above in each lane. */
static inline lanes by_limit(lanes x, lanes limit, lanes below, lanes above) {
#if defined(__AVX512F__)
    __mmask16 under = _mm512_cmp_ps_mask((__m512)x, (__m512)limit, _CMP_LT_OQ);
    return (lanes)_mm512_mask_blend_ps(under, (__m512)above, (__m512)below);
#elif defined(__AVX2__)
    __m256 under = _mm256_cmp_ps((__m256)x, (__m256)limit, _CMP_LT_OQ);
    return (lanes)_mm256_blendv_ps((__m256)above, (__m256)below, under);
#else
    whole_lanes under = x < limit;
    return (lanes)(((whole_lanes)below & under) | ((whole_lanes)above & ~under));
#endif
}

/* table[index] in each lane, of 16 entries. */
static inline lanes look_up_16(const float table[16], whole_lanes index) {
#if defined(__AVX512F__)
    return (lanes)_mm512_permutexvar_ps((__m512i)index, _mm512_loadu_ps(table));
#elif defined(__AVX2__)
    __m256 low = _mm256_permutevar8x32_ps(_mm256_loadu_ps(table), (__m256i)index);
    __m256 high = _mm256_permutevar8x32_ps(_mm256_loadu_ps(table + 8), (__m256i)index);
    __m256 eight = _mm256_castsi256_ps(_mm256_slli_epi32((__m256i)index, 28));
    return (lanes)_mm256_blendv_ps(low, high, eight);
#else
    lanes v;
    for (int i = 0; i < LANES; i++) v[i] = table[index[i]];
    return v;
#endif
}

/* table[index] in each lane, of 32 entries. */
static inline lanes look_up_32(const float table[32], whole_lanes index) {
#if defined(__AVX512F__)
    return (lanes)_mm512_permutex2var_ps(_mm512_loadu_ps(table), (__m512i)index,
                                         _mm512_loadu_ps(table + 16));
#elif defined(__AVX2__)
    __m256 sixteen = _mm256_castsi256_ps(_mm256_slli_epi32((__m256i)index, 27));
    return (lanes)_mm256_blendv_ps((__m256)look_up_16(table, index),
                                   (__m256)look_up_16(table + 16, index), sixteen);
#else
    lanes v;
    for (int i = 0; i < LANES; i++) v[i] = table[index[i]];
    return v;
#endif
}

#endif
