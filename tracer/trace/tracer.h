#ifndef WF_TRACER_TRACE_TRACER_H
#define WF_TRACER_TRACE_TRACER_H

#include "filters/base/rational.h"
#include "tracer/scene/scene.h"

/* Light along rays of a scene. A tracer looks at one window of time after another; between two
 * looks it is immutable, and any number of threads trace, each with its own scratch. */
typedef struct wf_tracer wf_tracer;
typedef struct wf_trace_scratch wf_trace_scratch;

/* The raster that rays are counted in: x in pixels, y in frame lines. */
typedef struct wf_view {
    int width_px, lines;
    double pixel_aspect;   /* width over height */
    double field_period_s; /* what temporal widths are counted in */
} wf_view;

/* The time of one field. A sample at fraction f of the job's window sees every solid that has a
 * temporal width of its own at fraction f of that solid's. */
typedef struct wf_window_of_time {
    wf_rational base_s;  /* the field's instant, exact */
    double width_fields; /* of the job's window */
    double anchor; /* where the instant lies in every window: 0 start, 0.5 center, 1 end */
    double late_s; /* how much later than the base the last sample's instant is */
} wf_window_of_time;

typedef struct wf_trace_counts {
    int64_t samples, rays, tiles, tiles_skipped;
} wf_trace_counts;

/* So many samples go together: near ones meet fewer solids. */
#define WF_TRACE_PACKET 128

/* Samples of one tile. Arrays of [count]. */
typedef struct wf_trace_samples {
    size_t count;
    const double *x, *y; /* of the raster */
    const double *f;     /* fraction of the window, 0..1 */
    double late_s;       /* their instant, after the window's base */
    float *rgb[3];       /* scene-linear light: written; never NaN or infinite */
    float *alpha;        /* by which it is multiplied: written; NULL: it is not wanted */
} wf_trace_samples;

/* The scene must outlive the tracer. NULL: no memory. */
wf_tracer *wf_tracer_new(const wf_scene *scene, const wf_view *view);
void wf_tracer_free(wf_tracer *tracer); /* NULL is fine */

/* Whether a solid has a temporal width of its own. */
bool wf_tracer_own_widths(const wf_tracer *tracer);

/* Whether nothing moves at all. */
bool wf_tracer_still(const wf_tracer *tracer);

/* Turns to a window of time. skip false: from now on nothing is left out. False: no memory. */
bool wf_tracer_look(wf_tracer *tracer, const wf_window_of_time *window, bool skip);

/* NULL: no memory. */
wf_trace_scratch *wf_trace_scratch_new(const wf_tracer *tracer);
void wf_trace_scratch_free(wf_trace_scratch *scratch); /* NULL is fine */
wf_trace_counts wf_trace_counted(const wf_trace_scratch *scratch);

/* What stands still in a rectangle, which is the same in all windows of time: whoever asks of
 * the same one again keeps it, zero at first; one thread at a time. */
typedef struct wf_trace_sight {
    bool known, plain;      /* plain: nothing mirrors or is clear, and all of it has an end */
    double low[3], high[3]; /* the box of what takes light */
} wf_trace_sight;

/* Whether what a rectangle of the raster shows is proved to look alike in all windows of time
 * in which it is still: nothing that can be seen in it, or come between that and a light,
 * moves. */
bool wf_trace_still(const wf_tracer *tracer, wf_trace_scratch *scratch, const double x[2],
                    const double y[2], wf_trace_sight *sight);

/* Prepares for samples inside a rectangle: finds what can be seen there; *empty: nothing but
 * background. False: no memory. */
bool wf_trace_prepare(const wf_tracer *tracer, wf_trace_scratch *scratch, const double x[2],
                      const double y[2], bool *empty);

/* Whether nothing but background is seen anywhere in a rectangle. Forgets what was prepared. */
bool wf_trace_nothing(const wf_tracer *tracer, wf_trace_scratch *scratch, const double x[2],
                      const double y[2]);

/* Counts a tile that nothing is traced for. */
void wf_trace_skip(wf_trace_scratch *scratch);

/* Light at samples inside the rectangle prepared for. False: no memory. */
bool wf_trace(const wf_tracer *tracer, wf_trace_scratch *scratch,
              const wf_trace_samples *samples);

#endif
