#ifndef WF_TESTS_UNIT_SUPPORT_EXR_WRITE_H
#define WF_TESTS_UNIT_SUPPORT_EXR_WRITE_H

#include <openexr.h>

#include "convert/read/source.h"

/* A part of an EXR to be made for a test. */
typedef struct exr_part {
    const char *name; /* NULL: "part" and its number */
    wf_box display, data;
    /* Blank separated, in the order of names: "A B G R". "RY/2" has a sample for every second
       pixel and line, "RY/2x1" for every second pixel of every line, "id#" whole numbers. */
    const char *channels;
    exr_pixel_type_t type;
    exr_compression_t compression;
    int tile_width, tile_height;  /* 0: scanlines */
    exr_tile_level_mode_t levels; /* of tiles; each has values of its own pixels */
    exr_tile_round_mode_t round;
    const char *rate, *time;   /* "480000/1001": framesPerSecond and weft:time; NULL: none */
    const char *subframe_rate; /* weft:subframeRate, as text; NULL: none */
    uint32_t timecode;         /* timeCode, as convert/job/timecode.h packs it; 0: none */
    float pixel_aspect;        /* 0: 1 */
    const char *attribute[2];  /* name and value of a text; NULL: none */
    const wf_box *region; /* weft:region, as a box2i of these half-open bounds; NULL: none */
    const float *chromaticities; /* x, y of red, green, blue, white; NULL: none */
    /* Value of a channel at a pixel of the data window. */
    float (*value)(const void *user, int channel, int x, int y);
    const void *user;
} exr_part;

/* Writes the parts with OpenEXRCore; false if it refused anything. */
bool exr_write(const char *path, const exr_part *parts, int count);

#endif
