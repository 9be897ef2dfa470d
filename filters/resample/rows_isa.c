/* Rows of samples times weights into sums: the inner loops of the resampler. */
#include "filters/resample/rows.h"

#include "filters/base/half.h"
#include "filters/base/isa_file.h"

#if defined(__F16C__)
#include <immintrin.h>
#endif

static inline float half_value(uint16_t half) {
#if defined(__F16C__)
    return _cvtsh_ss(half);
#else
    return wf_half_value(half);
#endif
}

static void add_half(double *restrict sum, const uint16_t *restrict pixel, double weight,
                     size_t count) {
    size_t i = 0;
#if defined(__AVX512F__)
    __m512d w = _mm512_set1_pd(weight);
    for (; i + 16 <= count; i += 16) {
        __m512 value = _mm512_cvtph_ps(_mm256_loadu_si256((const __m256i *)(pixel + i)));
        __m512d low = _mm512_cvtps_pd(_mm512_castps512_ps256(value));
        __m512d high = _mm512_cvtps_pd(_mm512_extractf32x8_ps(value, 1));
        low = _mm512_add_pd(_mm512_loadu_pd(sum + i), _mm512_mul_pd(w, low));
        high = _mm512_add_pd(_mm512_loadu_pd(sum + i + 8), _mm512_mul_pd(w, high));
        _mm512_storeu_pd(sum + i, low);
        _mm512_storeu_pd(sum + i + 8, high);
    }
#elif defined(__F16C__)
    __m256d w = _mm256_set1_pd(weight);
    for (; i + 8 <= count; i += 8) {
        __m256 value = _mm256_cvtph_ps(_mm_loadu_si128((const __m128i *)(pixel + i)));
        __m256d low = _mm256_cvtps_pd(_mm256_castps256_ps128(value));
        __m256d high = _mm256_cvtps_pd(_mm256_extractf128_ps(value, 1));
        low = _mm256_add_pd(_mm256_loadu_pd(sum + i), _mm256_mul_pd(w, low));
        high = _mm256_add_pd(_mm256_loadu_pd(sum + i + 4), _mm256_mul_pd(w, high));
        _mm256_storeu_pd(sum + i, low);
        _mm256_storeu_pd(sum + i + 4, high);
    }
#endif
    for (; i < count; i++) sum[i] += weight * (double)half_value(pixel[i]);
}

/* What stays in registers while all that is to be added is added. */
typedef double doubles __attribute__((vector_size(64), aligned(8), may_alias));
typedef float floats __attribute__((vector_size(64), aligned(4), may_alias));
typedef float half_floats __attribute__((vector_size(32), aligned(4), may_alias));
enum { DOUBLES = 8, FLOATS = 16, BESIDE = 4 };

/* Vectors are passed between functions of this file only, which are inlined. */
#pragma GCC diagnostic ignored "-Wpsabi"

static inline doubles wide(const float *from) {
    return __builtin_convertvector(*(const half_floats *)from, doubles);
}

static void add_floats(double *restrict sum, bool begins, const float *const *row,
                       const double *weight, size_t rows, size_t count) {
    size_t i = 0;
    for (; i + BESIDE * DOUBLES <= count; i += BESIDE * DOUBLES) {
        doubles *to = (doubles *)(sum + i), kept[BESIDE];
        for (int b = 0; b < BESIDE; b++) kept[b] = begins ? (doubles){0} : to[b];
        for (size_t r = 0; r < rows; r++)
            for (int b = 0; b < BESIDE; b++)
                kept[b] += weight[r] * wide(row[r] + i + b * DOUBLES);
        for (int b = 0; b < BESIDE; b++) to[b] = kept[b];
    }
    for (; i < count; i++) {
        double kept = begins ? 0 : sum[i];
        for (size_t r = 0; r < rows; r++) kept += weight[r] * (double)row[r][i];
        sum[i] = kept;
    }
}

static void quick_add_floats(float *restrict sum, bool begins, const float *const *row,
                             const double *weight, size_t rows, size_t count) {
    size_t i = 0;
    for (; i + BESIDE * FLOATS <= count; i += BESIDE * FLOATS) {
        floats *to = (floats *)(sum + i), kept[BESIDE];
        for (int b = 0; b < BESIDE; b++) kept[b] = begins ? (floats){0} : to[b];
        for (size_t r = 0; r < rows; r++) {
            const floats *from = (const floats *)(row[r] + i);
            for (int b = 0; b < BESIDE; b++) kept[b] += (float)weight[r] * from[b];
        }
        for (int b = 0; b < BESIDE; b++) to[b] = kept[b];
    }
    for (; i < count; i++) {
        float kept = begins ? 0 : sum[i];
        for (size_t r = 0; r < rows; r++) kept += (float)weight[r] * row[r][i];
        sum[i] = kept;
    }
}

