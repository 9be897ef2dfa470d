#ifndef WF_CONVERT_READ_DEEP_READ_H
#define WF_CONVERT_READ_DEEP_READ_H

#include "convert/base/fail.h"
#include "convert/media/deep.h"
#include "filters/raster/raster.h"

/* Whether a file is a sample buffer: a deep EXR with a channel sample.x. An error: it is there
 * and cannot be read. */
weft_status wf_deep_is(const char *path, bool *is, weft_error *err);

typedef struct wf_deep_file wf_deep_file; /* open; immutable, any threads */

/* Opens and checks: channels, windows against the raster, compression. */
weft_status wf_deep_open(const char *path, const wf_raster *raster, wf_deep_file **out,
                         weft_error *err);
void wf_deep_close(wf_deep_file *file);
/* The raster and the color space that the file names. They live as long as the file. */
const char *wf_deep_raster(const wf_deep_file *file); /* weft:raster; "" if it has none */
const char *wf_deep_space(const wf_deep_file *file);  /* weft:colorSpace; "" */

/* Buffers of one thread. */
typedef struct wf_deep_buffers {
    uint8_t *packed, *inflated, *merged;
    size_t packed_capacity, inflated_capacity, merged_capacity;
    float *floats;
    size_t floats_capacity;
    wf_deep_line line;
} wf_deep_buffers;

void wf_deep_buffers_free(wf_deep_buffers *buffers);

/* Reads line y of the raster into buffers->line, all of whose channels but A and WEIGHT are
 * there; lines that the file does not have are empty. Samples that are not finite are an error,
 * as are those that lie in another pixel. */
weft_status wf_deep_read(const wf_deep_file *file, wf_deep_buffers *buffers, int y,
                         weft_error *err);

#endif
