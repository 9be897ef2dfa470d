#ifndef WF_TRACER_SCENE_GUESS_H
#define WF_TRACER_SCENE_GUESS_H

#include "filters/base/spelling.h"

/* Looks for the word of the scene language that somebody meant: one that other programs call as
 * they did (cube: box), or else one that is spelled alike, or longer or shorter. Start with
 * wf_guess_of, offer every word there is, and ask for what was found. */
typedef struct wf_guess {
    wf_spelling spelling;
    const char *begins; /* a candidate of which the text is the beginning, or the other way */
    const char *meant;  /* what a candidate that means the same should be told as */
    int row;            /* of the table of meanings, of which the first counts */
} wf_guess;

wf_guess wf_guess_of(const char *text);

void wf_guess_offer(wf_guess *guess, const char *candidate);

/* What was meant, or NULL; it lives as long as the candidates do. */
const char *wf_guess_found(const wf_guess *guess);

#endif
