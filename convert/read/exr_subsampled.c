/* Reads EXRs whole some of whose channels have not a sample for every pixel: luminance-chroma
 * images, and pictures beside channels that are subsampled. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "color/codes/chroma.h"
#include "convert/base/reserve.h"
#include "convert/read/chunk.h"
#include "convert/read/nan_fix.h"
#include "convert/read/source_exr.h"

/* A channel that is picked, as the file has it. */
typedef struct plane {
    int channel, across, down; /* pixels and lines a sample: 1, 2 or 4 */
    size_t width, lines;       /* of samples */
    float *sample;             /* [lines][width] */
    bool borrowed;             /* the sample's memory */
} plane;

typedef struct reading {
    const wf_subframe *s;
    const exr_attr_chlist_t *list;
    size_t width, lines;
    plane plane[4];
    int count;
    size_t *line_bytes; /* [channels of the file], of a line that has samples */
    float *line;        /* for interpolation: of the longer side, twice */
    wf_chunk_decoder decoder;
    uint8_t *packed, *samples; /* of a chunk that weft decodes itself */
    size_t packed_capacity, samples_capacity;
    exr_decode_pipeline_t pipeline; /* of the others */
    bool started;
    int chunk_y; /* the first line of the chunk in hand */
} reading;

static weft_status no_memory(const reading *r, weft_error *err) {
    return wf_fail(err, WEFT_NO_MEMORY, "%s: no memory to read it whole", r->s->path);
}

/* ---- Memory ---- */

static bool is_factor(int n) {
    return n == 1 || n == 2 || n == 4;
}

static weft_status make_plane(reading *r, int p, float *full, weft_error *err) {
    const exr_attr_chlist_entry_t *c = &r->list->entries[r->s->pick.channel[p]];
    plane *to = &r->plane[p];
    *to = (plane){r->s->pick.channel[p], c->x_sampling, c->y_sampling, 0, 0, full, true};
    if (!is_factor(to->across) || !is_factor(to->down))
        return wf_fail(err, WEFT_FAILED,
                       "%s: channel %s is subsampled %dx%d; weft reads chroma of 1x1, 2x2 and "
                       "4x4",
                       r->s->path, c->name.str, to->across, to->down);
    to->width = (r->width + (size_t)to->across - 1) / (size_t)to->across;
    to->lines = (r->lines + (size_t)to->down - 1) / (size_t)to->down;
    if (to->across == 1 && to->down == 1) return WEFT_OK;
    to->borrowed = false;
    to->sample = calloc(to->width * to->lines, sizeof *to->sample);
    return to->sample ? WEFT_OK : no_memory(r, err);
}

static weft_status measure_lines(reading *r, weft_error *err) {
    wf_box data = r->s->info.data;
    for (int c = 0; c < r->list->num_channels; c++) {
        const exr_attr_chlist_entry_t *channel = &r->list->entries[c];
        int across = channel->x_sampling, down = channel->y_sampling;
        if (across < 1 || down < 1 || data.x0 % across || data.y0 % down)
            return wf_fail(
                err, WEFT_FAILED,
                "%s: its data window does not begin at a sample of channel %s, which "
                "is subsampled %dx%d",
                r->s->path, channel->name.str, across, down);
        r->line_bytes[c] = (r->width + (size_t)across - 1) / (size_t)across *
                           (channel->pixel_type == EXR_PIXEL_HALF ? 2 : 4);
    }
    return WEFT_OK;
}

static weft_status start(reading *r, const wf_subframe *s, float *planes, weft_error *err) {
    wf_box data = s->info.data;
    *r = (reading){.s = s, .pipeline = EXR_DECODE_PIPELINE_INITIALIZER};
    r->width = (size_t)(data.x1 - data.x0);
    r->lines = (size_t)(data.y1 - data.y0);
    exr_get_channels(s->exr, s->part, &r->list);
    size_t longer = (r->width > r->lines ? r->width : r->lines) + 4;
    r->line_bytes = calloc((size_t)r->list->num_channels, sizeof *r->line_bytes);
    r->line = malloc(2 * longer * sizeof *r->line);
    bool ready = wf_chunk_decoder_init(&r->decoder) && r->line_bytes && r->line;
    weft_status status = ready ? measure_lines(r, err) : no_memory(r, err);
    for (; !status && r->count < s->pick.count; r->count++)
        status = make_plane(r, r->count, planes + (size_t)r->count * r->width * r->lines, err);
    return status;
}

