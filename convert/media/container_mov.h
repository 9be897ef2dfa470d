#ifndef WF_CONVERT_MEDIA_CONTAINER_MOV_H
#define WF_CONVERT_MEDIA_CONTAINER_MOV_H

#include "convert/base/outfile.h"
#include "convert/media/container_facts.h"

/* Completes a QuickTime file (QuickTime File Format): fiel, colr, pasp and clap of the video's
 * sample description, the words for its codec, and the clean aperture of tapt; of sound, that
 * every track is heard and which channels it has. Of MP4 (muxer mp4) only that every track is
 * heard. */
weft_status wf_container_complete_mov(wf_outfile *file, const wf_container_facts *facts,
                                      weft_error *err);

/* The part of a 601 line that is the 4:3 or 16:9 picture, as Apple's Technical Note TN2162 has
 * it: 704 of 720 pixels, and 480 of the 486 lines. Rasters whose pixels have none of the shapes
 * of 601 are all picture, since then the whole line is what was meant. */
void wf_clean_aperture(const wf_raster *raster, uint32_t *width, uint32_t *lines);

#endif
