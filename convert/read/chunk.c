/* One EXR chunk to samples, by a decoder of our own where there is one, else by OpenEXRCore. */
#include "convert/read/chunk.h"

#include <stdlib.h>
#include <string.h>

#include "convert/base/reserve.h"
#include "convert/read/source_exr.h"

bool wf_chunk_decoder_init(wf_chunk_decoder *decoder) {
    *decoder = (wf_chunk_decoder){.channel = NULL};
    return wf_exr_decoder_init(&decoder->exr);
}

void wf_chunk_decoder_free(wf_chunk_decoder *decoder) {
    wf_exr_decoder_free(&decoder->exr);
    free(decoder->channel);
}

static weft_status damaged(const wf_subframe *s, const wf_chunk *chunk, const char *how,
                           weft_error *err) {
    return wf_fail(err, WEFT_FAILED, "%s: the chunk at line %d is damaged: %s", s->path,
                   chunk->place.y0 - s->info.display.y0, how);
}

static size_t chunk_bytes(const wf_subframe *s, const wf_chunk *chunk) {
    return (size_t)(chunk->place.x1 - chunk->place.x0) *
           (size_t)(chunk->place.y1 - chunk->place.y0) * s->layout.pixel_bytes;
}

/* ---- What a chunk holds ---- */

static size_t samples_between(int first, int end, int step) {
    size_t samples = 0;
    if (step == 1) return (size_t)(end - first);
    for (int i = first; i < end; i++) samples += i % step == 0;
    return samples;
}

static wf_exr_channel channel_of(const exr_attr_chlist_entry_t *c, wf_box place) {
    wf_exr_channel channel = {
        .name = c->name.str,
        .type = (wf_exr_type)c->pixel_type,
        .bytes = c->pixel_type == EXR_PIXEL_HALF ? 2 : 4,
        .across = c->x_sampling,
        .down = c->y_sampling,
        .linear = c->p_linear,
        .width = samples_between(place.x0, place.x1, c->x_sampling),
        .lines = samples_between(place.y0, place.y1, c->y_sampling),
    };
    channel.line_bytes = channel.width * channel.bytes;
    channel.plane_bytes = channel.line_bytes * channel.lines;
    return channel;
}

bool wf_chunk_shape(wf_chunk_decoder *d, const wf_subframe *s, wf_box place,
                    wf_exr_shape *shape) {
    const exr_attr_chlist_t *list = NULL;
    exr_get_channels(s->exr, s->part, &list);
    if (!wf_reserve(&d->channel, &d->channel_capacity,
                    (size_t)list->num_channels * sizeof *d->channel))
        return false;
    *shape = (wf_exr_shape){d->channel, list->num_channels, place.y0, place.y1 - place.y0, 0};
    for (int c = 0; c < list->num_channels; c++) {
        d->channel[c] = channel_of(&list->entries[c], place);
        shape->bytes += d->channel[c].plane_bytes;
    }
    return true;
}

/* ---- Decoding ---- */

static weft_status decode_by_own(wf_chunk_decoder *d, const wf_subframe *s,
                                 const wf_chunk *chunk, const uint8_t *packed, uint8_t *out,
                                 weft_error *err) {
    wf_exr_decode_fn *decode = wf_exr_decode_of(s->layout.compression);
    wf_exr_shape shape;
    weft_error why = {""};
    if (!wf_chunk_shape(d, s, chunk->place, &shape))
        return wf_fail(err, WEFT_NO_MEMORY, "%s: no memory for a chunk", s->path);
    weft_status status =
        decode(&d->exr, &shape, packed, (size_t)chunk->info.packed_size, out, &why);
    if (status == WEFT_FAILED) return damaged(s, chunk, why.text, err);
    return status ? wf_fail(err, status, "%s: %s", s->path, why.text) : WEFT_OK;
}

static exr_result_t already_read(exr_decode_pipeline_t *pipeline) {
    (void)pipeline;
    return EXR_ERR_SUCCESS;
}

