#ifndef WF_CONVERT_VERIFY_CHECKS_H
#define WF_CONVERT_VERIFY_CHECKS_H

#include "convert/verify.h"

/* A file with all that is known of it. */
typedef struct wf_subject {
    const wf_verify_options *options;
    const wf_profile *profile;
    wf_claims claims;
    bool contained;     /* claims are known */
    wf_figures figures; /* frames 0: the pixels cannot be read */
    wf_raster raster;   /* that it is held to */
    bool raster_known;
    int coded_lines;     /* with those of the vertical interval */
    const char *trouble; /* why the pixels cannot be read */
} wf_subject;

/* Whether `name` is one of the words, which have blanks between. */
bool wf_in_words(const char *words, const char *name);

/* Every check of the table that applies to the file and that its profile asks for. */
void wf_run_checks(const wf_subject *subject, wf_verification *out);

#endif
