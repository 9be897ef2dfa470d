#ifndef WF_COLOR_COMPOSITE_FIR_H
#define WF_COLOR_COMPOSITE_FIR_H

#include <stddef.h>

/* A symmetric filter: tap[0] is the middle one, tap[k] those k samples before and after it. */
#define WF_FIR_MOST 18
typedef struct wf_fir {
    int reach; /* tap[reach] is the last */
    float tap[WF_FIR_MOST + 1];
} wf_fir;

/* Gain 1 at 0 Hz; 0 at the subcarriers of both systems and at twice their frequency. chroma is
 * 1.5 dB down at 1.3 MHz and half at 1.65; luma is flat to 1.4 MHz and half at 1.9. */
const wf_fir *wf_fir_chroma(void);
const wf_fir *wf_fir_luma(void);

/* in[count + 2 reach], of which in[reach + i] is the sample under out[i]. */
void wf_fir_apply(const wf_fir *fir, float *restrict out, const float *restrict in,
                  size_t count);

/* out[0 .. width + 2 margin), the line reflected about its first and last samples. */
void wf_fir_reflect(float *restrict out, const float *restrict line, int width, int margin);

#endif
