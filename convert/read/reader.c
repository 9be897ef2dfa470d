/* Rows of an open picture: its chunks are read, compared with the last ones and decoded, NaN
 * and Inf are replaced, and the rows are handed out. */
#include "convert/read/reader.h"

#include <stdlib.h>
#include <string.h>

#include "convert/base/reserve.h"
#include "convert/read/nan_fix.h"
#include "convert/read/source_exr.h"

weft_status wf_reader_new(const wf_source_options *options, wf_reader **out, weft_error *err) {
    wf_reader *r = *out = calloc(1, sizeof *r);
    if (r) r->options = *options;
    if (r && wf_chunk_decoder_init(&r->decoder)) return WEFT_OK;
    wf_reader_free(r);
    *out = NULL;
    return wf_fail(err, WEFT_NO_MEMORY, "no memory for a reader");
}

static void free_packed(wf_packed *packed) {
    free(packed->bytes);
    free(packed->chunk);
}

void wf_reader_free(wf_reader *r) {
    if (!r) return;
    wf_reader_free(r->neighbor);
    wf_reader_free(r->base);
    wf_reader_free(r->over);
    wf_chunk_decoder_free(&r->decoder);
    free_packed(&r->kept);
    free_packed(&r->ahead);
    free(r->native);
    free(r->tile);
    free(r->plain);
    free(r->edges);
    free(r->light);
    free(r);
}

wf_source_counts wf_reader_counts(const wf_reader *r) {
    return r->counts;
}

static weft_status no_memory(const wf_subframe *s, weft_error *err) {
    return wf_fail(err, WEFT_NO_MEMORY, "%s: no memory for its rows",
                   s->path ? s->path : "video");
}

/* ---- Reading chunks ---- */

static int least(int a, int b) {
    return a < b ? a : b;
}

/* Appends the chunk at column x, line y of the data window, both where a chunk begins. */
static weft_status read_chunk(wf_packed *p, const wf_subframe *s, int x, int y,
                              weft_error *err) {
    const wf_exr_layout *l = &s->layout;
    wf_chunk *chunk = &p->chunk[p->count];
    int width = l->tile_width ? l->tile_width : l->data.x1 - l->data.x0;
    *chunk = (wf_chunk){
        .place = {x, y, least(x + width, l->data.x1), least(y + l->chunk_lines, l->data.y1)},
        .at = p->used};
    exr_result_t result =
        l->tile_width
            ? exr_read_tile_chunk_info(s->exr, s->part, (x - l->data.x0) / width,
                                       (y - l->data.y0) / l->tile_height, 0, 0, &chunk->info)
            : exr_read_scanline_chunk_info(s->exr, s->part, y, &chunk->info);
    wf_box place = chunk->place;
    size_t bytes =
        (size_t)(place.x1 - place.x0) * (size_t)(place.y1 - place.y0) * l->pixel_bytes;
    uint64_t packed = chunk->info.packed_size;
    if (result == EXR_ERR_SUCCESS &&
        (chunk->info.unpacked_size != bytes || packed < 1 || packed > bytes))
        result = EXR_ERR_CORRUPT_CHUNK;
    if (result == EXR_ERR_SUCCESS)
        result = exr_read_chunk(s->exr, s->part, &chunk->info, p->bytes + p->used);
    if (result != EXR_ERR_SUCCESS) return wf_exr_unread(s, y, result, err);
    p->used += (size_t)packed;
    p->count++;
    return WEFT_OK;
}

/* Makes *packed large enough for the chunks of lines first <= y < end, which are at most as
 * big as their samples. */
static bool reserve_packed(wf_packed *p, const wf_subframe *s, int first, int end) {
    const wf_exr_layout *l = &s->layout;
    size_t width = (size_t)(l->data.x1 - l->data.x0);
    int across =
        l->tile_width ? (int)((width + (size_t)l->tile_width - 1) / (size_t)l->tile_width) : 1;
    int count = across * ((end - first + l->chunk_lines - 1) / l->chunk_lines);
    if (count > p->chunk_capacity) {
        wf_chunk *grown = realloc(p->chunk, (size_t)count * sizeof *grown);
        if (!grown) return false;
        p->chunk = grown;
        p->chunk_capacity = count;
    }
    p->count = 0;
    p->used = 0;
    return wf_reserve(&p->bytes, &p->capacity, width * (size_t)(end - first) * l->pixel_bytes);
}

