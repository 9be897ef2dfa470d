#ifndef WF_CONVERT_READ_VIDEO_KINDS_H
#define WF_CONVERT_READ_VIDEO_KINDS_H

#include "convert/read/video.h"

/* Inside the reading of video: what each kind of file has to do. */

extern const wf_video_kind wf_video_y4m, wf_video_raw, wf_video_pictures, wf_video_libav;

#endif
