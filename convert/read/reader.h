#ifndef WF_CONVERT_READ_READER_H
#define WF_CONVERT_READ_READER_H

#include "convert/read/subframe.h"
#include "convert/read/unzip.h"

struct libdeflate_decompressor;

/* Inside the source: one thread's buffers, and what they hold. */

/* A chunk as it lies in the file, and where it belongs in the picture. */
typedef struct wf_chunk {
    exr_chunk_info_t info;
    wf_box place;
    size_t at; /* of its bytes */
} wf_chunk;

typedef struct wf_packed {
    uint8_t *bytes;
    size_t room, used;
    wf_chunk *chunk;
    int count, chunk_room;
} wf_packed;

struct wf_reader {
    wf_source_options options;
    wf_source_counts counts;
    const wf_unzip_ops *ops;
    struct libdeflate_decompressor *inflate;

    wf_packed kept, ahead;       /* of the result; and what may follow it */
    const wf_subframe *ahead_of; /* whose rows `ahead` holds; NULL: nobody's */
    int ahead_y0, ahead_y1;

    bool held; /* a result stands: */
    wf_exr_layout layout;
    wf_rows rows;
    int64_t mended;
    bool suspect; /* it may hold samples that are not finite */

    uint8_t *native; /* [lines][channels of the file][width] from line native_y0 on */
    size_t native_room;
    int native_y0;
    uint8_t *inflated, *tile;
    size_t inflated_room, tile_room;
    float *plain, *edges; /* rows as floats; the rows above and below them */
    size_t plain_room, edges_room;
    wf_reader *neighbor; /* reads those */
};

/* Makes room for bytes; what was there is lost. False when memory is out. */
bool wf_room(void *pointer, size_t *room, size_t bytes);

/* Decodes a chunk to [lines][channels of the file][width of the chunk]. May mark the result
 * suspect. */
weft_status wf_chunk_decode(wf_reader *reader, const wf_subframe *subframe,
                            const wf_chunk *chunk, const uint8_t *packed, uint8_t *out,
                            weft_error *err);

#endif
