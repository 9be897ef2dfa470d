/* Columns that break their bounds: the segments of them that bounds change, side by side into
 * the interior point method, and the proof of what comes out. */
#include "filters/least/segments.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = WF_LEAST_COLUMNS, LANES = WF_LEAST_LANES };

/* Bounds that are met to this much of max(1, max S) hold. */
#define HELD 3e-8
/* Of the duality gap, over max(1, max S)^2: what is solved to, and what is promised. */
#define SOLVED 3e-11
#define PROVED 1e-10

/* Multipliers grow as limits shrink, and what rounding leaves of the gap with their square: so
 * much is promised to limits from here on, times the root of max(1, max S), and to smaller ones
 * in proportion. */
#define FINE_LIMIT 0.003

/* No L is so far above max(1, max S): where there is no most, this stands for it. */
#define FAR 16
/* Multipliers begin so that each, times its slack, is this share of the mean square change. */
#define START 0.25

/* How often a column is solved: the last time all of it at once. */
enum { ROUNDS = 8 };

static double limit_at(const wf_least_scratch *s, int j, int column) {
    return s->limit[j * s->limit_step + column];
}

double wf_least_flicker(const wf_least *least, const double *x, int j) {
    int lines = least->desc.lines, above = j ? j - 1 : 1, below = j < lines - 1 ? j + 1 : j - 1;
    return 0.5 * x[j * WIDTH] - 0.25 * (x[above * WIDTH] + x[below * WIDTH]);
}

/* Of numbers that are not NaN. */
static inline double larger(double a, double b) {
    return a > b ? a : b;
}

static inline double smaller(double a, double b) {
    return a < b ? a : b;
}

/* ---- Segments ---- */

/* Marks the lines of a column that break a bound, by how much. */
static void find_breaks(const wf_least *least, wf_least_scratch *s, int column) {
    const double *x = s->l + column, held = HELD * s->scale[column];
    for (int j = 0; j < least->desc.lines; j++) {
        double l = x[j * WIDTH];
        double over = fabs(wf_least_flicker(least, x, j)) - limit_at(s, j, column);
        over = larger(over, larger(-l, l - least->desc.most));
        if (over > held) s->breaks[j] = larger(s->breaks[j], over);
    }
}

/* Adds lines to the segments of a column; those that are no farther apart than a tail are one.
 */
static void add_segment(const wf_least *least, wf_least_scratch *s, int column, int first,
                        int end) {
    while (s->segment_count) {
        const wf_least_segment *last = &s->segments[s->segment_count - 1];
        if (last->column != column || first > last->end + least->tail + 2) break;
        first = last->first < first ? last->first : first;
        end = last->end > end ? last->end : end;
        s->segment_count--;
        s->pieces[column]--;
    }
    s->segments[s->segment_count++] = (wf_least_segment){column, first, end, true};
    s->pieces[column]++;
}

/* The least limit of a column. */
static double least_limit(const wf_least *least, const wf_least_scratch *s, int column) {
    double limit = limit_at(s, 0, column);
    for (int j = 1; s->limit_step && j < least->desc.lines; j++)
        limit = smaller(limit, limit_at(s, j, column));
    return limit;
}

/* Lines about those that break a bound: a step of height h is spread over the square root of
 * h / limit lines. */
static void find_segments(const wf_least *least, wf_least_scratch *s, int column, int round) {
    int lines = least->desc.lines;
    s->pieces[column] = 0;
    for (int j = 0; j < lines; j++) {
        if (!(s->breaks[j] > 0)) continue;
        int margin = (3 + (int)(1.2 * sqrt(s->breaks[j] / limit_at(s, j, column)))) << round;
        if (round > ROUNDS - 4 || margin > lines) margin = lines;
        int first = j - margin < 3 ? 0 : j - margin, end = j + margin + 1;
        add_segment(least, s, column, first, end > lines - 3 ? lines : end);
    }
}

/* What is bounded swings so far beyond what it is made of, at most, but where it does not
 * matter. */
#define SWING 0.1

static bool meets_box(const wf_least *least, const wf_least_scratch *s,
                      const wf_least_segment *g) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (int j = g->first; j < g->end; j++) {
        double l = s->base[j * WIDTH + g->column];
        low = l < low ? l : low;
        high = l > high ? l : high;
    }
    double swing = SWING * (high - low);
    return low - swing <= 0 || high + swing >= least->desc.most;
}

