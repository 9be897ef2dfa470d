#ifndef WF_TRACER_CSG_H
#define WF_TRACER_CSG_H

#include "tracer/solid.h"

/* Constructive solid geometry along rays, by classification: the end of a run of one solid is
 * the surface of the whole just where the whole, as its program makes it of its solids, is not
 * the same before the end and after it. No list is kept or merged, programs may be as deep as
 * memory, and ends that rounding cannot tell apart are one: A - A is empty, and a cone that
 * stands on a box has no crack. */

/* What is nearest along each ray so far. */
typedef struct wf_hits {
    _Alignas(64) double s[WF_PACKET]; /* HUGE_VAL: nothing yet */
    int object[WF_PACKET], solid[WF_PACKET];
    uint8_t entering[WF_PACKET]; /* from outside to inside */
} wf_hits;

void wf_hits_clear(wf_hits *hits, int count);

/* An object's program with its solids' runs. Steps of kind WF_STEP_SOLID count runs from 0 on.
 */
typedef struct wf_csg {
    const wf_step *steps;
    int step_count;
    const wf_runs *runs; /* one for each solid of the program, in its order */
    const int *solid;    /* what each is called in hits */
    int solid_count;
    int object; /* what the object is called in hits */
} wf_csg;

/* Finds the nearest surface with s > 0 and nearer than what hits hold. rounding: how far apart
 * two ends may lie along each ray and still be one. stack: room for 2 * most_stack * WF_PACKET
 * bytes. */
void wf_csg_nearest(const wf_csg *csg, int count, const double *rounding, uint8_t *stack,
                    wf_hits *hits);

/* Whether the object holds the point at s of each ray, as bytes 0 and 1. */
void wf_csg_inside(const wf_csg *csg, int count, const double *s, uint8_t *stack,
                   uint8_t *inside);

#endif
