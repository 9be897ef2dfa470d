#ifndef WF_CONVERT_MEDIA_DEEP_H
#define WF_CONVERT_MEDIA_DEEP_H

#include "convert/base/fail.h"
#include "filters/raster/raster.h"

/* Sample buffers on disk (samples.md, 2): deep scanline EXR, one file a frame. Deep pixel (i,
 * j) holds the samples with floor(x) = i and floor(y) = j: channels sample.x, sample.y (raster
 * coordinates), sample.t (field periods since the frame's first field), R G B [A], and
 * sample.w (a weight) if there are any. */

typedef enum wf_deep_channel {
    WF_DEEP_B,
    WF_DEEP_G,
    WF_DEEP_R,
    WF_DEEP_T,
    WF_DEEP_X,
    WF_DEEP_Y,
    WF_DEEP_WEIGHT,
    WF_DEEP_A,
    WF_DEEP_CHANNELS
} wf_deep_channel;

/* One line of samples, pixel after pixel. */
typedef struct wf_deep_line {
    int32_t *upto; /* [width]: how many samples pixels 0 .. i have together */
    float *channel[WF_DEEP_CHANNELS]; /* [upto[width - 1]]; NULL: it has none */
} wf_deep_line;

/* ---- Writing: float R G B, sample.x, .y, .t ---- */

typedef struct wf_deep_writer wf_deep_writer;

/* A line ready to be written; packing may be done by any thread. */
typedef struct wf_deep_packed {
    uint8_t *table, *data;
    size_t table_bytes, data_bytes, unpacked_bytes;
} wf_deep_packed;

weft_status wf_deep_writer_new(const char *path, const wf_raster *raster,
                               const char *color_space, bool overwrite, wf_deep_writer **out,
                               weft_error *err);
weft_status wf_deep_pack(int width, const wf_deep_line *line, wf_deep_packed *out,
                         weft_error *err);
void wf_deep_packed_free(wf_deep_packed *packed);
/* Lines from the top, each once. */
weft_status wf_deep_write(wf_deep_writer *writer, int y, const wf_deep_packed *line,
                          weft_error *err);
weft_status wf_deep_commit(wf_deep_writer *writer, weft_error *err); /* frees it in any case */
void wf_deep_abandon(wf_deep_writer *writer);

/* ---- Reading ---- */

/* Whether a file is a sample buffer: a deep EXR with a channel sample.x. */
bool wf_deep_is(const char *path);

typedef struct wf_deep_file wf_deep_file; /* open; immutable, any threads */

/* Opens and checks: channels, windows against the raster, compression. */
weft_status wf_deep_open(const char *path, const wf_raster *raster, wf_deep_file **out,
                         weft_error *err);
void wf_deep_close(wf_deep_file *file);
/* The windows it covers: its lines first <= y < end and whether it names another raster. */
const char *wf_deep_raster(const wf_deep_file *file); /* weft:raster; "" if it has none */
const char *wf_deep_space(const wf_deep_file *file);  /* weft:colorSpace; "" */

/* Buffers of one thread. */
typedef struct wf_deep_buffers {
    uint8_t *packed, *inflated, *merged;
    size_t packed_room, inflated_room, merged_room;
    float *floats;
    size_t floats_room;
    wf_deep_line line;
} wf_deep_buffers;

void wf_deep_buffers_free(wf_deep_buffers *buffers);

/* Reads line y of the raster into buffers->line, all of whose channels but A and WEIGHT are
 * there; lines that the file does not have are empty. Samples that are not finite are an error,
 * as are those that lie in another pixel. */
weft_status wf_deep_read(const wf_deep_file *file, wf_deep_buffers *buffers, int y,
                         weft_error *err);

#endif
