/* The inverse cosine transform of DWA's blocks, and what follows it.
 *
 * Along a row every coefficient is spread and multiplied by a column of the matrix, so that no
 * sum runs across a vector; down columns rows are the vectors. */
#include "convert/read/exr/dct.h"

#include <stddef.h>
#if defined(__F16C__)
#include <immintrin.h>
#endif

#include "convert/read/exr/half.h"
#include "filters/base/isa_file.h"

/* Halves of the cosines of pi/4, pi/16, pi/8, 3pi/16, 5pi/16, 3pi/8 and 7pi/16, as OpenEXR
 * rounds them. */
#define A 3.535536e-01f
#define B 4.903927e-01f
#define C 4.619398e-01f
#define D 4.157349e-01f
#define E 2.777855e-01f
#define F 1.913422e-01f
#define G 9.754573e-02f

typedef struct row {
    float v[8];
} row;

/* What one coefficient adds to the eight samples of its row. */
static const row even_column[4] = {{{A, A, A, A, A, A, A, A}},
                                   {{C, F, -F, -C, -C, -F, F, C}},
                                   {{A, -A, -A, A, A, -A, -A, A}},
                                   {{F, -C, C, -F, -F, C, -C, F}}};
static const row odd_column[4] = {{{B, D, E, G, -G, -E, -D, -B}},
                                  {{D, -G, -B, -E, E, B, G, -D}},
                                  {{E, -B, G, D, -D, -G, B, -E}},
                                  {{G, -E, D, -B, B, -D, E, -G}}};

#if defined(__F16C__)

static inline void floats_of_halves(float *to, const uint16_t *from) {
    _mm256_storeu_ps(to, _mm256_cvtph_ps(_mm_loadu_si128((const __m128i *)from)));
}
static inline void halves_of_floats(uint16_t *to, const float *from) {
    __m128i half = _mm256_cvtps_ph(_mm256_loadu_ps(from), _MM_FROUND_TO_NEAREST_INT);
    _mm_storeu_si128((__m128i *)to, half);
}

#else

static inline void floats_of_halves(float *to, const uint16_t *from) {
    for (size_t i = 0; i < 8; i++) to[i] = wf_float_of_half(from[i]);
}
static inline void halves_of_floats(uint16_t *to, const float *from) {
    for (size_t i = 0; i < 8; i++) to[i] = wf_half_of_float(from[i]);
}

#endif

static inline void along(const float *x, float *out) {
    const row *e = even_column, *o = odd_column;
    for (size_t i = 0; i < 8; i++)
        out[i] =
            ((x[0] * e[0].v[i] + x[2] * e[1].v[i]) + (x[4] * e[2].v[i] + x[6] * e[3].v[i])) +
            ((x[1] * o[0].v[i] + x[3] * o[1].v[i]) + (x[5] * o[2].v[i] + x[7] * o[3].v[i]));
}

static inline void down(const float (*r)[8], float *out) {
    for (size_t i = 0; i < 8; i++) {
        float sum = A * r[0][i] + A * r[4][i], difference = A * r[0][i] - A * r[4][i];
        float q = C * r[2][i] + F * r[6][i], s = F * r[2][i] - C * r[6][i];
        float e[4] = {sum + q, difference + s, difference - s, sum - q};
        float o[4] = {(B * r[1][i] + D * r[3][i]) + (E * r[5][i] + G * r[7][i]),
                      (D * r[1][i] - (G * r[3][i] + B * r[5][i])) - E * r[7][i],
                      ((E * r[1][i] - B * r[3][i]) + G * r[5][i]) + D * r[7][i],
                      (G * r[1][i] + D * r[5][i]) - (E * r[3][i] + B * r[7][i])};
        for (size_t k = 0; k < 4; k++) {
            out[8 * k + i] = e[k] + o[k];
            out[8 * (7 - k) + i] = e[k] - o[k];
        }
    }
}

static void inverse(const uint16_t *coefficient, int rows, float *sample) {
    float r[8][8] = {{0}}, x[8];
    for (int y = 0; y < rows; y++) {
        floats_of_halves(x, coefficient + 8 * y);
        along(x, r[y]);
    }
    down((const float(*)[8])r, sample);
}

static void rgb(float *y, float *cb, float *cr) {
    for (size_t i = 0; i < 64; i++) {
        float luma = y[i], blue = cb[i], red = cr[i];
        y[i] = luma + red * 1.5747f;
        cb[i] = (blue * -0.1873f + luma) + red * -0.4682f;
        cr[i] = blue * 1.8556f + luma;
    }
}

static void halves(uint16_t *to, const float *from) {
    for (size_t i = 0; i < 64; i += 8) halves_of_floats(to + i, from + i);
}

const wf_dct_ops WF_ISA_TABLE(wf_dct_ops) = {
    .inverse = inverse,
    .rgb = rgb,
    .halves = halves,
};
