/* What all kinds of video share: turning codes into signals, and running out of memory. */
#include "convert/media/video_kind.h"

#include <string.h>

#include "color/codes/levels.h"

weft_status wf_video_no_memory(const wf_video *video, weft_error *err) {
    return wf_fail(err, WEFT_NO_MEMORY, "%s: no memory for a frame", video->path);
}

void wf_video_note_trouble(wf_video *video, const weft_error *why) {
    if (!*video->troubles.missing.text) video->troubles.missing = *why;
}

int wf_video_planes(const wf_video_options *options, const wf_video_info *info) {
    return options->want_alpha && info->alpha ? 4 : 3;
}

size_t wf_video_code_bytes(const wf_video_info *info) {
    return info->bits > 8 ? 2 : 1;
}

static void *kept_line(const wf_video *video, int plane, int line) {
    size_t bytes = (size_t)video->frame.width_px[plane] * wf_video_code_bytes(&video->info);
    return (uint8_t *)video->code[plane] + (size_t)line * bytes;
}

static void keep_codes(const wf_video *video, int plane, int line, const uint16_t *code) {
    size_t width = (size_t)video->frame.width_px[plane];
    uint8_t *to = kept_line(video, plane, line);
    if (wf_video_code_bytes(&video->info) == sizeof *code)
        memcpy(to, code, width * sizeof *code);
    else
        for (size_t x = 0; x < width; x++) to[x] = (uint8_t)code[x];
}

void wf_video_take_bytes(wf_video *video, int plane, int line, const uint8_t *code) {
    if (video->code[plane])
        memcpy(kept_line(video, plane, line), code, (size_t)video->frame.width_px[plane]);
}

void wf_video_take_codes(wf_video *video, int plane, int line, const uint16_t *code) {
    const wf_video_info *info = &video->info;
    const wf_encoding encoding = {
        .ycbcr = info->layout == WF_YCBCR, .full_range = info->full_range, .bits = info->bits};
    size_t width = (size_t)video->frame.width_px[plane];
    if (video->take_codes) {
        if (video->code[plane]) keep_codes(video, plane, line, code);
        return;
    }
    wf_decode_line(&encoding, plane, code, video->frame.plane[plane] + (size_t)line * width,
                   width);
}

weft_status wf_video_check_memory(const wf_video *v, weft_error *err) {
    double bytes = 12.0 * sizeof(float) * v->info.width_px * v->info.lines;
    if (bytes <= (double)v->options.max_memory_bytes) return WEFT_OK;
    return wf_fail(
        err, WEFT_NO_MEMORY,
        "%s: frames of %dx%d take %.0f MB, and --max-memory allows %zu MB; allow more", v->path,
        v->info.width_px, v->info.lines, bytes / (1 << 20), v->options.max_memory_bytes >> 20);
}
