/* How wrong cells may be, pooled over those about them. A cell's quarters say too little alone:
 * what all of them missed is worth nothing to them. What its neighbors saw does not depend on
 * its own luck, so that stopping by it leaves its mean unbiased. */
#include "tracer/sample/adaptive_pool.h"

#include <math.h>
#include <stdlib.h>

/* Errors fall as a power of the number of samples: by 1 where samples are scattered, by 1.5 on
 * straight edges that stand still; until a tile has told, and as many cells as that say it. */
#define LEAST_FALL 1.0
#define FIRST_FALL 1.15
#define MOST_FALL  1.6
#define FALL_CELLS 8

/* What counts, in the mean over 5 x 5 cells, of those not beside it; the largest of pairs to
 * both sides, and of the cell itself: a few samples' variance is as likely half of the truth as
 * twice. */
#define OF_FAR  0.3
#define OF_PAIR 0.5
#define OF_OWN  0.25

/* From so many samples of a quarter on a cell may be plain, if they vary by less than this part
 * of what others say; then what N of them miss is about this over N N, of that. */
#define PLAIN_EACH 8
#define PLAIN      0.02
#define MISSED     4

/* The square of what N points are off in the part of a cell that an edge cuts off is about this
 * over N sqrt(N), of the variance of what is cut. */
#define CUT 0.5

/* Variances of means of a half and of a quarter of a cell's samples beyond those of twice as
 * many; display-encoded, over R, G, B. */
typedef struct gains {
    double half, quarter;
} gains;

static double mean_of(const wf_adaptive_cell *c, int quarter, int k) {
    return c->sum[quarter][k] / c->each;
}

/* V(N/2) - V(N) is the mean of (a - b)^2 / 4 over halves a, b: exact, however the samples
 * depend on each other. So is V(N/4) - V(N/2) of each half's quarters. */
static gains gains_of(const wf_adaptive_cell *c) {
    gains g = {0, 0};
    for (int k = 0; k < 3; k++) {
        double a = mean_of(c, 0, k), b = mean_of(c, 1, k), d = mean_of(c, 2, k),
               e = mean_of(c, 3, k), steep = c->steep[k] * c->steep[k] / 3;
        double halves = (a + b - d - e) / 2;
        g.half += halves * halves / 4 * steep;
        g.quarter += ((a - b) * (a - b) + (d - e) * (d - e)) / 8 * steep;
    }
    return g;
}

/* ---- Fall ---- */

static void find_fall(wf_adaptive *a, const gains *all) {
    double half = 0, quarter = 0, square = 0, total;
    for (int at = 0; at < GRID_CELLS; at++) {
        if (!a->cell[at].own) continue;
        double one = all[at].half + all[at].quarter;
        half += all[at].half;
        quarter += all[at].quarter;
        square += one * one;
    }
    total = half + quarter;
    double cells = square > 0 ? total * total / square : 0;
    double share = half > 0 ? fmin(quarter / half, 8) : cells > 0 ? 8 : 0;
    double fall = (share * cells + FALL_CELLS * exp2(FIRST_FALL)) / (cells + FALL_CELLS);
    a->fall = fmin(fmax(log2(fall), LEAST_FALL), MOST_FALL);
}

/* ---- Steepness ---- */

/* What an output pixel may show, which mixes cells. */
static void mix(const wf_adaptive *a, int at, double rgb[3]) {
    bool wide =
        a->s->desc.gather.aperture.half_u > 0.5 || a->s->desc.gather.aperture.kind->couples_uv;
    double sum[3] = {0}, weight = 0;
    for (int down = -1; down <= 1; down++)
        for (int right = -wide; right <= wide; right++) {
            const wf_adaptive_cell *c = wf_cell_beside(a, at, right, down);
            double share = (down ? 1 : 2) * (right ? 1 : 2);
            if (!c) continue;
            for (int k = 0; k < 3; k++) sum[k] += share * c->mean[k];
            weight += share;
        }
    for (int k = 0; k < 3; k++) rgb[k] = sum[k] / weight;
}

/* Cells have powers of two of samples, up to WF_MOST_SAMPLES. */
#define MOST_POWERS 16

/* Of each cell, one sample: squared, on the display. */
typedef struct pool {
    const wf_adaptive *a;
    double one[GRID_CELLS];     /* what it would be off, so that N are off 1 / N^fall of that */
    double within[GRID_CELLS];  /* how far it lies from the mean */
    double cut[GRID_CELLS];     /* what it would be off in what an aperture's edge cuts off */
    double fallen[MOST_POWERS]; /* what so many samples leave of it: of 2^n */
} pool;

