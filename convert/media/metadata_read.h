#ifndef WF_CONVERT_MEDIA_METADATA_READ_H
#define WF_CONVERT_MEDIA_METADATA_READ_H

#include "convert/media/metadata.h"

/* Asks a container what it says: through the libav module, and in MOV and MXF also our own
 * readers, for what libav keeps to itself. */
weft_status wf_metadata_read(const char *path, wf_metadata *metadata, weft_error *err);

#endif
