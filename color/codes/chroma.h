#ifndef WF_COLOR_CODES_CHROMA_H
#define WF_COLOR_CODES_CHROMA_H

#include "color/codes/encoder.h"

/* Most taps before or after the middle one that are not 0. */
#define WF_CHROMA_PAIRS 10

/* A decimation by two, co-sited with even samples: the middle tap is 1/2, those 1 + 2 j samples
 * before and after it are pair[j], all others 0. Taps add up to exactly 1. */
typedef struct wf_chroma_filter {
    const char *name;
    size_t pairs;
    bool symmetric; /* false: the only other tap is pair[0], after the middle */
    float pair[WF_CHROMA_PAIRS];
} wf_chroma_filter;

/* NULL for 444, which does not filter. */
const wf_chroma_filter *wf_chroma_filter_of(wf_chroma chroma);

/* Samples of scratch for a line of width_px. */
size_t wf_chroma_scratch(size_t width_px);

/* The first width_px / 2 samples of line become those of the decimated line; outside, the line
 * is reflected about its first and last samples (c b | a b c). width_px is even. */
void wf_chroma_decimate(const wf_chroma_filter *filter, float *line, size_t width_px,
                        float *scratch);

/* The other way: a line of width_px samples from its width_px / 2 even ones, by the same taps
 * (a "standard upsampler"); even samples stay as they are. Outside, samples are reflected as
 * above. line is not half. */
void wf_chroma_interpolate(const wf_chroma_filter *filter, const float *half, size_t width_px,
                           float *line);

#endif
