#ifndef WF_CONVERT_PLAN_REFINE_H
#define WF_CONVERT_PLAN_REFINE_H

#include "convert/plan/plan.h"

/* What subframes in a folder still want for an error that is asked for. */

/* A subframe of the plan, and what of it is there. */
typedef struct wf_refine_slot {
    int64_t number;
    char *path;     /* NULL: it is not there */
    bool whole;     /* it exists everywhere */
    wf_box region;  /* where it exists, of its display window */
    bool is_wanted; /* more of it: */
    wf_box wanted;
} wf_refine_slot;

typedef struct wf_refining {
    const wf_plan *plan;
    double error; /* Rec. 709's transfer of light, 1 being white */
    wf_refine_slot *slot;
    size_t slots;
    wf_box *moved; /* [fields]: where something moves within the window */
} wf_refining;

/* Turns a plan of all that fields see into one of what the folder job.refine still wants. */
weft_status wf_plan_refine(wf_plan *plan, weft_error *err);

/* Marks, in the slots first .. last, what field `field` still wants of those between. The first
 * is the first of its window; first and last are whole. *moved gets the rectangle of what moves
 * between subframes of the window itself; empty: nothing that is there. (estimate.c) */
weft_status wf_refine_estimate(wf_refining *refining, int64_t field, size_t first, size_t last,
                               wf_box *moved, weft_error *err);

/* Adds a rectangle to what is wanted of a slot, and what there is of it, which it replaces. */
void wf_refine_want(const wf_refining *refining, wf_refine_slot *slot, wf_box box);

#endif
