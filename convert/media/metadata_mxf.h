#ifndef WF_CONVERT_MEDIA_METADATA_MXF_H
#define WF_CONVERT_MEDIA_METADATA_MXF_H

#include <stdio.h>

#include "convert/media/metadata.h"

/* Adds what an MXF file says in places that libavformat keeps to itself. What is not well
 * formed ends the reading of it; nothing is read beyond the file. */
void wf_metadata_mxf(FILE *file, wf_metadata *metadata);

/* Takes the order of mixed fields, both in one picture, from the lines that they begin with and
 * the field that is first, where nothing else has told the scan: libavformat passes it over. */
void wf_metadata_mxf_scan(wf_metadata *metadata);

#endif
