/* Shows how far a job is, in the styles of --progress. */
#ifndef WF_CONVERT_PROGRAM_PROGRESS_H
#define WF_CONVERT_PROGRAM_PROGRESS_H

#include <stdio.h>

#include "convert/weft.h"

/* Shows how far a job is, on standard error, in one of the styles of --progress. */
typedef struct wf_meter {
    void (*show)(struct wf_meter *meter, const weft_progress *progress); /* NULL: nothing */
    bool drawn; /* a line is waiting to be rewritten */
    bool color;
    double shown_s; /* when show last wrote, in seconds of the job; below 0: never */
    double began_s; /* when work on frames did: after what comes before the first */
    int percent;    /* what show last wrote; -1: nothing yet */
    weft_progress last;
} wf_meter;

/* Starts a meter in a style; NULL: a rewritten line on a terminal, and nothing elsewhere. False
 * for an unknown style. */
bool wf_meter_init(wf_meter *meter, const char *style);

/* Shows progress, if it is time to; a weft_progress_fn whose user is the meter. */
void wf_meter_update(const weft_progress *progress, void *user);

/* Takes the waiting line away, so that a message can be written. */
void wf_meter_clear(wf_meter *meter);

#endif
