/* Frames of video as a page has them: fields of codes, and how these become R'G'B'. */
#ifndef WF_CONVERT_PAGE_SHOWN_H
#define WF_CONVERT_PAGE_SHOWN_H

#include "convert/page/pack.h"
#include "convert/read/video.h"

/* What a browser computes R'G'B' of Y'CbCr with: R' is (luma (Y' - black) + red_cr (Cr - 128) +
 * 32768) >> 16, G' the same with - green_cb Cb - green_cr Cr, B' with blue_cb Cb. */
typedef struct wf_page_colors {
    int black, luma, red_cr, green_cb, green_cr, blue_cb;
} wf_page_colors;

/* How the fields of a video are shown. */
typedef struct wf_page_form {
    wf_pack_shape
        shape; /* of a field; of an odd number of lines of the upper one, the larger */
    /* Planes are Y' Cb Cr, else R'G'B' as G, R - G, B - G. */
    bool ycbcr;
    wf_page_colors colors;
    bool rounded; /* codes had more than 8 bits, or were light */
    bool brought; /* colors were brought to those of Rec. 709 through light */
} wf_page_form;

typedef struct wf_page_shown wf_page_shown; /* one thread at a time */

weft_status wf_page_shown_new(const wf_video_info *info, wf_page_shown **out, weft_error *err);
void wf_page_shown_free(wf_page_shown *shown); /* NULL is fine */
const wf_page_form *wf_page_shown_form(const wf_page_shown *shown);

/* Takes a frame. */
void wf_page_shown_take(wf_page_shown *shown, const wf_video_frame *frame);

/* Planes of the field of the frame that owns its upper (0) or lower (1) lines; valid until the
 * next frame is taken. */
const uint16_t *const *wf_page_shown_field(const wf_page_shown *shown, int parity);

/* R'G'B' of line y of the frame, from 0 to 1 and beyond, in the colors of the page, chroma
 * brought to every pixel by the half-band of Rec. BT.601: [width_px] each. */
void wf_page_shown_rgb(const wf_page_shown *shown, int y, float *const rgb[3]);

#endif
