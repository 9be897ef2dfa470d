/* What is seen of a modulation of a picture's light, in just noticeable differences. */
#ifndef WF_FILTERS_SEEN_SEEN_H
#define WF_FILTERS_SEEN_SEEN_H

#include <stdbool.h>
#include <stddef.h>

#include "filters/base/isa.h"
#include "filters/seen/eye.h"

/* The loops of it. One table for each level of the processor; every table gives the same bits.
 */
typedef struct wf_seen_ops {
    /* out[x] = sum over k < rows of weight[k] row[k][x], one k after another */
    void (*down)(float *out, const float *const *row, const float *weight, size_t rows,
                 size_t count);
    /* out[x] = weight[0] in[x] + sum over k, 1 .. reach, of weight[k] (in[x - k] + in[x + k])
     */
    void (*across)(float *out, const float *in, const float *weight, size_t reach,
                   size_t count);
    /* sum[x] += w part[x], w being weight[..][band] of the eye between the knots about the
     * luminance, white local[x] */
    void (*add_band)(float *sum, const float *part, const float *local, const wf_eye *eye,
                     int band, float white, size_t count);
} wf_seen_ops;

WF_ISA_DECLARE(wf_seen_ops);

/* For pictures of one size, looked at from one place. One thread at a time. */
typedef struct wf_seen wf_seen;

/* NULL: no memory. viewing is copied. */
wf_seen *wf_seen_new(const wf_viewing *viewing);
void wf_seen_free(wf_seen *seen); /* NULL is fine */

/* jnd[lines][width_px]: |sum over the eye's bands of weight(L) (G * m)| / L. m is the
 * modulation, real[lines][width_px] or, where imaginary is not NULL, real + i imaginary, G the
 * band's low pass in both directions, and L the local luminance: that of mean[lines][width_px],
 * the light about which it is, white being 1, through a Gaussian with a deviation of half a
 * degree. Beyond the picture all are as in a mirror in its last line or column. A modulation
 * that is m everywhere about one mean has m / mean times the sensitivity to a whole field.
 * Local luminances below a hundredth of a cd/m2 count as that. */
void wf_seen_jnd(wf_seen *seen, const float *real, const float *imaginary, const float *mean,
                 float *jnd);

/* A bound on a modulation at every pixel, whatever its sign, below which no more than `jnd`
 * just noticeable differences are seen: bound[lines][width_px] = jnd L / S, S being the
 * sensitivity to a whole field at the local luminance L of light[lines][width_px], that of a
 * still. It is exact where L is even, and what is beside a brighter place within a degree may
 * be seen up to a tenth more. */
void wf_seen_bound(wf_seen *seen, const float *light, double jnd, float *bound);

#endif
