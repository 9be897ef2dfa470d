/* Time: windows of fields and cells of subframes. */
#ifndef WF_FILTERS_RASTER_TIMING_H
#define WF_FILTERS_RASTER_TIMING_H

#include <stdbool.h>
#include <stdint.h>

#include "filters/raster/raster.h"

/* Where the temporal window of a field lies about its instant: it begins there, is centered on
 * it, or ends there. */
typedef enum wf_position { WF_START, WF_CENTER, WF_END } wf_position;

/* Where in the window the instant lies: 0, 1/2 or 1 widths after its beginning. */
double wf_position_anchor(wf_position position);

/* Which subframes a field's window meets, and by how much (filters/README.md, Time). Everything
 * is an integer count of one tick, so that a window that ends where a cell begins does not meet
 * it, at field 0 as at field 10^7. */
typedef struct wf_timing_desc {
    const wf_raster *raster;
    wf_rational subframe_rate; /* of the selected subframes, a second */
    bool subframe_center;      /* cells lie about k/R instead of after it */
    int64_t subframes;         /* in the sequence, missing ones included */
    /* Where cells have lengths of their own, instead of the rate: wf_timing_edges's, borrowed,
     * and how long the sequence is shown, in field periods. NULL: a constant rate. */
    const wf_rational *edges;
    int64_t edges_from; /* the number of edges[0]: those before it are forgotten */
    wf_rational shown;
    wf_rational width; /* tau, field periods; under pulldown film frames */
    wf_position position;
    wf_rational skew; /* 0..1 */
} wf_timing_desc;

__extension__ typedef __int128 wf_ticks;

typedef struct wf_timing {
    wf_ticks tick_rate;       /* ticks a field period */
    wf_ticks cell;            /* a subframe's cell; 0: there are edges */
    wf_ticks cell_zero;       /* where cell 0 begins */
    const wf_rational *edges; /* the description's */
    int64_t edges_from;
    wf_ticks width, opens; /* the window, and where it opens from the field's instant */
    wf_ticks skew_line;    /* delay of one frame line */
    int64_t subframes;
    int64_t least_frames;    /* of the time that the sequence is shown */
    const wf_raster *raster; /* the description's: which fields share an instant */
} wf_timing;

/* Subframes first <= k < first + count that a window meets. Never empty: a window that meets
 * none takes the nearest one, and so does an instantaneous one (alone: its only weight is 1).
 */
typedef struct wf_window {
    int64_t first, count;
    bool alone;
} wf_window;

/* Cells of pictures that are shown from times_s[k], seconds, to times_s[k + 1], the last to
 * times_s[count]: cell k is from edges[k] to edges[k + 1], field periods from when the first is
 * shown. center: cells run between the midpoints of these times instead, the first from half
 * its length before its time, the last to half of it after. Both arrays have count + 1 ratios.
 * False with a reason where times do not ascend, or a ratio does not fit. */
bool wf_timing_edges(const wf_raster *raster, const wf_rational *times_s, int64_t count,
                     bool center, wf_rational *edges, char *why, size_t why_size);

/* False with a reason if the ratios are too fine to share a tick. */
bool wf_timing_init(wf_timing *timing, const wf_timing_desc *desc, char *why, size_t why_size);

/* Edges of cells that are found out one by one: those of numbers from <= k < subframes,
 * borrowed until the next call, and one more, WF_EDGE_UNKNOWN or where the last cell ends. What
 * windows before edge `subframes - 1` meet is then as it would be with all of them. False where
 * an edge is too fine to be counted. */
#define WF_EDGE_UNKNOWN ((wf_rational){INT64_C(1) << 31, 1})
bool wf_timing_set_edges(wf_timing *timing, const wf_rational *edges, int64_t from,
                         int64_t subframes);

/* Frames that the sequence gives: those that fit into the time it is shown, but at least its
 * leading whole frames. A frame is whole if its first field's instant lies before the end of
 * the last cell, and all its windows end by then (of instantaneous ones: their instants lie
 * before it). 0 where wf_timing_init refuses. */
int64_t wf_timing_frames(const wf_timing_desc *desc);

/* Whether all windows of a frame, of some width, end by the end of the last cell, where its
 * instant may lie too (of windows that end at it): who asks for this frame by its number can
 * have it. */
bool wf_timing_covers(const wf_timing_desc *desc, int64_t frame);

/* The window of frame line `line` of a field; the line matters only under scan skew. */
wf_window wf_timing_window(const wf_timing *timing, int64_t field, int line);

/* The window of all lines of a raster of `lines` lines. */
wf_window wf_timing_field(const wf_timing *timing, int64_t field, int lines);

/* When the windows of all lines of a raster of `lines` lines open and close, in seconds. */
void wf_timing_seconds(const wf_timing *timing, int64_t field, int lines, double *from,
                       double *to);

/* The part of cell k inside the window, in field periods from the window's center. */
void wf_timing_cell(const wf_timing *timing, int64_t field, int line, int64_t k, double *q0,
                    double *q1);

#endif
