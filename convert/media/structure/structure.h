#ifndef WF_CONVERT_MEDIA_STRUCTURE_STRUCTURE_H
#define WF_CONVERT_MEDIA_STRUCTURE_STRUCTURE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "convert/base/fail.h"

/* What a container's own structure says: where the file ends, how long its streams are, which
 * material it is. Read by weft itself and not by libavformat, which makes do with less. */

#define WF_STATED_MOST 8
#define WF_ID_BYTES    32

/* A length that the file states. */
typedef struct wf_stated {
    char of[24]; /* where: "mvhd", "DURATION" */
    double seconds;
    double tick_s; /* to which it is rounded; 0: to nothing that counts */
    bool of_all;   /* of the longest stream; else of the picture */
} wf_stated;

/* How complete the metadata of an MXF partition is: byte 14 of its pack's key (SMPTE ST 377-1).
 */
typedef enum wf_mxf_status {
    WF_MXF_NO_PARTITION,
    WF_MXF_OPEN_INCOMPLETE,
    WF_MXF_CLOSED_INCOMPLETE,
    WF_MXF_OPEN_COMPLETE,
    WF_MXF_CLOSED_COMPLETE
} wf_mxf_status;

typedef struct wf_structure {
    bool known;        /* its container is one of those that are read here */
    bool ends;         /* it says where it ends */
    char missing[128]; /* the first thing that is not there, for people; "": all is */
    const char *doubt; /* what may not be there; NULL: nothing */
    bool fragments;    /* MP4 in pieces: its header counts those of the first at most */
    wf_stated stated[WF_STATED_MOST];
    int stated_count;

    wf_mxf_status header, footer; /* MXF; the footer's where it repeats the metadata */
    /* MXF: the UMIDs of the material package and of the first file package; Matroska: the
     * SegmentUID in the first half of the first. */
    uint8_t id[2][WF_ID_BYTES];
    bool has_id[2];

    bool quicktime; /* its brand is QuickTime's, or it has none, as before brands were */
    int sound_tracks, sound_disabled, sound_grouped; /* QuickTime and Matroska */
} wf_structure;

/* Reads a file of libavformat's `container` ("mov", "mxf", "matroska", "avi", "mpegts",
 * "mpeg"). Others leave known false. An error: the file cannot be opened. */
weft_status wf_structure_read(const char *path, const char *container, wf_structure *out,
                              weft_error *err);

/* The same of an open file, from its first byte to its last. */
void wf_structure_of(FILE *file, const char *container, wf_structure *out);

#endif
