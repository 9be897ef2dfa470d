/* Reads sample buffers: deep scanline EXR, whose chunks are inflated here, a line at a time. */
#include "convert/read/deep_read.h"

#include <inttypes.h>
#include <libdeflate.h>
#include <math.h>
#include <openexr.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "convert/base/reserve.h"
#include "convert/read/choice/exr_parts.h"
#include "convert/read/source_exr.h"
#include "convert/read/exr/unzip.h"
#include "filters/base/half.h"

/* One pixel's samples beyond these are no renderer's. */
#define MOST_IN_PIXEL (1 << 20)

typedef struct stored {
    int what; /* wf_deep_channel; -1: not ours */
    exr_pixel_type_t type;
} stored;

#define MOST_STORED 32

struct wf_deep_file {
    char *path;
    wf_exr_stream stream;
    exr_context_t exr; /* of the stream */
    exr_compression_t compression;
    int width, lines, y0, y1; /* of the raster; of the file's lines */
    stored channel[MOST_STORED];
    int count;
    size_t sample_bytes;
    bool has[WF_DEEP_CHANNELS];
    const char *raster, *space;
};

static const struct {
    const char *name;
    bool needed;
} names[] = {
    [WF_DEEP_B] = {"B", true},        [WF_DEEP_G] = {"G", true},
    [WF_DEEP_R] = {"R", true},        [WF_DEEP_T] = {"sample.t", true},
    [WF_DEEP_X] = {"sample.x", true}, [WF_DEEP_Y] = {"sample.y", true},
    [WF_DEEP_A] = {"A", false},       [WF_DEEP_WEIGHT] = {"sample.w", false},
};

static bool is_deep(exr_context_t exr) {
    exr_storage_t storage;
    return exr_get_storage(exr, 0, &storage) == EXR_ERR_SUCCESS &&
           storage == EXR_STORAGE_DEEP_SCANLINE;
}

weft_status wf_deep_is(const char *path, bool *is, weft_error *err) {
    wf_exr_stream stream = {.exr = NULL};
    struct stat about;
    *is = false;
    if (stat(path, &about) || !S_ISREG(about.st_mode)) return WEFT_OK;
    exr_result_t result = wf_exr_stream_start(&stream, path);
    weft_status status = wf_exr_stream_trouble(&stream, result, path, err);
    bool deep = result == EXR_ERR_SUCCESS && is_deep(stream.exr);
    const exr_attr_chlist_t *list = deep ? wf_exr_channels(stream.exr, 0) : NULL;
    for (int c = 0; list && c < list->num_channels; c++)
        *is |= !strcmp(list->entries[c].name.str, names[WF_DEEP_X].name);
    wf_exr_stream_end(&stream);
    return status;
}

/* ---- Opening ---- */

static int what_is(const char *name) {
    for (int w = 0; w < WF_DEEP_CHANNELS; w++)
        if (!strcmp(names[w].name, name)) return w;
    return -1;
}

static weft_status find_channels(wf_deep_file *f, weft_error *err) {
    const exr_attr_chlist_t *list = wf_exr_channels(f->exr, 0);
    if (!list || list->num_channels > MOST_STORED)
        return wf_fail(err, WEFT_FAILED, "%s: its channels cannot be read, or are too many",
                       f->path);
    for (int c = 0; c < list->num_channels; c++) {
        stored *s = &f->channel[f->count++];
        *s = (stored){what_is(list->entries[c].name.str), list->entries[c].pixel_type};
        f->sample_bytes += s->type == EXR_PIXEL_HALF ? 2 : 4;
        if (s->what >= 0 && s->type != EXR_PIXEL_UINT) f->has[s->what] = true;
    }
    for (int w = 0; w < WF_DEEP_CHANNELS; w++)
        if (names[w].needed && !f->has[w])
            return wf_fail(err, WEFT_FAILED,
                           "%s: a sample buffer has channels R G B sample.x sample.y sample.t, "
                           "half or float, and %s is missing",
                           f->path, names[w].name);
    return WEFT_OK;
}

