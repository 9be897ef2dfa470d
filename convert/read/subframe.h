#ifndef WF_CONVERT_READ_SUBFRAME_H
#define WF_CONVERT_READ_SUBFRAME_H

#include <openexr.h>

#include "convert/read/exr_stream.h"
#include "convert/read/choice/pick.h"
#include "convert/read/source.h"

/* Inside the source: an open picture, and how its decoded bytes lie. */

/* Chunks decode to lines of all the file's channels one after the other (the order of names),
 * each data.x1 - data.x0 samples long (tiles: the tile's width). Equal layouts and equal packed
 * bytes give equal pictures. */
typedef struct wf_exr_layout {
    wf_box data;
    exr_compression_t compression;
    exr_pixel_type_t type[4];    /* of the channels picked */
    int channels;                /* read: 3, or 4 with alpha */
    bool subsampled;             /* some channel has not a sample for every pixel */
    int tile_width, tile_height; /* 0: scanlines */
    int chunk_lines;             /* of a scanline chunk, or a tile */
    size_t before[4];            /* bytes of a pixel that lie before the channel picked */
    size_t pixel_bytes;          /* of all channels */
    uint64_t channel_hash;       /* of the names and kinds of all channels */
} wf_exr_layout;

struct wf_subframe {
    char *path;
    int part;
    char part_name[WF_LAYER_SIZE]; /* "": none, or the only part */
    wf_pick pick;
    wf_reason alpha_reason;
    bool multiplies; /* color by alpha, which the file has not done */
    bool divides;    /* by alpha before decoding, and multiplies after it */
    wf_file_colors colors;
    wf_transform decode; /* apply is NULL where samples are delivered as they are stored */
    bool owns_decode;    /* and frees it */
    wf_image_info info;
    wf_exr_layout layout;
    wf_exr_stream stream;
    exr_context_t exr;         /* of the stream; NULL: read whole, through OpenImageIO */
    const wf_row_maker *maker; /* NULL: it is a file */
    void *picture;             /* the maker's */
    wf_layer_over *layer;      /* [layers] of one that is composed, bottom first */
    int layers;                /* 0: it is not */
    float *whole;              /* [channels][height][width] of the data window */
};

/* Settles what the picture's colors are taken for, by info.colors, and how they are decoded. */
weft_status wf_subframe_settle_colors(wf_subframe *subframe, const wf_source_options *options,
                                      weft_error *err);

/* After its colors, settles, of a picture whose channels are picked and whose info.alpha says
 * how its format stores color beside alpha, whether alpha is read, multiplied by and delivered.
 */
void wf_subframe_settle_alpha(wf_subframe *subframe, const wf_source_options *options);

#endif
