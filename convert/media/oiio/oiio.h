#ifndef WF_CONVERT_MEDIA_OIIO_OIIO_H
#define WF_CONVERT_MEDIA_OIIO_OIIO_H

#include "convert/base/fail.h"
#include "convert/media/image.h"

/* What the OpenImageIO module (convert/media/oiio) does for reading and writing: formats that
 * weft does not read or write itself. No function keeps anything between calls; any threads.
 * Entry points are found by name with wf_module_symbol("oiio", "wf_oiio_probe", ..). */

/* What picture `part` (subimage, counted from 0; -1: the first) of a file is, no pixel read.
 * Names of its channels follow each other in *names, each with its '\0'; owned by the caller,
 * free(). Refused: what cannot be opened, deep and volume images, pictures whose floats exceed
 * max_memory_bytes. */
typedef weft_status wf_oiio_probe_fn(const char *path, int part, size_t max_memory_bytes,
                                     wf_image_info *info, int *channel_count, char **names,
                                     weft_error *err);

/* Reads count channels of that picture into planes [count][data height][data width] as floats:
 * integer formats as 0 .. 1, alpha neither multiplied nor divided. data is what the probe (or
 * the EXR header) said; a file that no longer agrees is an error. */
typedef weft_status wf_oiio_read_fn(const char *path, int part, const int *channel, int count,
                                    const wf_box *data, float *planes, weft_error *err);

/* A picture to be written whole: R G B planes and, of four channels, alpha, line_stride[c]
 * samples from line to line. */
typedef struct wf_oiio_picture {
    const char *format; /* "openexr", "dpx", "tiff", "png" */
    int channels;       /* 3, 4 */
    bool straight;      /* color is not multiplied by alpha */
    const void *plane[4];
    size_t line_stride[4];
    int width_px, lines;
    bool full_range;          /* codes reach from 0 to the highest */
    int bits;                 /* 8, 10, 12, 16: uint16_t codes; 32: float samples */
    wf_rational pixel_aspect; /* width over height of a pixel */
    wf_rational frame_rate;   /* pictures a second */
    int field;       /* 1, 2: it is the first or second field of a frame, alone; 0: not */
    bool top_lines;  /* and that field has the frame's top line */
    bool interlaced; /* two fields are woven into it */
    bool top_first;
    const char *timecode;     /* of the frame: "01:02:03;04"; "" for none */
    const char *color_space;  /* "" if unknown */
    double chromaticities[8]; /* x, y of red, green, blue and white of EXR; all 0: those of
                                 color_space */
    int primaries, transfer;  /* its code points of ITU-T H.273; 0: none */
    const char *raster;       /* for weft:raster; "" for none */
    wf_rational subframe_rate, time_s; /* of a subframe; {0, 0}: it is none */
} wf_oiio_picture;

/* Encodes the picture and hands its bytes to write, in order and whole (a writer that has to
 * seek is given memory to seek in). */
typedef weft_status wf_oiio_bytes_fn(void *user, const void *data, size_t bytes,
                                     weft_error *err);
typedef weft_status wf_oiio_write_fn(const wf_oiio_picture *picture, wf_oiio_bytes_fn *write,
                                     void *user, weft_error *err);

#endif
