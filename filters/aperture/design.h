/* Vertical apertures made to measure (filters/README.md, Designs). */
#ifndef WF_FILTERS_APERTURE_DESIGN_H
#define WF_FILTERS_APERTURE_DESIGN_H

#include <stdbool.h>
#include <stddef.h>

#include "filters/aperture/stairs.h"

#define WF_DESIGN_SHARPS 4    /* sharp=S,at=F pairs, at most */
#define WF_DESIGN_ALIAS  0.05 /* unless the wish says otherwise */

/* Which vertical apertures may be chosen, and what is asked of the one that is: either the
 * least flicker of all whose response is sharp enough, or the sharpest of all that flicker
 * little enough. H is the vertical response, 1 at 0. */
typedef struct wf_design_wish {
    double support;   /* lines to each side, a multiple of 1/2 */
    double overshoot; /* the response to a step stays in -overshoot .. 1 + overshoot */
    double alias;     /* |H| at most, beyond 1/2 cycle a line */
    double width;     /* pixels, across */
    double flicker;   /* RMS, of the still zone plate, at most; 0: the least there is */
    int sharps;       /* 0 if flicker is given: H(at[0]) is then made the greatest */
    double sharp[WF_DESIGN_SHARPS]; /* H(at[i]) and H of all lower frequencies, at least */
    double at[WF_DESIGN_SHARPS];    /* cycles a line */
} wf_design_wish;

/* A kernel, and the certificate that says what it is like. */
typedef struct wf_design {
    double comb[WF_COMB_MOST];
    wf_stairs stairs;
    double flicker;   /* RMS, of the still zone plate (flicker.h) */
    double overshoot; /* of a step */
    double least;     /* the least H beyond 1/4 cycle a line */
    double alias;     /* the largest |H| beyond 1/2 */
    double zero;      /* |H| at 1/2 */
    /* How good the kernel is: of all that keep the wish's limits (less a fiftieth, which is
     * kept back for what responses do between the frequencies that are looked at) and pass no
     * more than twice its noise (wf_stairs_power), none has a flicker squared that is below its
     * own by more than gap + slack. Where flicker was wished, that is said of those whose
     * response at at[0] is no less. */
    double gap, slack;
    /* Whether the flicker wished for allows the sharpest kernel of all. gap + slack are then of
     * the response at at[0]: no kernel with as little flicker has a response above its own by
     * more than that, and none with as much flicker as was wished by more than that and spare.
     */
    bool sharpest;
    double spare;
    bool no_memory;           /* why there is none */
    int iterations, programs; /* of the solver; programs solved on the way */
} wf_design;

/* The combs of crisp and calm, wf_comb_count of their support each. */
extern const double wf_comb_crisp[], wf_comb_calm[];

/* Reads "support=4,overshoot=0.08,sharp=0.8,at=0.25". Support is 4 lines, overshoot and alias
 * are 5 % and width is 1 pixel unless given. `at` belongs to the sharp before it and is 0.25
 * unless given; where there is one sharp only it may come first. Numbers may be fractions,
 * "1/2". Each key comes once, but for sharp=S,at=F pairs. False with a reason in why. */
bool wf_design_parse(const char *text, wf_design_wish *wish, char *why, size_t why_size);

/* Chooses the kernel. Takes some milliseconds, ten times as long where flicker is wished; gives
 * the same bits on all machines whose sin and cos do. False with a reason in why, which says
 * what would be possible. */
bool wf_design_solve(const wf_design_wish *wish, wf_design *design, char *why, size_t why_size);

#endif
