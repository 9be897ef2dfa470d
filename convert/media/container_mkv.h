#ifndef WF_CONVERT_MEDIA_CONTAINER_MKV_H
#define WF_CONVERT_MEDIA_CONTAINER_MKV_H

#include "convert/base/outfile.h"
#include "convert/media/container_facts.h"

/* Completes a Matroska file (RFC 9559): its SegmentUID, which libavformat leaves out where the
 * same input is to make the same bytes. It takes the place of the title, which has to be
 * WF_MKV_TITLE. */
weft_status wf_container_complete_mkv(wf_outfile *file, const wf_container_facts *facts,
                                      weft_error *err);

#define WF_MKV_TITLE "SegmentUID here." /* 16 bytes, as long as the number */

#endif
