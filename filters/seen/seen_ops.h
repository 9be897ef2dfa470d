/* The hot loops of what is seen. */
#ifndef WF_FILTERS_SEEN_SEEN_OPS_H
#define WF_FILTERS_SEEN_SEEN_OPS_H

#include <stdbool.h>
#include <stddef.h>

#include "filters/base/isa.h"
#include "filters/seen/eye.h"

/* One table for each level of the processor; every table gives the same bits. */
typedef struct wf_seen_ops {
    /* out[i] = sum over k < rows of weight[k] row[k][x + i], one k after another */
    void (*down)(float *out, const float *const *row, size_t x, const float *weight,
                 size_t rows, size_t count);
    /* out[x] = weight[0] in[x] + sum over k, 1 .. reach, of weight[k] (in[x - k] + in[x + k])
     */
    void (*across)(float *out, const float *in, const float *weight, size_t reach,
                   size_t count);
    /* Straight lines from mean to mean, of `step` samples, 1 or even, each: of sample i of the
     * out[(count + 1) * step], k = i / step - 1, in[k] + share (in[k + 1] - in[k]), share being
     * that of i % step + 1/2 in the step. in[-1] and in[count] are there too. A step of 1 is a
     * copy of in[0 .. count]. */
    void (*stretch)(float *out, const float *in, size_t step, size_t count);
    /* sum[x] = sum over bands of w part[band][x], w being weight[..][band] of the eye between
     * the knots about the luminance, white local[x]; where part[band] is NULL there is nothing
     * of that band. */
    void (*weigh)(float *sum, const float *const part[WF_EYE_BANDS], const float *local,
                  const wf_eye *eye, float white, size_t count);
    /* jnd[x] = |real[x] + i imaginary[x]| / local[x]; imaginary may be NULL */
    void (*see)(float *jnd, const float *real, const float *imaginary, const float *local,
                size_t count);
    bool (*any)(const float *in, size_t count); /* whether one is not 0 */
} wf_seen_ops;

WF_ISA_DECLARE(wf_seen_ops);

#endif
