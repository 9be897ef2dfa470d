/* The inner loops of the nearest picture: recursions down columns, eight or more side by side,
 * and the interior point method of segments of columns, one in each lane. */
#include "filters/least/pack.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "filters/base/isa_file.h"

/* Every lane is computed by itself, so that all levels give the same bits. */
typedef double lanes __attribute__((vector_size(8 * WF_LEAST_LANES), may_alias, aligned(8)));
typedef int64_t mask __attribute__((vector_size(8 * WF_LEAST_LANES)));

#pragma GCC diagnostic ignored "-Wpsabi"

/* ---- Columns of a tile ---- */

static void subtract_rows(double *restrict x, const double *restrict one,
                          const double *restrict two, double f1, double f2) {
    for (int i = 0; i < WF_LEAST_COLUMNS; i++) x[i] = x[i] - f1 * one[i] - f2 * two[i];
}

static void smooth(const wf_least_factor *f, double *x) {
    const int width = WF_LEAST_COLUMNS;
    const double zeros[WF_LEAST_COLUMNS] = {0};
    for (int j = 1; j < f->lines; j++)
        subtract_rows(x + j * width, x + (j - 1) * width, j > 1 ? x + (j - 2) * width : zeros,
                      f->f1[j], f->f2[j]);
    for (int j = f->lines - 1; j >= 0; j--) {
        double *row = x + j * width;
        bool one = j + 1 < f->lines, two = j + 2 < f->lines;
        for (int i = 0; i < width; i++) row[i] *= f->inverse[j];
        if (one)
            subtract_rows(row, row + width, two ? row + 2 * width : zeros, f->f1[j + 1],
                          two ? f->f2[j + 2] : 0);
    }
}

static void look(const wf_least_claim *c, double *excess) {
    const int width = WF_LEAST_COLUMNS;
    for (int i = 0; i < width; i++) excess[i] = -HUGE_VAL;
    for (int j = 0; j < c->lines; j++) {
        const double *row = c->l + j * width, *above = j ? row - width : row + width;
        const double *below = j < c->lines - 1 ? row + width : row - width;
        const double *limit = c->limit + j * c->limit_step;
        for (int i = 0; i < width; i++) {
            double b = 0.5 * row[i] - 0.25 * (above[i] + below[i]);
            double over = fabs(b) - limit[i], high = row[i] - c->most, low = -row[i];
            over = over > high ? over : high;
            over = over > low ? over : low;
            excess[i] = excess[i] > over ? excess[i] : over;
        }
    }
}

/* What a line's flicker pulls with, its weight's and its bound's share. */
static void pull_of(const wf_least_claim *c, int j, double *restrict y) {
    const int width = WF_LEAST_COLUMNS;
    const double *row = c->l + j * width, *tension = c->tension + j * width;
    const double *above = j ? row - width : row + width;
    const double *below = j < c->lines - 1 ? row + width : row - width;
    for (int i = 0; i < width; i++)
        y[i] = tension[i] + c->weight * (0.5 * row[i] - 0.25 * (above[i] + below[i]));
}

/* Slack times multiplier of a line, b's and the bounds'. */
static void add_slacks(const wf_least_claim *c, int j, double *restrict gap) {
    const int width = WF_LEAST_COLUMNS;
    const double *row = c->l + j * width, *tension = c->tension + j * width;
    const double *press = c->press + j * width;
    const double *above = j ? row - width : row + width;
    const double *below = j < c->lines - 1 ? row + width : row - width;
    const double *limit = c->limit + j * c->limit_step;
    const double most = c->most < 1e300 ? c->most : 0;
    for (int i = 0; i < width; i++) {
        double b = 0.5 * row[i] - 0.25 * (above[i] + below[i]);
        double room = press[i] > 0 ? most - row[i] : -row[i];
        gap[i] += 2 * (limit[i] * fabs(tension[i]) - tension[i] * b + press[i] * room);
    }
}

