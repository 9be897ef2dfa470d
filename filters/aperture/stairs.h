/* Kernels of equal steps, which designs are made of. */
#ifndef WF_FILTERS_APERTURE_STAIRS_H
#define WF_FILTERS_APERTURE_STAIRS_H

/* Kernels of frame lines made of equal steps: m(v) is constant over each eighth of a line and
 * even in v. They are a comb of pulses seen through the interlaced box,
 *
 *     m = box(2) * sum of comb[|k|] delta(v - k/8),   H(f) = sinc(2f) C(f),
 *
 * so that H vanishes at every multiple of 1/2 cycle a line however the comb's numbers round,
 * and weights of s samples a line keep that zero whenever 2s is whole, as those of the box do.
 */

#define WF_STAIRS_STEPS 8 /* a line */
#define WF_STAIRS_LINES 6 /* to each side, at most */
#define WF_STAIRS_MOST  (WF_STAIRS_STEPS * WF_STAIRS_LINES)
#define WF_COMB_MOST    (WF_STAIRS_MOST - WF_STAIRS_STEPS + 1)

typedef struct wf_stairs {
    int count;                       /* steps to each side */
    double height[WF_STAIRS_MOST];   /* of step i, i/8 <= |v| < (i+1)/8; their area is 1 */
    double area[WF_STAIRS_MOST + 1]; /* of m from 0 to i/8 */
} wf_stairs;

/* Pulses to one side, the middle one included, of kernels that reach so many lines (a multiple
 * of 1/2, from 3/2 to WF_STAIRS_LINES). */
int wf_comb_count(double lines);

/* comb[wf_comb_count(lines)], of a sum other than zero; it is scaled to an area of 1. */
void wf_stairs_init(wf_stairs *stairs, double lines, const double *comb);

/* How many of pulse k and its mirror image reach step i: 0, 1 or 2. Height i is half the sum of
 * share(i, k) comb[k], once the comb adds up to 1 with all mirror images. */
double wf_comb_share(int step, int pulse);

/* The integral of m from 0 to v. */
double wf_stairs_integral(const wf_stairs *stairs, double v);

/* H(f), f in cycles a line. */
double wf_stairs_response(const wf_stairs *stairs, double f);

/* The integral of m squared: how much of the noise of independent samples passes, where `line`
 * passes 1. */
double wf_stairs_power(const wf_stairs *stairs);

#endif