/* The first line of the chunk that holds y. */
static int chunk_top(const wf_exr_layout *l, int y) {
    return l->data.y0 + (y - l->data.y0) / l->chunk_lines * l->chunk_lines;
}

static weft_status read_ahead(wf_reader *r, const wf_subframe *s, int y0, int y1,
                              weft_error *err) {
    const wf_exr_layout *l = &s->layout;
    int width = l->tile_width ? l->tile_width : l->data.x1 - l->data.x0;
    int top = chunk_top(l, y0), end = least(chunk_top(l, y1 - 1) + l->chunk_lines, l->data.y1);
    r->ahead_of = NULL;
    if (!reserve_packed(&r->ahead, s, top, end)) return no_memory(s, err);
    for (int y = top; y < end; y += l->chunk_lines)
        for (int x = l->data.x0; x < l->data.x1; x += width) {
            weft_status status = read_chunk(&r->ahead, s, x, y, err);
            if (status) return status;
        }
    r->ahead_of = s;
    r->ahead_y0 = y0;
    r->ahead_y1 = y1;
    return WEFT_OK;
}

static bool same_layout(const wf_exr_layout *a, const wf_exr_layout *b) {
    return !memcmp(&a->data, &b->data, sizeof a->data) && a->compression == b->compression &&
           a->channels == b->channels && !memcmp(a->before, b->before, sizeof a->before) &&
           a->tile_width == b->tile_width && a->chunk_lines == b->chunk_lines &&
           a->pixel_bytes == b->pixel_bytes && a->channel_hash == b->channel_hash;
}

/* Whether the result that is held is of these rows and of a picture laid out like s, so that
 * chunks can be compared. */
static bool comparable(const wf_reader *r, const wf_subframe *s, int y0, int y1) {
    return r->held && s->exr && r->rows.y0 == y0 && r->rows.y1 == y1 &&
           same_layout(&r->layout, &s->layout);
}

static bool same_chunk(const wf_packed *a, const wf_packed *b, int i) {
    const wf_chunk *x = &a->chunk[i], *y = &b->chunk[i];
    return x->info.packed_size == y->info.packed_size &&
           !memcmp(a->bytes + x->at, b->bytes + y->at, (size_t)x->info.packed_size);
}

/* ---- Decoding ---- */

/* Copies the lines of a decoded tile to their places in the picture, channel by channel. */
static void spread_tile(wf_reader *r, const wf_subframe *s, const wf_chunk *chunk) {
    const exr_attr_chlist_t *list = NULL;
    exr_get_channels(s->exr, s->part, &list);
    const wf_exr_layout *l = &s->layout;
    size_t full = (size_t)(l->data.x1 - l->data.x0),
           width = (size_t)(chunk->place.x1 - chunk->place.x0);
    size_t left = (size_t)(chunk->place.x0 - l->data.x0);
    const uint8_t *from = r->tile;
    for (int y = chunk->place.y0; y < chunk->place.y1; y++) {
        uint8_t *line = r->native + (size_t)(y - r->native_y0) * full * l->pixel_bytes;
        for (int c = 0; c < list->num_channels; c++) {
            size_t bytes = list->entries[c].pixel_type == EXR_PIXEL_HALF ? 2 : 4;
            memcpy(line + left * bytes, from, width * bytes);
            from += width * bytes;
            line += full * bytes;
        }
    }
}

