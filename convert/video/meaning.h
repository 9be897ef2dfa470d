#ifndef WF_CONVERT_VIDEO_MEANING_H
#define WF_CONVERT_VIDEO_MEANING_H

#include "convert/media/video_kind.h"
#include "convert/read/file_colors.h"

/* What the codes of a stream mean: as its tags say, or where they say nothing, as its size
 * suggests. Code points are those of Rec. ITU-T H.273. */
typedef struct wf_meaning {
    bool ycbcr;                      /* false: the planes are R'G'B' */
    double kr, kb;                   /* Y' = kr R' + (1 - kr - kb) G' + kb B' */
    int primaries, transfer, matrix; /* none of them 2 */
    bool matrix_asked;               /* by --from, where the stream does not say it */
    bool tagged;                     /* the stream says all of them */
    bool full_range;
    wf_file_colors colors; /* the primaries and the transfer */
} wf_meaning;

/* WEFT_FAILED for a matrix that is not read, such as constant luminance. Primaries and
 * transfers that are not known are colors.trouble, since --from can name them. */
weft_status wf_meaning_of(const wf_video_info *info, const char *path, wf_meaning *out,
                          weft_error *err);

/* The matrix that goes with the signal of a space of weft's own, as H.273 numbers it; 2: none.
 */
int wf_matrix_of_space(const char *space);

/* Adds "space", "transfer", "matrix" and "range". */
void wf_meaning_take(const wf_meaning *meaning, const wf_video_info *info, wf_taken_list *list);

/* How color lies beside alpha, where there is some that counts: as asked, as the file says,
 * else straight. WF_ALPHA_UNSET: there is none. Adds "alpha". */
wf_alpha wf_meaning_alpha(const wf_video_info *info, wf_alpha asked, wf_taken_list *list);

#endif
