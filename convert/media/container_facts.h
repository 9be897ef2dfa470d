#ifndef WF_CONVERT_MEDIA_CONTAINER_FACTS_H
#define WF_CONVERT_MEDIA_CONTAINER_FACTS_H

#include <stdint.h>

#include "convert/job/colors.h"
#include "filters/raster/raster.h"

/* What a finished file has to say of its picture. */
typedef struct wf_container_facts {
    const char *muxer;       /* libavformat's name of what wrote it */
    const wf_raster *raster; /* as it is in the file */
    wf_color_tags tags;
    const char *compressor; /* QuickTime: the codec in words, at most 31 bytes; NULL: none */
    uint8_t identity[16];   /* a hash of all that was written: whose numbers the file gets */
    bool alpha, straight;   /* there is alpha; color beside it is not multiplied by it */
} wf_container_facts;

#endif
