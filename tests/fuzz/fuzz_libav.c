/* Video of any container as a source of light: what it says, its times, a jump, pictures and
 * all rows of them. */
#include <stdlib.h>
#include <string.h>

#include "tests/unit/support/read_video.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    video_bytes b;
    weft_error err = {""};
    int64_t next;
    bool is_y4m = size > 9 && !memcmp(data, "YUV4MPEG2", 9);
    if (is_y4m || !size) return 0;
    weft_status status = open_video_bytes(&b, "video", data, size, &err);
    if (!status) status = read_video(b.video, b.mends ? 6 : 2, &err);
    if (!status) status = wf_video_seek(b.video, 4, &next, &err);
    if (!status) status = read_video(b.video, 2, &err);
    if (status && !*err.text) abort(); /* every failure says why */
    close_video_bytes(&b);
    return 0;
}
