#ifndef WF_CONVERT_CHECK_VERIFY_PROFILES_H
#define WF_CONVERT_CHECK_VERIFY_PROFILES_H

#include <stdbool.h>
#include <stddef.h>

#include "convert/weft.h"

/* What a station or a format asks for: a row of the table. NULL and 0: anything will do. */
typedef struct wf_profile {
    const char *name, *about; /* with its source */
    const char *container;    /* libavformat's name */
    const char *codec;        /* libavcodec's name */
    const char *rasters;      /* one or several with blanks between; never NULL */
    const char *start;        /* timecode of the first frame */
    bool timecode;            /* it has one */
    int bits;
    int sound_channels;   /* the least */
    const char *channels; /* one of these numbers, with blanks between */
    int sound_bits;
    int coded_lines; /* with the vertical interval; 0: the raster's */
} wf_profile;

/* The table by index; NULL past the end. */
const wf_profile *wf_profile_at(size_t index);

/* By its name; NULL with an error that names the one that is spelled alike. */
const wf_profile *wf_profile_find(const char *name, weft_error *err);

#endif