static void end(reading *r) {
    wf_chunk_decoder_free(&r->decoder);
    free(r->packed);
    free(r->samples);
    if (r->started) exr_decoding_destroy(r->s->exr, &r->pipeline);
    for (int p = 0; p < 4; p++)
        if (!r->plane[p].borrowed) free(r->plane[p].sample);
    free(r->line_bytes);
    free(r->line);
}

/* ---- Chunks ---- */

/* A line of a channel goes to every plane that is made of it. */
static void take_line(reading *r, int channel, int line, const uint8_t *from) {
    bool half = r->list->entries[channel].pixel_type == EXR_PIXEL_HALF;
    for (int p = 0; p < r->count; p++) {
        const plane *to = &r->plane[p];
        if (to->channel != channel) continue;
        float *sample = to->sample + (size_t)(line / to->down) * to->width;
        if (half)
            wf_floats_of_halves(sample, from, to->width);
        else
            memcpy(sample, from, to->width * sizeof *sample);
    }
}

/* Lines of all channels follow each other, less those without samples. */
static exr_result_t take_lines(reading *r, const uint8_t *from, size_t left, int lines) {
    wf_box data = r->s->info.data;
    for (int y = r->chunk_y; y < r->chunk_y + lines && y < data.y1; y++)
        for (int c = 0; c < r->list->num_channels; c++) {
            const exr_attr_chlist_entry_t *channel = &r->list->entries[c];
            if (y % channel->y_sampling) continue;
            size_t bytes = r->line_bytes[c];
            if (bytes > left) return EXR_ERR_CORRUPT_CHUNK;
            take_line(r, c, y - data.y0, from);
            from += bytes;
            left -= bytes;
        }
    return left ? EXR_ERR_CORRUPT_CHUNK : EXR_ERR_SUCCESS;
}

/* In place of the library's own routines, of which that of version 3.1 for three channels takes
 * all for whole ones. */
static exr_result_t take_unpacked(exr_decode_pipeline_t *pipeline) {
    return take_lines(pipeline->decoding_user_data, pipeline->unpacked_buffer,
                      pipeline->chunk.unpacked_size, pipeline->chunk.height);
}

static exr_result_t decode_by_core(reading *r, const exr_chunk_info_t *chunk) {
    const wf_subframe *s = r->s;
    exr_result_t result = r->started
                              ? exr_decoding_update(s->exr, s->part, chunk, &r->pipeline)
                              : exr_decoding_initialize(s->exr, s->part, chunk, &r->pipeline);
    if (result != EXR_ERR_SUCCESS) return result;
    if (!r->started)
        result = exr_decoding_choose_default_routines(s->exr, s->part, &r->pipeline);
    r->started = true;
    r->pipeline.unpack_and_convert_fn = take_unpacked;
    r->pipeline.decoding_user_data = r;
    return result == EXR_ERR_SUCCESS ? exr_decoding_run(s->exr, s->part, &r->pipeline) : result;
}

/* A chunk that is as long as its samples holds these. */
static exr_result_t decode_by_own(reading *r, const exr_chunk_info_t *chunk,
                                  const wf_exr_shape *shape) {
    const wf_subframe *s = r->s;
    size_t packed = (size_t)chunk->packed_size;
    if (chunk->unpacked_size != shape->bytes || packed > shape->bytes)
        return EXR_ERR_CORRUPT_CHUNK;
    if (!wf_reserve(&r->packed, &r->packed_capacity, packed) ||
        !wf_reserve(&r->samples, &r->samples_capacity, shape->bytes))
        return EXR_ERR_OUT_OF_MEMORY;
    exr_result_t result = exr_read_chunk(s->exr, s->part, chunk, r->packed);
    if (result != EXR_ERR_SUCCESS) return result;
    if (packed == shape->bytes) return take_lines(r, r->packed, packed, chunk->height);
    weft_status status = wf_exr_decode_of(s->layout.compression)(
        &r->decoder.exr, shape, r->packed, packed, r->samples, NULL);
    if (status) return status == WEFT_NO_MEMORY ? EXR_ERR_OUT_OF_MEMORY : EXR_ERR_CORRUPT_CHUNK;
    return take_lines(r, r->samples, shape->bytes, chunk->height);
}

