/* Writes PNG files of 8 bits of R'G'B', each line as its difference from the one above. */
#include "convert/page/png.h"

#include <libdeflate.h>
#include <stdlib.h>
#include <string.h>

#define LEVEL 6 /* of compression */

static void put_32(uint8_t *to, uint32_t value) {
    for (int i = 0; i < 4; i++) to[i] = (uint8_t)(value >> (24 - 8 * i));
}

static weft_status put_chunk(const char *kind, const uint8_t *data, size_t bytes,
                             wf_outfile *file, weft_error *err) {
    uint8_t head[8], tail[4];
    put_32(head, (uint32_t)bytes);
    memcpy(head + 4, kind, 4);
    uint32_t sum = libdeflate_crc32(0, head + 4, 4);
    put_32(tail, bytes ? libdeflate_crc32(sum, data, bytes) : sum);
    weft_status status = wf_outfile_write(file, head, sizeof head, err);
    if (!status && bytes) status = wf_outfile_write(file, data, bytes, err);
    return status ? status : wf_outfile_write(file, tail, sizeof tail, err);
}

/* Lines behind their filter type, 2: what is above is subtracted. */
static void filter(const uint8_t *rgb, size_t row, int lines, uint8_t *to) {
    for (int y = 0; y < lines; y++, rgb += row) {
        *to++ = 2;
        for (size_t i = 0; i < row; i++)
            *to++ = (uint8_t)(rgb[i] - (y ? rgb[(ptrdiff_t)i - (ptrdiff_t)row] : 0));
    }
}

static weft_status put_data(const uint8_t *lines, size_t bytes, wf_outfile *file,
                            weft_error *err) {
    struct libdeflate_compressor *compressor = libdeflate_alloc_compressor(LEVEL);
    size_t most = compressor ? libdeflate_zlib_compress_bound(compressor, bytes) : 0;
    uint8_t *packed = compressor ? malloc(most) : NULL;
    weft_status status;
    if (packed) {
        size_t got = libdeflate_zlib_compress(compressor, lines, bytes, packed, most);
        status = put_chunk("IDAT", packed, got, file, err);
    } else {
        status = wf_fail(err, WEFT_NO_MEMORY, "no memory to compress the picture");
    }
    if (compressor) libdeflate_free_compressor(compressor);
    free(packed);
    return status;
}

weft_status wf_png_write(const uint8_t *rgb, int width_px, int lines, wf_outfile *file,
                         weft_error *err) {
    static const uint8_t magic[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    uint8_t head[13] = {[8] = 8, [9] = 2};
    size_t row = 3 * (size_t)width_px, bytes = (row + 1) * (size_t)lines;
    uint8_t *filtered = malloc(bytes);
    if (!filtered) return wf_fail(err, WEFT_NO_MEMORY, "no memory for the picture");
    put_32(head, (uint32_t)width_px);
    put_32(head + 4, (uint32_t)lines);
    filter(rgb, row, lines, filtered);
    weft_status status = wf_outfile_write(file, magic, sizeof magic, err);
    if (!status) status = put_chunk("IHDR", head, sizeof head, file, err);
    if (!status) status = put_data(filtered, bytes, file, err);
    free(filtered);
    return status ? status : put_chunk("IEND", NULL, 0, file, err);
}
