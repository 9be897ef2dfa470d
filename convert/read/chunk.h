#ifndef WF_CONVERT_READ_CHUNK_H
#define WF_CONVERT_READ_CHUNK_H

#include "convert/read/exr/decode.h"
#include "convert/read/subframe.h"

/* Chunks of an EXR: the unit that is stored, compressed and decoded alone. */

/* A chunk as it lies in the file, and where it belongs in the picture. */
typedef struct wf_chunk {
    exr_chunk_info_t info;
    wf_box place;
    size_t at; /* of its packed bytes, in the buffer that they were read into */
} wf_chunk;

/* Buffers that one thread decodes chunks with. */
typedef struct wf_chunk_decoder {
    wf_exr_decoder exr;
    wf_exr_channel *channel; /* of the chunk in hand */
    size_t channel_capacity;
} wf_chunk_decoder;

/* False when memory is out; wf_chunk_decoder_free releases it in any case. */
bool wf_chunk_decoder_init(wf_chunk_decoder *decoder);
void wf_chunk_decoder_free(wf_chunk_decoder *decoder);

/* What lies in a chunk of these columns and lines; its channels belong to the decoder until the
 * next call. False when memory is out. */
bool wf_chunk_shape(wf_chunk_decoder *decoder, const wf_subframe *subframe, wf_box place,
                    wf_exr_shape *shape);

/* Decodes packed to out: [lines][channels of the file][width of the chunk]. An error names the
 * file and the line. */
weft_status wf_chunk_decode(wf_chunk_decoder *decoder, const wf_subframe *subframe,
                            const wf_chunk *chunk, const uint8_t *packed, uint8_t *out,
                            weft_error *err);

#endif
