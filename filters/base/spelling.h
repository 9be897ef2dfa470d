/* Suggestions for names that are not known. */
#ifndef WF_FILTERS_BASE_SPELLING_H
#define WF_FILTERS_BASE_SPELLING_H

#include <stddef.h>

/* Looks for the name that somebody who typed `text` most likely meant. Start with {.text =
 * text}, offer every name there is, and read `best`: the one that takes the fewest letters
 * changed, added, left out or swapped, or NULL if all take more than a third of them. */
typedef struct wf_spelling {
    const char *text;
    const char *best; /* one of the candidates: theirs to own */
    size_t distance;
} wf_spelling;

void wf_spelling_offer(wf_spelling *spelling, const char *candidate);

#endif
