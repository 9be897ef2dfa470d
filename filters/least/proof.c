/* The proof that a column is the nearest: what its multipliers show, and what rounding left of
 * them put right. */
#include "filters/least/segments.h"

#include <math.h>

enum { WIDTH = WF_LEAST_COLUMNS };

wf_least_claim wf_least_claim_of(const wf_least *least, const wf_least_scratch *s) {
    return (wf_least_claim){.s = s->s,
                            .l = s->l,
                            .tension = s->tension,
                            .press = s->press,
                            .lines = least->desc.lines,
                            .weight = least->desc.weight,
                            .most = least->desc.most,
                            .limit = s->limit,
                            .limit_step = s->limit_step};
}

void wf_least_judge(const wf_least *least, const wf_least_scratch *s, double *excess,
                    double *gap) {
    const wf_least_claim claim = wf_least_claim_of(least, s);
    least->ops->look(&claim, excess);
    least->ops->prove(&claim, gap);
    for (int i = 0; i < WIDTH; i++) gap[i] /= s->scale[i] * s->scale[i];
}

/* ---- Settling ---- */

/* Of a bound that is met: larger than what the interior point leaves of one that is not. */
#define MET 1e-6

/* What is left of the gradient at line j; where a bound of L is met its multiplier takes it up.
 */
static double rest_at(const wf_least *least, wf_least_scratch *s, int column, int j) {
    int lines = least->desc.lines, at = j * WIDTH + column;
    double rest = s->l[at] - s->s[at] + s->press[at];
    for (int k = j ? j - 1 : 0; k <= j + 1 && k < lines; k++)
        rest += wf_least_b(lines, k, j) *
                (least->desc.weight * wf_least_flicker(least, s->l + column, k) +
                 s->tension[k * WIDTH + column]);
    bool met = fabs(s->press[at]) > MET && (s->press[at] - rest) * s->press[at] > 0;
    if (met) s->press[at] -= rest;
    return met ? 0 : rest;
}

static bool is_met(const wf_least_scratch *s, int column, int lines, int j) {
    return j >= 0 && j < lines && fabs(s->tension[j * WIDTH + column]) > MET;
}

/* Row j of B B' where both bounds are met. */
static double product(const wf_least_scratch *s, int column, int lines, int j, int k) {
    double sum = 0;
    if (!is_met(s, column, lines, j) || !is_met(s, column, lines, k)) return 0;
    for (int m = j - 1; m <= j + 1; m++)
        if (m >= 0 && m < lines) sum += wf_least_b(lines, j, m) * wf_least_b(lines, k, m);
    return sum;
}

/* Least squares: B B' d = B rest, of the lines whose bounds are met, by F D F'. */
void wf_least_settle(const wf_least *least, wf_least_scratch *s, int column) {
    int lines = least->desc.lines;
    double *rest = s->settling, *d = rest + lines, *f1 = d + lines, *f2 = f1 + lines,
           *pivot = f2 + lines;
    for (int j = 0; j < lines; j++) rest[j] = rest_at(least, s, column, j);
    for (int j = 0; j < lines; j++) {
        bool met = is_met(s, column, lines, j);
        double h2 = j > 1 ? product(s, column, lines, j, j - 2) : 0;
        double h1 = j ? product(s, column, lines, j, j - 1) - (j > 1 ? h2 * f1[j - 1] : 0) : 0;
        f2[j] = j > 1 ? h2 / pivot[j - 2] : 0;
        f1[j] = j ? h1 / pivot[j - 1] : 0;
        pivot[j] = met ? product(s, column, lines, j, j) - f1[j] * h1 - f2[j] * h2 : 1;
        pivot[j] = fmax(pivot[j], 1e-12);
        d[j] = 0;
        for (int m = j ? j - 1 : 0; met && m <= j + 1 && m < lines; m++)
            d[j] -= wf_least_b(lines, j, m) * rest[m];
        d[j] -= (j ? f1[j] * d[j - 1] : 0) + (j > 1 ? f2[j] * d[j - 2] : 0);
    }
    for (int j = lines - 1; j >= 0; j--) {
        d[j] /= pivot[j];
        if (j + 1 < lines) d[j] -= f1[j + 1] * d[j + 1];
        if (j + 2 < lines) d[j] -= f2[j + 2] * d[j + 2];
        s->tension[j * WIDTH + column] += is_met(s, column, lines, j) ? d[j] : 0;
    }
}
