#ifndef WF_CONVERT_MEDIA_METADATA_READ_H
#define WF_CONVERT_MEDIA_METADATA_READ_H

#include "convert/media/metadata.h"

/* Asks the container: through the libav module, and the parts of MOV and MXF that libav keeps
 * to itself by own readers. Y4M, raw files and pictures are not asked: WEFT_USAGE. */
weft_status wf_metadata_read(const char *path, wf_metadata *metadata, weft_error *err);

#endif
