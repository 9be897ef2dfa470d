#ifndef WF_CONVERT_MEDIA_IMAGE_H
#define WF_CONVERT_MEDIA_IMAGE_H

#include "convert/job/choices.h"
#include "convert/media/box.h"
#include "filters/base/rational.h"

/* What files of pictures say of themselves. */

/* What a file says of its colors, as it says it; what of that counts is decided in
 * convert/read/file_colors.c. */
typedef struct wf_color_said {
    bool floats;             /* samples are floats, which are light */
    char space[64];          /* weft:colorSpace, or the project of a DPX; "" if none */
    char interop[64];        /* colorInteropID; "" if none */
    bool has_chromaticities; /* x and y of red, green, blue and white: */
    double chromaticities[8];
    int primaries, transfer; /* code points of PNG's cICP; 0: none */
    bool narrow;             /* and its range */
    int bits;                /* of a sample of a PNG */
    bool srgb;               /* a PNG has an sRGB chunk */
    double gamma;            /* of PNG's gAMA: signals are light to this power; 0: none */
    char profile[64]; /* what an ICC profile calls itself that is not of sRGB; "" if none */
    bool inks;        /* samples are amounts of four inks, of which R G B were made */
    bool no_alpha;    /* the file does not call its fourth channel alpha */
    bool dpx;         /* it is a DPX, with these fields of ST 268: */
    int dpx_transfer, dpx_colorimetric;
} wf_color_said;

/* What a subframe says of itself. */
typedef struct wf_image_info {
    wf_box display, data; /* the file's windows */
    double pixel_aspect;  /* 1 where the file has none */
    wf_rational rate;     /* weft:subframeRate, else framesPerSecond; {0,0} if neither */
    wf_rational frames;   /* framesPerSecond, which timecode counts; {0,0} if none */
    wf_rational time_s;   /* weft:time; {0,0} if none */
    bool counts_files;    /* the rate is weft:subframeRate, of the files there are */
    char no_rate[64];     /* what it says for a rate and none is: "framesPerSecond -1"; or "" */
    bool has_alpha;       /* alpha is delivered as a fourth channel */
    wf_alpha alpha;       /* how its color is stored; WF_ALPHA_UNSET: the file has none */
    bool alpha_by_file;   /* the file says so itself, and not its format alone */
    int band_lines;       /* height of its natural bands: a chunk, a row of tiles; counted from
                             data.y0. Reading whole bands reads nothing twice. */
    bool whole;         /* the reader holds the whole picture (not chunked): open few at once */
    char timecode[16];  /* "" if none */
    bool timecode_all;  /* its frames are counted one by one, not in pairs, at any rate */
    bool timecode_mark; /* its field mark: the second of a pair */
    char raster[64];    /* weft:raster; "" if none */
    wf_color_said colors;
    char format[96]; /* for people: "OpenEXR scanline, ZIP, R G B half" */
} wf_image_info;

#endif
