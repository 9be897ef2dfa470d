/* The tone that levels are set by, and rounding to the bits of an output. */
#include "convert/sound/tone.h"

#include <math.h>

#include "convert/job/audio.h"

/* Samples of a period, which are whole. */
enum { PERIOD = WF_SOUND_RATE / WF_TONE_HZ };

int32_t wf_sample_rounded(int32_t sample, int bits) {
    if (bits >= 32) return sample;
    int64_t step = INT64_C(1) << (32 - bits);
    int64_t whole = (sample + step / 2) & ~(step - 1);
    return whole > INT32_MAX ? (int32_t)(INT32_MAX + INT64_C(1) - step) : (int32_t)whole;
}

int32_t wf_tone_sample(int64_t n, int bits) {
    double pi = acos(-1), peak = 2147483648.0 * pow(10, WF_TONE_DBFS / 20.0);
    double value = peak * sin(2 * pi * (double)(n % PERIOD) / PERIOD);
    return wf_sample_rounded((int32_t)llround(value), bits);
}