static int by_length(const void *left, const void *right) {
    const wf_least_segment *a = left, *b = right;
    int one = a->end - a->first, other = b->end - b->first;
    if (a->boxed != b->boxed) return a->boxed ? -1 : 1;
    if (one != other) return one < other ? 1 : -1;
    if (a->column != b->column) return a->column < b->column ? -1 : 1;
    return a->first < b->first ? -1 : a->first > b->first;
}

/* ---- Packs ---- */

static double *cell(const wf_least_pack *p, int array, int row, int lane) {
    return wf_least_rows(p, array) + (ptrdiff_t)row * LANES + lane;
}

/* Rows that are no lane's: a picture of its own, at rest. */
static void clear_lane(wf_least_pack *p, int lane, int from) {
    for (int row = from; row < p->rows; row++) {
        for (int a = 0; a < WF_LEAST_ARRAYS; a++) *cell(p, a, row, lane) = 0;
        *cell(p, WF_LEAST_M0, row, lane) = *cell(p, WF_LEAST_LIMIT, row, lane) = 1;
        *cell(p, WF_LEAST_BASE, row, lane) = *cell(p, WF_LEAST_L, row, lane) =
            p->most[lane] / 2;
        for (int i = 0; i < 4; i++) *cell(p, WF_LEAST_Z + i, row, lane) = 1;
    }
}

static void clear_guard(wf_least_pack *p) {
    size_t bytes = WF_LEAST_GUARD * LANES * sizeof(double);
    for (int a = 0; a < WF_LEAST_ARRAYS; a++) memset(cell(p, a, p->rows, 0), 0, bytes);
}

/* The quadratic form at the ends of a segment: what lies beyond has no bound that matters, and
 * is eliminated as in F D F', from above and from below. */
static void close_end(const wf_least *least, wf_least_pack *p, int lane, int row, int next,
                      int line) {
    double pivot = least->pivot[line], f1 = least->f1[line + 1];
    *cell(p, WF_LEAST_M0, row, lane) = pivot;
    *cell(p, WF_LEAST_M1, row < next ? row : next, lane) = f1 * pivot;
    *cell(p, WF_LEAST_M0, next, lane) = least->pivot[line + 1] + f1 * f1 * pivot;
}

static void put_form(const wf_least *least, wf_least_pack *p, const wf_least_segment *g,
                     int lane) {
    int rows = g->end - g->first, lines = least->desc.lines;
    for (int row = 0; row < rows; row++)
        for (int d = 0; d < 3; d++)
            *cell(p, WF_LEAST_M0 + d, row, lane) =
                row + d < rows ? wf_least_entry(&least->desc, g->first + row, d) : 0;
    if (g->first) close_end(least, p, lane, 0, 1, g->first);
    if (g->end < lines) close_end(least, p, lane, rows - 1, rows - 2, lines - g->end);
}

/* b of a line counts where both its neighbors are in the segment. */
static void put_bounds(const wf_least *least, wf_least_scratch *s, const wf_least_segment *g,
                       int lane) {
    wf_least_pack *p = &s->pack;
    int rows = g->end - g->first, lines = least->desc.lines;
    for (int row = 0; row < rows; row++) {
        int j = g->first + row;
        bool bound = (row > 0 || j == 0) && (row < rows - 1 || j == lines - 1);
        *cell(p, WF_LEAST_ABOVE, row, lane) = bound ? wf_least_b(lines, j, j - 1) : 0;
        *cell(p, WF_LEAST_BELOW, row, lane) = bound ? wf_least_b(lines, j, j + 1) : 0;
        *cell(p, WF_LEAST_BOUND, row, lane) = bound;
        *cell(p, WF_LEAST_LIMIT, row, lane) = bound ? limit_at(s, j, g->column) : 1;
        *cell(p, WF_LEAST_OWN, row, lane) = 1;
    }
}

