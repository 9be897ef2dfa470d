#ifndef WF_CONVERT_MEDIA_PICTURE_OUT_H
#define WF_CONVERT_MEDIA_PICTURE_OUT_H

#include "convert/base/fail.h"
#include "filters/base/rational.h"

/* A picture that becomes a file of its own: R G B planes and, of four channels, alpha,
 * line_stride[c] samples from line to line. Strings and planes are borrowed. */
typedef struct wf_picture_out {
    int channels;  /* 3, 4 */
    bool straight; /* color is not multiplied by alpha */
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
} wf_picture_out;

/* Takes the next bytes of a file. */
typedef weft_status wf_bytes_fn(void *user, const void *data, size_t bytes, weft_error *err);

/* Encodes a picture as a format has it and hands the file's bytes to write, in their order. A
 * failure of write is returned as it is. Nothing is kept between calls; any threads. */
typedef weft_status wf_encode_picture_fn(const wf_picture_out *picture, wf_bytes_fn *write,
                                         void *user, weft_error *err);

/* What every format has words of the picture for: "525i, bottom first". Headers of DPX hold 31
 * characters, to which a raster's name is cut. Returns text. */
#define WF_PICTURE_WORDS_SIZE 32
const char *wf_picture_words(const wf_picture_out *p, char text[WF_PICTURE_WORDS_SIZE]);

/* Its time code as EXR and DPX hold it (convert/job/timecode.h); false: it has none. Both
 * fields of a frame have its label, told apart by the field mark: just what ST 12-1 does with
 * pairs of progressive frames. */
bool wf_picture_time(const wf_picture_out *p, uint32_t *word);

/* Who wrote it. */
#define WF_PICTURE_SOFTWARE "weft " WEFT_VERSION

#endif