static weft_status decode_chunk(wf_reader *r, const wf_subframe *s, const wf_chunk *chunk,
                                weft_error *err) {
    const wf_exr_layout *l = &s->layout;
    size_t line_bytes = (size_t)(l->data.x1 - l->data.x0) * l->pixel_bytes;
    size_t tile_bytes = (size_t)l->tile_width * (size_t)l->chunk_lines * l->pixel_bytes;
    const uint8_t *packed = r->ahead.bytes + chunk->at;
    r->counts.chunks_decoded++;
    if (!l->tile_width)
        return wf_chunk_decode(
            &r->decoder, s, chunk, packed,
            r->native + (size_t)(chunk->place.y0 - r->native_y0) * line_bytes, err);
    if (!wf_reserve(&r->tile, &r->tile_capacity, tile_bytes)) return no_memory(s, err);
    weft_status status = wf_chunk_decode(&r->decoder, s, chunk, packed, r->tile, err);
    if (!status) spread_tile(r, s, chunk);
    return status;
}

static bool all_half(const wf_exr_layout *l, const wf_subframe *s) {
    const exr_attr_chlist_t *list = NULL;
    exr_get_channels(s->exr, s->part, &list);
    return l->pixel_bytes == 2 * (size_t)list->num_channels;
}

/* Decodes what was read ahead, except the chunks that the result already holds. *changed:
 * any was decoded. */
static weft_status decode_ahead(wf_reader *r, const wf_subframe *s, int y0, int y1,
                                bool *changed, weft_error *err) {
    const wf_exr_layout *l = &s->layout;
    bool compare = comparable(r, s, y0, y1);
    size_t bytes = 0;
    for (int i = 0; i < r->ahead.count; i++)
        bytes += (size_t)r->ahead.chunk[i].info.unpacked_size;
    *changed = !compare;
    r->held = false;
    r->decoder.exr.suspect = (compare && r->decoder.exr.suspect) || !all_half(l, s);
    if (!wf_reserve(&r->native, &r->native_capacity, bytes)) return no_memory(s, err);
    r->native_y0 = chunk_top(l, y0);
    for (int i = 0; i < r->ahead.count; i++) {
        if (compare && same_chunk(&r->kept, &r->ahead, i)) {
            r->counts.chunks_reused++;
            continue;
        }
        *changed = true;
        weft_status status = decode_chunk(r, s, &r->ahead.chunk[i], err);
        if (status) return status;
    }
    wf_packed kept = r->kept;
    r->kept = r->ahead;
    r->ahead = kept;
    r->ahead_of = NULL;
    r->layout = *l;
    return WEFT_OK;
}

/* ---- Handing out ---- */

static size_t plane_samples(const wf_rows *rows) {
    return (size_t)(rows->x1 - rows->x0) * (size_t)(rows->y1 - rows->y0);
}

/* Has rows point at planes of floats, [channels][lines][width]. */
static void point_at(wf_rows *rows, const float *planes) {
    for (int c = 0; c < rows->channels; c++)
        rows->plane[c] = planes + (size_t)c * plane_samples(rows);
    rows->type = WF_FLOAT;
    rows->line_stride = (size_t)(rows->x1 - rows->x0);
}

/* Whether all channels are of this type and lie aligned for it, so that rows can be handed
 * out where they were decoded. */
static bool lies_well(const wf_exr_layout *l, exr_pixel_type_t type, size_t width) {
    size_t bytes = type == EXR_PIXEL_HALF ? 2 : 4;
    bool well = width * l->pixel_bytes % bytes == 0;
    for (int c = 0; c < l->channels; c++)
        well &= l->type[c] == type && l->before[c] * width % bytes == 0;
    return well;
}

/* Planes of mixed kinds, as floats. */
static bool convert_planes(wf_reader *r, const wf_exr_layout *l, const uint8_t *lines,
                           wf_rows *rows) {
    size_t width = (size_t)(rows->x1 - rows->x0), line_bytes = width * l->pixel_bytes;
    if (!wf_reserve(&r->plain, &r->plain_capacity,
                    (size_t)rows->channels * plane_samples(rows) * sizeof(float)))
        return false;
    float *out = r->plain;
    for (int c = 0; c < rows->channels; c++)
        for (int y = rows->y0; y < rows->y1; y++, out += width) {
            const uint8_t *from =
                lines + (size_t)(y - rows->y0) * line_bytes + l->before[c] * width;
            if (l->type[c] == EXR_PIXEL_HALF)
                wf_floats_of_halves(out, from, width);
            else
                memcpy(out, from, width * sizeof *out);
        }
    point_at(rows, r->plain);
    return true;
}