static void prove(const wf_least_claim *c, double *gap) {
    enum { WIDE = WF_LEAST_COLUMNS };
    double y[3][WIDE] = {{0}};
    for (int i = 0; i < WIDE; i++) gap[i] = 0;
    pull_of(c, 0, y[1]);
    for (int j = 0; j < c->lines; j++) {
        double *before = y[j % 3], *at = y[(j + 1) % 3], *after = y[(j + 2) % 3];
        double up = j == 1 ? -0.5 : -0.25, down = j + 2 == c->lines ? -0.5 : -0.25;
        const double *l = c->l + j * WIDE, *s = c->s + j * WIDE, *press = c->press + j * WIDE;
        if (j + 1 < c->lines) pull_of(c, j + 1, after);
        for (int i = 0; i < WIDE && j + 1 == c->lines; i++) after[i] = 0;
        for (int i = 0; i < WIDE; i++) {
            double rest = l[i] - s[i] + press[i] + 0.5 * at[i];
            rest += up * before[i] + down * after[i];
            gap[i] += rest * rest;
        }
        add_slacks(c, j, gap);
    }
}

/* ---- Lanes ---- */

static inline lanes all(double x) {
    return x - (lanes){0};
}

static inline lanes choose(mask where, lanes a, lanes b) {
    return (lanes)(((mask)a & where) | ((mask)b & ~where));
}

static inline lanes larger(lanes a, lanes b) {
    return choose(a > b, a, b);
}

static inline lanes lanes_at(const double *from) {
    lanes x;
    memcpy(&x, from, sizeof x);
    return x;
}

/* The arrays of a pack as rows of lanes. */
typedef struct view {
    int rows;
    lanes most;
    const lanes *base, *m0, *m1, *m2, *above, *below, *bound, *own, *limit;
    lanes *l, *z[4], *s[4], *best[5], *inverse[4], *w, *w_box, *f1, *f2, *pivot, *force,
        *tension, *step_0, *step, *dz[4];
} view;

static lanes *rows_of(const wf_least_pack *pack, int array) {
    return (lanes *)(void *)wf_least_rows(pack, array);
}

static view view_of(const wf_least_pack *p) {
    view v = {.rows = p->rows,
              .most = lanes_at(p->most),
              .base = rows_of(p, WF_LEAST_BASE),
              .m0 = rows_of(p, WF_LEAST_M0),
              .m1 = rows_of(p, WF_LEAST_M1),
              .m2 = rows_of(p, WF_LEAST_M2),
              .above = rows_of(p, WF_LEAST_ABOVE),
              .below = rows_of(p, WF_LEAST_BELOW),
              .bound = rows_of(p, WF_LEAST_BOUND),
              .own = rows_of(p, WF_LEAST_OWN),
              .limit = rows_of(p, WF_LEAST_LIMIT),
              .l = rows_of(p, WF_LEAST_L),
              .w = rows_of(p, WF_LEAST_W),
              .w_box = rows_of(p, WF_LEAST_W_BOX),
              .f1 = rows_of(p, WF_LEAST_F1),
              .f2 = rows_of(p, WF_LEAST_F2),
              .pivot = rows_of(p, WF_LEAST_PIVOT),
              .force = rows_of(p, WF_LEAST_FORCE),
              .tension = rows_of(p, WF_LEAST_TENSION),
              .step_0 = rows_of(p, WF_LEAST_STEP_0),
              .step = rows_of(p, WF_LEAST_STEP)};
    for (int i = 0; i < 5; i++) v.best[i] = rows_of(p, WF_LEAST_BEST + i);
    for (int i = 0; i < 4; i++) {
        v.z[i] = rows_of(p, WF_LEAST_Z + i);
        v.s[i] = rows_of(p, WF_LEAST_S + i);
        v.inverse[i] = rows_of(p, WF_LEAST_INVERSE + i);
        v.dz[i] = rows_of(p, WF_LEAST_DZ + i);
    }
    return v;
}

/* ---- The interior point ---- */

/* Row j of B times x, where b counts. */
static inline lanes flicker(const view *v, const lanes *x, int j) {
    return v->bound[j] * (v->above[j] * x[j - 1] + 0.5 * x[j] + v->below[j] * x[j + 1]);
}

