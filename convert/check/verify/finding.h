#ifndef WF_CONVERT_CHECK_VERIFY_FINDING_H
#define WF_CONVERT_CHECK_VERIFY_FINDING_H

#include <stdbool.h>

typedef enum wf_verdict { WF_RIGHT, WF_WRONG, WF_OPEN } wf_verdict;

/* What came of one check. */
typedef struct wf_finding {
    const char *check;
    wf_verdict verdict;        /* WF_OPEN: the file gives no answer */
    char is[160], should[160]; /* for people; should "": as it is */
    char by[96];               /* what demands it */
} wf_finding;

/* Fills a finding: what is there, and, unless it is right, what should be. */
wf_verdict wf_say(wf_finding *finding, bool right, const char *is, const char *should);

/* Fills one that the file gives no answer for. */
wf_verdict wf_open_question(wf_finding *finding, const char *is);

/* Whether `name` is one of the words, which have blanks between. */
bool wf_in_words(const char *words, const char *name);

#endif
