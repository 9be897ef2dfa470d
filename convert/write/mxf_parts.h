#ifndef WF_CONVERT_WRITE_MXF_PARTS_H
#define WF_CONVERT_WRITE_MXF_PARTS_H

#include "convert/write/mxf_klv.h"
#include "convert/write/mxf.h"

/* What the parts of the MXF writer share. */

enum { WF_MXF_BODY_SID = 1, WF_MXF_INDEX_SID = 2 };
enum { WF_MXF_TIMECODE_TRACK = 1, WF_MXF_PICTURE_TRACK = 2, WF_MXF_SOUND_TRACK = 3 };

/* Essence elements by the last four bytes of their keys, which are their track numbers: type,
 * elements of it in an edit unit, mapping (frame wrapped), number. */
uint32_t wf_mxf_picture_number(void);
uint32_t wf_mxf_sound_number(int tracks, int track);

/* The essence container labels: those of the file's tracks and, where there are several, the
 * one that says so, which comes last. Returns how many. */
#define WF_MXF_CONTAINERS 3
int wf_mxf_containers(const wf_mxf_options *o, wf_ul out[WF_MXF_CONTAINERS]);

extern const wf_ul wf_mxf_op1a;

/* A name-based UUID: number n of the file that seed is of. */
wf_uid wf_mxf_uid(wf_uid seed, uint64_t n);
enum { WF_MXF_INDEX_UID = 9 };

/* The picture's descriptor, all but its InstanceUID and what every file descriptor has. */
void wf_mxf_describe_picture(wf_bytes *b, const wf_mxf_options *o);

/* The header metadata: primer and sets. */
void wf_mxf_metadata(wf_bytes *b, const wf_mxf_options *o, wf_uid seed);

#endif
