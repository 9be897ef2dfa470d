/* Writes sample buffers: deep scanline EXR, a line a chunk, deflated here by any thread. */
#include "convert/write/deep_write.h"

#include <errno.h>
#include <libdeflate.h>
#include <openexr.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "convert/base/outplace.h"
#include "convert/write/exr_zip.h"

/* OpenEXRCore puts the file together. It does not report writes that fail, so they are noted
 * here. */
struct wf_deep_writer {
    wf_outplace place;
    int fd;
    int code; /* errno of the first write that failed; 0: none did */
    exr_context_t exr;
};

static const struct {
    const char *name;
    wf_deep_channel channel;
} written[] = {{"A", WF_DEEP_A},       {"B", WF_DEEP_B},        {"G", WF_DEEP_G},
               {"R", WF_DEEP_R},       {"sample.t", WF_DEEP_T}, {"sample.x", WF_DEEP_X},
               {"sample.y", WF_DEEP_Y}};

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
        memcpy(to, line->channel[written[c].channel], each);
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

static int64_t put_bytes(exr_const_context_t exr, void *user, const void *data, uint64_t bytes,
                         uint64_t at, exr_stream_error_func_ptr_t error) {
    wf_deep_writer *w = user;
    (void)exr, (void)error;
    for (uint64_t done = 0; done < bytes && !w->code;) {
        ssize_t n = pwrite(w->fd, (const char *)data + done, bytes - done, (off_t)(at + done));
        if (n < 0 && errno != EINTR) w->code = errno;
        done += n > 0 ? (uint64_t)n : 0;
    }
    return w->code ? -1 : (int64_t)bytes;
}

/* Where neither the system nor memory is at fault, OpenEXRCore is. */
static weft_status fail(const wf_deep_writer *w, const char *what, weft_error *err) {
    if (w->code)
        return wf_fail(err, WEFT_FAILED, "%s: %s cannot be written: %s", w->place.path, what,
                       strerror(w->code));
    return wf_fail(err, WEFT_NO_MEMORY, "%s: no memory to write %s", w->place.path, what);
}

static bool set_text(exr_context_t exr, const char *name, const char *text) {
    return !*text || !exr_attr_set_string(exr, 0, name, text);
}

static bool describe(wf_deep_writer *w, const wf_raster *r, const char *color_space,
                     bool alpha) {
    exr_attr_box2i_t window = {.min = {.x = 0, .y = 0},
                               .max = {.x = r->width_px - 1, .y = r->lines - 1}};
    exr_attr_v2f_t center = {.x = 0, .y = 0};
    exr_attr_rational_t rate = {(int32_t)r->frame_rate.num, (uint32_t)r->frame_rate.den};
    bool good = !exr_add_part(w->exr, "samples", EXR_STORAGE_DEEP_SCANLINE, NULL) &&
                !exr_initialize_required_attr(
                    w->exr, 0, &window, &window, (float)wf_ratio_value(r->pixel_aspect),
                    &center, 1, EXR_LINEORDER_INCREASING_Y, EXR_COMPRESSION_ZIPS);
    for (size_t c = alpha ? WITH_ALPHA : WITHOUT_ALPHA; good && c < WRITTEN; c++)
        good = !exr_add_channel(w->exr, 0, written[c].name, EXR_PIXEL_FLOAT,
                                EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
    return good && !exr_attr_set_rational(w->exr, 0, "framesPerSecond", &rate) &&
           set_text(w->exr, "weft:raster", r->name) &&
           set_text(w->exr, "weft:colorSpace", color_space) && !exr_write_header(w->exr);
}

weft_status wf_deep_writer_new(const char *path, const wf_raster *raster,
                               const char *color_space, bool alpha, bool overwrite,
                               wf_deep_writer **out, weft_error *err) {
    exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
    wf_deep_writer *w = calloc(1, sizeof *w);
    if (!w) return wf_fail(err, WEFT_NO_MEMORY, "%s: no memory", path);
    w->fd = -1;
    how.user_data = w;
    how.write_fn = put_bytes;
    weft_status status = wf_outplace_open(path, overwrite, &w->place, &w->fd, err);
    if (!status && (exr_start_write(&w->exr, path, EXR_WRITE_FILE_DIRECTLY, &how) ||
                    !describe(w, raster, color_space, alpha)))
        status = fail(w, "its header", err);
    if (status) {
        wf_deep_abandon(w);
        return status;
    }
    *out = w;
    return WEFT_OK;
}

weft_status wf_deep_write(wf_deep_writer *w, int y, const wf_deep_packed *line,
                          weft_error *err) {
    exr_result_t result =
        exr_write_deep_scanline_chunk(w->exr, 0, y, line->data, line->data_bytes,
                                      line->unpacked_bytes, line->table, line->table_bytes);
    char what[32];
    if (result == EXR_ERR_SUCCESS && !w->code) return WEFT_OK;
    snprintf(what, sizeof what, "line %d", y);
    return fail(w, what, err);
}

weft_status wf_deep_commit(wf_deep_writer *w, weft_error *err) {
    exr_result_t result = exr_finish(&w->exr);
    weft_status status = WEFT_OK;
    if (!w->code && fsync(w->fd)) w->code = errno;
    if (result != EXR_ERR_SUCCESS || w->code)
        status = fail(w, "its end", err);
    else {
        status = wf_outplace_publish(&w->place, w->fd, err);
        w->fd = -1;
    }
    wf_deep_abandon(w);
    return status;
}

void wf_deep_abandon(wf_deep_writer *w) {
    if (!w) return;
    if (w->exr) exr_finish(&w->exr);
    if (w->fd >= 0) close(w->fd);
    wf_outplace_forget(&w->place);
    free(w);
}
