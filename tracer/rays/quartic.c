/* Where a quartic is below 0, for rays through a torus. */
#include "tracer/rays/quartic.h"

#include <math.h>
#include <stdbool.h>

static double value(const double *q, int degree, double t) {
    double sum = q[degree];
    for (int k = degree; k-- > 0;) sum = sum * t + q[k];
    return sum;
}

static double slope(const double *q, int degree, double t) {
    double sum = q[degree] * degree;
    for (int k = degree; k-- > 1;) sum = sum * t + q[k] * k;
    return sum;
}

/* The root between two points of opposite signs: Newton's step where it stays between, else the
 * middle. Ends when the bracket cannot get smaller. */
static double bracketed(const double *q, int degree, double low, double high) {
    bool rises = value(q, degree, low) < 0;
    double t = low + (high - low) / 2;
    for (int step = 0; step < 100; step++) {
        double f = value(q, degree, t);
        if (f == 0) return t;
        if ((f < 0) == rises)
            low = t;
        else
            high = t;
        double next = t - f / slope(q, degree, t);
        if (!(next > low && next < high)) next = low + (high - low) / 2;
        if (next == t || next <= low || next >= high) return t;
        t = next;
    }
    return t;
}

/* Roots of q in from < t < to, ascending: one at most between neighboring roots of its
 * derivative. */
static int roots_of(const double *q, int degree, double from, double to, double *root) {
    double derivative[4], turn[6];
    int count = 0, stretches;
    if (degree < 1) return 0;
    for (int k = 1; k <= degree; k++) derivative[k - 1] = q[k] * k;
    turn[0] = from;
    stretches = 1 + roots_of(derivative, degree - 1, from, to, turn + 1);
    turn[stretches] = to;
    for (int k = 0; k < stretches; k++) {
        double a = value(q, degree, turn[k]), b = value(q, degree, turn[k + 1]);
        if ((a < 0) != (b < 0)) root[count++] = bracketed(q, degree, turn[k], turn[k + 1]);
    }
    return count;
}

int wf_quartic_runs(const double q[5], double from, double to, double end[4]) {
    double root[6], edge[8];
    int count = 0, runs = 0;
    int found = roots_of(q, 4, from, to, root);
    if (value(q, 4, from) < 0) edge[count++] = from;
    for (int k = 0; k < found; k++) edge[count++] = root[k];
    if (count % 2) edge[count++] = to;
    for (int k = 0; k + 1 < count && runs < 2; k += 2, runs++) {
        end[2 * runs] = edge[k];
        end[2 * runs + 1] = edge[k + 1];
    }
    return runs;
}
