/* Y4M as a source of light: the header, the frames, and all rows of them. */
#include <stdlib.h>
#include <string.h>

#include "tests/unit/support/read_video.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    video_bytes b;
    weft_error err = {""};
    bool is_y4m = size > 9 && !memcmp(data, "YUV4MPEG2", 9);
    if (!is_y4m) return 0;
    weft_status status = open_video_bytes(&b, "video.y4m", data, size, &err);
    if (!status) status = read_video(b.video, 4, &err);
    if (status && !*err.text) abort(); /* every failure says why */
    close_video_bytes(&b);
    return 0;
}
