#ifndef WF_CONVERT_READ_EXR_DECODE_H
#define WF_CONVERT_READ_EXR_DECODE_H

#include <openexr.h>

#include "convert/base/fail.h"
#include "convert/read/exr/huffman.h"
#include "convert/read/exr/shape.h"
#include "convert/read/exr/unzip.h"
#include "convert/read/exr/wavelet.h"

/* Chunks of EXR, as they are stored, become samples. */

struct libdeflate_decompressor;

/* What one thread decodes with; buffers grow to what chunks need. */
typedef struct wf_exr_decoder {
    const wf_unzip_ops *unzip;
    const wf_huffman_ops *huffman;
    const wf_wavelet_ops *wavelet;
    struct libdeflate_decompressor *inflate;
    wf_huffman_codes *codes; /* NULL until they are needed */
    uint16_t *table;         /* [65536], PIZ's values, as codes */
    uint16_t *linear;        /* [65536], of wf_dwa_make_linear, as codes */
    uint8_t *inflated;
    size_t inflated_capacity;
    uint16_t *words;
    size_t words_capacity;
    bool suspect; /* halves that were decoded since this was false may hold NaN or Inf; of other
                     types nothing is noted */
} wf_exr_decoder;

/* False when memory is out; wf_exr_decoder_free releases it in any case. */
bool wf_exr_decoder_init(wf_exr_decoder *decoder);
void wf_exr_decoder_free(wf_exr_decoder *decoder);

/* Decodes `size` bytes to out, shape->bytes. WEFT_FAILED, with what is wrong as the end of a
 * sentence, of what is damaged; WEFT_NO_MEMORY. */
typedef weft_status wf_exr_decode_fn(wf_exr_decoder *decoder, const wf_exr_shape *shape,
                                     const uint8_t *packed, size_t size, uint8_t *out,
                                     weft_error *err);

/* The function of a compression; NULL where there is none, as for chunks that are not
 * compressed. */
wf_exr_decode_fn *wf_exr_decode_of(exr_compression_t compression);

wf_exr_decode_fn wf_exr_decode_rle, wf_exr_decode_zip, wf_exr_decode_piz, wf_exr_decode_pxr24,
    wf_exr_decode_dwa;

weft_status wf_exr_no_memory(weft_error *err);

#endif
