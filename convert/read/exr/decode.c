/* Which function decodes a compression of EXR, and what these share. */
#include "convert/read/exr/decode.h"

#include <libdeflate.h>
#include <stdlib.h>

#include "convert/base/reserve.h"

bool wf_exr_decoder_init(wf_exr_decoder *decoder) {
    *decoder = (wf_exr_decoder){.unzip = wf_unzip_ops_best(),
                                .huffman = wf_huffman_ops_best(),
                                .wavelet = wf_wavelet_ops_best(),
                                .inflate = libdeflate_alloc_decompressor()};
    return decoder->inflate;
}

void wf_exr_decoder_free(wf_exr_decoder *decoder) {
    if (decoder->inflate) libdeflate_free_decompressor(decoder->inflate);
    free(decoder->codes);
    free(decoder->table);
    free(decoder->linear);
    free(decoder->inflated);
    free(decoder->words);
}

weft_status wf_exr_no_memory(weft_error *err) {
    return wf_fail(err, WEFT_NO_MEMORY, "no memory to decode a chunk");
}

wf_exr_decode_fn *wf_exr_decode_of(exr_compression_t compression) {
    static wf_exr_decode_fn *const functions[] = {
        [EXR_COMPRESSION_RLE] = wf_exr_decode_rle,
        [EXR_COMPRESSION_ZIPS] = wf_exr_decode_zip,
        [EXR_COMPRESSION_ZIP] = wf_exr_decode_zip,
        [EXR_COMPRESSION_PIZ] = wf_exr_decode_piz,
        [EXR_COMPRESSION_PXR24] = wf_exr_decode_pxr24,
        [EXR_COMPRESSION_DWAA] = wf_exr_decode_dwa,
        [EXR_COMPRESSION_DWAB] = wf_exr_decode_dwa,
    };
    size_t index = (size_t)compression;
    return index < sizeof functions / sizeof *functions ? functions[index] : NULL;
}

weft_status wf_exr_decode_zip(wf_exr_decoder *d, const wf_exr_shape *shape,
                              const uint8_t *packed, size_t size, uint8_t *out,
                              weft_error *err) {
    if (!wf_reserve(&d->inflated, &d->inflated_capacity, shape->bytes))
        return wf_exr_no_memory(err);
    if (libdeflate_zlib_decompress(d->inflate, packed, size, d->inflated, shape->bytes, NULL) !=
        LIBDEFLATE_SUCCESS)
        return wf_fail(err, WEFT_FAILED, "it does not inflate to its size");
    d->suspect |= d->unzip->merge(out, d->inflated, shape->bytes);
    return WEFT_OK;
}
