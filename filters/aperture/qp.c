/* A small convex quadratic program by an interior point method. */
#include "filters/aperture/qp.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MOST_STEPS 60
#define LIMIT      1e-9
#define GAP        1e-7  /* rounding lets it become 1e-8 to 1e-12, as it leaves slopes */
#define SLOPE      1e-6  /* what slopes may be off by */
#define FAIR_GAP   1e-5  /* is enough where rounding allows no less */
#define TO_BORDER  0.995 /* of the way to where a slack or multiplier would vanish is gone */

bool wf_qp_alloc(wf_qp *qp, wf_qp_answer *answer, int n, int m) {
    size_t width = (size_t)n, height = (size_t)m;
    double *memory =
        calloc(width * width + 3 * width + width * height + 2 * height, sizeof *memory);
    if (!memory) return false;
    *qp = (wf_qp){.n = n, .m = m, .q = memory};
    qp->c = qp->q + width * width;
    qp->a = qp->c + width;
    answer->x = qp->a + width;
    qp->g = answer->x + width;
    qp->h = qp->g + width * height;
    answer->z = qp->h + height;
    return true;
}

void wf_qp_release(wf_qp *qp) {
    free(qp->q);
    qp->q = NULL;
}

static double dot(int n, const double *a, const double *b) {
    double sum = 0;
    for (int i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

/* ---- One step's linear algebra ---- */

typedef struct work {
    double *k;                         /* [n][n]: Q + G' (z/s) G, then its Cholesky factor */
    double *dual, *right, *dx, *along; /* [n]; along: K^-1 a */
    double *s, *ds, *dz, *short_of, *center; /* [m] */
    double level;                            /* a'x - b */
} work;

static bool make_work(work *w, int n, int m) {
    size_t width = (size_t)n, height = (size_t)m;
    double *memory = calloc(width * width + 4 * width + 5 * height, sizeof *memory);
    if (!memory) return false;
    *w = (work){.k = memory};
    w->dual = memory + width * width;
    w->right = w->dual + n;
    w->dx = w->right + n;
    w->along = w->dx + n;
    w->s = w->along + n;
    w->ds = w->s + m;
    w->dz = w->ds + m;
    w->short_of = w->dz + m;
    w->center = w->short_of + m;
    return true;
}

/* The lower triangle only. */
static void add_square(double *k, int n, const double *row, double weight) {
    for (int i = 0; i < n; i++) {
        double scaled = weight * row[i];
        for (int j = 0; j <= i; j++) k[i * n + j] += scaled * row[j];
    }
}

static bool factor(double *k, int n) {
    for (int j = 0; j < n; j++) {
        double left = k[j * n + j] - dot(j, k + j * n, k + j * n);
        if (!(left > 0)) return false;
        k[j * n + j] = sqrt(left);
        for (int i = j + 1; i < n; i++)
            k[i * n + j] = (k[i * n + j] - dot(j, k + i * n, k + j * n)) / k[j * n + j];
    }
    return true;
}

static void substitute(const double *k, int n, const double *right, double *x) {
    for (int i = 0; i < n; i++) x[i] = (right[i] - dot(i, k + i * n, x)) / k[i * n + i];
    for (int i = n; i-- > 0;) {
        for (int j = i + 1; j < n; j++) x[i] -= k[j * n + i] * x[j];
        x[i] /= k[i * n + i];
    }
}

/* ---- The method ---- */

/* Finds what the conditions of an optimum are off by; true where that is little. */
static bool residuals(const wf_qp *qp, const wf_qp_answer *at, work *w) {
    int n = qp->n;
    double limits = 0, slopes = 0;
    for (int i = 0; i < n; i++)
        w->dual[i] = dot(n, qp->q + i * n, at->x) + qp->c[i] + at->y * qp->a[i];
    for (int r = 0; r < qp->m; r++) {
        const double *row = qp->g + r * n;
        w->short_of[r] = dot(n, row, at->x) + w->s[r] - qp->h[r];
        limits = fmax(limits, fabs(w->short_of[r]));
        for (int i = 0; i < n; i++) w->dual[i] += at->z[r] * row[i];
    }
    for (int i = 0; i < n; i++) slopes = fmax(slopes, fabs(w->dual[i]));
    w->level = dot(n, qp->a, at->x) - qp->b;
    return fmax(limits, fabs(w->level)) < LIMIT && slopes < SLOPE;
}

static bool prepare(const wf_qp *qp, const wf_qp_answer *at, work *w) {
    int n = qp->n;
    memcpy(w->k, qp->q, (size_t)n * (size_t)n * sizeof *w->k);
    for (int r = 0; r < qp->m; r++) add_square(w->k, n, qp->g + r * n, at->z[r] / w->s[r]);
    if (!factor(w->k, n)) return false;
    substitute(w->k, n, qp->a, w->along);
    return true;
}

/* Finds Newton's direction to where each slack times its multiplier has changed by -center;
 * returns the part of it that is y's. */
static double direct(const wf_qp *qp, const wf_qp_answer *at, work *w) {
    int n = qp->n;
    for (int i = 0; i < n; i++) w->right[i] = -w->dual[i];
    for (int r = 0; r < qp->m; r++) {
        double push = (at->z[r] * w->short_of[r] - w->center[r]) / w->s[r];
        for (int i = 0; i < n; i++) w->right[i] -= push * qp->g[r * n + i];
    }
    substitute(w->k, n, w->right, w->dx);
    double dy = (dot(n, qp->a, w->dx) + w->level) / dot(n, qp->a, w->along);
    for (int i = 0; i < n; i++) w->dx[i] -= dy * w->along[i];
    for (int r = 0; r < qp->m; r++) {
        w->ds[r] = -w->short_of[r] - dot(n, qp->g + r * n, w->dx);
        w->dz[r] = (-w->center[r] - at->z[r] * w->ds[r]) / w->s[r];
    }
    return dy;
}

/* How far values may go before one of them vanishes, 1 at most. */
static double way_to_go(int m, const double *value, const double *change) {
    double far = 1;
    for (int r = 0; r < m; r++)
        if (change[r] < 0) far = fmin(far, -value[r] / change[r]);
    return far;
}

static void step(const wf_qp *qp, wf_qp_answer *at, work *w) {
    int m = qp->m;
    double mean = dot(m, w->s, at->z) / m, reached = 0;
    for (int r = 0; r < m; r++) w->center[r] = w->s[r] * at->z[r];
    direct(qp, at, w);
    double primal = way_to_go(m, w->s, w->ds), dual = way_to_go(m, at->z, w->dz);
    for (int r = 0; r < m; r++)
        reached += (w->s[r] + primal * w->ds[r]) * (at->z[r] + dual * w->dz[r]) / m;
    double centering = pow(reached / mean, 3);
    for (int r = 0; r < m; r++) w->center[r] += w->ds[r] * w->dz[r] - centering * mean;
    double dy = direct(qp, at, w);
    double far = TO_BORDER * fmin(way_to_go(m, w->s, w->ds), way_to_go(m, at->z, w->dz));
    for (int i = 0; i < qp->n; i++) at->x[i] += far * w->dx[i];
    for (int r = 0; r < m; r++) w->s[r] += far * w->ds[r];
    for (int r = 0; r < m; r++) at->z[r] += far * w->dz[r];
    at->y += far * dy;
}

static bool iterate(const wf_qp *qp, wf_qp_answer *at, work *w) {
    for (int r = 0; r < qp->m; r++) w->s[r] = at->z[r] = 1;
    memset(at->x, 0, (size_t)qp->n * sizeof *at->x);
    at->y = 0;
    for (at->iterations = 0;; at->iterations++) {
        bool met = residuals(qp, at, w);
        at->gap = dot(qp->m, w->s, at->z);
        if (met && at->gap < GAP) return true;
        if (at->iterations == MOST_STEPS || !prepare(qp, at, w))
            return met && at->gap < FAIR_GAP;
        step(qp, at, w);
    }
}

wf_qp_end wf_qp_solve(const wf_qp *qp, wf_qp_answer *answer) {
    work w;
    if (!make_work(&w, qp->n, qp->m)) return WF_QP_NO_MEMORY;
    bool solved = iterate(qp, answer, &w);
    free(w.k);
    return solved ? WF_QP_SOLVED : WF_QP_STUCK;
}