/* How far one sample of a cell lies from their mean; squared, on the display. */
static double within(const wf_adaptive_cell *c) {
    double count = WF_QUARTERS * c->each, all = 0;
    for (int k = 0; k < 3; k++) {
        double sum = 0;
        for (int quarter = 0; quarter < WF_QUARTERS; quarter++) sum += c->sum[quarter][k];
        double square = c->square[k] / count - sum * sum / (count * count);
        all += fmax(square, 0) * c->steep[k] * c->steep[k] / 3;
    }
    return all;
}

/* How far a cell lies from what the pixel shows. */
static double beyond(const wf_adaptive_cell *c, const double mixed[3]) {
    double all = 0;
    for (int k = 0; k < 3; k++) {
        double apart = (c->mean[k] - mixed[k]) * c->steep[k];
        all += apart * apart / 3;
    }
    return all;
}

/* Where an aperture's edge cuts cells, it sees a part of a cell's samples that is not quite its
 * part of the cell: what is off is how far they lie from their mean, where that is weighed
 * exactly, or else from what the pixel shows. */
static double cut_of(const wf_adaptive *a, const pool *p, int at, const double mixed[3]) {
    if (!wf_cuts_cells(a->s)) return 0;
    return p->within[at] + (wf_cells_are_weighed(a->s) ? 0 : beyond(&a->cell[at], mixed));
}

/* ---- Pools ---- */

/* That of a cell beside another; < 0: there is none. Of those about the tile it is told by too
 * few samples to count. */
static double beside(const pool *p, int at, int right, int down) {
    const wf_adaptive_cell *c = wf_cell_beside(p->a, at, right, down);
    if (!c || (!c->own && p->a->cell[at].own)) return -1;
    return c->rare && !p->a->cell[at].rare ? -1 : p->one[c - p->a->cell];
}

/* Of edges that come in from cells beside and were not found here: what those saw without them.
 */
static double largest_hidden(const pool *p, int at) {
    double most = 0;
    for (int down = -1; down <= 1 && !p->a->edge[at].found; down++)
        for (int right = -1; right <= 1; right++) {
            const wf_adaptive_cell *c = wf_cell_beside(p->a, at, right, down);
            if (c && wf_edge_coming(p->a, at, right, down)) most = fmax(most, c->one);
        }
    return most;
}

/* Without the cell itself: stopping by what a cell's own samples say would bias its mean. */
static double mean_about(const pool *p, int at) {
    double sum = 0, weight = 0;
    for (int down = -2; down <= 2; down++)
        for (int right = -2; right <= 2; right++) {
            double one = beside(p, at, right, down);
            double share = abs(down) > 1 || abs(right) > 1 ? OF_FAR : 1;
            if (one < 0 || (!down && !right)) continue;
            sum += share * one;
            weight += share;
        }
    return weight > 0 ? sum / weight : 0;
}

static double largest_pair(const pool *p, int at) {
    static const int way[4][2] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}};
    double most = 0;
    for (int n = 0; n < 4; n++) {
        double a = beside(p, at, way[n][0], way[n][1]);
        double b = beside(p, at, -way[n][0], -way[n][1]);
        if (a >= 0 && b >= 0) most = fmax(most, (a + b) / 2);
    }
    return most;
}

/* Of the tile's pixels this share may be off by more than the error asked for: the fewer of
 * them are uncertain at all, the more may these be. */
#define OUTSIDE 0.006

/* A cell counts as uncertain from this part of the most that it may be off; squared. */
#define UNCERTAIN 0.3

/* The deviation beyond which a share p of normal errors lies is about sqrt(-2 ln p) - 0.44. */
static double caution_for(double uncertain) {
    double share = OUTSIDE / fmax(uncertain, 0.05);
    return 1 / (sqrt(-2 * log(share)) - 0.44);
}

static void find_caution(wf_adaptive *a) {
    double most = a->s->desc.error * caution_for(0), own = 0, uncertain = 0;
    for (int at = 0; at < GRID_CELLS; at++) {
        const wf_adaptive_cell *c = &a->cell[at];
        if (!c->own) continue;
        own++;
        uncertain += c->need > UNCERTAIN * most * most;
    }
    a->caution = caution_for(uncertain / own);
}

