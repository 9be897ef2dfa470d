#ifndef WF_FILTERS_APERTURE_APERTURE_H
#define WF_FILTERS_APERTURE_APERTURE_H

#include <stddef.h>

#include "filters/aperture/stairs.h"
#include "filters/base/rational.h"

typedef struct wf_aperture wf_aperture;

/* How h depends on v, q and u: one height for all |u| <= half_u(v). */
typedef enum wf_profile {
    WF_PROFILE_LINE,
    WF_PROFILE_BOX,
    WF_PROFILE_NOTCH,
    WF_PROFILE_SHAPED,
    WF_PROFILE_DIAMOND,
    WF_PROFILE_MITCHELL,
    WF_PROFILE_DESIGN,
    WF_PROFILES
} wf_profile;

/* One row of the aperture table: the mathematics of one name of resampling.md, as data. Lengths
 * are pixels (u), frame lines (v) and field periods (q), each from the aperture's centre. */
typedef struct wf_aperture_kind {
    const char *name;
    const char *shape; /* for people: "1 pixel x 2 lines" */
    const char *paper; /* where the paper shows it; "" if it does not */
    wf_rational default_width;
    double reach_u, reach_v; /* h is zero beyond; of a design that names none */
    const char *follows;     /* "B,C" if there are such after "name:"; else NULL */
    const char *example;     /* of those */
    int parameters;          /* numbers among them that are kept */
    const char *design;      /* what was wished for (filters/design.h), unless that follows */
    const double *comb;      /* and what came of it */
    bool couples_uv;         /* h does not separate into u and v (shaped) */
    bool couples_vq;         /* h does not separate into v and q (diamond with tau > 0) */
    /* Integral of h's spatial part over the cell [u0,u1] x [v0,v1]. */
    double (*cell_uv)(const wf_aperture *a, double u0, double u1, double v0, double v1);
    /* Integral over v of h's vertical part; for shaped, of 4 f(v). */
    double (*cell_v)(const wf_aperture *a, double v0, double v1);
    /* Integral over [v0,v1] x [q0,q1] where v and q are coupled; NULL otherwise. */
    double (*cell_vq)(double tau, double v0, double v1, double q0, double q1);
    double (*response)(const wf_aperture *a, double tau, double fx, double fy, double ft);
    wf_profile profile; /* of h itself */
} wf_aperture_kind;

struct wf_aperture {
    const wf_aperture_kind *kind;
    double parameter[2];     /* mitchell: B, C */
    double reach_u, reach_v; /* multiples of 1/2; h is zero beyond */
    double half_u;           /* of those that separate: h is zero where |u| is more */
    wf_stairs stairs;        /* designs: the vertical part */
};

/* The table, by index; NULL past the end. */
const wf_aperture_kind *wf_aperture_at(size_t index);

/* "box", "mitchell:1.5,-0.25", "design:sharp=0.7". False with a reason and the names there are
 * in why. */
bool wf_aperture_parse(const char *text, wf_aperture *out, char *why, size_t why_size);

/* Whether the names of a kind ask for a design, and of what: the text after "design:", or what
 * the name stands for. NULL if it is none. */
const char *wf_aperture_wish(const wf_aperture_kind *kind, const char *name);

/* Integral of the horizontal part, B_1(u) but for designs, over [u0, u1]. */
double wf_cell_u(const wf_aperture *a, double u0, double u1);

/* Frequency response, 1 at DC; fx cycles/pixel, fy cycles/line, ft cycles/field period. */
double wf_response(const wf_aperture *a, double tau, double fx, double fy, double ft);

/* The aperture's value h(u, v, q), for irregular samples and for tests; tau > 0. */
double wf_aperture_value(const wf_aperture *a, double tau, double u, double v, double q);

#endif
