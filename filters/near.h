#ifndef WF_FILTERS_NEAR_H
#define WF_FILTERS_NEAR_H

#include <stddef.h>

/* Looks for the name that somebody who typed `text` most likely meant. Start with {.text =
 * text}, offer every name there is, and read `best`: the closest by letters changed, added,
 * left out or swapped, or NULL if none is close. */
typedef struct wf_near {
    const char *text;
    const char *best; /* one of the candidates: theirs to own */
    size_t distance;
} wf_near;

void wf_near_offer(wf_near *near, const char *candidate);

#endif
