/* Writes sample buffers: deep scanline EXR, a line a chunk, deflated here by any thread. */
#include "convert/write/deep_write.h"

#include <libdeflate.h>
#include <stdlib.h>
#include <string.h>

#include "convert/base/outfile.h"
#include "convert/write/exr_header.h"
#include "convert/write/exr_zip.h"

struct wf_deep_writer {
    wf_outfile *file;
    int lines;
    int64_t table, end; /* bytes before the table of chunks, and of all that was written */
    uint64_t chunk[];   /* [lines]: where each begins */
};

/* In the order of the alphabet. */
static const char *const names[] = {"A", "B", "G", "R", "sample.t", "sample.x", "sample.y"};
static const wf_deep_channel written[] = {WF_DEEP_A, WF_DEEP_B, WF_DEEP_G, WF_DEEP_R,
                                          WF_DEEP_T, WF_DEEP_X, WF_DEEP_Y};

#define WRITTEN (sizeof written / sizeof *written)
enum { WITH_ALPHA = 0, WITHOUT_ALPHA = 1 }; /* of `written`, the first that there is */

/* ---- Lines ---- */

static bool deflate(struct libdeflate_compressor *how, const uint8_t *raw, size_t count,
                    uint8_t **out, size_t *out_bytes) {
    uint8_t *merged = malloc(count + 1);
    *out = malloc(count + 1);
    bool enough = merged && *out;
    if (enough) *out_bytes = wf_exr_zip(how, raw, count, merged, *out);
    free(merged);
    return enough;
}

weft_status wf_deep_pack(int width, const wf_deep_line *line, wf_deep_packed *out,
                         weft_error *err) {
    size_t samples = (size_t)line->upto[width - 1], each = samples * sizeof(float);
    size_t first = line->channel[WF_DEEP_A] ? WITH_ALPHA : WITHOUT_ALPHA;
    size_t bytes = (WRITTEN - first) * each;
    *out = (wf_deep_packed){.unpacked_bytes = bytes};
    struct libdeflate_compressor *how = libdeflate_alloc_compressor(1);
    uint8_t *raw = malloc(bytes + 1);
    bool good = how && raw;
    /* Lays the samples out as they are stored: all of a line's for one channel, then for the
     * next. */
    uint8_t *to = raw;
    for (size_t c = first; good && c < WRITTEN; c++, to += each)
        memcpy(to, line->channel[written[c]], each);
    good = good && deflate(how, raw, bytes, &out->data, &out->data_bytes) &&
           deflate(how, (const uint8_t *)line->upto, (size_t)width * sizeof *line->upto,
                   &out->table, &out->table_bytes);
    free(raw);
    if (how) libdeflate_free_compressor(how);
    return good ? WEFT_OK : wf_fail(err, WEFT_NO_MEMORY, "no memory for a line of samples");
}

void wf_deep_packed_free(wf_deep_packed *packed) {
    free(packed->table);
    free(packed->data);
    *packed = (wf_deep_packed){0};
}

/* ---- Files ---- */

static void describe(wf_exr_header *h, const wf_raster *r, const char *color_space,
                     bool alpha) {
    size_t first = alpha ? WITH_ALPHA : WITHOUT_ALPHA;
    wf_exr_header_begin(h, WF_EXR_DEEP);
    wf_exr_put_text(h, "type", "deepscanline");
    wf_exr_put_text(h, "name", "samples");
    wf_exr_put_int(h, "version", 1);
    wf_exr_put_required(h, WF_EXR_ZIPS, r->width_px, r->lines, r->pixel_aspect);
    wf_exr_put_channels(h, names + first, WRITTEN - first);
    wf_exr_put_ratio(h, "framesPerSecond", r->frame_rate);
    wf_exr_put_text(h, "weft:raster", r->name);
    wf_exr_put_text(h, "weft:colorSpace", color_space);
    wf_exr_put_int(h, "chunkCount", r->lines); /* a line a chunk */
    wf_exr_header_end(h);
}

/* Goes on at the end of the file. */
static weft_status put(wf_deep_writer *w, const void *data, size_t bytes, weft_error *err) {
    w->end += (int64_t)bytes;
    return wf_outfile_write(w->file, data, bytes, err);
}

/* The header, and room for the table, which is known at the end. */
static weft_status begin(wf_deep_writer *w, const char *path, const wf_exr_header *h,
                         weft_error *err) {
    if (h->full)
        return wf_fail(err, WEFT_FAILED, "%s: the names of its colors or raster are too long",
                       path);
    weft_status status = put(w, h->bytes, h->used, err);
    w->table = w->end;
    return status ? status : put(w, w->chunk, (size_t)w->lines * sizeof *w->chunk, err);
}

weft_status wf_deep_writer_new(const char *path, const wf_raster *raster,
                               const char *color_space, bool alpha, bool overwrite,
                               wf_deep_writer **out, weft_error *err) {
    wf_exr_header h;
    wf_deep_writer *w = calloc(1, sizeof *w + (size_t)raster->lines * sizeof *w->chunk);
    if (!w) return wf_fail(err, WEFT_NO_MEMORY, "%s: no memory", path);
    w->lines = raster->lines;
    describe(&h, raster, color_space, alpha);
    weft_status status = wf_outfile_open(path, overwrite, &w->file, err);
    if (!status) status = begin(w, path, &h, err);
    if (status) {
        wf_deep_abandon(w);
        return status;
    }
    *out = w;
    return WEFT_OK;
}

weft_status wf_deep_write(wf_deep_writer *w, int y, const wf_deep_packed *line,
                          weft_error *err) {
    const uint64_t bytes[3] = {line->table_bytes, line->data_bytes, line->unpacked_bytes};
    const int32_t number = y;
    w->chunk[y] = (uint64_t)w->end;
    weft_status status = put(w, &number, sizeof number, err);
    if (!status) status = put(w, bytes, sizeof bytes, err);
    if (!status) status = put(w, line->table, line->table_bytes, err);
    return status ? status : put(w, line->data, line->data_bytes, err);
}

weft_status wf_deep_commit(wf_deep_writer *w, weft_error *err) {
    size_t bytes = (size_t)w->lines * sizeof *w->chunk;
    weft_status status = wf_outfile_seek(w->file, w->table, err);
    if (!status) status = wf_outfile_write(w->file, w->chunk, bytes, err);
    if (status) {
        wf_deep_abandon(w);
        return status;
    }
    status = wf_outfile_commit(w->file, err);
    free(w);
    return status;
}

void wf_deep_abandon(wf_deep_writer *w) {
    if (!w) return;
    wf_outfile_abandon(w->file);
    free(w);
}