static double fallen(const pool *p, const wf_adaptive_cell *c) {
    return p->fallen[ilogb(WF_QUARTERS * c->each)];
}

/* V(N/4) - V(N) is the sum of both gains; what is left of it follows from the fall. */
static void find_ones(wf_adaptive *a, pool *p) {
    gains all[GRID_CELLS];
    double mixed[3];
    for (int at = 0; at < GRID_CELLS; at++) {
        if (!a->cell[at].there) continue;
        mix(a, at, mixed);
        for (int k = 0; k < 3; k++) a->cell[at].steep[k] = wf_display_steepness(mixed[k]);
        all[at] = gains_of(&a->cell[at]);
        p->within[at] = within(&a->cell[at]);
        p->cut[at] = cut_of(a, p, at, mixed);
    }
    find_fall(a, all);
    for (int n = 0; n < MOST_POWERS; n++) p->fallen[n] = exp2(-a->fall * n);
    double beyond_all = exp2(2 * a->fall) - 1;
    for (int at = 0; at < GRID_CELLS; at++) {
        if (!a->cell[at].there) continue;
        p->one[at] = (all[at].half + all[at].quarter) / (beyond_all * fallen(p, &a->cell[at]));
        if (!a->edge[at].found) a->cell[at].one = p->one[at];
    }
}

/* Whether an edge was found nearby: what others see is long, not scattered. */
static bool has_edge_near(const wf_adaptive *a, int at) {
    for (int down = -2; down <= 2; down++)
        for (int right = -2; right <= 2; right++) {
            const wf_adaptive_cell *c = wf_cell_beside(a, at, right, down);
            if (c && a->edge[c - a->cell].found) return true;
        }
    return false;
}

/* Whether a cell's samples are alike where others see an edge, and so many that what they miss
 * is hardly more than the share of one. */
static bool is_plain(const pool *p, int at, double one) {
    return p->a->cell[at].each >= PLAIN_EACH && p->within[at] < PLAIN * one &&
           has_edge_near(p->a, at);
}

/* Cells about the tile are hardly in any pool, and what they say biases nothing; rare ones are
 * sampled again. */
static double need_of(const pool *p, int at) {
    const wf_adaptive *a = p->a;
    double count = WF_QUARTERS * a->cell[at].each;
    double own = a->cell[at].own && !a->cell[at].rare ? OF_OWN : 1;
    double one = fmax(mean_about(p, at), fmax(OF_PAIR * largest_pair(p, at), own * p->one[at]));
    double missed = largest_hidden(p, at) / (2 * count * count);
    double seen =
        is_plain(p, at, one) ? MISSED * one / (count * count) : one * fallen(p, &a->cell[at]);
    double cut = CUT * p->cut[at] / (count * sqrt(count));
    return fmax(fmax(seen, missed), cut) * wf_adaptive_share(a);
}

/* So many samples leave the least error over all if the square of each cell's goes with the
 * root of what one sample of it is off, and the fewest pixels far off if all are alike. Between
 * them, with this power, from so little on and up to so much. */
#define SPREAD        0.3
#define LEAST_ALLOWED 0.25
#define MOST_ALLOWED  1.2

/* From this part of the error that cells may have they count here; squared. */
#define COUNTS 1e-4

static void find_allowed(const pool *p, wf_adaptive *a) {
    double sum = 0, count = 0;
    for (int at = 0; at < GRID_CELLS; at++) {
        wf_adaptive_cell *c = &a->cell[at];
        c->allowed = c->need > 0 && c->own ? pow(c->need / fallen(p, c), SPREAD) : 0;
        if (!c->own || !(c->need > COUNTS * wf_adaptive_target(a))) continue;
        sum += c->allowed;
        count++;
    }
    for (int at = 0; at < GRID_CELLS; at++) {
        wf_adaptive_cell *c = &a->cell[at];
        double share = count > 0 ? c->allowed * count / sum : 1;
        c->allowed = c->allowed > 0 ? fmin(fmax(share, LEAST_ALLOWED), MOST_ALLOWED) : 1;
    }
}

void wf_pool_errors(wf_adaptive *a) {
    pool p = {.a = a};
    find_ones(a, &p);
    for (int at = 0; at < GRID_CELLS; at++)
        if (a->cell[at].there) a->cell[at].need = need_of(&p, at);
    find_caution(a);
    find_allowed(&p, a);
}
