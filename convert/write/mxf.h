#ifndef WF_CONVERT_WRITE_MXF_H
#define WF_CONVERT_WRITE_MXF_H

#include "convert/base/outfile.h"
#include "convert/job/audio.h"
#include "convert/job/output.h"
#include "convert/job/timecode.h"
#include "filters/raster/raster.h"

/* Uncompressed 4:2:2 in MXF OP1a: SMPTE ST 377-1 (file), ST 378 (OP1a), ST 379 (generic
 * container, frame wrapped), ST 384 (picture), ST 382 (sound). Edit units are all of one
 * size, so that the whole file is known before its first frame: it is written from front to
 * end, and its header again, when its identifiers are known; the header is closed and
 * complete, the index is in the footer. Equal input makes equal bytes: identifiers are
 * hashes of what is in the file, dates are those that are given, or "unknown". */

typedef struct wf_mxf_options {
    const wf_raster *raster; /* borrowed; even width */
    int bits;                /* 8: UYVY; 10: v210 */
    size_t frame_bytes;      /* of the packed picture */
    bool full_range;
    const char *color_space; /* as wf_output_options; borrowed */
    int64_t frame_count;     /* how many frames will be written */
    wf_timecode start;       /* of the first of them */
    wf_date date;            /* that it was made */
    int64_t first_frame;     /* of the run, from which samples are shared out to frames */
    wf_sound_feed sound;     /* mono tracks of 16 or 24 bits, at most WF_SOUND_TRACKS */
} wf_mxf_options;

typedef struct wf_mxf wf_mxf;

/* Writes into file, which stays the caller's: committing or abandoning it is. */
weft_status wf_mxf_open(const wf_mxf_options *options, wf_outfile *file, wf_mxf **out,
                        weft_error *err);

/* The next frame: frame_bytes of UYVY or v210, lines interleaved, top line first. */
weft_status wf_mxf_write(wf_mxf *mxf, const void *picture, weft_error *err);

/* The footer; an error if frame_count frames have not been written. */
weft_status wf_mxf_finish(wf_mxf *mxf, weft_error *err);

void wf_mxf_free(wf_mxf *mxf);

#endif