/* The rows as they were decoded. */
static bool native_rows(wf_reader *r, const wf_subframe *s, int y0, int y1, wf_rows *rows) {
    const wf_exr_layout *l = &s->layout;
    size_t width = (size_t)(l->data.x1 - l->data.x0), line_bytes = width * l->pixel_bytes;
    const uint8_t *lines = r->native + (size_t)(y0 - r->native_y0) * line_bytes;
    *rows = (wf_rows){
        .channels = l->channels, .y0 = y0, .y1 = y1, .x0 = l->data.x0, .x1 = l->data.x1};
    bool half = lies_well(l, EXR_PIXEL_HALF, width);
    if (!half && !lies_well(l, EXR_PIXEL_FLOAT, width))
        return convert_planes(r, l, lines, rows);
    rows->type = half ? WF_HALF : WF_FLOAT;
    rows->line_stride = line_bytes / (half ? 2 : 4);
    for (int c = 0; c < l->channels; c++) rows->plane[c] = lines + l->before[c] * width;
    return true;
}

static void whole_rows(const wf_subframe *s, int y0, int y1, wf_rows *rows) {
    wf_box data = s->info.data;
    size_t width = (size_t)(data.x1 - data.x0), plane = width * (size_t)(data.y1 - data.y0);
    *rows = (wf_rows){.channels = s->layout.channels,
                      .type = WF_FLOAT,
                      .line_stride = width,
                      .y0 = y0,
                      .y1 = y1,
                      .x0 = data.x0,
                      .x1 = data.x1};
    for (int c = 0; c < rows->channels; c++)
        rows->plane[c] = s->whole + (size_t)c * plane + (size_t)(y0 - data.y0) * width;
}

/* Makes the rows of a picture that is no file. They are finite. */
static weft_status made_rows(wf_reader *r, const wf_subframe *s, int y0, int y1,
                             weft_error *err) {
    wf_box data = s->info.data;
    size_t channels = (size_t)s->maker->channels;
    r->rows = (wf_rows){
        .channels = s->maker->channels, .y0 = y0, .y1 = y1, .x0 = data.x0, .x1 = data.x1};
    size_t plane = plane_samples(&r->rows);
    if (!wf_reserve(&r->plain, &r->plain_capacity, channels * plane * sizeof(float)) ||
        !wf_reserve(&r->tile, &r->tile_capacity, s->maker->scratch_bytes))
        return no_memory(s, err);
    point_at(&r->rows, r->plain);
    for (int y = y0; y < y1; y += s->maker->most_rows) {
        float *at = r->plain + (size_t)(y - y0) * r->rows.line_stride;
        s->maker->rows(s->picture, y, least(y + s->maker->most_rows, y1), r->tile,
                       (float *[4]){at, at + plane, at + 2 * plane, at + 3 * plane});
    }
    r->decoder.exr.suspect = false;
    return WEFT_OK;
}

static weft_status raw_rows(wf_reader *r, const wf_subframe *s, int y0, int y1, bool *changed,
                            weft_error *err) {
    weft_status status = WEFT_OK;
    *changed = true;
    if (s->maker) return made_rows(r, s, y0, y1, err);
    if (s->layers) return wf_composed_rows(r, s, y0, y1, err);
    if (!s->exr) {
        r->held = false;
        r->decoder.exr.suspect = true;
        whole_rows(s, y0, y1, &r->rows);
        return WEFT_OK;
    }
    bool ready = r->ahead_of == s && r->ahead_y0 == y0 && r->ahead_y1 == y1;
    if (!ready) status = read_ahead(r, s, y0, y1, err);
    if (!status) status = decode_ahead(r, s, y0, y1, changed, err);
    if (status || !*changed) return status;
    return native_rows(r, s, y0, y1, &r->rows) ? WEFT_OK : no_memory(s, err);
}

/* ---- NaN and Inf ---- */

