/* Video of any container as a source of light: what it says, its times, a jump, pictures and
 * all rows of them. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "tests/unit/support/read_video.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    int ways = size ? data[size - 1] : 0;
    const wf_video_options options = {.max_memory_bytes = (size_t)16 << 20,
                                      .want_times = true,
                                      .codes_only = true,
                                      .mends = ways & 1,
                                      .want_alpha = ways & 2};
    char path[64];
    int descriptor = memfd_create("video", 0);
    if (descriptor < 0 || write(descriptor, data, size) != (ssize_t)size) abort();
    snprintf(path, sizeof path, "/proc/self/fd/%d", descriptor);
    wf_video *video = NULL;
    weft_error err = {""};
    bool is_y4m = size > 9 && !memcmp(data, "YUV4MPEG2", 9);
    weft_status status =
        is_y4m || !size ? WEFT_OK : wf_video_open(path, &options, &video, &err);
    if (!status && video) status = read_video(video, options.mends ? 6 : 2, &err);
    int64_t next;
    if (!status && video) status = wf_video_seek(video, 4, &next, &err);
    if (!status && video) status = read_video(video, 2, &err);
    if (status && !*err.text) abort(); /* every failure says why */
    wf_video_close(video);
    close(descriptor);
    return 0;
}