/* Every channel gets a place: the library crashes where one has none. */
static void place_channels(exr_decode_pipeline_t *pipeline, const wf_subframe *s,
                           const wf_chunk *chunk, uint8_t *out) {
    size_t width = (size_t)(chunk->place.x1 - chunk->place.x0), before = 0;
    for (int c = 0; c < pipeline->channel_count; c++) {
        exr_coding_channel_info_t *channel = &pipeline->channels[c];
        channel->decode_to_ptr = out + before * width;
        channel->user_pixel_stride = channel->bytes_per_element;
        channel->user_line_stride = (int32_t)(s->layout.pixel_bytes * width);
        channel->user_bytes_per_element = (int16_t)channel->bytes_per_element;
        channel->user_data_type = channel->data_type;
        before += (size_t)channel->bytes_per_element;
    }
}

static exr_result_t run_pipeline(exr_decode_pipeline_t *pipeline, const wf_subframe *s,
                                 const wf_chunk *chunk, const uint8_t *packed, uint8_t *out) {
    place_channels(pipeline, s, chunk, out);
    exr_result_t result = exr_decoding_choose_default_routines(s->exr, s->part, pipeline);
    if (result != EXR_ERR_SUCCESS) return result;
    pipeline->read_fn = already_read;
    pipeline->packed_buffer =
        (void *)(uintptr_t)packed; /* not freed, since its alloc_size is 0 */
    result = exr_decoding_run(s->exr, s->part, pipeline);
    pipeline->packed_buffer = NULL;
    return result;
}

static weft_status decode_by_core(wf_chunk_decoder *d, const wf_subframe *s,
                                  const wf_chunk *chunk, const uint8_t *packed, uint8_t *out,
                                  weft_error *err) {
    exr_decode_pipeline_t pipeline = {0};
    exr_result_t result = exr_decoding_initialize(s->exr, s->part, &chunk->info, &pipeline);
    if (result == EXR_ERR_SUCCESS) result = run_pipeline(&pipeline, s, chunk, packed, out);
    exr_decoding_destroy(s->exr, &pipeline);
    d->exr.suspect = true;
    if (result == EXR_ERR_SUCCESS) return WEFT_OK;
    weft_status status = wf_exr_stream_trouble(&s->stream, result, s->path, err);
    return status ? status : damaged(s, chunk, wf_exr_trouble(result), err);
}

/* A deflated chunk that came out just as long as its samples should have been stored as it was,
 * but OpenEXRCore 3.1 writes the deflated bytes. Samples that are a zlib stream, with the right
 * checksum at its end, do not happen. */
static bool inflates_to_its_own_size(wf_chunk_decoder *d, const wf_subframe *s,
                                     const wf_chunk *chunk, const uint8_t *packed,
                                     uint8_t *out) {
    exr_compression_t how = s->layout.compression;
    bool zip = how == EXR_COMPRESSION_ZIP || how == EXR_COMPRESSION_ZIPS;
    bool headed = chunk->info.packed_size > 2 && (packed[0] & 15) == 8 &&
                  (packed[0] * 256 + packed[1]) % 31 == 0;
    return zip && headed && decode_by_own(d, s, chunk, packed, out, NULL) == WEFT_OK;
}

weft_status wf_chunk_decode(wf_chunk_decoder *d, const wf_subframe *s, const wf_chunk *chunk,
                            const uint8_t *packed, uint8_t *out, weft_error *err) {
    exr_compression_t how = s->layout.compression;
    if (chunk->info.packed_size == chunk_bytes(s, chunk)) {
        if (inflates_to_its_own_size(d, s, chunk, packed, out)) return WEFT_OK;
        memcpy(out, packed, chunk_bytes(s, chunk)); /* stored as it is: it would not shrink */
        d->exr.suspect = true;
        return WEFT_OK;
    }
    if (how == EXR_COMPRESSION_NONE) return damaged(s, chunk, "it is too short", err);
    return wf_exr_decode_of(how) ? decode_by_own(d, s, chunk, packed, out, err)
                                 : decode_by_core(d, s, chunk, packed, out, err);
}
