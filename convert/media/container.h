#ifndef WF_CONVERT_MEDIA_CONTAINER_H
#define WF_CONVERT_MEDIA_CONTAINER_H

#include "convert/base/outfile.h"
#include "convert/media/container_facts.h"

/* Completes a finished file, before it gets its name: what libavformat 5.1 leaves out, or
 * writes of its own belief, is written as facts have it. Files of other muxers are left alone.
 * mxf, mxf_d10 (SMPTE ST 377-1): the line map, the aspect ratio, the siting of chroma and the
 * field that comes first, of every picture descriptor. mov: wf_container_complete_mov. */
weft_status wf_container_complete(wf_outfile *file, const wf_container_facts *facts,
                                  weft_error *err);

#endif