/* Row j of B' times t, which is 0 where b does not count. */
static inline lanes pull(const view *v, const lanes *t, int j) {
    return v->below[j - 1] * t[j - 1] + 0.5 * t[j] + v->above[j + 1] * t[j + 1];
}

static inline lanes form(const view *v, int j) {
    lanes sum = v->m0[j] * (v->l[j] - v->base[j]);
    sum += v->m1[j] * (v->l[j + 1] - v->base[j + 1]);
    sum += v->m1[j - 1] * (v->l[j - 1] - v->base[j - 1]);
    sum += v->m2[j] * (v->l[j + 2] - v->base[j + 2]);
    return sum + v->m2[j - 2] * (v->l[j - 2] - v->base[j - 2]);
}

/* Vectors are passed between functions that are inlined, and made for each number of kinds. */
#define ALWAYS_INLINE static inline __attribute__((always_inline))

/* How many kinds of bounds count: those of b, or of L too. Functions are made for both. */
enum { UNBOXED = 2, BOXED = 4 };

/* Slacks as they are at first. Later each is multiplied by what it grows by, since the
 * difference of a limit and b would soon be rounding alone. */
ALWAYS_INLINE void begin_slacks(const view *v, int kinds) {
    for (int j = 0; j < v->rows; j++) {
        lanes b = flicker(v, v->l, j);
        v->s[0][j] = v->limit[j] - b;
        v->s[1][j] = v->limit[j] + b;
        if (kinds < BOXED) continue;
        v->s[2][j] = v->l[j];
        v->s[3][j] = v->most - v->l[j];
    }
}

/* 1 / a and 1 / b by one division. */
static inline void invert(lanes a, lanes b, lanes *ia, lanes *ib) {
    lanes both = 1.0 / (a * b);
    *ia = b * both;
    *ib = a * both;
}

/* Slacks inverted, weights of both kinds; returns the sum of slack times multiplier. */
ALWAYS_INLINE lanes weigh(const view *v, int kinds) {
    lanes sum = all(0);
    for (int j = 0; j < v->rows; j++) {
        invert(v->s[0][j], v->s[1][j], &v->inverse[0][j], &v->inverse[1][j]);
        v->w[j] = v->bound[j] * (v->z[0][j] * v->inverse[0][j] + v->z[1][j] * v->inverse[1][j]);
        sum += v->bound[j] * (v->s[0][j] * v->z[0][j] + v->s[1][j] * v->z[1][j]);
        v->tension[j] = v->bound[j] * (v->z[0][j] - v->z[1][j]);
        if (kinds < BOXED) continue;
        invert(v->s[2][j], v->s[3][j], &v->inverse[2][j], &v->inverse[3][j]);
        v->w_box[j] = v->z[2][j] * v->inverse[2][j] + v->z[3][j] * v->inverse[3][j];
        sum += v->own[j] * (v->s[2][j] * v->z[2][j] + v->s[3][j] * v->z[3][j]);
    }
    return sum;
}

/* The gradient; returns the sum of the Lagrangian's, squared. */
ALWAYS_INLINE lanes gradient(const view *v, int kinds) {
    lanes sum = all(0);
    for (int j = 0; j < v->rows; j++) {
        v->force[j] = form(v, j);
        lanes rest = v->force[j] + pull(v, v->tension, j);
        if (kinds == BOXED) rest += v->z[3][j] - v->z[2][j];
        sum += v->own[j] * rest * rest;
    }
    return sum;
}

