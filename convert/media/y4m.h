#ifndef WF_CONVERT_MEDIA_Y4M_H
#define WF_CONVERT_MEDIA_Y4M_H

#include <stddef.h>
#include <stdio.h>

#include "filters/base/rational.h"

/* The header of a YUV4MPEG2 stream (mjpegtools, yuv4mpeg(5)). */
typedef struct wf_y4m {
    int width_px, lines;
    wf_rational rate, aspect; /* {0, 0}: unknown, which aspects may be */
    char order;               /* 'p', 't', 'b', 'm' (mixed); 0: unknown */
    char chroma[32];          /* "422p10"; "420jpeg" where the header has none */
    bool full_range, range_said;
    int bits;         /* of the codes; those beyond 8 take two bytes, low byte first */
    int across, down; /* luma samples to a chroma sample; 0, 0: no chroma */
    bool alpha;       /* a fourth plane, as large as the first */
    bool known;       /* the chroma's name is; else bits, across and down are not */
} wf_y4m;

#define WF_Y4M_MAGIC "YUV4MPEG2"
#define WF_Y4M_LINE  1024 /* the longest header line that is read */

/* Reads a header's line (without its end; it is cut into words). False if a size or the rate is
 * missing or out of range. */
bool wf_y4m_parse(char *line, wf_y4m *out);

/* Bytes of a frame's planes, without its "FRAME" line; 0 if the chroma is not known. */
int64_t wf_y4m_frame_bytes(const wf_y4m *y4m);

/* Whole frames after a header of so many bytes, if they carry no parameters of their own; -1:
 * that cannot be told. */
int64_t wf_y4m_count(const wf_y4m *y4m, FILE *file, int64_t header_bytes);

/* "top first", "unknown", .. */
const char *wf_y4m_order(const wf_y4m *y4m);

#endif
