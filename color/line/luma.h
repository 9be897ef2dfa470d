#ifndef WF_COLOR_LINE_LUMA_H
#define WF_COLOR_LINE_LUMA_H

/* Luma weights Kr, Kb of the three standards (BT.601, BT.709, BT.2020 non-constant luminance).
 */
typedef enum wf_luma { WF_LUMA_601, WF_LUMA_709, WF_LUMA_2020 } wf_luma;

#endif
