#ifndef WF_CONVERT_VIDEO_RATE_H
#define WF_CONVERT_VIDEO_RATE_H

#include "convert/media/video_kind.h"

/* Pictures a second of video whose pictures all last equally long: the rate R for which every
 * timestamp lies within one tick of k/R after the first, of the rate that the stream states,
 * rates that are in use, and the mean. Without timestamps it is the rate that is stated. *rate
 * is {0, 0} where pictures last unequally long: wf_video_shown says how long. Fails where there
 * is no rate, or one that cannot be. */
weft_status wf_video_rate(const wf_video_info *info, const char *path, wf_rational *rate,
                          weft_error *err);

/* A picture that is shown for longer has a damaged timestamp after it. */
#define WF_LONGEST_SHOWN_S 3600.0

/* Whether a picture that is shown so many ticks after the first keeps to a rate, within a tick.
 */
bool wf_video_in_step(const wf_video_info *info, wf_rational rate, int64_t picture,
                      int64_t ticks);

/* When `count` pictures are shown, each step-th from `first` on: times_s[count + 1], seconds
 * after the first of them; the last is when the last one ends, which is as long as its stream
 * says, else as the one before. The caller's, free(). WEFT_FAILED where a picture does not come
 * after the one before it. */
weft_status wf_video_shown(const wf_video_info *info, const char *path, int64_t first,
                           int64_t step, int64_t count, wf_rational **times_s, weft_error *err);

#endif
