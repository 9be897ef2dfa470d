#ifndef WF_CONVERT_WRITE_DEEP_WRITE_H
#define WF_CONVERT_WRITE_DEEP_WRITE_H

#include "convert/base/fail.h"
#include "convert/media/deep.h"
#include "filters/raster/raster.h"

/* Writes sample buffers: float R G B, if asked for A, sample.x, sample.y, sample.t, ZIPS. */

typedef struct wf_deep_writer wf_deep_writer;

/* A line ready to be written; packing may be done by any thread. */
typedef struct wf_deep_packed {
    uint8_t *table, *data;
    size_t table_bytes, data_bytes, unpacked_bytes;
} wf_deep_packed;

weft_status wf_deep_writer_new(const char *path, const wf_raster *raster,
                               const char *color_space, bool alpha, bool overwrite,
                               wf_deep_writer **out, weft_error *err);
/* Lines of a file have A either all or none. */
weft_status wf_deep_pack(int width, const wf_deep_line *line, wf_deep_packed *out,
                         weft_error *err);
void wf_deep_packed_free(wf_deep_packed *packed);
/* Writes line y; lines come from the top, each once. */
weft_status wf_deep_write(wf_deep_writer *writer, int y, const wf_deep_packed *line,
                          weft_error *err);
weft_status wf_deep_commit(wf_deep_writer *writer, weft_error *err); /* frees it in any case */
void wf_deep_abandon(wf_deep_writer *writer);

#endif
