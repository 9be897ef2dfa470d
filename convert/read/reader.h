#ifndef WF_CONVERT_READ_READER_H
#define WF_CONVERT_READ_READER_H

#include "convert/read/chunk.h"

/* A reader: the buffers of one thread, and what they hold. */

/* Chunks that were read and not decoded, one after the other. */
typedef struct wf_packed {
    uint8_t *bytes;
    size_t capacity, used;
    wf_chunk *chunk;
    int count, chunk_capacity;
} wf_packed;

struct wf_reader {
    wf_source_options options;
    wf_source_counts counts;
    wf_chunk_decoder decoder; /* it is suspect: the result may hold what is not finite */

    wf_packed kept, ahead;       /* of the result; and what may follow it */
    const wf_subframe *ahead_of; /* whose rows `ahead` holds; NULL: nobody's */
    int ahead_y0, ahead_y1;

    bool held; /* a result stands: */
    wf_exr_layout layout;
    wf_rows rows;
    wf_nan_counts fixed;

    uint8_t *native; /* [lines][channels of the file][width] from line native_y0 on */
    size_t native_capacity;
    int native_y0;
    uint8_t *tile;
    size_t tile_capacity;
    float *plain, *edges; /* rows as floats; the rows above and below them */
    size_t plain_capacity, edges_capacity;
    wf_reader *neighbor;    /* reads those */
    wf_reader *base, *over; /* read the layers of pictures that are composed */
    bool stored;            /* rows are handed out as files store them: it is a neighbor */
    float *light;           /* rows after wf_reader's last step */
    size_t light_capacity;
};

/* Makes the rows of a composed picture the reader's. (composed.c) */
weft_status wf_composed_rows(wf_reader *reader, const wf_subframe *subframe, int y0, int y1,
                             weft_error *err);

#endif
