#ifndef WF_CONVERT_READ_VIDEO_H
#define WF_CONVERT_READ_VIDEO_H

#include "convert/media/video_kind.h"

/* Finished video read back, frame by frame and as signals, for what measures or decodes it:
 * Y4M, raw v210 and uyvy, pictures and sequences of them and, through the libav module where it
 * is there, whatever else. One thread at a time. */

/* Opens a file, a pattern or a directory of pictures, or "-" for Y4M on standard input, and
 * reads what it says of itself. */
weft_status wf_video_open(const char *path, const wf_video_options *options, wf_video **out,
                          weft_error *err);
const wf_video_info *wf_video_info_of(const wf_video *video);

/* The next frame, owned by the video and valid until the next call; NULL after the last. A file
 * that ends within a frame, or a picture of another size, is an error that says which. */
weft_status wf_video_next(wf_video *video, const wf_video_frame **frame, weft_error *err);
void wf_video_close(wf_video *video); /* NULL is fine */

#endif
