/* Apertures: what a field pixel is a weighted mean of. */
#ifndef WF_FILTERS_APERTURE_APERTURE_H
#define WF_FILTERS_APERTURE_APERTURE_H

#include <stddef.h>

#include "filters/aperture/stairs.h"
#include "filters/base/rational.h"

typedef struct wf_aperture wf_aperture;

/* How h depends on u, v and q: by one height, h(v, q), for all |u| <= half_u(v). */
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

/* One row of the aperture table: the mathematics of one name (filters/README.md, Apertures), as
 * data. Lengths are pixels (u), frame lines (v) and field periods (q), each from the aperture's
 * center. */
typedef struct wf_aperture_kind {
    const char *name;
    const char *shape; /* for people: "1 pixel x 2 lines" */
    const char *paper; /* where the paper shows it; "" if it does not */
    wf_rational default_width;
    double reach_u, reach_v; /* h is zero beyond; of design:.., what its wish does not say */
    const char *follows;     /* "B,C" if there are such after "name:"; else NULL */
    const char *example;     /* of what follows; else NULL */
    int parameters;          /* how many numbers follow that wf_aperture keeps */
    double low, high;        /* what each of them may be */
    bool nearest; /* what it sees is the nearest picture's S; what follows is the weight */
    const char *design; /* the wish that a name stands for (design.h); else NULL */
    const double *comb; /* the answer to that wish; else NULL */
    bool couples_uv;    /* h does not separate into u and v (shaped) */
    bool couples_vq;    /* h does not separate into v and q (diamond with tau > 0) */
    /* The integral of h's spatial part over the cell [u0,u1] x [v0,v1]. */
    double (*cell_uv)(const wf_aperture *a, double u0, double u1, double v0, double v1);
    /* The integral over v of h's vertical part; for shaped, of 4 f(v). */
    double (*cell_v)(const wf_aperture *a, double v0, double v1);
    /* The integral over [v0,v1] x [q0,q1] where h couples v and q; else NULL. */
    double (*cell_vq)(double tau, double v0, double v1, double q0, double q1);
    /* As wf_response. */
    double (*response)(const wf_aperture *a, double tau, double fx, double fy, double ft);
    wf_profile profile; /* of h itself */
} wf_aperture_kind;

struct wf_aperture {
    const wf_aperture_kind *kind;
    double parameter[2];     /* mitchell: B, C; least: the weight of flicker */
    double reach_u, reach_v; /* multiples of 1/2; h is zero beyond */
    double half_u;           /* h is zero where |u| is more, unless h couples u and v */
    wf_stairs stairs;        /* designs: the vertical part */
};

/* The table, by index; NULL past the end. */
const wf_aperture_kind *wf_aperture_at(size_t index);

/* Reads "box", "mitchell:1.5,-0.25" or "design:sharp=0.7". False with a reason in why, which
 * lists the names where text has none of them; *out is then untouched. */
bool wf_aperture_parse(const char *text, wf_aperture *out, char *why, size_t why_size);

/* Whether the names of a kind ask for a design, and of what: the text after "design:", or what
 * the name stands for. NULL if it is none. */
const char *wf_aperture_wish(const wf_aperture_kind *kind, const char *name);

/* The integral over [u0, u1] of the horizontal part: a box, 1 pixel wide but for designs. */
double wf_cell_u(const wf_aperture *a, double u0, double u1);

/* Frequency response, 1 at DC; fx cycles/pixel, fy cycles/line, ft cycles/field period. */
double wf_response(const wf_aperture *a, double tau, double fx, double fy, double ft);

/* The aperture's value h(u, v, q), unnormalized; tau > 0. */
double wf_aperture_value(const wf_aperture *a, double tau, double u, double v, double q);

#endif
