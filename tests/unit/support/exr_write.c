/* Writes small EXR files of any make for tests, with OpenEXRCore. */
#include "tests/unit/support/exr_write.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct writer {
    exr_context_t exr;
    const exr_part *part;
    int index;
    exr_encode_pipeline_t encoder;
    bool started;
    float *samples; /* [channels][lines][width] of a chunk */
    int chunk_x, chunk_y;
} writer;

static exr_attr_box2i_t inclusive(wf_box box) {
    return (exr_attr_box2i_t){.min = {.x = box.x0, .y = box.y0},
                              .max = {.x = box.x1 - 1, .y = box.y1 - 1}};
}

static bool add_channels(const writer *w) {
    char names[256];
    bool fine = true;
    snprintf(names, sizeof names, "%s", w->part->channels);
    char *rest = NULL;
    for (char *name = strtok_r(names, " ", &rest); name; name = strtok_r(NULL, " ", &rest)) {
        char *factor = strchr(name, '/'), *whole = strchr(name, '#');
        int across = factor ? atoi(factor + 1) : 1, down = across;
        char *other = factor ? strchr(factor, 'x') : NULL;
        if (other) down = atoi(other + 1);
        if (factor) *factor = '\0';
        if (whole) *whole = '\0';
        fine &= !exr_add_channel(w->exr, w->index, name, whole ? EXR_PIXEL_UINT : w->part->type,
                                 EXR_PERCEPTUALLY_LOGARITHMIC, across, down);
    }
    return fine;
}

static bool set_ratio(const writer *w, const char *name, const char *text) {
    wf_rational ratio;
    if (!text) return true;
    if (!wf_ratio_parse(text, &ratio)) return false;
    exr_attr_rational_t value = {(int32_t)ratio.num, (uint32_t)ratio.den};
    return !exr_attr_set_rational(w->exr, w->index, name, &value);
}

static bool describe(writer *w) {
    const exr_part *p = w->part;
    char name[32];
    snprintf(name, sizeof name, "part%d", w->index);
    exr_attr_box2i_t data = inclusive(p->data), display = inclusive(p->display);
    exr_attr_v2f_t center = {.x = 0, .y = 0};
    bool fine = !exr_add_part(w->exr, p->name ? p->name : name,
                              p->tile_width ? EXR_STORAGE_TILED : EXR_STORAGE_SCANLINE, NULL);
    fine = fine &&
           !exr_initialize_required_attr(w->exr, w->index, &display, &data,
                                         p->pixel_aspect > 0 ? p->pixel_aspect : 1, &center, 1,
                                         EXR_LINEORDER_INCREASING_Y, p->compression);
    if (fine && p->tile_width)
        fine = !exr_set_tile_descriptor(w->exr, w->index, (uint32_t)p->tile_width,
                                        (uint32_t)p->tile_height, p->levels, p->round);
    fine = fine && add_channels(w) && set_ratio(w, "framesPerSecond", p->rate) &&
           set_ratio(w, "weft:time", p->time);
    if (fine && p->subframe_rate)
        fine = !exr_attr_set_string(w->exr, w->index, "weft:subframeRate", p->subframe_rate);
    const exr_attr_timecode_t label = {.time_and_flags = p->timecode};
    if (fine && p->timecode)
        fine = !exr_attr_set_timecode(w->exr, w->index, "timeCode", &label);
    if (fine && p->attribute[0])
        fine = !exr_attr_set_string(w->exr, w->index, p->attribute[0], p->attribute[1]);
    if (fine && p->region) {
        const wf_box *r = p->region;
        exr_attr_box2i_t box;
        box.min.x = r->x0, box.min.y = r->y0, box.max.x = r->x1 - 1, box.max.y = r->y1 - 1;
        fine = !exr_attr_set_box2i(w->exr, w->index, "weft:region", &box);
    }
    exr_attr_chromaticities_t colors;
    if (fine && p->chromaticities) {
        memcpy(&colors, p->chromaticities, sizeof colors);
        fine = !exr_attr_set_chromaticities(w->exr, w->index, "chromaticities", &colors);
    }
    return fine;
}

/* ---- Channels with fewer samples than pixels ---- */

/* Of a value that a half holds exactly. */
static uint16_t half_of(float value) {
    uint32_t bits;
    float small = value * 0x1p-112f;
    memcpy(&bits, &small, sizeof bits);
    return (uint16_t)((bits >> 16 & 0x8000) | (bits >> 13 & 0x7fff));
}

static uint8_t *put_sample(uint8_t *to, exr_pixel_type_t type, float value) {
    uint16_t half = half_of(value);
    uint32_t whole = value >= 0x1p32f ? UINT32_MAX : value > 0 ? (uint32_t)value : 0;
    size_t bytes = type == EXR_PIXEL_HALF ? 2 : 4;
    memcpy(to,
           type == EXR_PIXEL_HALF   ? (const void *)&half
           : type == EXR_PIXEL_UINT ? (const void *)&whole
                                    : (const void *)&value,
           bytes);
    return to + bytes;
}

