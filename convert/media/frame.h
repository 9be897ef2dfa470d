#ifndef WF_CONVERT_MEDIA_FRAME_H
#define WF_CONVERT_MEDIA_FRAME_H

#include <stddef.h>
#include <stdint.h>

/* One finished frame, both fields woven, top line first. Planes are R G B or Y Cb Cr and alpha,
 * which is NULL where the output has none, each line stride[p] samples after the last. Codes
 * are uint16_t, WF_LINEAR is float. */
typedef struct wf_frame {
    const void *plane[4];
    size_t stride[4];
    int64_t index; /* from 0 in the whole run, chunk or not */
} wf_frame;

/* Line y of plane p, of codes. */
static inline const uint16_t *wf_frame_codes(const wf_frame *frame, int p, int y) {
    return (const uint16_t *)frame->plane[p] + (size_t)y * frame->stride[p];
}

#endif
