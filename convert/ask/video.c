/* Finished video handed out frame by frame. */
#include "convert/read/video.h"

#include <stdlib.h>

#include "convert/ask/asking.h"
#include "convert/job/raster_tell.h"

struct weft_video {
    wf_video *video;
    wf_raster raster; /* that the user named */
};

static weft_status open_video(weft_video *v, const char *path, const char *raster,
                              weft_error *err) {
    const wf_video_options options = {.raster = raster ? &v->raster : NULL,
                                      .max_memory_bytes = (size_t)2 << 30};
    weft_status status = wf_ask_raster(raster, &v->raster, err);
    return status ? status : wf_video_open(path, &options, &v->video, err);
}

weft_status weft_video_open(const char *path, const char *raster, weft_video **out,
                            weft_error *err) {
    weft_error own;
    if (!err) err = &own;
    err->text[0] = '\0';
    weft_video *v = *out = NULL;
    if (!path || !*path) return wf_fail(err, WEFT_USAGE, "a video's name is empty");
    v = calloc(1, sizeof *v);
    if (!v) return wf_fail(err, WEFT_NO_MEMORY, "%.300s: out of memory", path);
    weft_status status = open_video(v, path, raster, err);
    if (status)
        weft_video_close(v);
    else
        *out = v;
    return status;
}

void weft_video_close(weft_video *video) {
    if (video) wf_video_close(video->video);
    free(video);
}

void weft_video_tell(const weft_video *video, weft_video_info *out) {
    static const char *const layouts[] = {
        [WF_YCBCR] = "ycbcr", [WF_RGB] = "rgb", [WF_LINEAR] = "linear"};
    const wf_video_info *info = wf_video_info_of(video->video);
    weft_video_info all = {.size = out->size,
                           .format = info->format,
                           .layout = layouts[info->layout],
                           .width_px = info->width_px,
                           .lines = info->lines,
                           .bits = info->bits,
                           .across = info->across,
                           .down = info->down,
                           .full_range = info->full_range,
                           .scan_known = info->scan_known,
                           .frames = info->frames};
    wf_raster_tell(&info->raster, &all.raster);
    wf_asked_give(&all, sizeof all, out);
}

weft_status weft_video_next(weft_video *video, weft_picture *out, weft_error *err) {
    const wf_video_frame *frame;
    weft_error own;
    weft_picture all = {.size = out->size};
    if (!err) err = &own;
    err->text[0] = '\0';
    weft_status status = wf_video_next(video->video, &frame, err);
    int planes = status || !frame ? 0 : wf_video_info_of(video->video)->planes;
    if (planes) all.index = frame->index;
    for (int p = 0; p < planes; p++) {
        all.plane[p] = frame->plane[p];
        all.width_px[p] = frame->width_px[p];
        all.lines[p] = frame->lines[p];
    }
    wf_asked_give(&all, sizeof all, out);
    return status;
}
