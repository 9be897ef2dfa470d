#ifndef WF_CONVERT_RUN_SUM_FLOW_H
#define WF_CONVERT_RUN_SUM_FLOW_H

#include "convert/finish/crew.h"
#include "convert/finish/frames.h"
#include "convert/finish/setup.h"
#include "convert/run/sum/source.h"

/* All that one weft_job_run holds. What is counted in it is read once, after it. */
struct wf_run {
    weft_job *job;
    wf_report *report;
    wf_setup setup;
    wf_crew crew;
    const wf_source_kind *kind; /* NULL: not known yet */
    void *source;               /* the kind's */
    wf_pace pace;
    wf_frames *frames; /* NULL: not made */
    void *sums;        /* of kind->summing; NULL: not begun */
    bool finished;     /* the output stands at its name */
};

#endif
