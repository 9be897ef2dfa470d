#ifndef WF_TRACER_TRACE_SEEK_H
#define WF_TRACER_TRACE_SEEK_H

#include "tracer/trace/tracer_inside.h"

/* What rays meet, each on its own way through trees of boxes: for packets whose rays have
 * little in common, or of which each meets something else. */

typedef enum wf_seek_what {
    WF_SEEK_NEAREST, /* surfaces of objects as the unions that they are */
    WF_SEEK_ANY,     /* whether there is one at all, of any part */
    WF_SEEK_HOLDERS  /* parts that hold where rays start */
} wf_seek_what;

/* Fills in hits, which hold how far is looked, what a search of all parts would find there, bit
 * for bit; WF_SEEK_ANY: of what is met some surface, not the nearest. False: no memory. */
bool wf_seek(const wf_tracer *tracer, wf_trace_scratch *scratch, const wf_packet *packet,
             wf_seek_what what, wf_hits *hits);

/* Calls `found` with each ray of a packet and each part that has a box and holds where that ray
 * starts. False: no memory. */
typedef void wf_holder_fn(void *user, int ray, int part);
bool wf_seek_holders(const wf_tracer *tracer, wf_trace_scratch *scratch,
                     const wf_packet *packet, wf_holder_fn *found, void *user);

/* How many parts a packet may meet before each of its rays goes its own way for less. */
int wf_seek_above(const wf_tracer *tracer, wf_seek_what what);

#endif
