#ifndef WF_CONVERT_RUN_SUM_NEEDS_H
#define WF_CONVERT_RUN_SUM_NEEDS_H

#include "convert/run/sum/source.h"

/* A walk through the units that groups of fields need, in ascending order: each is given once,
 * or, where no fields are carried from group to group, once to every group that needs it. */
typedef struct wf_walk {
    int64_t next_unit;        /* those before it have been given */
    int64_t field, group_end; /* of the group in hand */
} wf_walk;

/* Begins a walk: the fields that follow are those of other frames. */
wf_walk wf_walk_begin(void);

/* Turns to the group of fields first <= n < end. */
void wf_walk_group(const wf_run *run, wf_walk *walk, int64_t first, int64_t end);

/* The next units that the group needs, as many as are read together; false when it has been
 * given all of them. */
bool wf_walk_units(const wf_run *run, wf_walk *walk, wf_units *units);

/* Where the group ends that begins with `field`; `past` is the end of the last one. */
int64_t wf_walk_group_end(const wf_run *run, int64_t field, int64_t past);

#endif
