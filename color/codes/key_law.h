#ifndef WF_COLOR_CODES_KEY_LAW_H
#define WF_COLOR_CODES_KEY_LAW_H

#include <stddef.h>

/* Fill and key for mixers, which mix encoded video: over a background of code v they show
 * F + (1 - K) v, where light would be t(v) = encode(A + (1 - alpha) decode(v)). A is
 * premultiplied light of a channel, encode the inverse of BT.1886 (a power of 1 / 2.4, of a
 * sign as well), and v lies from 0 to 1. Only where A is 0 or alpha 1 is that one straight
 * line. */
typedef enum wf_key_law {
    WF_KEY_LIGHT,  /* K = alpha, F = encode(A): right over black */
    WF_KEY_ENCODED /* K and F for which the largest |F + (1 - K) v - t(v)| of all channels and
                      backgrounds is least */
} wf_key_law;

/* A line of count pixels in place: rgba[] is encode(A) of any size and alpha, which is taken
 * from 0 to 1, and becomes F, premultiplied ("shaped"), and K. Pure: any number of threads.
 *
 * For one K = 1 - m, t(v) - m v is convex, so it is largest at 0 or 1 and least at
 * v^2.4 = r A / (1 - r (1 - alpha)), r = (m / (1 - alpha))^(12/7), or at 1; F is the mean of
 * both, and e(m) half their difference, which is convex in m. m is found by halving. */
void wf_key_line(wf_key_law law, float *const rgba[4], size_t count);

/* F of premultiplied to F of straight, in place: F / K, at most 1, and 0 where K is 0. The
 * number of pixels in which some channel was above 1. */
size_t wf_key_straighten(float *const rgba[4], size_t count);

#endif
