#ifndef WF_CONVERT_CHECK_VERIFY_CHECKS_H
#define WF_CONVERT_CHECK_VERIFY_CHECKS_H

#include "convert/check/verify.h"
#include "convert/check/verify_frames.h"

/* A file with all that is known of it. */
typedef struct wf_subject {
    const wf_verify_options *options;
    const wf_profile *profile;
    wf_metadata metadata;
    bool contained;     /* metadata is known */
    wf_figures figures; /* frames 0: the pixels cannot be read */
    wf_raster raster;   /* that it is held to */
    bool raster_known;
    wf_frame_labels labels; /* files 0: it is no image sequence */
    int coded_lines;        /* with those of the vertical interval */
    const char *trouble;    /* why the pixels cannot be read */
} wf_subject;

/* Fills a finding: what is there, and, unless it is right, what should be. */
wf_verdict wf_say(wf_finding *finding, bool right, const char *is, const char *should);
wf_verdict wf_open_question(wf_finding *finding, const char *is);

/* Those of the table that are about time (verify_time.c). */
typedef wf_verdict wf_check_fn(const wf_subject *subject, wf_finding *finding);
wf_check_fn wf_check_timecode, wf_check_labels, wf_check_interlace, wf_check_base,
    wf_check_frames, wf_check_sound;

/* Whether `name` is one of the words, which have blanks between. */
bool wf_in_words(const char *words, const char *name);

/* Every check of the table that applies to the file and that its profile asks for. */
void wf_run_checks(const wf_subject *subject, wf_verification *out);

#endif
