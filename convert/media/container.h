#ifndef WF_CONVERT_MEDIA_CONTAINER_H
#define WF_CONVERT_MEDIA_CONTAINER_H

#include "convert/base/outfile.h"
#include "convert/job/colors.h"
#include "filters/raster/raster.h"

/* What a finished file has to say of its picture. */
typedef struct wf_container_facts {
    const char *muxer;       /* libavformat's name of what wrote it */
    const wf_raster *raster; /* as it is in the file */
    wf_color_tags tags;
    const char *compressor; /* QuickTime: the codec in words, at most 31 bytes; NULL: none */
} wf_container_facts;

/* Mends in a finished file, before it gets its name, what libavformat 5.1 leaves out or writes
 * of its own belief. Other muxers' files are left alone. mxf, mxf_d10 (SMPTE ST 377-1): the
 * line map, the aspect ratio, the siting of chroma and the field that comes first, of every
 * picture descriptor. mov (QuickTime File Format): fiel, colr, pasp and clap of the video's
 * sample description, the words for its codec, and the clean aperture of tapt. */
weft_status wf_container_mend(wf_outfile *file, const wf_container_facts *facts,
                              weft_error *err);

/* The part of a 601 line that is the 4:3 or 16:9 picture, as Apple's Technical Note TN2162 has
 * it: 704 of 720 pixels, and 480 of the 486 lines. Where pixels are of another shape somebody
 * else's reckoning makes the whole line the picture. Other rasters are all picture. */
void wf_clean_aperture(const wf_raster *raster, uint32_t *width, uint32_t *lines);

/* The same for QuickTime alone (container_mov.c). */
weft_status wf_container_mend_mov(wf_outfile *file, const wf_container_facts *facts,
                                  weft_error *err);

#endif
