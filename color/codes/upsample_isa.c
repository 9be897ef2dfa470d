/* The inner loops from codes to R'G'B': codes to signals, sums of chroma, the matrix. */
#include "color/codes/upsample.h"

#include "color/line/lanes.h"
#include "filters/base/isa_file.h"

#include <stdbool.h>

/* ---- In float ---- */

static void signals(float *restrict signal, const uint16_t *restrict code, double zero,
                    double per_code, size_t count) {
    float whole_zero = (float)zero, scale = (float)per_code;
    for (size_t i = 0; i < count; i++) signal[i] = ((float)code[i] - whole_zero) * scale;
}

static void of_bytes(float *restrict signal, const uint8_t *restrict code, double zero,
                     double per_code, size_t count) {
    float whole_zero = (float)zero, scale = (float)per_code;
    size_t i = 0;
    for (; i + LANES <= count; i += LANES)
        put_lanes(signal + i, (lanes_of_bytes(code + i) - whole_zero) * scale);
    for (; i < count; i++) signal[i] = ((float)code[i] - whole_zero) * scale;
}

/* Vectors side by side, so that no sum waits for another, and all sums of two phases fit into
 * registers. */
#if defined(__AVX512F__)
enum { BESIDE = 4 };
#else
enum { BESIDE = 2 };
#endif

/* Adds tap[k] times sample k, of taps k, k + by, .. up to but not with `end`. */
static inline void sum_taps(lanes sum[BESIDE], const float *from, ptrdiff_t step,
                            const float *tap, int k, int end, int by) {
    for (int b = 0; b < BESIDE; b++) sum[b] = lanes_of(0);
    for (; k != end; k += by)
        for (int b = 0; b < BESIDE; b++)
            sum[b] += tap[k] * lanes_at(from + k * step + b * LANES);
}

static inline float weigh_one(const float *from, ptrdiff_t step, const wf_upsample_phase *p) {
    float before = 0, after = 0;
    for (int k = 0; k < p->middle; k++) before += p->tap[k] * from[k * step];
    for (int k = p->count - 1; k >= p->middle; k--) after += p->tap[k] * from[k * step];
    return before + after;
}

static void weigh(float *restrict out, const float *restrict chroma, ptrdiff_t step,
                  const wf_upsample_phase *phase, size_t count) {
    const float *from = chroma + phase->first * step;
    size_t i = 0;
    for (; i + BESIDE * LANES <= count; i += BESIDE * LANES) {
        lanes before[BESIDE], after[BESIDE];
        sum_taps(before, from + i, step, phase->tap, 0, phase->middle, 1);
        sum_taps(after, from + i, step, phase->tap, phase->count - 1, phase->middle - 1, -1);
        for (int b = 0; b < BESIDE; b++) put_lanes(out + i + b * LANES, after[b] + before[b]);
    }
    for (; i < count; i++) out[i] = weigh_one(from + i, step, phase);
}

/* The same of two phases, for which every sample is loaded once. */
static inline void sum_pair(lanes a[BESIDE], lanes c[BESIDE], const float *from, ptrdiff_t step,
                            const wf_upsample_phase *p, int k, int end, int by) {
    for (int b = 0; b < BESIDE; b++) a[b] = c[b] = lanes_of(0);
    for (; k != end; k += by)
        for (int b = 0; b < BESIDE; b++) {
            lanes sample = loaded(lanes_at(from + k * step + b * LANES));
            a[b] += p[0].tap[k] * sample;
            c[b] += p[1].tap[k] * sample;
        }
}

static void weigh_pair(float *const out[2], const float *chroma, ptrdiff_t step,
                       const wf_upsample_phase phase[2], size_t count) {
    const float *from = chroma + phase->first * step;
    float *even = out[0], *odd = out[1];
    int first = 0, middle = phase->middle, last = phase->count - 1;
    size_t i = 0;
    for (; i + BESIDE * LANES <= count; i += BESIDE * LANES) {
        lanes before[2][BESIDE], after[2][BESIDE];
        sum_pair(before[0], before[1], from + i, step, phase, first, middle, 1);
        sum_pair(after[0], after[1], from + i, step, phase, last, middle - 1, -1);
        for (int b = 0; b < BESIDE; b++) {
            put_lanes(even + i + b * LANES, after[0][b] + before[0][b]);
            put_lanes(odd + i + b * LANES, after[1][b] + before[1][b]);
        }
    }
    for (; i < count; i++)
        for (int r = 0; r < 2; r++) out[r][i] = weigh_one(from + i, step, &phase[r]);
}

static void rgb(const wf_rgb_of_chroma *matrix, float *restrict y, float *restrict cb,
                float *restrict cr, size_t count) {
    float of_y = (float)matrix->luma, of_cr = (float)matrix->of_cr,
          of_cb = (float)matrix->of_cb;
    float green_cb = (float)matrix->green_cb, green_cr = (float)matrix->green_cr;
    for (size_t i = 0; i < count; i++) {
        float luma = of_y * y[i], blue = cb[i], red = cr[i];
        y[i] = luma + of_cr * red;
        cb[i] = luma - (green_cb * blue + green_cr * red);
        cr[i] = luma + of_cb * blue;
    }
}

