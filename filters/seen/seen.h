/* What is seen of a modulation of a picture's light, in just noticeable differences. */
#ifndef WF_FILTERS_SEEN_SEEN_H
#define WF_FILTERS_SEEN_SEEN_H

#include "filters/seen/eye.h"

/* For pictures of one size, looked at from one place. */
typedef struct wf_seen wf_seen;

/* Of every `every`th line, from the first on, is told what is seen; 1: of all. As many threads
 * as there are `workers` may take part. NULL: no memory. viewing is copied. */
wf_seen *wf_seen_new(const wf_viewing *viewing, int every, int workers);
void wf_seen_free(wf_seen *seen); /* NULL is fine */

/* jnd[(lines + every - 1) / every][width_px]: |sum over the eye's bands of weight(L) (G * m)| /
 * L. m is the modulation, real[lines][width_px] or, where imaginary is not NULL, real + i
 * imaginary, G the band's low pass in both directions, and L the local luminance: that of
 * mean[lines][width_px], the light about which it is, white being 1, through a Gaussian with a
 * deviation of half a degree. Beyond the picture all are as in a mirror in its last line or
 * column. A modulation that is m everywhere about one mean has m / mean times the sensitivity
 * to a whole field. Local luminances below a hundredth of a cd/m2 count as that. */
void wf_seen_jnd(wf_seen *seen, const float *real, const float *imaginary, const float *mean,
                 float *jnd);

/* The same by pieces, which several threads may share out: after wf_seen_begin all preparations
 * 0 .. wf_seen_preparations - 1, in any order, and when these are done all tiles 0 ..
 * wf_seen_tiles - 1. Threads that take part at the same time are other workers, below those of
 * wf_seen_new. Bits depend on none of that. The pictures must stay until the end. */
void wf_seen_begin(wf_seen *seen, const float *real, const float *imaginary, const float *mean,
                   float *jnd);
int wf_seen_preparations(const wf_seen *seen);
void wf_seen_prepare(wf_seen *seen, int worker, int n);
int wf_seen_tiles(const wf_seen *seen);
void wf_seen_tile(wf_seen *seen, int worker, int n);

/* A bound on a modulation at every pixel, whatever its sign, below which no more than `jnd`
 * just noticeable differences are seen: bound[lines][width_px] = jnd L / S, S being the
 * sensitivity to a whole field at the local luminance L of light[lines][width_px], that of a
 * still. It is exact where L is even, and what is beside a brighter place within a degree may
 * be seen up to a tenth more. Of wf_seen_new with every 1; one thread. */
void wf_seen_bound(wf_seen *seen, const float *light, double jnd, float *bound);

#endif