/* L begins as a gray with as much of the picture as leaves it well within all bounds. */
static void put_start(const wf_least *least, wf_least_scratch *s, const wf_least_segment *g,
                      int lane) {
    wf_least_pack *p = &s->pack;
    const double *base = s->base + g->column;
    int rows = g->end - g->first;
    double mean = 0, most = p->most[lane], part = 1;
    for (int j = g->first; j < g->end; j++) mean += base[j * WIDTH] / rows;
    mean = smaller(larger(mean, 0.05 * smaller(most, 1)), 0.95 * most);
    for (int j = g->first; j < g->end; j++) {
        double off = base[j * WIDTH] - mean;
        double b = fabs(wf_least_flicker(least, base, j));
        if (b > 0) part = smaller(part, 0.7 * limit_at(s, j, g->column) / b);
        if (p->boxed && off < 0) part = smaller(part, 0.9 * mean / -off);
        if (p->boxed && off > 0) part = smaller(part, 0.9 * (most - mean) / off);
    }
    double mu = 0;
    for (int j = g->first; j < g->end; j++) {
        double off = (1 - part) * (base[j * WIDTH] - mean);
        mu += off * off / rows;
    }
    mu = fmax(START * mu, 1e-9);
    for (int row = 0; row < rows; row++) {
        double at = base[(g->first + row) * WIDTH], l = mean + part * (at - mean);
        *cell(p, WF_LEAST_BASE, row, lane) = at;
        *cell(p, WF_LEAST_L, row, lane) = l;
        *cell(p, WF_LEAST_Z, row, lane) = *cell(p, WF_LEAST_Z + 1, row, lane) =
            mu / limit_at(s, g->first + row, g->column);
        *cell(p, WF_LEAST_Z + 2, row, lane) = p->boxed ? mu / l : 0;
        *cell(p, WF_LEAST_Z + 3, row, lane) = p->boxed ? mu / (most - l) : 0;
    }
}

/* Beyond a segment L follows from its end as it does without bounds. */
static void put_tail(const wf_least *least, double *x, const double d[2], int line, int step) {
    int lines = least->desc.lines;
    double one = d[0], two = d[1];
    for (int j = line; j >= 0 && j < lines && fabs(one) + fabs(two) > 1e-16; j += step) {
        int at = step < 0 ? j : lines - 1 - j; /* counted from where F begins */
        double next = -least->f1[at + 1] * one - least->f2[at + 2] * two;
        x[j * WIDTH] += next;
        two = one;
        one = next;
    }
}

static void take_lane(const wf_least *least, wf_least_scratch *s, const wf_least_segment *g,
                      int lane) {
    const wf_least_pack *p = &s->pack;
    int rows = g->end - g->first, column = g->column;
    double *x = s->l + column, d[2], e[2];
    for (int i = 0; i < 2; i++) {
        d[i] = *cell(p, WF_LEAST_L, i, lane) - *cell(p, WF_LEAST_BASE, i, lane);
        e[i] = *cell(p, WF_LEAST_L, rows - 1 - i, lane) -
               *cell(p, WF_LEAST_BASE, rows - 1 - i, lane);
    }
    for (int row = 0; row < rows; row++) {
        int at = (g->first + row) * WIDTH;
        double bound = *cell(p, WF_LEAST_BOUND, row, lane);
        x[at] = *cell(p, WF_LEAST_L, row, lane);
        s->tension[at + column] =
            bound * (*cell(p, WF_LEAST_Z, row, lane) - *cell(p, WF_LEAST_Z + 1, row, lane));
        double up = least->desc.most < HUGE_VAL ? *cell(p, WF_LEAST_Z + 3, row, lane) : 0;
        s->press[at + column] = up - *cell(p, WF_LEAST_Z + 2, row, lane);
    }
    if (g->first) put_tail(least, x, d, g->first - 1, -1);
    if (g->end < least->desc.lines) put_tail(least, x, e, g->end, 1);
}

static void solve_together(const wf_least *least, wf_least_scratch *s,
                           const wf_least_segment *g, int count) {
    wf_least_pack *p = &s->pack;
    p->rows = g->end - g->first; /* they come by length */
    p->boxed = g->boxed;

    for (int lane = 0; lane < LANES; lane++) {
        int own = lane < count ? lane : 0, rows = g[own].end - g[own].first;
        double scale = s->scale[g[own].column];
        p->tolerance[lane] = SOLVED * scale * scale / s->pieces[g[own].column];
        p->most[lane] = fmin(least->desc.most, FAR * scale);
        put_form(least, p, &g[own], lane);
        put_bounds(least, s, &g[own], lane);
        put_start(least, s, &g[own], lane);
        clear_lane(p, lane, rows);
    }
    clear_guard(p);
    least->ops->solve(p);
    for (int lane = 0; lane < count; lane++) take_lane(least, s, &g[lane], lane);
}