static bool any_not_finite(const wf_reader *r, const wf_rows *rows) {
    size_t width = (size_t)(rows->x1 - rows->x0);
    for (int c = 0; c < rows->channels; c++)
        for (int y = rows->y0; y < rows->y1; y++) {
            size_t at = (size_t)(y - rows->y0) * rows->line_stride;
            bool odd = rows->type == WF_HALF ? r->decoder.exr.unzip->odd_halves(
                                                   (const uint16_t *)rows->plane[c] + at, width)
                                             : r->decoder.exr.unzip->odd_floats(
                                                   (const float *)rows->plane[c] + at, width);
            if (odd) return true;
        }
    return false;
}

/* Reads row y, beyond those that are fixed, into `to`; *edge is empty where the picture
 * ends. */
static weft_status edge_row(wf_reader *r, const wf_subframe *s, int y, wf_rows *edge, float *to,
                            weft_error *err) {
    *edge = (wf_rows){.y0 = y, .y1 = y};
    if (y < s->info.data.y0 || y >= s->info.data.y1) return WEFT_OK;
    weft_status status = wf_reader_rows(r->neighbor, s, y, y + 1, edge, err);
    if (status) return status;
    size_t width = (size_t)(edge->x1 - edge->x0);
    for (int c = 0; c < edge->channels; c++)
        if (edge->type == WF_HALF)
            wf_floats_of_halves(to + (size_t)c * width, edge->plane[c], width);
        else
            memcpy(to + (size_t)c * width, edge->plane[c], width * sizeof *to);
    point_at(edge, to);
    return WEFT_OK;
}

static weft_status read_edges(wf_reader *r, const wf_subframe *s, wf_nan_fixer *fixer,
                              weft_error *err) {
    wf_source_options options = r->options;
    options.nan_fix = WF_NAN_NONE;
    size_t row = (size_t)fixer->rows.channels * (size_t)(fixer->rows.x1 - fixer->rows.x0);
    if (!wf_reserve(&r->edges, &r->edges_capacity, 2 * row * sizeof(float)))
        return no_memory(s, err);
    weft_status status = r->neighbor ? WEFT_OK : wf_reader_new(&options, &r->neighbor, err);
    if (!status) r->neighbor->stored = true;
    if (!status) status = edge_row(r, s, fixer->rows.y0 - 1, &fixer->above, r->edges, err);
    if (!status) status = edge_row(r, s, fixer->rows.y1, &fixer->below, r->edges + row, err);
    return status;
}

static weft_status refuse_not_finite(const wf_subframe *s, const wf_rows *rows,
                                     weft_error *err) {
    int x, y;
    wf_find_not_finite(rows, &x, &y);
    return wf_fail(
        err, WEFT_FAILED,
        "%s: the sample at pixel %d of line %d is NaN or infinite; render it again, or let "
        "--fix-nan box3 mend it",
        s->path, x - s->info.display.x0, y - s->info.display.y0);
}

/* Replaces what is not finite in a copy, so that later chunks are still compared with the
 * rows as decoded. */
static weft_status fix_nan(wf_reader *r, const wf_subframe *s, weft_error *err) {
    wf_nan_fixer fixer = {.rows = r->rows, .how = r->options.nan_fix};
    if (fixer.how == WF_NAN_ERROR) return refuse_not_finite(s, &r->rows, err);
    weft_status status = fixer.how == WF_NAN_BOX3 ? read_edges(r, s, &fixer, err) : WEFT_OK;
    if (status) return status;
    float *out = NULL;
    size_t capacity = 0;
    if (!wf_reserve(&out, &capacity,
                    (size_t)r->rows.channels * plane_samples(&r->rows) * sizeof *out))
        return no_memory(s, err);
    r->fixed = wf_nan_fix_rows(&fixer, out);
    point_at(&r->rows, out);
    free(r->plain); /* not earlier: the rows that were read may lie in it */
    r->plain = out;
    r->plain_capacity = capacity;
    return WEFT_OK;
}

/* ---- Stored samples to light ---- */