static weft_status check_windows(wf_deep_file *f, const wf_raster *raster, weft_error *err) {
    exr_attr_box2i_t display, data;
    if (exr_get_display_window(f->exr, 0, &display) || exr_get_data_window(f->exr, 0, &data))
        return wf_fail(err, WEFT_FAILED, "%s: it has no windows", f->path);
    int64_t width = (int64_t)display.max.x - display.min.x + 1;
    int64_t lines = (int64_t)display.max.y - display.min.y + 1;
    bool same = data.min.x == 0 && data.max.x == raster->width_px - 1 && data.min.y >= 0 &&
                data.max.y < raster->lines && data.min.y <= data.max.y;
    if (width != raster->width_px || lines != raster->lines || !same)
        return wf_fail(err, WEFT_FAILED,
                       "%s: its samples are of a raster of %" PRId64 "x%" PRId64
                       ", and %s is %dx%d; give --raster",
                       f->path, width, lines, raster->name, raster->width_px, raster->lines);
    f->width = raster->width_px;
    f->lines = raster->lines;
    f->y0 = data.min.y;
    f->y1 = data.max.y + 1;
    return WEFT_OK;
}

static weft_status check_compression(wf_deep_file *f, weft_error *err) {
    bool known =
        !exr_get_compression(f->exr, 0, &f->compression) &&
        (f->compression == EXR_COMPRESSION_NONE || f->compression == EXR_COMPRESSION_RLE ||
         f->compression == EXR_COMPRESSION_ZIPS);
    return known ? WEFT_OK
                 : wf_fail(err, WEFT_FAILED,
                           "%s: deep pictures are compressed by none, RLE or ZIPS, not as this",
                           f->path);
}

static const char *text_of(const wf_deep_file *f, const char *name) {
    const char *text = NULL;
    int32_t length;
    return exr_attr_get_string(f->exr, 0, name, &length, &text) || !text ? "" : text;
}

weft_status wf_deep_open(const char *path, const wf_raster *raster, wf_deep_file **out,
                         weft_error *err) {
    wf_deep_file *f = calloc(1, sizeof *f);
    if (!f || !(f->path = strdup(path))) {
        free(f);
        return wf_fail(err, WEFT_NO_MEMORY, "%s: no memory", path);
    }
    exr_result_t result = wf_exr_stream_start(&f->stream, path);
    weft_status status = wf_exr_stream_trouble(&f->stream, result, path, err);
    f->exr = f->stream.exr;
    if (!status && result != EXR_ERR_SUCCESS)
        status = wf_fail(err, WEFT_FAILED, "%s: %s", path, wf_exr_trouble(result));
    else if (!status && !is_deep(f->exr))
        status = wf_fail(err, WEFT_FAILED,
                         "%s: the first file is a sample buffer and this one is not", path);
    if (!status) status = find_channels(f, err);
    if (!status) status = check_windows(f, raster, err);
    if (!status) status = check_compression(f, err);
    if (status) {
        wf_deep_close(f);
        return status;
    }
    f->raster = text_of(f, "weft:raster");
    f->space = text_of(f, "weft:colorSpace");
    *out = f;
    return WEFT_OK;
}

void wf_deep_close(wf_deep_file *f) {
    if (!f) return;
    wf_exr_stream_end(&f->stream);
    free(f->path);
    free(f);
}

const char *wf_deep_raster(const wf_deep_file *f) {
    return f->raster;
}

const char *wf_deep_space(const wf_deep_file *f) {
    return f->space;
}

/* ---- Lines ---- */

static weft_status damaged(const wf_deep_file *f, int y, const char *how, weft_error *err) {
    return wf_fail(err, WEFT_FAILED, "%s: line %d is damaged: %s", f->path, y, how);
}

static weft_status unread(const wf_deep_file *f, int y, exr_result_t result, const char *how,
                          weft_error *err) {
    weft_status status = wf_exr_stream_trouble(&f->stream, result, f->path, err);
    return status ? status : damaged(f, y, how, err);
}

static weft_status no_memory(const wf_deep_file *f, int y, weft_error *err) {
    return wf_fail(err, WEFT_NO_MEMORY, "%s: no memory for line %d", f->path, y);
}