static void rgb_of_bytes(const wf_rgb_of_chroma *matrix, const uint8_t *restrict code,
                         double zero, float *restrict r, float *restrict cb, float *restrict cr,
                         size_t count) {
    float whole_zero = (float)zero, of_y = (float)matrix->luma, of_cr = (float)matrix->of_cr,
          of_cb = (float)matrix->of_cb;
    float green_cb = (float)matrix->green_cb, green_cr = (float)matrix->green_cr;
    size_t i = 0;
    for (; i + LANES <= count; i += LANES) {
        lanes luma = of_y * (lanes_of_bytes(code + i) - whole_zero);
        lanes blue = lanes_at(cb + i), red = lanes_at(cr + i);
        put_lanes(r + i, luma + of_cr * red);
        put_lanes(cb + i, luma - (green_cb * blue + green_cr * red));
        put_lanes(cr + i, luma + of_cb * blue);
    }
    for (; i < count; i++) {
        float luma = of_y * ((float)code[i] - whole_zero), blue = cb[i], red = cr[i];
        r[i] = luma + of_cr * red;
        cb[i] = luma - (green_cb * blue + green_cr * red);
        cr[i] = luma + of_cb * blue;
    }
}

/* ---- In double ---- */

static void fine_signals(float *restrict signal, const uint16_t *restrict code, double zero,
                         double per_code, size_t count) {
    for (size_t i = 0; i < count; i++) signal[i] = (float)((code[i] - zero) * per_code);
}

static void fine_of_bytes(float *restrict signal, const uint8_t *restrict code, double zero,
                          double per_code, size_t count) {
    for (size_t i = 0; i < count; i++) signal[i] = (float)((code[i] - zero) * per_code);
}

#define FINE_LANES (LANES / 2)
enum { FINE_BESIDE = 4 }; /* vectors of sums */

typedef double fine_lanes __attribute__((vector_size(8 * FINE_LANES)));
typedef float half_lanes __attribute__((vector_size(4 * FINE_LANES), may_alias));

static inline fine_lanes fine_lanes_at(const float *from) {
    half_lanes v;
    memcpy(&v, from, sizeof v);
    return __builtin_convertvector(v, fine_lanes);
}

static inline void put_fine_lanes(float *to, fine_lanes v) {
    half_lanes rounded = __builtin_convertvector(v, half_lanes);
    memcpy(to, &rounded, sizeof rounded);
}

static inline float fine_weigh_one(const float *from, ptrdiff_t step,
                                   const wf_upsample_phase *p) {
    double sum = 0;
    for (int k = 0; k < p->count; k++) sum += p->fine_tap[k] * (double)from[k * step];
    return (float)sum;
}

static void fine_weigh(float *restrict out, const float *restrict chroma, ptrdiff_t step,
                       const wf_upsample_phase *phase, size_t count) {
    const float *from = chroma + phase->first * step;
    size_t i = 0;
    for (; i + FINE_BESIDE * FINE_LANES <= count; i += FINE_BESIDE * FINE_LANES) {
        fine_lanes sum[FINE_BESIDE] = {{0}};
        for (int k = 0; k < phase->count; k++)
            for (int b = 0; b < FINE_BESIDE; b++)
                sum[b] += phase->fine_tap[k] *
                          fine_lanes_at(from + k * step + (ptrdiff_t)i + b * FINE_LANES);
        for (int b = 0; b < FINE_BESIDE; b++) put_fine_lanes(out + i + b * FINE_LANES, sum[b]);
    }
    for (; i < count; i++) out[i] = fine_weigh_one(from + i, step, phase);
}

static void fine_weigh_pair(float *const out[2], const float *chroma, ptrdiff_t step,
                            const wf_upsample_phase phase[2], size_t count) {
    for (int r = 0; r < 2; r++) fine_weigh(out[r], chroma, step, &phase[r], count);
}

static void fine_rgb(const wf_rgb_of_chroma *matrix, float *restrict y, float *restrict cb,
                     float *restrict cr, size_t count) {
    const wf_rgb_of_chroma m = *matrix;
    for (size_t i = 0; i < count; i++) {
        double luma = m.luma * (double)y[i], blue = (double)cb[i], red = (double)cr[i];
        y[i] = (float)(luma + m.of_cr * red);
        cb[i] = (float)(luma - (m.green_cb * blue + m.green_cr * red));
        cr[i] = (float)(luma + m.of_cb * blue);
    }
}

static void fine_rgb_of_bytes(const wf_rgb_of_chroma *matrix, const uint8_t *restrict code,
                              double zero, float *restrict r, float *restrict cb,
                              float *restrict cr, size_t count) {
    for (size_t i = 0; i < count; i++) r[i] = (float)(code[i] - zero);
    fine_rgb(matrix, r, cb, cr, count);
}

/* ---- Both ---- */

static void interleave(float *restrict out, const float *restrict even,
                       const float *restrict odd, size_t count) {
    for (size_t i = 0; i < count; i++) {
        out[2 * i] = even[i];
        out[2 * i + 1] = odd[i];
    }
}

const wf_upsample_ops WF_ISA_TABLE(wf_upsample_ops) = {
    .quick = {signals, of_bytes, weigh, weigh_pair, rgb_of_bytes, rgb},
    .fine = {fine_signals, fine_of_bytes, fine_weigh, fine_weigh_pair, fine_rgb_of_bytes,
             fine_rgb},
    .interleave = interleave,
};
