#ifndef WF_CONVERT_CHECK_VERIFY_PROFILES_H
#define WF_CONVERT_CHECK_VERIFY_PROFILES_H

#include <stdbool.h>
#include <stddef.h>

#include "convert/weft.h"

/* What a station or a format asks for: a row of the table. NULL and 0: anything will do. Texts
 * that are "one of these" have blanks between their words. */
typedef struct wf_delivery_profile {
    const char *name, *about; /* with where it was read */
    const char *container;    /* libavformat's name */
    const char *codec;        /* libavcodec's name */
    const char *rasters;      /* one of these; never NULL */
    const char *start;        /* timecode of the first frame */
    bool timecode;            /* it has one */
    int bits;
    int sound_channels;   /* the least */
    const char *channels; /* one of these numbers */
    int sound_bits;
    int coded_lines; /* with the vertical interval; 0: the raster's */

    const char *codec_profile; /* as libavcodec calls it */
    int level;                 /* as libavcodec numbers it */
    const char *chroma;        /* libavutil's name of such pixels of 8 bits */
    int group;    /* pictures from one that is whole to the next at most; 1: all are whole */
    bool between; /* there are pictures that are predicted; needs two of them to show */
    int bit_rate; /* a second, which is constant; stated by the stream where it is MPEG-2 */
    bool alpha;   /* there is some, and the file says how color lies beside it */
    const char *frame_bytes; /* of every frame, one of these numbers */
    const char *sound_codec; /* one of these */
    bool mono;               /* each stream of sound has one channel */
    bool one_sound;          /* one stream has all channels */
    bool closed;             /* MXF's header partition itself is closed and complete */
    const char *not_checked; /* what the format asks for besides */
} wf_delivery_profile;

/* The table by index; NULL past the end. */
const wf_delivery_profile *wf_profile_at(size_t index);

/* By its name; NULL with an error that names the one that is spelled alike. */
const wf_delivery_profile *wf_profile_find(const char *name, weft_error *err);

#endif
