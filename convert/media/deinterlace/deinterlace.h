#ifndef WF_CONVERT_MEDIA_DEINTERLACE_DEINTERLACE_H
#define WF_CONVERT_MEDIA_DEINTERLACE_DEINTERLACE_H

#include "convert/base/fail.h"
#include "filters/base/rational.h"

/* A picture for each field of interlaced video, as FFmpeg's deinterlacers make them. */

typedef struct wf_woven {
    const char *filter; /* "bwdif", "yadif" or "w3fdif", with a picture a field */
    bool ycbcr;         /* false: R' G' B' */
    int planes;         /* 3, or 1: a lone Y */
    int bits;           /* of a code, 8 to 16 */
    int across, down;   /* luma samples to a chroma sample */
    int width_px, lines;
    bool top_first;
    wf_rational frame_rate;
} wf_woven;

/* wf_deinterlacer_of, the entry point of the deinterlace module. Codes are planes Y Cb Cr or
 * R G B, [lines][width_px] of the plane. One thread at a time. */
typedef struct wf_deinterlacer {
    /* WEFT_FAILED where libavfilter has no such filter, or no format of this kind. The state is
     * closed in any case. */
    weft_status (*open)(const wf_woven *woven, void **state, weft_error *err);
    /* Takes the next frame; NULL: that was the last. All pictures that there are have been
     * taken by then. */
    weft_status (*put)(void *state, const uint16_t *const plane[3], weft_error *err);
    /* Fills the planes with the next picture, in the order of time; *more is false, and nothing
     * filled, where another frame has to come first, or none does. */
    weft_status (*take)(void *state, uint16_t *const plane[3], bool *more, weft_error *err);
    void (*close)(void *state); /* NULL is fine */
} wf_deinterlacer;
typedef const wf_deinterlacer *wf_deinterlacer_fn(void);

#endif
