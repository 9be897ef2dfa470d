/* A solver of small convex quadratic programs. */
#ifndef WF_FILTERS_APERTURE_QP_H
#define WF_FILTERS_APERTURE_QP_H

#include <stdbool.h>

/* A small dense convex quadratic program: the x that makes
 *
 *     1/2 x'Qx + c'x  least, where  a'x = b  and  Gx <= h.
 *
 * Q is positive definite and everything of the order of 1. */
typedef struct wf_qp {
    int n, m;
    double *q; /* [n][n], symmetric */
    double *c; /* [n] */
    double *a; /* [n], not zero */
    double b;
    double *g; /* [m][n] */
    double *h; /* [m] */
} wf_qp;

/* No x that meets the limits has a value below the answer's by more than gap: the multipliers
 * z >= 0 prove it. */
typedef struct wf_qp_answer {
    double *x; /* [n] */
    double *z; /* [m], of Gx <= h */
    double y;  /* of a'x = b */
    double gap;
    int iterations;
} wf_qp_answer;

typedef enum wf_qp_end { WF_QP_SOLVED, WF_QP_STUCK, WF_QP_NO_MEMORY } wf_qp_end;

/* Memory for a program of n unknowns and at most m limits, zeroed: its arrays and the answer's.
 * False if there is none. wf_qp_release releases both. */
bool wf_qp_alloc(wf_qp *qp, wf_qp_answer *answer, int n, int m);
void wf_qp_release(wf_qp *qp);

/* Primal-dual interior point method with Mehrotra's predictor and corrector (1992). Gets stuck
 * where nothing meets the limits, and may where rounding leaves a gap above 1e-5: that it is
 * stuck proves nothing. */
wf_qp_end wf_qp_solve(const wf_qp *qp, wf_qp_answer *answer);

#endif
