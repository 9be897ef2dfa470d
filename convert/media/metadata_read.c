/* What a container says of itself: libav is asked first, then our own readers of MOV and MXF.
 */
#include "convert/media/metadata_read.h"

#include <stdio.h>
#include <string.h>

#include "convert/base/infile.h"
#include "convert/base/module.h"
#include "convert/media/metadata_mov.h"
#include "convert/media/metadata_mxf.h"

weft_status wf_metadata_read(const char *path, wf_metadata *metadata, weft_error *err) {
    void *symbol;
    char what[600];
    wf_libav_metadata_fn *ask;
    *metadata = (wf_metadata){.frames = -1, .frame_layout = -1, .dominance = -1, .siting = -1};
    snprintf(what, sizeof what, "%.500s: a container", path);
    weft_status status = wf_module_symbol("libav", "wf_libav_metadata", what, &symbol, err);
    if (status) return status;
    memcpy(&ask, &symbol, sizeof ask);
    status = ask(path, metadata, err);
    if (status) return status;
    FILE *file;
    status = wf_infile_open(path, &file, err);
    if (status) return status;
    if (!strcmp(metadata->container, "mov")) wf_metadata_mov(file, metadata);
    if (!strcmp(metadata->container, "mxf")) wf_metadata_mxf(file, metadata);
    wf_metadata_mxf_scan(metadata);
    return wf_infile_close(file, path, WEFT_OK, err);
}
