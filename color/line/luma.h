#ifndef WF_COLOR_LINE_LUMA_H
#define WF_COLOR_LINE_LUMA_H

/* Luma weights of the three standards: Rec. ITU-R BT.601-7 item 2.5.1, BT.709-6 item 3.2 and
 * BT.2020-2 table 4, non-constant luminance. */
typedef enum wf_luma { WF_LUMA_601, WF_LUMA_709, WF_LUMA_2020 } wf_luma;

/* What R'G'B' is multiplied by to make Y'CbCr of it. */
typedef struct wf_ycbcr {
    float kr, kb;             /* Y' = kr R' + (1 - kr - kb) G' + kb B' */
    float cb_scale, cr_scale; /* Cb = cb_scale (B' - Y'): 1 / (2 (1 - kb)); Cr likewise */
} wf_ycbcr;

wf_ycbcr wf_ycbcr_of(wf_luma luma);

#endif
