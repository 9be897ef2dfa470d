#ifndef WF_TRACER_RAYS_CSG_H
#define WF_TRACER_RAYS_CSG_H

#include "filters/base/isa.h"
#include "tracer/rays/solid.h"

/* Constructive solid geometry along rays, by classification: the end of a run of one solid is
 * the surface of the whole just where the whole, as its program makes it of its solids, is not
 * the same before the end and after it. No list is kept or merged, programs may be as deep as
 * memory, and ends that rounding cannot tell apart are one: A - A is empty, and a cone that
 * stands on a box has no crack. */

/* What is nearest along each ray so far. */
typedef struct wf_hits {
    _Alignas(64) double s[WF_PACKET];         /* HUGE_VAL: nothing yet */
    _Alignas(64) int64_t solid[WF_PACKET];    /* -1: none */
    _Alignas(64) int64_t entering[WF_PACKET]; /* 1: from outside to inside */
} wf_hits;

/* How far apart two ends of runs may lie and still be one: rounding[i] + s * WF_ROUNDING. */
#define WF_ROUNDING 0x1p-49

void wf_hits_clear(wf_hits *hits);

static inline void wf_hits_copy(const wf_hits *from, int i, wf_hits *to, int k) {
    to->s[k] = from->s[i];
    to->solid[k] = from->solid[i];
    to->entering[k] = from->entering[i];
}

/* An object's program with its solids' runs. Steps of kind WF_STEP_SOLID count runs from 0 on.
 */
typedef struct wf_csg {
    const wf_step *steps;
    int step_count;
    const wf_runs *runs; /* one for each solid of the program, in its order */
    const int *solid;    /* what each is called in hits */
    int solid_count;
    int count; /* of rays */
} wf_csg;

/* An entry of the stack on which programs are evaluated: where each ray may be inside, and
 * whether it is. */
typedef struct wf_csg_entry {
    _Alignas(64) double from[WF_PACKET], to[WF_PACKET];
    _Alignas(64) uint8_t in[WF_PACKET];
} wf_csg_entry;

typedef struct wf_csg_ops {
    /* Finds the nearest surface with s > 0 and nearer than what hits hold (or as near, of a
     * solid that comes before). stack: as many entries as the program's most_stack. */
    void (*nearest)(const wf_csg *csg, const double *rounding, wf_csg_entry *stack,
                    wf_hits *hits);
    /* Whether the object holds the point at s of each ray, as bytes 0 and 1. */
    void (*inside)(const wf_csg *csg, const double *s, wf_csg_entry *stack, uint8_t *inside);
} wf_csg_ops;

WF_ISA_DECLARE(wf_csg_ops);

#endif
