#ifndef WF_CONVERT_SOUND_TONE_H
#define WF_CONVERT_SOUND_TONE_H

#include <stdint.h>

/* EBU R 68: the alignment signal is a sine of 1 kHz whose peak is 18 dB below full scale. */
#define WF_TONE_HZ   1000
#define WF_TONE_DBFS (-18)

/* Sample n of it at WF_SOUND_RATE, n >= 0, which begins with 0 at n = 0: of 32 bits, rounded to
 * the upper `bits`. */
int32_t wf_tone_sample(int64_t n, int bits);

/* A sample of 32 bits rounded to its upper `bits`, held within full scale. */
int32_t wf_sample_rounded(int32_t sample, int bits);

#endif