static void set_rows(double *restrict sum, const float *restrict a, const float *restrict b,
                     size_t count) {
    if (b)
        for (size_t i = 0; i < count; i++) sum[i] = (double)a[i] + (double)b[i];
    else
        for (size_t i = 0; i < count; i++) sum[i] = (double)a[i];
}

static void add_row(double *restrict sum, const float *restrict pixel, size_t count) {
    for (size_t i = 0; i < count; i++) sum[i] += (double)pixel[i];
}

static void add_tap(double *restrict sum, const double *restrict row, double weight,
                    size_t count) {
    for (size_t i = 0; i < count; i++) sum[i] += weight * row[i];
}

static void weave(double *restrict sum, const wf_strand *strand, size_t strands, size_t count) {
    size_t i = 0;
    for (; i + BESIDE * DOUBLES <= count; i += BESIDE * DOUBLES) {
        doubles *to = (doubles *)(sum + i), kept[BESIDE];
        for (int b = 0; b < BESIDE; b++) kept[b] = (doubles){0};
        for (size_t s = 0; s < strands; s++) {
            const doubles *from = (const doubles *)(strand[s].row + i);
            for (int b = 0; b < BESIDE; b++) kept[b] += strand[s].weight * from[b];
        }
        for (int b = 0; b < BESIDE; b++) to[b] = kept[b];
    }
    for (; i < count; i++) {
        double kept = 0;
        for (size_t s = 0; s < strands; s++) kept += strand[s].weight * strand[s].row[i];
        sum[i] = kept;
    }
}

static void quick_weave(float *restrict out, const wf_quick_strand *strand, size_t strands,
                        const float *restrict scale, size_t count) {
    size_t i = 0;
    for (; i + BESIDE * FLOATS <= count; i += BESIDE * FLOATS) {
        const floats *times = (const floats *)(scale + i);
        floats *to = (floats *)(out + i), kept[BESIDE];
        for (int b = 0; b < BESIDE; b++) kept[b] = (floats){0};
        for (size_t s = 0; s < strands; s++) {
            const floats *from = (const floats *)(strand[s].row + i);
            for (int b = 0; b < BESIDE; b++) kept[b] += strand[s].weight * from[b];
        }
        for (int b = 0; b < BESIDE; b++) to[b] = kept[b] * times[b];
    }
    for (; i < count; i++) {
        float kept = 0;
        for (size_t s = 0; s < strands; s++) kept += strand[s].weight * strand[s].row[i];
        out[i] = kept * scale[i];
    }
}

static void quick_set_rows(float *sum, const float *a, const float *b, size_t count) {
    for (size_t i = 0; i < count; i++) sum[i] = a[i] + b[i];
}

static void invert(double *row, size_t count) {
    for (size_t i = 0; i < count; i++) row[i] = 1 / row[i];
}

static void multiply(float *restrict out, const double *restrict a, const double *restrict b,
                     size_t count) {
    for (size_t i = 0; i < count; i++) out[i] = (float)(a[i] * b[i]);
}

/* Some numbers of lanes have loops of their own, of which compilers make shuffles. */
#define SPLIT(name, type)                                                                      \
    static void name(float *restrict lane, const type *restrict row, size_t lanes,             \
                     size_t lane_length, size_t count) {                                       \
        for (size_t z = 0; z < lanes; z++) {                                                   \
            float *out = lane + z * lane_length;                                               \
            size_t length = count > z ? (count - z + lanes - 1) / lanes : 0;                   \
            if (lanes == 1)                                                                    \
                for (size_t m = 0; m < length; m++) out[m] = (float)row[m];                    \
            else if (lanes == 2)                                                               \
                for (size_t m = 0; m < length; m++) out[m] = (float)row[2 * m + z];            \
            else                                                                               \
                for (size_t m = 0; m < length; m++) out[m] = (float)row[lanes * m + z];        \
            for (size_t m = length; m < lane_length; m++) out[m] = 0;                          \
        }                                                                                      \
    }
SPLIT(split, double)
SPLIT(quick_split, float)

const wf_row_ops WF_ISA_TABLE(wf_row_ops) = {
    .add_half = add_half,
    .add_floats = add_floats,
    .quick_add_floats = quick_add_floats,
    .set_rows = set_rows,
    .add_row = add_row,
    .add_tap = add_tap,
    .weave = weave,
    .quick_weave = quick_weave,
    .quick_set_rows = quick_set_rows,
    .invert = invert,
    .multiply = multiply,
    .split = split,
    .quick_split = quick_split,
};
