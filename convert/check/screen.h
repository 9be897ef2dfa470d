#ifndef WF_CONVERT_CHECK_SCREEN_H
#define WF_CONVERT_CHECK_SCREEN_H

#include "convert/check/measure_options.h"
#include "convert/read/signal.h"
#include "filters/seen/eye.h"

/* What a display makes of the two fields of a frame: a picture of each. */

typedef struct wf_shown {
    float *field[2]; /* of the top and of the bottom field, light, [lines][width_px] */
    /* Of displays that deinterlace, the same as coded, in the order of time; else NULL. */
    const wf_video_frame *picture[2];
} wf_shown;

typedef struct wf_screen wf_screen; /* one thread at a time */

/* For video that info describes. WEFT_FAILED where the display cannot show it. */
weft_status wf_screen_new(const wf_video_info *info, wf_display_kind kind, wf_screen **out,
                          weft_error *err);
void wf_screen_free(wf_screen *screen); /* NULL is fine */

/* Shows `frame`, which is followed by `next`: NULL where it is the last. Before the first,
 * frame is NULL, and so is *shown then. What is shown is valid until the next call. */
weft_status wf_screen_show(wf_screen *screen, const wf_signal *frame, const wf_signal *next,
                           const wf_shown **shown, weft_error *err);

/* How the pictures of a display that deinterlaces are coded; NULL for the others. */
const wf_video_info *wf_screen_info(const wf_screen *screen);

/* From where, and how bright, pictures of this video are seen, for a modulation of so many Hz:
 * as asked for or usual. */
wf_viewing wf_screen_viewing(const wf_video_info *info, const wf_measure_options *options,
                             double hz);

#endif
