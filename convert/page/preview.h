/* One frame of video as a picture for a computer's screen. */
#ifndef WF_CONVERT_PAGE_PREVIEW_H
#define WF_CONVERT_PAGE_PREVIEW_H

#include <signal.h>

#include "color/codes/display.h"
#include "convert/weft.h"
#include "filters/raster/raster.h"

typedef struct wf_preview_request {
    const char *video;           /* as wf_page_clip.path */
    const wf_raster *raster;     /* what it is; NULL: as it says */
    const wf_transfer *transfer; /* of the display it is made for; NULL: as it says */
    int64_t frame;               /* below 0: the middle one, of an even number the later */
    size_t max_memory_bytes;     /* of a picture in hand */
    bool overwrite;              /* a picture that is there */
    const volatile sig_atomic_t *canceled; /* not 0: to stop soon; NULL: never */
} wf_preview_request;

/* Writes a PNG of 8-bit R'G'B' with square pixels: as many lines as the frame has, and its
 * width times the pixel aspect. Of interlaced video it is the moment of the first field:
 * between its lines stands the middle one of the line above, the line below and the other
 * field's, so that what stands still is whole and what moves has no comb. WEFT_USAGE where
 * there is no such frame. */
weft_status wf_preview_write(const wf_preview_request *request, const char *path,
                             weft_error *err);

/* The number of a frame as --preview-frame gives it, from 0; NULL keeps *frame as it is. It is
 * of a preview, which has a name. */
weft_status wf_preview_read_frame(const char *text, const char *preview, int64_t *frame,
                                  weft_error *err);

/* Whether the picture's name would do: it ends in .png, and nothing is there that may not be
 * replaced. Asked before long work. */
weft_status wf_preview_check_name(const char *path, bool overwrite, weft_error *err);

#endif