/* In place of the library's own, which in version 3.1 writes lines that a channel has not. */
static exr_result_t pack_subsampled(exr_encode_pipeline_t *e) {
    const writer *w = e->encoding_user_data;
    uint8_t *to = e->packed_buffer;
    for (int y = w->chunk_y; y < w->chunk_y + e->chunk.height; y++)
        for (int c = 0; c < e->channel_count; c++) {
            const exr_coding_channel_info_t *channel = &e->channels[c];
            if (y % channel->y_samples) continue;
            for (int x = 0; x < channel->width; x++)
                to = put_sample(
                    to, channel->data_type,
                    w->part->value(w->part->user, c, w->chunk_x + x * channel->x_samples, y));
        }
    e->packed_bytes = (uint64_t)(to - (uint8_t *)e->packed_buffer);
    return EXR_ERR_SUCCESS;
}

static bool write_chunk(writer *w, const exr_chunk_info_t *chunk, int x0, int y0) {
    exr_encode_pipeline_t *e = &w->encoder;
    exr_result_t result = w->started ? exr_encoding_update(w->exr, w->index, chunk, e)
                                     : exr_encoding_initialize(w->exr, w->index, chunk, e);
    if (result) return false;
    float *to = w->samples;
    for (int c = 0; c < e->channel_count; c++) {
        exr_coding_channel_info_t *channel = &e->channels[c];
        channel->encode_from_ptr = (const uint8_t *)to;
        channel->user_data_type = EXR_PIXEL_FLOAT;
        channel->user_bytes_per_element = sizeof(float);
        channel->user_pixel_stride = sizeof(float);
        channel->user_line_stride = channel->width * (int32_t)sizeof(float);
        for (int y = 0; y < channel->height; y++)
            for (int x = 0; x < channel->width; x++)
                *to++ = w->part->value(w->part->user, c, x0 + x * channel->x_samples,
                                       y0 + y * channel->y_samples);
    }
    if (!w->started && exr_encoding_choose_default_routines(w->exr, w->index, e)) return false;
    w->chunk_x = x0, w->chunk_y = y0;
    e->encoding_user_data = w;
    if (strchr(w->part->channels, '/')) e->convert_and_pack_fn = pack_subsampled;
    w->started = true;
    return exr_encoding_run(w->exr, w->index, e) == EXR_ERR_SUCCESS;
}

static bool write_lines(writer *w) {
    const exr_part *p = w->part;
    int lines = 0;
    exr_chunk_info_t chunk;
    bool fine = !exr_get_scanlines_per_chunk(w->exr, w->index, &lines);
    for (int y = p->data.y0; fine && y < p->data.y1; y += lines)
        fine = !exr_write_scanline_chunk_info(w->exr, w->index, y, &chunk) &&
               write_chunk(w, &chunk, p->data.x0, y);
    return fine;
}

static bool write_level(writer *w, int level_x, int level_y) {
    const exr_part *p = w->part;
    int width, lines;
    exr_chunk_info_t chunk;
    bool fine = !exr_get_level_sizes(w->exr, w->index, level_x, level_y, &width, &lines);
    for (int j = 0; fine && j * p->tile_height < lines; j++)
        for (int i = 0; fine && i * p->tile_width < width; i++)
            fine =
                !exr_write_tile_chunk_info(w->exr, w->index, i, j, level_x, level_y, &chunk) &&
                write_chunk(w, &chunk, p->data.x0 + i * p->tile_width,
                            p->data.y0 + j * p->tile_height);
    return fine;
}

static bool write_tiles(writer *w) {
    int across = 1, down = 1;
    bool fine = !exr_get_tile_levels(w->exr, w->index, &across, &down);
    bool all = w->part->levels == EXR_TILE_RIPMAP_LEVELS;
    for (int y = 0; fine && y < down; y++)
        for (int x = all ? 0 : y; fine && x < (all ? across : y + 1); x++)
            fine = write_level(w, x, y);
    return fine;
}

static bool write_part(writer *w) {
    const exr_part *p = w->part;
    size_t width = (size_t)(p->data.x1 - p->data.x0),
           lines = p->tile_height > 256 ? (size_t)p->tile_height : 256;
    w->samples = malloc(32 * width * lines * sizeof *w->samples);
    if (!w->samples) return false;
    bool fine = p->tile_width ? write_tiles(w) : write_lines(w);
    if (w->started) exr_encoding_destroy(w->exr, &w->encoder);
    w->encoder = (exr_encode_pipeline_t)EXR_ENCODE_PIPELINE_INITIALIZER;
    w->started = false;
    free(w->samples);
    return fine;
}

bool exr_write(const char *path, const exr_part *parts, int count) {
    exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
    writer w = {.encoder = EXR_ENCODE_PIPELINE_INITIALIZER};
    if (exr_start_write(&w.exr, path, EXR_WRITE_FILE_DIRECTLY, &how)) return false;
    bool fine = true;
    for (w.index = 0; fine && w.index < count; w.index++) {
        w.part = &parts[w.index];
        fine = describe(&w);
    }
    fine = fine && !exr_write_header(w.exr);
    for (w.index = 0; fine && w.index < count; w.index++) {
        w.part = &parts[w.index];
        fine = write_part(&w);
    }
    return !exr_finish(&w.exr) && fine;
}
