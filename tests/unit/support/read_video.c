/* A few pictures of a video, and all rows of light of them: for fuzz targets. */
#include "tests/unit/support/read_video.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

#include "convert/video/light.h"

weft_status open_video_bytes(video_bytes *b, const char *name, const uint8_t *data, size_t size,
                             weft_error *err) {
    int ways = size ? data[size - 1] : 0;
    const wf_video_options options = {.max_memory_bytes = (size_t)16 << 20,
                                      .want_times = true,
                                      .codes_only = true,
                                      .mends = ways & 1,
                                      .want_alpha = ways & 2};
    char path[64];
    *b = (video_bytes){.descriptor = memfd_create(name, 0), .mends = options.mends};
    if (b->descriptor < 0 || write(b->descriptor, data, size) != (ssize_t)size) abort();
    snprintf(path, sizeof path, "/proc/self/fd/%d", b->descriptor);
    return wf_video_open(path, &options, &b->video, err);
}

void close_video_bytes(video_bytes *b) {
    wf_video_close(b->video);
    close(b->descriptor);
}

static void make_rows(const wf_light *light, const wf_video_info *info, void *const plane[3]) {
    size_t width = (size_t)info->width_px;
    void *scratch = malloc(wf_light_scratch(light));
    float *rgb = malloc(3 * width * sizeof *rgb);
    if (!scratch || !rgb) abort();
    for (int y = 0; y < info->lines; y++)
        wf_light_rows(light, (const void *[3]){plane[0], plane[1], plane[2]}, y, y + 1, scratch,
                      (float *[3]){rgb, rgb + width, rgb + 2 * width});
    free(scratch);
    free(rgb);
}

weft_status read_video(wf_video *video, int pictures, weft_error *err) {
    const wf_video_info *info = wf_video_info_of(video);
    wf_meaning meaning;
    wf_light *light = NULL;
    void *plane[4] = {NULL};
    weft_status status = wf_meaning_of(info, "video", &meaning, err);
    if (!status) status = wf_light_new(info, &meaning, NULL, &light, err);
    for (int p = 0; p < 4; p++) {
        int width, lines;
        wf_video_plane_size(video, p, &width, &lines);
        plane[p] = malloc((size_t)width * (size_t)lines * wf_video_code_bytes(info) + 1);
        if (!plane[p]) abort();
    }
    bool more = true;
    for (int n = 0; !status && more && n < pictures; n++) {
        status = wf_video_next_codes(video, plane, &more, err);
        if (!status && more) make_rows(light, info, plane);
    }
    for (int p = 0; p < 4; p++) free(plane[p]);
    wf_light_free(light);
    return status;
}
