#ifndef WF_CONVERT_MEDIA_CONTAINER_H
#define WF_CONVERT_MEDIA_CONTAINER_H

#include "convert/base/outfile.h"
#include "convert/media/container_facts.h"

/* Completes a finished file, before it gets its name: what libavformat 5.1 leaves out, or
 * writes of its own belief, is written as facts have it. Files of other muxers are left alone.
 * mxf, mxf_d10 (SMPTE ST 377-1): the line map, the aspect ratio, the siting of chroma and the
 * field that comes first, of every picture descriptor, and the numbers of UMIDs, which
 * libavformat leaves 0 where the same input is to make the same bytes. mov:
 * wf_container_complete_mov. matroska: the SegmentUID. */
weft_status wf_container_complete(wf_outfile *file, const wf_container_facts *facts,
                                  weft_error *err);

/* What libavformat is told to call the packages of MXF: zeros that become their number. */
#define WF_MXF_PACKAGE_NAME "weft 00000000000000000000000000000000"

/* Number n of a file, of its identity: equal files have equal ones, and others have others. */
void wf_container_number(const uint8_t identity[16], unsigned n, uint8_t number[16]);

#endif