/* Row j of the step's matrix times what comes before it: F of F D F'. */
ALWAYS_INLINE void factor_row(const view *v, int kinds, int j) {
    lanes h0 = v->m0[j] + 0.25 * v->w[j];
    if (kinds == BOXED) h0 += v->w_box[j];
    h0 += v->above[j + 1] * v->above[j + 1] * v->w[j + 1];
    h0 += v->below[j - 1] * v->below[j - 1] * v->w[j - 1];
    lanes h1 = v->m1[j - 1] + 0.5 * (v->below[j - 1] * v->w[j - 1] + v->above[j] * v->w[j]);
    lanes h2 = v->m2[j - 2] + v->above[j - 1] * v->below[j - 1] * v->w[j - 1];
    lanes rest = h1 - h2 * v->f1[j - 1];
    v->f2[j] = h2 * v->pivot[j - 2];
    v->f1[j] = rest * v->pivot[j - 1];
    v->pivot[j] = 1.0 / (h0 - v->f1[j] * rest - v->f2[j] * h2);
}

static inline void forward(const view *v, lanes *x, int j, lanes right) {
    x[j] = right - v->f1[j] * x[j - 1] - v->f2[j] * x[j - 2];
}

static void backward(const view *v, lanes *x) {
    for (int j = v->rows - 1; j >= 0; j--)
        x[j] = x[j] * v->pivot[j] - v->f1[j + 1] * x[j + 1] - v->f2[j + 2] * x[j + 2];
}

ALWAYS_INLINE void predict(const view *v, int kinds) {
    for (int j = 0; j < v->rows; j++) {
        factor_row(v, kinds, j);
        forward(v, v->step_0, j, -v->force[j]);
    }
    backward(v, v->step_0);
}

/* How slacks change, by their sizes. */
ALWAYS_INLINE void ratios(const view *v, int kinds, const lanes *step, int j, lanes x[4]) {
    lanes b = flicker(v, step, j), l = v->own[j] * step[j];
    x[0] = -b * v->inverse[0][j];
    x[1] = b * v->inverse[1][j];
    if (kinds < BOXED) return;
    x[2] = l * v->inverse[2][j];
    x[3] = -l * v->inverse[3][j];
}

static inline lanes counts(const view *v, int i, int j) {
    return i < 2 ? v->bound[j] : v->own[j];
}

/* What the sum of slack times multiplier would be after the longest predicted step, over what
 * it is. Multipliers fall by 1 + x of themselves where slacks grow by x. */
ALWAYS_INLINE lanes predicted(const view *v, int kinds, lanes sum) {
    lanes most = all(1), curve = all(0);
    for (int j = 0; j < v->rows; j++) {
        lanes x[4];
        ratios(v, kinds, v->step_0, j, x);
        for (int i = 0; i < kinds; i++) {
            most = larger(most, larger(-x[i], 1.0 + x[i]));
            curve += counts(v, i, j) * (v->s[i][j] * v->z[i][j]) * (x[i] + x[i] * x[i]);
        }
    }
    lanes length = 1.0 / most;
    return (1.0 - length) - length * length * curve / sum;
}

/* What the product of slack and multiplier is to become, over the slack. */
ALWAYS_INLINE void targets(const view *v, int kinds, lanes aim, int j, lanes t[4]) {
    lanes x[4];
    ratios(v, kinds, v->step_0, j, x);
    for (int i = 0; i < kinds; i++)
        t[i] = counts(v, i, j) * (aim * v->inverse[i][j] + v->z[i][j] * (x[i] + x[i] * x[i]));
}

ALWAYS_INLINE void correct(const view *v, int kinds, lanes aim) {
    for (int j = 0; j < v->rows; j++) {
        lanes t[4];
        targets(v, kinds, aim, j, t);
        v->tension[j] = t[0] - t[1];
        if (kinds == BOXED) v->force[j] += t[3] - t[2];
        for (int i = 0; i < kinds; i++) v->dz[i][j] = t[i];
    }
    for (int j = 0; j < v->rows; j++)
        forward(v, v->step, j, -v->force[j] - pull(v, v->tension, j));
    backward(v, v->step);
}

/* The longest step, by which no slack or multiplier falls below 0, inverted. */
ALWAYS_INLINE lanes steepest(const view *v, int kinds) {
    lanes most = all(1e-300);
    for (int j = 0; j < v->rows; j++) {
        lanes x[4], iz[4];
        ratios(v, kinds, v->step, j, x);
        invert(v->z[0][j], v->z[1][j], &iz[0], &iz[1]);
        if (kinds == BOXED) invert(v->z[2][j], v->z[3][j], &iz[2], &iz[3]);
        for (int i = 0; i < kinds; i++) {
            lanes dz = counts(v, i, j) * (v->dz[i][j] - v->z[i][j] * (1.0 + x[i]));
            v->dz[i][j] = dz;
            most = larger(most, larger(-x[i], -dz * iz[i]));
        }
    }
    return most;
}

