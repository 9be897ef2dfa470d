#ifndef WF_COLOR_CODES_CHROMA_H
#define WF_COLOR_CODES_CHROMA_H

#include <stdbool.h>
#include <stddef.h>

/* How Cb and Cr lose half their samples; 444 keeps them. luma-adjust decimates as bt601 does
 * and then chooses Y' so that the luminance, once chroma is interpolated, is that of the
 * picture before (color/codes/adjust.h). */
typedef enum wf_chroma {
    WF_CHROMA_BT601,
    WF_CHROMA_121,
    WF_CHROMA_BOX,
    WF_CHROMA_444,
    WF_CHROMA_LUMA_ADJUST
} wf_chroma;

/* Most taps before or after the middle one that are not 0. */
#define WF_CHROMA_PAIRS 10

/* A decimation by two, co-sited with even samples: the middle tap is 1/2, those 1 + 2 j samples
 * before and after it are pair[j], all others 0. Taps add up to exactly 1. */
typedef struct wf_chroma_filter {
    size_t pairs;
    bool symmetric; /* false: the only other tap is pair[0], after the middle */
    float pair[WF_CHROMA_PAIRS];
} wf_chroma_filter;

/* The filter of a name; static storage. NULL for 444, which does not filter. */
const wf_chroma_filter *wf_chroma_filter_of(wf_chroma chroma);

/* Samples of scratch that wf_chroma_decimate needs for a line of width_px. */
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
