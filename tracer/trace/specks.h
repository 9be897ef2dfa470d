#ifndef WF_TRACER_TRACE_SPECKS_H
#define WF_TRACER_TRACE_SPECKS_H

#include "tracer/trace/tracer.h"

/* Something smaller than a few cells, or a piece of something narrower than one. */
typedef struct wf_trace_speck {
    double x[2], y[2]; /* of the raster: a box in which it is all the window */
    double area;       /* about how many cells it covers at any time */
    double light;      /* about the most that it shows, scene-linear; not what shines on it */
} wf_trace_speck;

typedef void wf_trace_see_speck(void *user, const wf_trace_speck *speck);

/* Tells of what is so small in the rectangle that was prepared for, hidden or not: a solid that
 * is part of others, too. Nothing is told where more is seen than a list was made of: there are
 * so many of them that samples cannot miss all. */
void wf_trace_specks(const wf_tracer *tracer, const wf_trace_scratch *scratch,
                     wf_trace_see_speck *see, void *user);

#endif
