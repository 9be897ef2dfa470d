#ifndef WF_FILTERS_APERTURE_DESIGN_H
#define WF_FILTERS_APERTURE_DESIGN_H

#include <stdbool.h>
#include <stddef.h>

#include "filters/aperture/stairs.h"

#define WF_DESIGN_SHARPS 4
#define WF_DESIGN_ALIAS  0.05 /* unless told */

/* The vertical apertures there are to choose from, and what is asked of the one that is chosen:
 * either the least flicker for responses that are sharp enough, or the sharpest for a flicker.
 */
typedef struct wf_design_wish {
    double support;   /* lines to each side, a multiple of 1/2 */
    double overshoot; /* the response to a step stays in -overshoot .. 1 + overshoot */
    double alias;     /* |H| at most, beyond 1/2 cycle a line */
    double width;     /* pixels, across */
    double flicker;   /* of the still zone plate, at most; 0: the least there is */
    int sharps;       /* 0 if flicker is given: H at at[0] is made the greatest */
    double sharp[WF_DESIGN_SHARPS],
        at[WF_DESIGN_SHARPS]; /* H at `at` cycles a line, at least */
} wf_design_wish;

/* A kernel, and what it is like: its certificate. */
typedef struct wf_design {
    double comb[WF_COMB_MOST];
    wf_stairs stairs;
    double flicker;   /* RMS, of the still zone plate (filters/flicker.h) */
    double overshoot; /* of a step */
    double least;     /* H beyond 1/4 cycle a line */
    double alias;     /* |H| beyond 1/2 */
    double zero;      /* |H| at 1/2 */
    /* Of flicker squared. What keeps the wish's limits and, where flicker was wished, has no
     * less response at at[0], has less by no more than gap and slack together, unless it passes
     * more than twice the noise (wf_stairs_power). Responses are held to a fiftieth less than
     * their limits, for what lies between the frequencies that are looked at. */
    double gap, slack;
    /* The flicker wished leaves the sharpest of all: gap and slack are then of the response at
     * at[0] instead. Nothing allowed that flickers no more has more of it by more than both
     * (likewise), and nothing that flickers as much as was wished by more than spare besides.
     */
    bool sharpest;
    double spare;
    bool no_memory;           /* why there is none */
    int iterations, programs; /* of the solver; programs solved on the way */
} wf_design;

/* What comes of the wishes of `crisp` and `calm`, so that their names cost nothing. */
extern const double wf_comb_crisp[], wf_comb_calm[];

/* "support=4,overshoot=0.08,sharp=0.8,at=0.25". What is not given is 4 lines, 5 % of overshoot
 * and of alias, and 1 pixel; `at` is of the sharp before it, and 0.25 unless given; before a
 * sharp it may come where there is but one. Numbers may be fractions, "1/2". No key comes
 * twice, but for sharp=S,at=F pairs. False with a reason in why. */
bool wf_design_parse(const char *text, wf_design_wish *wish, char *why, size_t why_size);

/* Chooses. Takes some milliseconds, for `flicker` ten times as long; gives the same bits
 * wherever sin and cos do. False with a reason, and with what is possible, in why. */
bool wf_design_solve(const wf_design_wish *wish, wf_design *design, char *why, size_t why_size);

#endif