static bool copy_to_light(wf_reader *r) {
    const wf_rows *rows = &r->rows;
    size_t width = (size_t)(rows->x1 - rows->x0);
    if (!wf_reserve(&r->light, &r->light_capacity,
                    (size_t)rows->channels * plane_samples(rows) * sizeof(float)))
        return false;
    float *to = r->light;
    for (int c = 0; c < rows->channels; c++)
        for (int y = 0; y < rows->y1 - rows->y0; y++, to += width) {
            size_t at = (size_t)y * rows->line_stride;
            if (rows->type == WF_HALF)
                wf_floats_of_halves(to, (const uint16_t *)rows->plane[c] + at, width);
            else
                memcpy(to, (const float *)rows->plane[c] + at, width * sizeof *to);
        }
    point_at(&r->rows, r->light);
    return true;
}

static void multiply_by_alpha(float *planes, size_t samples) {
    const float *alpha = planes + 3 * samples;
    for (size_t c = 0; c < 3; c++)
        for (size_t i = 0; i < samples; i++) planes[c * samples + i] *= alpha[i];
}

/* Where there is no coverage color has nothing to be divided by. */
static bool covers(float alpha) {
    return alpha > 1e-6f;
}

static void divide_by_alpha(float *planes, size_t samples) {
    const float *alpha = planes + 3 * samples;
    for (size_t c = 0; c < 3; c++)
        for (size_t i = 0; i < samples; i++)
            planes[c * samples + i] /= covers(alpha[i]) ? alpha[i] : 1;
}

static void multiply_what_was_divided(float *planes, size_t samples) {
    const float *alpha = planes + 3 * samples;
    for (size_t c = 0; c < 3; c++)
        for (size_t i = 0; i < samples; i++)
            planes[c * samples + i] *= covers(alpha[i]) ? alpha[i] : 1;
}

/* Rows as a file stores them become rows of light, premultiplied: encoded color is decoded
 * before it is multiplied by alpha, and where it is multiplied already, between dividing by
 * alpha and multiplying again. */
static bool bring_to_light(wf_reader *r, const wf_subframe *s) {
    size_t samples = plane_samples(&r->rows);
    if ((!s->multiplies && !s->decode.apply) || r->stored) return true;
    if (!copy_to_light(r)) return false;
    float *light = r->light;
    if (s->divides) divide_by_alpha(light, samples);
    if (s->decode.apply)
        s->decode.apply(s->decode.self, light, light + samples, light + 2 * samples, samples);
    if (s->divides) multiply_what_was_divided(light, samples);
    if (s->multiplies) multiply_by_alpha(light, samples);
    if (!s->info.has_alpha) r->rows.channels = 3;
    return true;
}

static void add_nan(wf_nan_counts *to, wf_nan_counts of) {
    to->fixed += of.fixed;
    to->alone += of.alone;
}

weft_status wf_reader_rows(wf_reader *r, const wf_subframe *s, int y0, int y1, wf_rows *rows,
                           weft_error *err) {
    bool changed;
    weft_status status = raw_rows(r, s, y0, y1, &changed, err);
    if (!status && changed) {
        r->fixed = (wf_nan_counts){0, 0};
        if (r->decoder.exr.suspect && r->options.nan_fix != WF_NAN_NONE &&
            any_not_finite(r, &r->rows))
            status = fix_nan(r, s, err);
        if (!status && !bring_to_light(r, s)) status = no_memory(s, err);
    }
    r->held = !status && s->exr;
    if (status) return status;
    add_nan(&r->counts.nan, r->fixed);
    *rows = r->rows;
    return WEFT_OK;
}

weft_status wf_reader_same(wf_reader *r, const wf_subframe *s, int y0, int y1, bool *same,
                           weft_error *err) {
    *same = false;
    if (!comparable(r, s, y0, y1)) return WEFT_OK;
    weft_status status = read_ahead(r, s, y0, y1, err);
    if (status) return status;
    for (int i = 0; i < r->ahead.count; i++)
        if (!same_chunk(&r->kept, &r->ahead, i)) return WEFT_OK;
    r->ahead_of = NULL;
    r->counts.chunks_reused += r->ahead.count;
    add_nan(&r->counts.nan, r->fixed);
    *same = true;
    return WEFT_OK;
}
