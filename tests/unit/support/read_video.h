#ifndef WF_TESTS_UNIT_SUPPORT_READ_VIDEO_H
#define WF_TESTS_UNIT_SUPPORT_READ_VIDEO_H

#include "convert/read/video.h"

/* A video that a fuzzer made up, as a file in memory. */
typedef struct video_bytes {
    wf_video *video; /* NULL: it could not be opened */
    int descriptor;
    bool mends;
} video_bytes;

/* Opens it; its last byte says in which way. name: of the file, for messages. Close it whatever
 * came of it. */
weft_status open_video_bytes(video_bytes *b, const char *name, const uint8_t *data, size_t size,
                             weft_error *err);
void close_video_bytes(video_bytes *b);

/* Decodes at most so many pictures, and makes light of all their rows. */
weft_status read_video(wf_video *video, int pictures, weft_error *err);

#endif
