/* Video rasters: size, rate, scan and field order. */
#ifndef WF_FILTERS_RASTER_RASTER_H
#define WF_FILTERS_RASTER_RASTER_H

#include <stddef.h>

#include "filters/base/rational.h"

typedef enum wf_scan { WF_INTERLACED, WF_SEGMENTED, WF_PROGRESSIVE } wf_scan;

/* Which coding standard's luma weights a raster's Y'CbCr uses. The 601 rasters differ in their
 * primaries: SMPTE-C for 525 lines, EBU for 625. */
typedef enum wf_matrix { WF_601_525, WF_601_625, WF_709, WF_2020 } wf_matrix;

/* A video raster: size, rate, scan and what its lines are called in the analog system. */
typedef struct wf_raster {
    char name[64];
    int width_px, lines;    /* of the whole frame */
    wf_rational frame_rate; /* frames a second */
    wf_scan scan;
    bool top_first; /* false for progressive rasters too */
    wf_rational pixel_aspect;
    wf_matrix matrix;
    /* First picture lines of fields 1 and 2, and all lines; 0 where there is no map. */
    int line1, line2, total_lines;
    /* Fields (progressive: frames) show film, 2 of them for each 5 in the order 2:3:2:3, so
     * that frames are AA BB BC CD DD. Never set by wf_raster_parse; not for segmented frames.
     */
    bool pulldown;
    /* Fields are made with all lines of the frame at their instant, of which they keep their
     * own later: parity 0, line step 1. Never set by wf_raster_parse. */
    bool all_lines;
    /* Both fields of a segmented frame are made as one field of all its lines, which has the
     * frame's number. Never set by wf_raster_parse. */
    bool whole_frames;
} wf_raster;

/* The named rasters, by index; NULL past the end. Static storage. */
const wf_raster *wf_raster_at(size_t index);

/* A name of the table, a 525 or 625 name with "-wide", another name of one of these
 * (raster_alias.h: pal, 576i50, 1080i25 ..), or
 * WxH@RATE(i|p|psf)[,tff|bff][,par=N:D][,601-525|601-625|709|2020]. False with a reason, and
 * with a suggestion where a name is close, in why. */
bool wf_raster_parse(const char *text, wf_raster *out, char *why, size_t why_size);

/* "601-525", "601-625", "709" or "2020". Static storage. */
const char *wf_matrix_name(wf_matrix matrix);

/* "top first", "bottom first", "one instant" (segmented) or "progressive". */
const char *wf_raster_order(const wf_raster *raster);

/* Whether the top picture line belongs to field 1, from the line map alone: L1 < L2 - N/2.
 * False also for an invalid map; wf_raster_map_valid tells. */
bool wf_raster_map_top_first(int line1, int line2, int total_lines);
bool wf_raster_map_valid(int line1, int line2, int total_lines);

/* The instant of a field, counted in instants: both fields of a segmented frame have one, and
 * all fields of a film frame under pulldown; and the first field that has an instant. */
int64_t wf_raster_instant(const wf_raster *raster, int64_t field);
int64_t wf_raster_first_field(const wf_raster *raster, int64_t instant);

/* Film frames a second that 2:3 pulldown takes: 24 from 60 fields, 24000/1001 from 60000/1001;
 * {0, 0} for rasters that have no such pulldown. */
wf_rational wf_raster_film_rate(const wf_raster *raster);

/* Field n of the raster: its parity (0: it owns the top lines j = 0, 2, ..; 1: j = 1, 3, ..;
 * progressive rasters, and fields of all lines: always 0), the distance between its lines (2,
 * or 1) and their number. */
int wf_raster_parity(const wf_raster *raster, int64_t field);
int wf_raster_line_step(const wf_raster *raster);
int wf_raster_field_lines(const wf_raster *raster, int parity);
int wf_raster_fields_per_frame(const wf_raster *raster); /* 1 or 2 */

/* Field period Tf in seconds (filters/README.md, Time): from one instant to the next. That of
 * segmented frames is a frame's, that of pulldown a film frame's. */
wf_rational wf_raster_field_period(const wf_raster *raster);

#endif