static exr_result_t decode_chunk(reading *r, int y) {
    const wf_subframe *s = r->s;
    exr_chunk_info_t chunk;
    wf_exr_shape shape;
    wf_box data = s->info.data;
    int end = data.y1 - y < s->layout.chunk_lines ? data.y1 : y + s->layout.chunk_lines;
    r->chunk_y = y;
    exr_result_t result = exr_read_scanline_chunk_info(s->exr, s->part, y, &chunk);
    if (result != EXR_ERR_SUCCESS) return result;
    if (!wf_exr_decode_of(s->layout.compression)) return decode_by_core(r, &chunk);
    return wf_chunk_shape(&r->decoder, s, (wf_box){data.x0, y, data.x1, end}, &shape)
               ? decode_by_own(r, &chunk, &shape)
               : EXR_ERR_OUT_OF_MEMORY;
}

static weft_status decode_all(reading *r, weft_error *err) {
    const wf_subframe *s = r->s;
    for (int y = s->info.data.y0; y < s->info.data.y1; y += s->layout.chunk_lines) {
        exr_result_t result = decode_chunk(r, y);
        if (result != EXR_ERR_SUCCESS) return wf_exr_unread(s, y, result, err);
    }
    return WEFT_OK;
}

/* ---- Chroma ---- */

/* count samples, `step` apart, become count * factor ones, of which `most` are stored. */
static void interpolate(const reading *r, const float *from, size_t count, size_t step,
                        int factor, float *to, size_t to_step, size_t most) {
    const wf_chroma_filter *half_band = wf_chroma_filter_of(WF_CHROMA_BT601);
    size_t longer = (r->width > r->lines ? r->width : r->lines) + 4;
    float *a = r->line, *b = r->line + longer;
    for (size_t i = 0; i < count; i++) a[i] = from[i * step];
    for (; factor > 1; factor /= 2) {
        count *= 2;
        wf_chroma_interpolate(half_band, a, count, b);
        float *swap = a;
        a = b, b = swap;
    }
    for (size_t i = 0; i < most; i++) to[i * to_step] = a[i];
}

/* ---- Samples that are not finite ---- */

/* Interpolation would spread them over every sample that its filter reaches. So they are
 * replaced before it, and only the pixels that a bad sample stands for are bad after it, for
 * --fix-nan to treat as it treats others. */

static weft_status replace_bad(const reading *r, plane *p, float **before, weft_error *err) {
    size_t samples = p->width * p->lines;
    wf_nan_fixer fixer = {.rows = {.plane = {p->sample},
                                   .line_stride = p->width,
                                   .type = WF_FLOAT,
                                   .channels = 1,
                                   .y1 = (int)p->lines,
                                   .x1 = (int)p->width},
                          .how = WF_NAN_BOX3};
    int x, y;
    *before = NULL;
    if (!wf_find_not_finite(&fixer.rows, &x, &y)) return WEFT_OK;
    float *fixed = malloc(samples * sizeof *fixed);
    if (!fixed) return no_memory(r, err);
    wf_nan_fix_rows(&fixer, fixed);
    *before = p->sample;
    p->sample = fixed;
    return WEFT_OK;
}

/* Marks the pixels of samples that were bad before. */
static void mark_bad(const reading *r, const plane *p, const float *before, float *full) {
    for (size_t y = 0; y < r->lines; y++)
        for (size_t x = 0; x < r->width; x++) {
            float sample = before[y / (size_t)p->down * p->width + x / (size_t)p->across];
            if (!isfinite(sample)) full[y * r->width + x] = sample;
        }
}

