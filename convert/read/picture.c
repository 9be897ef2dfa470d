/* Reads a picture whole, for the textures of scenes. */
#include "convert/read/picture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/read/source.h"
#include "filters/base/half.h"

/* IEC 61966-2-1. */
static float linear_of(float v) {
    return v <= 0.04045f ? v / 12.92f : powf((v + 0.055f) / 1.055f, 2.4f);
}

static float sample_at(const wf_rows *rows, int c, size_t at) {
    if (rows->type == WF_HALF) return wf_half_value(((const uint16_t *)rows->plane[c])[at]);
    return ((const float *)rows->plane[c])[at];
}

static void take_rows(const wf_rows *rows, const wf_image_info *info, bool srgb,
                      wf_image *out) {
    for (int y = rows->y0; y < rows->y1; y++)
        for (int x = rows->x0; x < rows->x1; x++) {
            int column = x - info->data.x0, line = y - info->data.y0;
            size_t from = (size_t)(y - rows->y0) * rows->line_stride + (size_t)(x - rows->x0);
            size_t to = 3 * ((size_t)line * (size_t)out->width_px + (size_t)column);
            for (int c = 0; c < 3; c++) {
                float v = sample_at(rows, c, from);
                out->rgb[to + (size_t)c] = srgb ? linear_of(v) : v;
            }
        }
}

/* Textures have no windows: the picture is its data window. */
static weft_status read_all(const wf_subframe *subframe, const wf_source_options *options,
                            bool srgb, wf_image *out, weft_error *err) {
    const wf_image_info *info = wf_subframe_info(subframe);
    *out = (wf_image){info->data.x1 - info->data.x0, info->data.y1 - info->data.y0, NULL};
    out->rgb = calloc((size_t)out->width_px * (size_t)out->height_px, 3 * sizeof(float));
    if (!out->rgb) return wf_fail(err, WEFT_NO_MEMORY, "no memory for the picture");
    wf_reader *reader;
    weft_status status = wf_reader_new(options, &reader, err);
    int step = info->band_lines > 0 ? info->band_lines : 16;
    for (int y = info->data.y0; !status && y < info->data.y1; y += step) {
        wf_rows rows;
        int end = y + step < info->data.y1 ? y + step : info->data.y1;
        status = wf_reader_rows(reader, subframe, y, end, &rows, err);
        if (!status) take_rows(&rows, info, srgb, out);
    }
    wf_reader_free(reader);
    return status;
}

bool wf_picture_load(void *user, const char *path, bool srgb, wf_image *out, char *why,
                     size_t why_size) {
    const wf_source_options options = {
        .alpha = WF_ALPHA_IGNORED, .nan_fix = WF_NAN_BOX3, .max_memory_bytes = (size_t)1 << 30};
    wf_subframe *subframe;
    weft_error err = {""};
    (void)user;
    *out = (wf_image){0};
    weft_status status = wf_subframe_open(path, -1, &options, &subframe, &err);
    if (!status) {
        status = read_all(subframe, &options, srgb, out, &err);
        wf_subframe_close(subframe);
    }
    if (!status) return true;
    free(out->rgb);
    *out = (wf_image){0};
    snprintf(why, why_size, "%s", err.text);
    return false;
}
