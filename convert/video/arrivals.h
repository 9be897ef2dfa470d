#ifndef WF_CONVERT_VIDEO_ARRIVALS_H
#define WF_CONVERT_VIDEO_ARRIVALS_H

#include "convert/base/fail.h"
#include "filters/base/rational.h"

/* When the pictures of a pipe are shown, which comes with each of them and cannot be listed
 * before. They last equally long as long as each timestamp lies within a tick of the stated
 * rate; from the first that does not, as their timestamps say, and if no window has been
 * decided before it, from the first picture on. */
typedef struct wf_arrivals wf_arrivals;

typedef struct wf_arrivals_desc {
    const char *path;     /* for people; borrowed */
    wf_rational rate;     /* that is stated, pictures a second */
    wf_rational tick_s;   /* of timestamps */
    wf_rational period_s; /* what edges are counted in */
    bool center;          /* cells run between the midpoints of times */
} wf_arrivals_desc;

weft_status wf_arrivals_new(const wf_arrivals_desc *desc, wf_arrivals **out, weft_error *err);
void wf_arrivals_free(wf_arrivals *arrivals); /* NULL is fine */

/* The next picture: when it is shown, and how long as far as it says (0: not), in ticks.
 * WEFT_FAILED where it does not come after the one before it. */
weft_status wf_arrivals_add(wf_arrivals *arrivals, int64_t ticks, int64_t lasts,
                            weft_error *err);

/* A picture that is none of these is not in step: they last unequally long as well. */
void wf_arrivals_turn_uneven(wf_arrivals *arrivals);

/* After the last picture, once: it ends as it says, else it lasts as the one before. */
weft_status wf_arrivals_end(wf_arrivals *arrivals, weft_error *err);

/* Before wf_arrivals_end, where pictures that were left out follow the last: when the last of
 * them ends, in ticks. */
void wf_arrivals_last_until(wf_arrivals *arrivals, int64_t ticks);

/* What has been told is used now: it will not change. */
void wf_arrivals_decide(wf_arrivals *arrivals);

/* Forgets pictures before `number`. */
void wf_arrivals_forget(wf_arrivals *arrivals, int64_t number);

/* Whether pictures last unequally long, and how many there have been. */
bool wf_arrivals_uneven(const wf_arrivals *arrivals);
int64_t wf_arrivals_count(const wf_arrivals *arrivals);

/* Edges of cells for wf_timing_set_edges, of pictures *from to the last, and one more. Valid
 * until the next call. */
const wf_rational *wf_arrivals_edges(const wf_arrivals *arrivals, int64_t *from);

/* How long, in periods, the pictures before `number` are shown; it is not forgotten, and at
 * most the count, which is the end of the last only after wf_arrivals_end. */
wf_rational wf_arrivals_shown(const wf_arrivals *arrivals, int64_t number);

#endif
