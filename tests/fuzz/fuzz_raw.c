/* Raw v210 and uyvy, whose name and raster say what they are: the first byte chooses these, and
 * what follows is the file. */
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "tests/unit/support/read_video.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static const char *const rasters[] = {"4x2@25p", "6x4@30i,tff", "50x2@24p", "96x3@50p",
                                      "2x2@25i,bff"};

/* A file of its own for each process, since its name counts. */
static void write_file(char path[64], const char *ending, const uint8_t *data, size_t size) {
    snprintf(path, 64, "/tmp/weft-fuzz-%ld%s", (long)getpid(), ending);
    int descriptor = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    if (descriptor < 0 || write(descriptor, data, size) != (ssize_t)size) abort();
    close(descriptor);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char path[64], why[256];
    wf_raster raster;
    wf_video *video = NULL;
    weft_error err = {""};
    if (!size) return 0;
    size_t which = data[0] / 2 % (sizeof rasters / sizeof *rasters);
    if (!wf_raster_parse(rasters[which], &raster, why, sizeof why)) abort();
    const wf_video_options options = {
        .raster = &raster, .max_memory_bytes = (size_t)64 << 20, .mends = size % 2};
    write_file(path, data[0] % 2 ? ".v210" : ".uyvy", data + 1, size - 1);
    weft_status status = wf_video_open(path, &options, &video, &err);
    if (!status) status = read_video(video, 4, &err);
    if (status && !*err.text) abort(); /* every failure says why */
    wf_video_close(video);
    unlink(path);
    return 0;
}
