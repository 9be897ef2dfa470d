#ifndef WF_COLOR_CODES_UPSAMPLE_H
#define WF_COLOR_CODES_UPSAMPLE_H

#include <stdbool.h>
#include <stddef.h>

/* Chroma of any siting brought to every luma sample of an axis: halves of a chroma step by the
 * interpolating half-band of color/codes/chroma.h, quarters by the half-band applied twice. A
 * sample that is there stays as it is. */

#define WF_UPSAMPLE_MOST_FACTOR 4
#define WF_UPSAMPLE_MOST_TAPS   80

/* Luma sample `factor` j + phase is the sum of tap[i] times chroma sample j + first + i. */
typedef struct wf_upsample_phase {
    int first, count;
    double tap[WF_UPSAMPLE_MOST_TAPS];
} wf_upsample_phase;

typedef struct wf_upsampler {
    int factor;  /* luma samples to a chroma sample: 1, 2 or 4 */
    bool center; /* the first chroma sample lies amid its luma samples, not at the first */
    wf_upsample_phase phase[WF_UPSAMPLE_MOST_FACTOR];
} wf_upsampler;

void wf_upsampler_init(wf_upsampler *upsampler, int factor, bool center);

/* Which of `count` chroma samples stands for sample `index` of an axis of `luma` samples, which
 * is continued by reflection: about its first and last chroma samples where they lie at luma
 * samples, else about its edges. */
int wf_upsample_reflected(const wf_upsampler *upsampler, int index, int count, int luma);

/* Doubles that wf_upsample_line needs behind and before its `count` samples. */
#define WF_UPSAMPLE_MARGIN WF_UPSAMPLE_MOST_TAPS

/* A line of `luma` samples from its `count` chroma samples. chroma[-WF_UPSAMPLE_MARGIN] to
 * chroma[count - 1 + WF_UPSAMPLE_MARGIN] is the caller's: what lies beyond the ends is filled.
 */
void wf_upsample_line(const wf_upsampler *upsampler, double *chroma, int count, double *line,
                      int luma);

#endif
