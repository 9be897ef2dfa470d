/* Y4M as a source of light: the header, the frames, and all rows of them. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "convert/read/video.h"
#include "convert/video/light.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void make_rows(const wf_light *light, const wf_video_info *info,
                      uint16_t *const plane[3]) {
    size_t width = (size_t)info->width_px;
    void *scratch = malloc(wf_light_scratch(light));
    float *rgb = malloc(3 * width * sizeof *rgb);
    if (!scratch || !rgb) abort();
    for (int y = 0; y < info->lines; y++)
        wf_light_rows(light, (const uint16_t *[3]){plane[0], plane[1], plane[2]}, y, y + 1,
                      scratch, (float *[3]){rgb, rgb + width, rgb + 2 * width});
    free(scratch);
    free(rgb);
}

static weft_status read_all(wf_video *video, weft_error *err) {
    const wf_video_info *info = wf_video_info_of(video);
    wf_meaning meaning;
    wf_light *light = NULL;
    uint16_t *plane[3] = {NULL};
    weft_status status = wf_meaning_of(info, "y4m", &meaning, err);
    if (!status) status = wf_light_new(info, &meaning, NULL, &light, err);
    for (int p = 0; p < 3; p++) {
        int width, lines;
        wf_video_plane_size(video, p, &width, &lines);
        plane[p] = malloc((size_t)width * (size_t)lines * sizeof *plane[p] + 1);
        if (!plane[p]) abort();
    }
    bool more = true;
    for (int n = 0; !status && more && n < 4; n++) {
        status = wf_video_next_codes(video, plane, &more, err);
        if (!status && more) make_rows(light, info, plane);
    }
    for (int p = 0; p < 3; p++) free(plane[p]);
    wf_light_free(light);
    return status;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const wf_video_options options = {
        .max_memory_bytes = (size_t)16 << 20, .want_times = true, .codes_only = true};
    char path[64];
    int descriptor = memfd_create("video.y4m", 0);
    if (descriptor < 0 || write(descriptor, data, size) != (ssize_t)size) abort();
    snprintf(path, sizeof path, "/proc/self/fd/%d", descriptor);
    wf_video *video = NULL;
    weft_error err = {""};
    bool is_y4m = size > 9 && !memcmp(data, "YUV4MPEG2", 9);
    weft_status status = is_y4m ? wf_video_open(path, &options, &video, &err) : WEFT_OK;
    if (!status && video) status = read_all(video, &err);
    if (status && !*err.text) abort(); /* every failure says why */
    wf_video_close(video);
    close(descriptor);
    return 0;
}
