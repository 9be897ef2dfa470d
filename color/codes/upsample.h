#ifndef WF_COLOR_CODES_UPSAMPLE_H
#define WF_COLOR_CODES_UPSAMPLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "filters/base/isa.h"

/* Chroma of any siting brought to every luma sample of an axis: halves of a chroma step by the
 * interpolating half-band of color/codes/chroma.h, quarters by the half-band applied twice. A
 * sample that is there stays as it is. */

#define WF_UPSAMPLE_MOST_FACTOR 4
#define WF_UPSAMPLE_MOST_TAPS   80

/* Luma sample `factor` j + phase is the sum of tap[i] times chroma sample j + first + i. Taps
 * are least at both ends; those before `middle` and those from it on are summed by themselves,
 * from the ends inward, so that rounding counts least. Two phases that both weigh reach equally
 * far, with taps of 0. */
typedef struct wf_upsample_phase {
    int first, count, middle;
    float tap[WF_UPSAMPLE_MOST_TAPS];
    double fine_tap[WF_UPSAMPLE_MOST_TAPS];
} wf_upsample_phase;

typedef struct wf_upsampler {
    int factor;  /* luma samples to a chroma sample: 1, 2 or 4 */
    bool center; /* the first chroma sample lies amid its luma samples, not at the first */
    int before, after; /* how far any phase reaches before and after chroma sample j */
    wf_upsample_phase phase[WF_UPSAMPLE_MOST_FACTOR];
} wf_upsampler;

/* Whether its phases are two that are made together. */
bool wf_upsample_pairs(const wf_upsampler *upsampler);

void wf_upsampler_init(wf_upsampler *upsampler, int factor, bool center);

/* Which of `count` chroma samples stands for sample `index` of an axis of `luma` samples, which
 * is continued by reflection: about its first and last chroma samples where they lie at luma
 * samples, else about its edges. */
int wf_upsample_reflected(const wf_upsampler *upsampler, int index, int count, int luma);

/* Floats that wf_upsample_line needs before and behind its `count` samples. */
#define WF_UPSAMPLE_MARGIN WF_UPSAMPLE_MOST_TAPS

/* Codes of Y' Cb Cr, each less its zero, to R' G' B': with Y' = luma Y they are Y' + of_cr Cr,
 * Y' - (green_cb Cb + green_cr Cr), Y' + of_cb Cb. */
typedef struct wf_rgb_of_chroma {
    double luma, of_cr, of_cb, green_cb, green_cr;
} wf_rgb_of_chroma;

/* Loops from codes to R'G'B'. */
typedef struct wf_signal_loops {
    /* signal[i] = (code[i] - zero) per_code */
    void (*signals)(float *signal, const uint16_t *code, double zero, double per_code,
                    size_t count);
    void (*of_bytes)(float *signal, const uint8_t *code, double zero, double per_code,
                     size_t count);
    /* out[i] = sum of tap[k] chroma[i + (first + k) step]: along a line where step is 1, down
     * the columns where it is that from line to line. */
    void (*weigh)(float *out, const float *chroma, ptrdiff_t step,
                  const wf_upsample_phase *phase, size_t count);
    /* The same for two phases that reach equally far. */
    void (*weigh_pair)(float *const out[2], const float *chroma, ptrdiff_t step,
                       const wf_upsample_phase phase[2], size_t count);
    /* rgb of codes of luma that have one byte: fills r, and what cb and cr hold. */
    void (*rgb_of_bytes)(const wf_rgb_of_chroma *matrix, const uint8_t *luma, double zero,
                         float *r, float *cb_to_g, float *cr_to_b, size_t count);
    /* In place. */
    void (*rgb)(const wf_rgb_of_chroma *matrix, float *y_to_r, float *cb_to_g, float *cr_to_b,
                size_t count);
} wf_signal_loops;

/* One table for each instruction set. Every table gives the same bits. */
typedef struct wf_upsample_ops {
    wf_signal_loops quick; /* computes in float */
    wf_signal_loops fine; /* in double, and rounds results once: PQ makes ten times of errors */
    /* out[2 i] = even[i], out[2 i + 1] = odd[i] */
    void (*interleave)(float *out, const float *even, const float *odd, size_t count);
} wf_upsample_ops;

WF_ISA_DECLARE(wf_upsample_ops);

/* A line of `luma` samples from its `count` chroma samples. chroma[-WF_UPSAMPLE_MARGIN] to
 * chroma[count - 1 + WF_UPSAMPLE_MARGIN] is the caller's: what lies beyond the ends is filled.
 * spare is of `luma` floats. */
void wf_upsample_line(const wf_upsampler *upsampler, const wf_signal_loops *loops,
                      float *chroma, int count, float *spare, float *line, int luma);

#endif
