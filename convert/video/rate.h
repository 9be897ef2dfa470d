#ifndef WF_CONVERT_VIDEO_RATE_H
#define WF_CONVERT_VIDEO_RATE_H

#include "convert/media/video_kind.h"

/* Pictures a second of video whose pictures all last equally long: the rate R for which every
 * timestamp lies within one tick of k/R after the first, of the rate that the stream states,
 * rates that are in use, and the mean. Without timestamps it is the rate that is stated.
 * WEFT_FAILED where there is none, or where pictures last unequally long. */
weft_status wf_video_rate(const wf_video_info *info, const char *path, wf_rational *rate,
                          weft_error *err);

#endif
