#ifndef WF_CONVERT_MEDIA_LIBAV_LIBAV_TIMES_H
#define WF_CONVERT_MEDIA_LIBAV_LIBAV_TIMES_H

#include "convert/media/video_kind.h"

/* Fills video->info.times, tick_s and frames from the packets of a stream, without decoding
 * any, and *packets with how many there are, those too that are not shown; leaves times NULL,
 * and frames as they are, where packets have no time or the file cannot be read twice.
 * *decoded: the times are those of decoding (AVI), and those of frames differ. */
weft_status wf_libav_times(wf_video *video, int stream, int64_t *packets, bool *decoded,
                           weft_error *err);

#endif
