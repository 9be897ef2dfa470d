#ifndef WF_COLOR_CODES_DISPLAYED_H
#define WF_COLOR_CODES_DISPLAYED_H

#include <stddef.h>
#include <stdint.h>

#include "color/codes/display.h"

/* Light that a display shows of R'G'B', changed in luminance and encoded again. */
typedef struct wf_displayed {
    bool encoded;         /* false: lines are light already, and most is infinite */
    wf_transfer transfer; /* of what is encoded */
    float most;           /* the luminance that the output holds; INFINITY: any */
    float weight[3];      /* of red, green and blue in luminance; they add up to 1 */
    wf_curve gamma;       /* of HLG's display */
} wf_displayed;

/* Of codes: most is 1 for BT.1886, 10000/203 for PQ and 1000/203 for HLG (Report ITU-R BT.2408:
 * white is 203 cd/m2). wf_display says what each shows. */
wf_displayed wf_displayed_of_codes(wf_primaries primaries, wf_transfer transfer);

/* Of light of these primaries. */
wf_displayed wf_displayed_of_light(const wf_chromaticities *primaries);

/* R'G'B' to light and its luminance, count pixels, rgb in place. What is encoded and below 0 is
 * dark. With clip, what is beyond most in any channel is brought there, and below 0 to 0, and
 * the pixels of which that is true are counted and returned; clipped[] tells them, where it is
 * not NULL. Light without a most is not clipped. */
int64_t wf_displayed_light(const wf_displayed *shown, float *const rgb[3], float *luminance,
                           bool *clipped, bool clip, size_t count);

/* Light to R'G'B', in place. */
void wf_displayed_encode(const wf_displayed *shown, float *const rgb[3], size_t count);

/* Light of luminance from[] becomes light of luminance to[], in place: darker by all channels
 * alike; brighter so too, up to most and to four times, and from there towards white. In gamut,
 * 0 .. most, it stays there; luminance is exact, and the change continuous. */
void wf_displayed_change(const wf_displayed *shown, float *const rgb[3], const float *from,
                         const float *to, size_t count);

#endif