/* first: the first time, when bounds on L are left out where they are not thought to be met. */
static void solve_segments(const wf_least *least, wf_least_scratch *s, bool first) {
    for (int n = 0; n < s->segment_count; n++)
        s->segments[n].boxed = !first || meets_box(least, s, &s->segments[n]);
    qsort(s->segments, (size_t)s->segment_count, sizeof *s->segments, by_length);
    for (int n = 0, count; n < s->segment_count; n += count) {
        const wf_least_segment *g = s->segments + n;
        for (count = 1; count < LANES && n + count < s->segment_count;) {
            if (g[count].boxed != g->boxed) break;
            count++;
        }
        solve_together(least, s, g, count);
    }
}

/* ---- Tiles ---- */

/* max(1, max S) of every column. */
static void find_scales(const wf_least *least, wf_least_scratch *s) {
    for (int i = 0; i < WIDTH; i++) s->scale[i] = 1;
    for (int j = 0; j < least->desc.lines; j++)
        for (int i = 0; i < WIDTH; i++) s->scale[i] = larger(s->scale[i], s->s[j * WIDTH + i]);
}

static void reset_column(const wf_least *least, wf_least_scratch *s, int column) {
    for (int j = 0; j < least->desc.lines; j++) {
        int at = j * WIDTH + column;
        s->l[at] = s->base[at];
        s->tension[at] = s->press[at] = 0;
    }
}

/* Columns that are not proved are solved by themselves, from wider and wider segments about
 * what breaks bounds as they stand and as they stood. */
static void solve_again(const wf_least *least, wf_least_scratch *s, int column, int round) {
    if (round == 1) memset(s->breaks, 0, (size_t)least->desc.lines * sizeof *s->breaks);
    find_breaks(least, s, column);
    reset_column(least, s, column);
    s->segment_count = 0;
    find_breaks(least, s, column);
    find_segments(least, s, column, round);
    solve_segments(least, s, false);
}

static bool is_proved(const wf_least *least, const wf_least_scratch *s, int column,
                      const double *excess, const double *gap) {
    double coarse =
        fmax(1, FINE_LIMIT * sqrt(s->scale[column]) / least_limit(least, s, column));
    return excess[column] <= HELD * s->scale[column] && gap[column] <= PROVED * coarse * coarse;
}

/* Most are proved at once; of others it may be rounding alone that stands in the way. */
static void prove_column(const wf_least *least, wf_least_scratch *s, int column,
                         const double *first_excess, const double *first_gap,
                         wf_least_counts *counts) {
    double excess[WIDTH], gap[WIDTH];
    memcpy(excess, first_excess, sizeof excess);
    memcpy(gap, first_gap, sizeof gap);
    for (int round = 1; round < ROUNDS && !is_proved(least, s, column, excess, gap); round++) {
        if (round > 1 || excess[column] > HELD * s->scale[column])
            solve_again(least, s, column, round > 1 ? round - 1 : 1);
        wf_least_settle(least, s, column);
        wf_least_judge(least, s, excess, gap);
    }
    counts->solved++;
    counts->failed += !is_proved(least, s, column, excess, gap);
    counts->gap = fmax(counts->gap, gap[column]);
}

static void find_all_segments(const wf_least *least, wf_least_scratch *s, int columns,
                              const double *broken) {
    s->segment_count = 0;
    find_scales(least, s);
    for (int i = 0; i < columns; i++) {
        if (broken[i] <= HELD) continue;
        memset(s->breaks, 0, (size_t)least->desc.lines * sizeof *s->breaks);
        find_breaks(least, s, i);
        find_segments(least, s, i, 0);
    }
}

void wf_least_hold(const wf_least *least, wf_least_scratch *s, int columns,
                   wf_least_counts *counts) {
    double broken[WIDTH], excess[WIDTH], gap[WIDTH];
    const wf_least_desc *d = &least->desc;
    size_t samples = (size_t)d->lines * WIDTH;
    bool any = false;
    const wf_least_claim claim = wf_least_claim_of(least, s);
    least->ops->look(&claim, broken);
    for (int i = 0; i < columns; i++) any |= broken[i] > HELD;
    if (!any) return;
    memcpy(s->base, s->l, samples * sizeof *s->l);
    memset(s->tension, 0, samples * sizeof *s->tension);
    memset(s->press, 0, samples * sizeof *s->press);
    find_all_segments(least, s, columns, broken);
    solve_segments(least, s, true);
    wf_least_judge(least, s, excess, gap);
    for (int i = 0; i < columns; i++)
        if (broken[i] > HELD) prove_column(least, s, i, excess, gap, counts);
}