ALWAYS_INLINE void move(const view *v, int kinds, lanes length) {
    for (int j = 0; j < v->rows; j++) {
        lanes x[4];
        ratios(v, kinds, v->step, j, x);
        v->l[j] += length * v->own[j] * v->step[j];
        for (int i = 0; i < kinds; i++) {
            v->s[i][j] += v->s[i][j] * (length * x[i]);
            v->z[i][j] += length * v->dz[i][j];
        }
    }
}

ALWAYS_INLINE lanes count_bounds(const view *v, int kinds) {
    lanes count = all(0);
    for (int j = 0; j < v->rows; j++) {
        count += 2.0 * v->bound[j];
        if (kinds == BOXED) count += 2.0 * v->own[j];
    }
    return larger(count, all(1));
}

/* Steps go so far towards the nearest bound. */
#define NEARLY 0.995

static bool any(mask m) {
    int64_t found = 0;
    for (int i = 0; i < WF_LEAST_LANES; i++) found |= m[i];
    return found != 0;
}

/* The last steps may lose to rounding what they gain: what was best is kept. */
ALWAYS_INLINE void keep(const view *v, int kinds, mask where) {
    for (int j = 0; j < v->rows; j++) {
        v->best[4][j] = choose(where, v->l[j], v->best[4][j]);
        for (int i = 0; i < kinds; i++)
            v->best[i][j] = choose(where, v->z[i][j], v->best[i][j]);
    }
}

ALWAYS_INLINE void take_best(const view *v, int kinds) {
    size_t bytes = (size_t)v->rows * sizeof(lanes);
    memcpy(v->l, v->best[4], bytes);
    for (int i = 0; i < kinds; i++) memcpy(v->z[i], v->best[i], bytes);
}

/* Towards a share of the mean product of slack and multiplier, by Mehrotra's rule. */
ALWAYS_INLINE void step(const view *v, int kinds, lanes gap, lanes count, mask open) {
    predict(v, kinds);
    lanes share = larger(predicted(v, kinds, gap), all(1e-6));
    correct(v, kinds, share * share * share * gap / count);
    lanes most = steepest(v, kinds), length = choose(most > all(NEARLY), NEARLY / most, all(1));
    move(v, kinds, choose(open & (most == most), length, all(0)));
}

/* Mehrotra's predictor and corrector (SIAM J. Optimization 2, 1992), L always within bounds. A
 * lane that is done, or gains nothing more, stands still. */
ALWAYS_INLINE int solve_kinds(wf_least_pack *pack, int kinds) {
    const view v = view_of(pack);
    const lanes tolerance = lanes_at(pack->tolerance), count = count_bounds(&v, kinds);
    lanes best = all(HUGE_VAL);
    mask open = best == best;
    int steps = 0;
    begin_slacks(&v, kinds);
    while (true) {
        lanes gap = weigh(&v, kinds), total = 2.0 * gap + gradient(&v, kinds);
        mask better = open & (total < best);
        if (steps == 0 || any(better & (total < 1e3 * tolerance))) keep(&v, kinds, better);
        best = choose(better, total, best);
        open &= (total > tolerance) & (better | (best > 10.0 * tolerance));
        if (!any(open) || steps == WF_LEAST_STEPS) break;
        step(&v, kinds, gap, count, open);
        steps++;
    }
    take_best(&v, kinds);
    return steps;
}

static int solve(wf_least_pack *pack) {
    return pack->boxed ? solve_kinds(pack, BOXED) : solve_kinds(pack, UNBOXED);
}

const wf_least_ops WF_ISA_TABLE(wf_least_ops) = {smooth, look, prove, solve};
