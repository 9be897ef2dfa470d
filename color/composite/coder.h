#ifndef WF_COLOR_COMPOSITE_CODER_H
#define WF_COLOR_COMPOSITE_CODER_H

#include "color/composite/composite.h"
#include "color/composite/fir.h"

/* What a coder holds; for this folder only. */
struct wf_composite {
    wf_tv tv;
    const wf_tv_standard *standard;
    wf_fir stop;          /* all but the band around the subcarrier */
    size_t row, margin;   /* samples */
    float *sine, *cosine; /* [row], of the subcarrier's angle after i samples */
};

#endif
