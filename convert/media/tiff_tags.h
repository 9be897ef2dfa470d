#ifndef WF_CONVERT_MEDIA_TIFF_TAGS_H
#define WF_CONVERT_MEDIA_TIFF_TAGS_H

#include <stdbool.h>
#include <stdio.h>

/* PhotometricInterpretation of TIFF 6.0. */
enum { WF_TIFF_WHITE_IS_ZERO = 0, WF_TIFF_SEPARATED = 5, WF_TIFF_CIELAB = 8 };

/* Tags of the first directory of a TIFF that decide how its samples are understood, and that
 * OpenImageIO does not tell. */
typedef struct wf_tiff_tags {
    int photometric;         /* -1: not said */
    int bits;                /* of the first sample */
    int samples;             /* a pixel */
    bool has_extra_samples;  /* the tag ExtraSamples is there */
    bool has_chromaticities; /* WhitePoint and PrimaryChromaticities are: x and y of red, green,
                                blue and white */
    double chromaticities[8];
    int subfile;         /* bits of NewSubfileType */
    int width_px, lines; /* 0: not said */
    bool more_pages;     /* another directory has a picture of that size too */
} wf_tiff_tags;

/* Reads them from any place of the file: TIFF and BigTIFF, of either byte order. False if it
 * has no directory. */
bool wf_tiff_tags_read(FILE *file, wf_tiff_tags *out);

#endif