/* Runs: a count n >= 0 and a byte that comes n + 1 times, or n < 0 and -n bytes as they are. */
static bool expand_runs(const uint8_t *in, size_t in_bytes, uint8_t *out, size_t bytes) {
    const uint8_t *end = in + in_bytes, *last = out + bytes;
    while (in < end) {
        int n = (int8_t)*in++;
        size_t count = n < 0 ? (size_t)-n : (size_t)n + 1, take = n < 0 ? count : 1;
        if (count > (size_t)(last - out) || take > (size_t)(end - in)) return false;
        if (n < 0)
            memcpy(out, in, count);
        else
            memset(out, *in, count);
        in += take;
        out += count;
    }
    return out == last;
}

static weft_status inflate(const uint8_t *in, size_t in_bytes, uint8_t *out, size_t bytes) {
    struct libdeflate_decompressor *how = libdeflate_alloc_decompressor();
    if (!how) return WEFT_NO_MEMORY;
    bool good =
        libdeflate_zlib_decompress(how, in, in_bytes, out, bytes, NULL) == LIBDEFLATE_SUCCESS;
    libdeflate_free_decompressor(how);
    return good ? WEFT_OK : WEFT_FAILED;
}

/* A block of a chunk, unpacked; stored ones are as they are. WEFT_FAILED: it is damaged. */
static weft_status unpack(const wf_deep_file *f, wf_deep_buffers *b, const uint8_t *in,
                          size_t in_bytes, size_t bytes, const uint8_t **out) {
    *out = in;
    if (f->compression == EXR_COMPRESSION_NONE || in_bytes == bytes)
        return in_bytes == bytes ? WEFT_OK : WEFT_FAILED;
    if (!wf_reserve(&b->inflated, &b->inflated_capacity, bytes + 1) ||
        !wf_reserve(&b->merged, &b->merged_capacity, bytes + 64))
        return WEFT_NO_MEMORY;
    weft_status status = WEFT_OK;
    if (f->compression != EXR_COMPRESSION_RLE)
        status = inflate(in, in_bytes, b->inflated, bytes);
    else if (!expand_runs(in, in_bytes, b->inflated, bytes))
        status = WEFT_FAILED;
    if (!status) wf_unzip_ops_best()->merge(b->merged, b->inflated, bytes);
    *out = b->merged;
    return status;
}

static bool check_counts(const int32_t *upto, int width) {
    for (int i = 0, before = 0; i < width; before = upto[i++])
        if (upto[i] < before || upto[i] - before > MOST_IN_PIXEL) return false;
    return true;
}

static float value_at(const uint8_t *from, exr_pixel_type_t type, size_t i) {
    uint16_t half;
    float value;
    if (type == EXR_PIXEL_HALF) {
        memcpy(&half, from + 2 * i, sizeof half);
        return wf_half_value(half);
    }
    memcpy(&value, from + 4 * i, sizeof value);
    return value;
}

static bool take_channels(const wf_deep_file *f, wf_deep_buffers *b, const uint8_t *raw,
                          size_t samples) {
    size_t need = WF_DEEP_CHANNELS * (samples + 1) * sizeof(float);
    if (!wf_reserve(&b->floats, &b->floats_capacity, need)) return false;
    for (int w = 0; w < WF_DEEP_CHANNELS; w++)
        b->line.channel[w] = f->has[w] ? b->floats + (size_t)w * (samples + 1) : NULL;
    for (int c = 0; c < f->count; c++) {
        const stored *s = &f->channel[c];
        float *to = s->what < 0 || s->type == EXR_PIXEL_UINT ? NULL : b->line.channel[s->what];
        for (size_t i = 0; to && i < samples; i++) to[i] = value_at(raw, s->type, i);
        raw += samples * (s->type == EXR_PIXEL_HALF ? 2 : 4);
    }
    return true;
}

