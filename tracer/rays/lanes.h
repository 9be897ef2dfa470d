#ifndef WF_TRACER_RAYS_LANES_H
#define WF_TRACER_RAYS_LANES_H

#include <stdint.h>

#if defined(__AVX512F__)
#include <immintrin.h>
#endif

/* Eight doubles side by side, for *_isa.c, whatever the instruction set makes of them. */

typedef double lanes __attribute__((vector_size(64), may_alias));
typedef int64_t lane_mask __attribute__((vector_size(64), may_alias));

/* Vectors are passed between functions of this file only, which are inlined. */
#pragma GCC diagnostic ignored "-Wpsabi"

#if defined(__AVX512F__)
static inline lanes larger(lanes a, lanes b) {
    return (lanes)_mm512_max_pd((__m512d)a, (__m512d)b);
}

static inline lanes smaller(lanes a, lanes b) {
    return (lanes)_mm512_min_pd((__m512d)a, (__m512d)b);
}

static inline unsigned not_over(lanes a, lanes b) {
    return _mm512_cmp_pd_mask((__m512d)a, (__m512d)b, _CMP_LE_OQ);
}
#else
/* b where a is no number, as the processor's own maximum is. */
static inline lanes larger(lanes a, lanes b) {
    lane_mask over = a > b;
    return (lanes)(((lane_mask)a & over) | ((lane_mask)b & ~over));
}

static inline lanes smaller(lanes a, lanes b) {
    lane_mask under = a < b;
    return (lanes)(((lane_mask)a & under) | ((lane_mask)b & ~under));
}

/* A bit for each lane where a <= b. */
static inline unsigned not_over(lanes a, lanes b) {
    lane_mask mask = a <= b;
    unsigned bits = 0;
    for (unsigned k = 0; k < 8; k++) bits |= (unsigned)mask[k] & 1u << k;
    return bits;
}
#endif

static inline lanes of(double v) {
    return v - (lanes){0};
}

#endif
