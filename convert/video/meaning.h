#ifndef WF_CONVERT_VIDEO_MEANING_H
#define WF_CONVERT_VIDEO_MEANING_H

#include "convert/media/video_kind.h"

/* What the codes of a stream mean: as its tags say, or where they say nothing, as its size
 * suggests. Code points are those of Rec. ITU-T H.273. */
typedef struct wf_meaning {
    bool ycbcr;                         /* false: the planes are R'G'B' */
    double kr, kb;                      /* Y' = kr R' + (1 - kr - kb) G' + kb B' */
    int primaries, transfer, matrix;    /* none of them 2 */
    bool tagged;                        /* the stream says all of them */
    bool transfer_tagged, space_tagged; /* it says the transfer; primaries or matrix */
    const char *space;                  /* linear, of color/weft.ocio, of these primaries */
} wf_meaning;

/* WEFT_FAILED for tags that name what is not read, such as constant luminance. */
weft_status wf_meaning_of(const wf_video_info *info, const char *path, wf_meaning *out,
                          weft_error *err);

/* For people: "Rec. 709", "BT.1886"; "" for what has no name here. */
const char *wf_primaries_name(int code_point);
const char *wf_transfer_name(int code_point);

#endif