static weft_status check_samples(const wf_deep_file *f, const wf_deep_buffers *b, int y,
                                 weft_error *err) {
    const wf_deep_line *l = &b->line;
    for (int i = 0, k = 0; i < f->width; i++)
        for (; k < l->upto[i]; k++) {
            for (int w = 0; w < WF_DEEP_CHANNELS; w++)
                if (l->channel[w] && !isfinite(l->channel[w][k]))
                    return wf_fail(err, WEFT_FAILED,
                                   "%s: a sample of line %d, pixel %d has a %s that is not "
                                   "finite",
                                   f->path, y, i, names[w].name);
            float x = l->channel[WF_DEEP_X][k], at = l->channel[WF_DEEP_Y][k];
            if (!(x >= (float)i && x <= (float)(i + 1) && at >= (float)y &&
                  at <= (float)(y + 1)))
                return wf_fail(err, WEFT_FAILED,
                               "%s: a sample of line %d, pixel %d says that it lies at %g, %g",
                               f->path, y, i, (double)x, (double)at);
        }
    return WEFT_OK;
}

/* The packed table of counts and the packed samples of line y, one after the other. */
static weft_status read_packed(const wf_deep_file *f, wf_deep_buffers *b, int y, size_t table,
                               exr_chunk_info_t *out, weft_error *err) {
    exr_chunk_info_t info;
    exr_result_t result = exr_read_scanline_chunk_info(f->exr, 0, y, &info);
    if (result) return unread(f, y, result, "it is not there", err);
    /* A deflated block is not longer than it was, and a table's length is known. */
    if (info.sample_count_table_size > 2 * table + 1024 ||
        info.packed_size > (uint64_t)1 << 32 || info.unpacked_size > (uint64_t)1 << 32)
        return damaged(f, y, "its sizes are not those of samples", err);
    if (!wf_reserve(&b->packed, &b->packed_capacity,
                    (size_t)info.sample_count_table_size + (size_t)info.packed_size + 1))
        return no_memory(f, y, err);
    *out = info;
    result = exr_read_deep_chunk(f->exr, 0, &info, b->packed + info.sample_count_table_size,
                                 b->packed);
    return result ? unread(f, y, result, "it cannot be read", err) : WEFT_OK;
}

static weft_status read_chunk(const wf_deep_file *f, wf_deep_buffers *b, int y,
                              weft_error *err) {
    exr_chunk_info_t info = {0};
    size_t table = (size_t)f->width * sizeof(int32_t);
    const uint8_t *counts, *raw;
    weft_status status = read_packed(f, b, y, table, &info, err);
    if (status) return status;
    size_t counts_bytes = (size_t)info.sample_count_table_size;
    status = unpack(f, b, b->packed, counts_bytes, table, &counts);
    if (status == WEFT_NO_MEMORY) return no_memory(f, y, err);
    if (status) return damaged(f, y, "its counts do not unpack", err);
    memcpy(b->line.upto, counts, table);
    if (!check_counts(b->line.upto, f->width)) return damaged(f, y, "its counts are none", err);
    size_t samples = (size_t)b->line.upto[f->width - 1], bytes = samples * f->sample_bytes;
    status = bytes == info.unpacked_size
                 ? unpack(f, b, b->packed + counts_bytes, (size_t)info.packed_size, bytes, &raw)
                 : WEFT_FAILED;
    if (status == WEFT_FAILED)
        return damaged(f, y, "its samples do not unpack to their number", err);
    if (status || !take_channels(f, b, raw, samples)) return no_memory(f, y, err);
    return check_samples(f, b, y, err);
}

weft_status wf_deep_read(const wf_deep_file *f, wf_deep_buffers *b, int y, weft_error *err) {
    if (!b->line.upto) b->line.upto = malloc((size_t)f->width * sizeof *b->line.upto);
    if (!b->line.upto) return wf_fail(err, WEFT_NO_MEMORY, "%s: no memory", f->path);
    if (y >= f->y0 && y < f->y1) return read_chunk(f, b, y, err);
    memset(b->line.upto, 0, (size_t)f->width * sizeof *b->line.upto);
    return WEFT_OK;
}

void wf_deep_buffers_free(wf_deep_buffers *b) {
    free(b->packed);
    free(b->inflated);
    free(b->merged);
    free(b->floats);
    free(b->line.upto);
    *b = (wf_deep_buffers){0};
}
