#ifndef WF_CONVERT_MEDIA_DEEP_H
#define WF_CONVERT_MEDIA_DEEP_H

#include <stdint.h>

/* Sample buffers on disk (convert/read/README.md): deep scanline EXR, one file a frame. Deep
 * pixel (i, j) holds the samples with floor(x) = i and floor(y) = j: channels sample.x,
 * sample.y (raster coordinates), sample.t (field periods since the frame's first field), R G B
 * [A], and sample.w (a weight) if there are any. */

typedef enum wf_deep_channel {
    WF_DEEP_B,
    WF_DEEP_G,
    WF_DEEP_R,
    WF_DEEP_T,
    WF_DEEP_X,
    WF_DEEP_Y,
    WF_DEEP_WEIGHT,
    WF_DEEP_A,
    WF_DEEP_CHANNELS
} wf_deep_channel;

/* One line of samples, pixel after pixel. */
typedef struct wf_deep_line {
    int32_t *upto; /* [width]: how many samples pixels 0 .. i have together */
    float *channel[WF_DEEP_CHANNELS]; /* [upto[width - 1]]; NULL: it has none */
} wf_deep_line;

#endif
