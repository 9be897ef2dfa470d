/* Low passes down and across a picture, and what is seen of what they leave. */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "filters/base/isa_file.h"
#include "filters/seen/seen_ops.h"

enum { BLOCK = 32, EIGHTS = BLOCK / 8 }; /* samples whose sums stay in registers */

/* Said by type, for a compiler that takes two rows at once sums them without vectors. */
typedef float eight __attribute__((vector_size(32), aligned(4), may_alias));

static inline void down_eights(float *restrict out, const float *const *row, size_t x,
                               const float *weight, size_t rows, size_t count) {
    eight sum[EIGHTS] = {{0}};
    for (size_t k = 0; k < rows; k++)
        for (size_t i = 0; i < count; i++)
            sum[i] += weight[k] * *(const eight *)(row[k] + x + 8 * i);
    memcpy(out, sum, count * sizeof *sum);
}

static void down(float *restrict out, const float *const *row, size_t x, const float *weight,
                 size_t rows, size_t count) {
    size_t i = 0;
    for (; i + BLOCK <= count; i += BLOCK)
        down_eights(out + i, row, x + i, weight, rows, EIGHTS);
    for (; i + 8 <= count; i += 8) down_eights(out + i, row, x + i, weight, rows, 1);
    for (; i < count; i++) {
        float sum = 0;
        for (size_t k = 0; k < rows; k++) sum += weight[k] * row[k][x + i];
        out[i] = sum;
    }
}

static inline void across_eights(float *restrict out, const float *restrict in,
                                 const float *weight, size_t reach, size_t count) {
    eight sum[EIGHTS];
    for (size_t i = 0; i < count; i++) sum[i] = weight[0] * *(const eight *)(in + 8 * i);
    for (size_t k = 1; k <= reach; k++)
        for (size_t i = 0; i < count; i++) {
            const float *at = in + 8 * i;
            sum[i] += weight[k] * (*(const eight *)(at - k) + *(const eight *)(at + k));
        }
    memcpy(out, sum, count * sizeof *sum);
}

static void across(float *restrict out, const float *restrict in, const float *weight,
                   size_t reach, size_t count) {
    size_t x = 0;
    for (; x + BLOCK <= count; x += BLOCK)
        across_eights(out + x, in + x, weight, reach, EIGHTS);
    for (; x + 8 <= count; x += 8) across_eights(out + x, in + x, weight, reach, 1);
    for (; x < count; x++) {
        const float *at = in + x;
        float sum = weight[0] * at[0];
        for (size_t k = 1; k <= reach; k++) sum += weight[k] * (*(at - k) + at[k]);
        out[x] = sum;
    }
}

static inline void stretch_by(float *restrict out, const float *restrict in, size_t step,
                              size_t count) {
    const float *before = in - 1;
    for (size_t k = 0; k <= count; k++)
        for (size_t i = 0; i < step; i++) {
            float share = (float)(2 * (int)i + 1) / (float)(2 * (int)step);
            out[k * step + i] = before[k] + share * (before[k + 1] - before[k]);
        }
}

static void stretch(float *restrict out, const float *restrict in, size_t step, size_t count) {
    if (step == 1)
        memcpy(out, in, (count + 1) * sizeof *out);
    else if (step == 2)
        stretch_by(out, in, 2, count);
    else if (step == 4)
        stretch_by(out, in, 4, count);
    else if (step == 8)
        stretch_by(out, in, 8, count);
    else if (step == 16)
        stretch_by(out, in, 16, count);
    else
        stretch_by(out, in, step, count);
}

/* Where among the eye's knots luminances lie: knot[i], and by how much of the way to the next.
 */
typedef struct places {
    int32_t knot[BLOCK], lowest, highest;
    float past[BLOCK];
} places;

/* The two upper bits of a float's mantissa tell the quarter of its octave, and the others how
 * far it is from there to the next, for knots lie evenly between octaves. */
static inline void find_places(places *p, const float *local, float white, size_t count) {
    const float least = 0x1p-7f, most = 16383;
    int32_t lowest = WF_EYE_KNOTS, highest = 0;
    for (size_t i = 0; i < count; i++) {
        float cd_m2 = white * local[i];
        int32_t bits;
        cd_m2 = cd_m2 > least ? cd_m2 : least;
        cd_m2 = cd_m2 < most ? cd_m2 : most;
        memcpy(&bits, &cd_m2, sizeof bits);
        int32_t knot = (bits >> 21) - ((127 + WF_EYE_LOW) << 2);
        p->knot[i] = knot;
        p->past[i] = (float)(bits & 0x1fffff) * 0x1p-21f;
        lowest = lowest < knot ? lowest : knot;
        highest = highest > knot ? highest : knot;
    }
    p->lowest = lowest;
    p->highest = highest;
}

/* Local luminance is smooth, and mostly lies between two knots all along. */
static inline void add_band(float *restrict sum, const float *restrict part, const places *p,
                            const wf_eye *eye, int band, size_t count) {
    if (p->lowest == p->highest) {
        float a = eye->weight[p->lowest][band], b = eye->weight[p->lowest + 1][band];
        for (size_t i = 0; i < count; i++) sum[i] += (a + p->past[i] * (b - a)) * part[i];
        return;
    }
    for (size_t i = 0; i < count; i++) {
        float a = eye->weight[p->knot[i]][band], b = eye->weight[p->knot[i] + 1][band];
        sum[i] += (a + p->past[i] * (b - a)) * part[i];
    }
}

static inline void weigh_block(float *restrict sum, const float *const part[WF_EYE_BANDS],
                               size_t x, const float *local, const wf_eye *eye, float white,
                               size_t count) {
    places p;
    float all[BLOCK] = {0};
    find_places(&p, local + x, white, count);
    for (int band = 0; band < WF_EYE_BANDS; band++)
        if (part[band]) add_band(all, part[band] + x, &p, eye, band, count);
    for (size_t i = 0; i < count; i++) sum[x + i] = all[i];
}

static void weigh(float *restrict sum, const float *const part[WF_EYE_BANDS],
                  const float *local, const wf_eye *eye, float white, size_t count) {
    size_t x = 0;
    for (; x + BLOCK <= count; x += BLOCK) weigh_block(sum, part, x, local, eye, white, BLOCK);
    if (x < count) weigh_block(sum, part, x, local, eye, white, count - x);
}

static void see(float *restrict jnd, const float *restrict real,
                const float *restrict imaginary, const float *restrict local, size_t count) {
    if (imaginary)
        for (size_t i = 0; i < count; i++)
            jnd[i] = sqrtf(real[i] * real[i] + imaginary[i] * imaginary[i]) / local[i];
    else
        for (size_t i = 0; i < count; i++) jnd[i] = fabsf(real[i]) / local[i];
}

static bool any(const float *in, size_t count) {
    uint32_t found = 0;
    for (size_t i = 0; i < count; i++) {
        uint32_t bits;
        memcpy(&bits, in + i, sizeof bits);
        found |= bits << 1; /* without the sign */
    }
    return found;
}

const wf_seen_ops WF_ISA_TABLE(wf_seen_ops) = {down, across, stretch, weigh, see, any};
