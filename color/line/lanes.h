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
