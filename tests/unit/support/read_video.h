#ifndef WF_TESTS_UNIT_SUPPORT_READ_VIDEO_H
#define WF_TESTS_UNIT_SUPPORT_READ_VIDEO_H

#include "convert/read/video.h"

/* Decodes at most so many pictures, and makes light of all their rows. */
weft_status read_video(wf_video *video, int pictures, weft_error *err);

#endif
