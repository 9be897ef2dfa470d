#ifndef WF_TRACER_TRACE_GROVE_H
#define WF_TRACER_TRACE_GROVE_H

#include "tracer/rays/walk.h"
#include "tracer/trace/tracer.h"

/* Parts in trees for single rays: those that stand still, those that one operator moves, in its
 * space where they do not move by it, and the rest, as wide as they are over the window. */

/* What a ray must know of a part that it may meet, beside each other as they are in a tree. */
typedef struct wf_leaf {
    _Alignas(64) wf_affine inverse; /* of the solid, where the part is one alone */
    int part, solid, op;            /* solid -1: there are several */
    wf_solid_kind kind;
    bool sibling; /* its object has other parts */
} wf_leaf;

typedef struct wf_grove {
    int op;     /* in whose space it is; -1: the world's */
    bool moves; /* within that space */
    wf_tree tree;
    wf_leaf *leaves; /* [tree.item_count] */
    uint8_t *kinds;  /* [tree.item_count]: of a solid in that space, where one is like any other
                      * of its kind; or  WF_SOLID_KINDS */
} wf_grove;

typedef struct wf_groves {
    wf_grove *grove;
    int count;
    int *of_part; /* [part]: which grove it is in */
} wf_groves;

/* Makes the tracer's groves, or makes those again in which something moves otherwise than it
 * did in the window before. False: no memory. */
bool wf_groves_look(wf_tracer *tracer);
const wf_tree *wf_groves_still(const wf_groves *groves);
void wf_groves_free(wf_groves *groves); /* NULL is fine */

#endif
