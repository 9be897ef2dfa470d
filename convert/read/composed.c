/* Pictures that are composed: at every pixel the last of several that exists there. */
#include <stdlib.h>
#include <string.h>

#include "convert/base/reserve.h"
#include "convert/read/nan_fix.h"
#include "convert/read/reader.h"
#include "convert/read/subframe.h"

/* ---- The picture ---- */

/* Where a layer exists, in the coordinates of its windows: its display and data window. */
static wf_box exists(const wf_layer_over *layer) {
    const wf_image_info *info = &layer->picture->info;
    wf_box region = wf_box_moved(layer->region, info->display.x0, info->display.y0);
    return wf_box_overlap(region, wf_box_around(info->display, info->data));
}

/* What it holds there; elsewhere in the display window it is 0. */
static wf_box holds(const wf_layer_over *layer) {
    return wf_box_overlap(exists(layer), layer->picture->info.data);
}

static void settle(wf_subframe *s) {
    const wf_image_info *base = &s->layer[0].picture->info;
    s->info = *base;
    s->info.whole = false;
    for (int i = 1; i < s->layers; i++) {
        const wf_layer_over *layer = &s->layer[i];
        s->info.data = wf_box_around(s->info.data, holds(layer));
        s->info.has_alpha |= layer->picture->info.has_alpha;
        s->info.whole |= layer->picture->info.whole;
    }
    s->layout.channels = s->info.has_alpha ? 4 : 3;
}

static weft_status refuse(const wf_layer_over *layers, int count, wf_subframe *s,
                          weft_error *err) {
    for (int i = 0; i < count; i++) wf_subframe_close(layers[i].picture);
    free(s);
    return wf_fail(err, WEFT_NO_MEMORY, "no memory for a picture");
}

weft_status wf_subframe_composed(const wf_layer_over *layers, int count, wf_subframe **out,
                                 weft_error *err) {
    wf_subframe *s = calloc(1, sizeof *s);
    if (s) s->layer = malloc((size_t)count * sizeof *layers);
    if (!s || !s->layer) return refuse(layers, count, s, err);
    memcpy(s->layer, layers, (size_t)count * sizeof *layers);
    s->layers = count;
    settle(s);
    *out = s;
    return WEFT_OK;
}

/* ---- Its rows ---- */

static size_t columns(const wf_rows *rows) {
    return (size_t)(rows->x1 - rows->x0);
}

static float *place(const wf_rows *to, int channel, int x, int y) {
    return (float *)to->plane[channel] + (size_t)(y - to->y0) * columns(to) + (x - to->x0);
}

/* What a picture is where it exists and holds nothing. A picture without alpha is opaque where
 * it has samples. */
static void clear(const wf_rows *to, wf_box box) {
    for (int c = 0; c < to->channels; c++)
        for (int y = box.y0; y < box.y1; y++)
            memset(place(to, c, box.x0, y), 0, (size_t)(box.x1 - box.x0) * sizeof(float));
}

static void copy_channel(const wf_rows *to, const wf_rows *from, int c, wf_box box) {
    size_t width = (size_t)(box.x1 - box.x0);
    for (int y = box.y0; y < box.y1; y++) {
        float *out = place(to, c, box.x0, y);
        size_t at = (size_t)(y - from->y0) * from->line_stride + (size_t)(box.x0 - from->x0);
        if (c >= from->channels)
            for (size_t i = 0; i < width; i++) out[i] = 1;
        else if (from->type == WF_HALF)
            wf_floats_of_halves(out, (const uint16_t *)from->plane[c] + at, width);
        else
            memcpy(out, (const float *)from->plane[c] + at, width * sizeof *out);
    }
}

static void add_counts(wf_reader *to, const wf_source_counts *before, const wf_reader *of) {
    to->counts.chunks_decoded += of->counts.chunks_decoded - before->chunks_decoded;
    to->counts.chunks_reused += of->counts.chunks_reused - before->chunks_reused;
    to->counts.nan.fixed += of->counts.nan.fixed - before->nan.fixed;
    to->counts.nan.alone += of->counts.nan.alone - before->nan.alone;
}

/* Lays what a layer has of the rows over what is there. */
static weft_status lay(wf_reader *r, wf_reader *by, const wf_layer_over *layer, wf_box there,
                       weft_error *err) {
    const wf_rows *to = &r->rows;
    const wf_box band = {to->x0, to->y0, to->x1, to->y1};
    wf_box held = wf_box_overlap(wf_box_overlap(there, layer->picture->info.data), band);
    wf_box all = wf_box_overlap(there, band);
    wf_rows rows;
    if (wf_box_is_empty(all)) return WEFT_OK;
    clear(to, all);
    if (wf_box_is_empty(held)) return WEFT_OK;
    wf_source_counts before = by->counts;
    weft_status status = wf_reader_rows(by, layer->picture, held.y0, held.y1, &rows, err);
    for (int c = 0; !status && c < to->channels; c++) copy_channel(to, &rows, c, held);
    add_counts(r, &before, by);
    return status;
}

static weft_status begin(wf_reader *r, const wf_subframe *s, int y0, int y1, weft_error *err) {
    wf_box data = s->info.data;
    r->rows = (wf_rows){.channels = s->layout.channels,
                        .type = WF_FLOAT,
                        .line_stride = (size_t)(data.x1 - data.x0),
                        .y0 = y0,
                        .y1 = y1,
                        .x0 = data.x0,
                        .x1 = data.x1};
    size_t plane = r->rows.line_stride * (size_t)(y1 - y0);
    weft_status status = r->base ? WEFT_OK : wf_reader_new(&r->options, &r->base, err);
    if (!status && !r->over) status = wf_reader_new(&r->options, &r->over, err);
    if (!status && !wf_reserve(&r->light, &r->light_capacity,
                               (size_t)r->rows.channels * plane * sizeof(float)))
        status = wf_fail(err, WEFT_NO_MEMORY, "no memory for rows of a picture");
    for (int c = 0; !status && c < r->rows.channels; c++)
        r->rows.plane[c] = r->light + (size_t)c * plane;
    return status;
}

weft_status wf_composed_rows(wf_reader *r, const wf_subframe *s, int y0, int y1,
                             weft_error *err) {
    weft_status status = begin(r, s, y0, y1, err);
    for (int i = 0; !status && i < s->layers; i++) {
        const wf_layer_over *layer = &s->layer[i];
        status = lay(r, i ? r->over : r->base, layer, i ? exists(layer) : s->info.data, err);
    }
    r->decoder.exr.suspect = false;
    return status;
}
