/* The inner loops of the resampler. */
#ifndef WF_FILTERS_RESAMPLE_ROWS_H
#define WF_FILTERS_RESAMPLE_ROWS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "filters/base/isa.h"

/* A row times a weight. */
typedef struct wf_strand {
    const double *row;
    double weight;
} wf_strand;
typedef struct wf_quick_strand {
    const float *row;
    float weight;
} wf_quick_strand;

/* One table for each level of the processor. Every table gives the same bits: products and sums
 * are rounded separately in double, in the same order, whatever the vector width. */
typedef struct wf_row_ops {
    /* sum[i] += weight * pixel[i] */
    void (*add_half)(double *sum, const uint16_t *pixel, double weight, size_t count);
    /* sum[i] += weight[r] * row[r][i] for one of `rows` after another; begins: to 0, not to
     * what sum holds */
    void (*add_floats)(double *sum, bool begins, const float *const *row, const double *weight,
                       size_t rows, size_t count);
    /* The same in float. */
    void (*quick_add_floats)(float *sum, bool begins, const float *const *row,
                             const double *weight, size_t rows, size_t count);
    /* sum[i] = a[i] + b[i]; b may be NULL: sum[i] = a[i] */
    void (*set_rows)(double *sum, const float *a, const float *b, size_t count);
    /* sum[i] += pixel[i] */
    void (*add_row)(double *sum, const float *pixel, size_t count);
    /* sum[i] += weight * row[i] */
    void (*add_tap)(double *sum, const double *row, double weight, size_t count);
    /* sum[i] = 0, and to that weight * row[i] of one strand after another is added */
    void (*weave)(double *sum, const wf_strand *strand, size_t strands, size_t count);
    /* out[i] = scale[i] times the sum of what weave adds, all in float */
    void (*quick_weave)(float *out, const wf_quick_strand *strand, size_t strands,
                        const float *scale, size_t count);
    /* sum[i] = a[i] + b[i] in float; sum may be a */
    void (*quick_set_rows)(float *sum, const float *a, const float *b, size_t count);
    /* row[i] = 1 / row[i] */
    void (*invert)(double *row, size_t count);
    /* out[i] = a[i] b[i] */
    void (*multiply)(float *out, const double *a, const double *b, size_t count);
    /* lane[z * lane_length + m] = (float)row[lanes * m + z] for all of count samples of row,
     * and 0 in what remains of the lanes */
    void (*split)(float *lane, const double *row, size_t lanes, size_t lane_length,
                  size_t count);
    void (*quick_split)(float *lane, const float *row, size_t lanes, size_t lane_length,
                        size_t count);
} wf_row_ops;

WF_ISA_DECLARE(wf_row_ops);

#endif
