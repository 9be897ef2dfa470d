/* What samples.c shares with its loops. */
#ifndef WF_FILTERS_GATHER_SAMPLES_INSIDE_H
#define WF_FILTERS_GATHER_SAMPLES_INSIDE_H

#include "filters/base/isa.h"
#include "filters/gather/samples.h"

/* Sums of one pixel. */
typedef struct wf_pixel_sum {
    double r, g, b, weight;
} wf_pixel_sum;

struct wf_gather {
    wf_gather_desc desc;
    int64_t field;
    int parity, line_step, field_lines; /* of the field */
    wf_patch held;
    double tau, middle, half; /* of the window, in field periods; its middle from the instant */
    double skew_a_line;       /* field periods that a frame line is late */
    wf_pixel_sum *sum;        /* [held.end - held.first][held.right - held.left] */
    double *alpha;            /* the same of alpha; NULL: it is not gathered */
};

/* How many instants of fields lie between a field and the gather's. */
double wf_gather_apart(const wf_gather *gather, int64_t field);

typedef struct wf_gather_ops {
    /* Adds samples; apart: instants from the field that they count in to the gather's. */
    void (*add)(wf_gather *gather, const wf_samples *samples, double apart);
} wf_gather_ops;

WF_ISA_DECLARE(wf_gather_ops);

static inline ptrdiff_t wf_gather_line_at(const wf_gather *g, int line) {
    return (ptrdiff_t)(line - g->held.first) * (g->held.right - g->held.left) - g->held.left;
}

/* The sums of a line, so that [i] is that of pixel i, where the gather holds it. */
static inline wf_pixel_sum *wf_gather_sums(const wf_gather *g, int line) {
    return g->sum + wf_gather_line_at(g, line);
}

/* The same of alpha; NULL: it is not gathered. */
static inline double *wf_gather_alphas(const wf_gather *g, int line) {
    return g->alpha ? g->alpha + wf_gather_line_at(g, line) : NULL;
}

#endif