/* A plane of the picture's size from one with fewer samples: first along lines, then up. */
static void fill_plane(const reading *r, const plane *p, float *full) {
    for (size_t y = 0; y < p->lines; y++)
        interpolate(r, p->sample + y * p->width, p->width, 1, p->across, full + y * r->width, 1,
                    r->width);
    for (size_t x = 0; p->down > 1 && x < r->width; x++)
        interpolate(r, full + x, p->lines, r->width, p->down, full + x, r->width, r->lines);
}

static double determinant(const double a[3], const double b[3], const double c[3]) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - b[0] * (a[1] * c[2] - a[2] * c[1]) +
           c[0] * (a[1] * b[2] - a[2] * b[1]);
}

static void xyz_of(exr_attr_v2f_t c, double xyz[3]) {
    double x = (double)c.x, y = (double)c.y != 0 ? (double)c.y : 1e-9;
    xyz[0] = x / y, xyz[1] = 1, xyz[2] = (1 - x - y) / y;
}

/* What R, G and B contribute to the luminance of white: Cramer's rule on their sum being white.
 * False of primaries that no color can be mixed of. */
static bool luma_of(const exr_attr_chromaticities_t *c, double weight[3]) {
    double red[3], green[3], blue[3], white[3];
    xyz_of((exr_attr_v2f_t){.x = c->red_x, .y = c->red_y}, red);
    xyz_of((exr_attr_v2f_t){.x = c->green_x, .y = c->green_y}, green);
    xyz_of((exr_attr_v2f_t){.x = c->blue_x, .y = c->blue_y}, blue);
    xyz_of((exr_attr_v2f_t){.x = c->white_x, .y = c->white_y}, white);
    double all = determinant(red, green, blue);
    weight[0] = determinant(white, green, blue) / all;
    weight[1] = determinant(red, white, blue) / all;
    weight[2] = determinant(red, green, white) / all;
    return fabs(all) > 1e-6 && weight[1] > 1e-3;
}

static void luma_weights(const wf_subframe *s, double weight[3]) {
    static const exr_attr_chromaticities_t rec709 = {.64f, .33f, .3f,    .6f,
                                                     .15f, .06f, .3127f, .329f};
    const exr_attribute_t *found = NULL;
    exr_get_attribute_by_name(s->exr, s->part, "chromaticities", &found);
    bool given = found && found->type == EXR_ATTR_CHROMATICITIES;
    if (!given || !luma_of(found->chromaticities, weight)) luma_of(&rec709, weight);
}

/* RY = (R - Y) / Y and BY = (B - Y) / Y, as the technical introduction to OpenEXR has them. */
static void make_rgb(const reading *r, float *planes) {
    double weight[3];
    size_t samples = r->width * r->lines;
    float *y = planes, *ry = planes + samples, *by = planes + 2 * samples;
    luma_weights(r->s, weight);
    for (size_t i = 0; i < samples; i++) {
        double light = (double)y[i], red = ((double)ry[i] + 1) * light,
               blue = ((double)by[i] + 1) * light;
        y[i] = (float)red;
        ry[i] = (float)((light - weight[0] * red - weight[2] * blue) / weight[1]);
        by[i] = (float)blue;
    }
}

static weft_status finish_plane(reading *r, plane *p, float *full, weft_error *err) {
    float *before;
    weft_status status = p->borrowed ? WEFT_OK : replace_bad(r, p, &before, err);
    if (status || p->borrowed) return status;
    fill_plane(r, p, full);
    if (before) mark_bad(r, p, before, full);
    free(before);
    return WEFT_OK;
}

static weft_status finish(reading *r, float *planes, weft_error *err) {
    size_t samples = r->width * r->lines;
    weft_status status = WEFT_OK;
    for (int p = 0; p < r->count && !status; p++)
        status = finish_plane(r, &r->plane[p], planes + (size_t)p * samples, err);
    if (!status && r->s->pick.kind == WF_PICTURE_LUMINANCE_CHROMA) make_rgb(r, planes);
    return status;
}

weft_status wf_exr_read_subsampled(const wf_subframe *s, float *planes, weft_error *err) {
    reading r;
    weft_status status = start(&r, s, planes, err);
    if (!status) status = decode_all(&r, err);
    if (!status) status = finish(&r, planes, err);
    end(&r);
    return status;
}
