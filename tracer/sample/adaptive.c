/* As many samples as each place needs. A cell's samples are one scrambled Sobol sequence, whose
 * quarters say how far the mean of all may be from the truth, and those of the cells about it
 * what its own may have missed (adaptive_pool.c). Where that is too far, the cell gets as many
 * samples as the error will take; nothing drawn is drawn in vain. Where that would be very
 * many, an edge is looked for instead (adaptive_edges.c). */
#include "tracer/sample/adaptive.h"

#include <math.h>

#include "tracer/sample/adaptive_edges.h"
#include "tracer/sample/adaptive_lines.h"
#include "tracer/sample/adaptive_points.h"
#include "tracer/sample/adaptive_pool.h"
#include "tracer/sample/adaptive_specks.h"

/* Samples of a quarter to begin with, and the error from which on cells about the tile make no
 * difference. */
#define FIRST_EACH   2
#define FIRST_ABOUT  1
#define COARSE_ERROR 0.02

/* Samples of a quarter that tell whether there is an edge, how many times as many may tell
 * more, and so many that more would not; of so many edges that are looked for in a tile one has
 * to be found for another look; and how many more samples a cell has to need as points before
 * one is looked for, which costs about 40 rays. */
#define EDGE_EACH    4
#define AGAIN        4
#define MOST_TRIED   64
#define RARELY       12
#define EDGE_SAMPLES 64

/* How fast the square of an error may fall as samples become more, how far it may be over
 * before there are more, and how many times as many there are in the next round at most. */
#define FAST_FALL    1.25
#define TOLERATED    1.2
#define MOST_AT_ONCE 16

/* From this part of the square of the error asked for on, a cell is short of samples: one in
 * six is off by more than that error. */
#define SHORT 0.5

/* What is said of errors' squares, beside what was found: rather too much. */
#define SAID 1.2

/* The cosine between edges of neighbors that are one, and how far apart they may be. */
#define ALIKE  0.9
#define NEARBY 0.3

/* ---- Who wants more ---- */

/* Each of these says how many samples of a quarter a cell is to have, or 1 if it is to be
 * looked at; 0: it is not in question. */
typedef int wants_fn(const wf_adaptive *a, int at);

/* How many times as many samples a cell wants. */
static double wanted(const wf_adaptive *a, int at) {
    double over = a->cell[at].need / (wf_adaptive_target(a) * a->cell[at].allowed);
    return pow(over, 1 / fmax(a->fall, FAST_FALL));
}

static bool needs_many(const wf_adaptive *a, int at) {
    return !a->edge[at].found && !a->cell[at].rare &&
           WF_QUARTERS * a->cell[at].each * (wanted(a, at) - 1) > EDGE_SAMPLES;
}

static int wants_to_be_seen(const wf_adaptive *a, int at) {
    return needs_many(a, at) && a->cell[at].each < EDGE_EACH ? EDGE_EACH : 0;
}

/* Whether too few edges were found where they were looked for to look again. */
static bool is_hopeless(const wf_adaptive *a) {
    int tried = 0, found = 0;
    for (int at = 0; at < GRID_CELLS; at++) {
        tried += a->edge[at].tried > 0;
        found += a->edge[at].found;
    }
    return tried > RARELY * (found + 1);
}

/* Whatever they say once there are some more: quarters may agree where none is right. */
static int wants_edge(const wf_adaptive *a, int at) {
    if (!a->edge[at].tried) return a->edge[at].seen || needs_many(a, at);
    return !a->hopeless && a->edge[at].tried < MOST_TRIED &&
           a->cell[at].each >= AGAIN * a->edge[at].tried && needs_many(a, at);
}

static int wants_to_follow(const wf_adaptive *a, int at) {
    int any = 0;
    if (a->edge[at].followed || a->edge[at].found) return 0;
    for (int down = -1; down <= 1; down++)
        for (int right = -1; right <= 1; right++)
            any |= wf_edge_coming(a, at, right, down) != NULL;
    return any;
}

/* As many as the error will take, to the nearest power of two. */
static int wants_samples(const wf_adaptive *a, int at) {
    int was = a->cell[at].each, each = 2 * was;
    bool again = a->edge[at].tried && !a->edge[at].found && was < AGAIN * EDGE_EACH;
    double most = was * fmin(wanted(a, at), again ? AGAIN : MOST_AT_ONCE);
    if (was >= WF_MOST_EACH ||
        a->cell[at].need <= TOLERATED * a->cell[at].allowed * wf_adaptive_target(a))
        return 0;
    while (M_SQRT2 * each <= most && 2 * each <= WF_MOST_EACH) each *= 2;
    return each;
}

static int wants_sight(const wf_adaptive *a, int at) {
    return a->cell[at].first > a->cell[at].each ? a->cell[at].first : 0;
}

/* Among the tile's own cells, or those about it, too. */
static bool choose(wf_adaptive *a, bool about, wants_fn *wants) {
    int any = 0;
    for (int at = 0; at < GRID_CELLS; at++) {
        a->more[at] = (about ? a->cell[at].there : a->cell[at].own) ? wants(a, at) : 0;
        any |= a->more[at];
    }
    return any;
}

/* ---- Rounds ---- */

static bool draw_round(wf_adaptive *a) {
    if (!wf_points_draw(a)) return false;
    for (int at = 0; at < GRID_CELLS; at++)
        if (a->more[at]) wf_cell_find_mean(&a->cell[at]);
    wf_pool_errors(a);
    return true;
}

/* Whether the edge of a neighbor, so many cells to the right and rows down, goes on as a cell's
 * own: either side may be the first. */
static bool is_one(const wf_adaptive_edge *own, const wf_adaptive_edge *edge, int right,
                   int down) {
    double size = sqrt(wf_dot(edge->n, edge->n)), own_size = sqrt(wf_dot(own->n, own->n));
    double along = wf_dot(edge->n, own->n) / (size * own_size);
    double middle[3] = {0.5, 0.5, 0.5};
    double from =
        (edge->d + edge->n[0] * right + edge->n[1] * down - wf_dot(edge->n, middle)) / size;
    double own_from = (own->d - wf_dot(own->n, middle)) / own_size;
    return fabs(along) > ALIKE && fabs(copysign(1, along) * from - own_from) < NEARBY;
}

/* Whether a neighbor's edge comes in that is another than a cell's own: there is a corner or
 * something thin, of which samples may not have seen enough to tell. */
static bool is_crossed(const wf_adaptive *a, int at) {
    for (int down = -1; down <= 1; down++)
        for (int right = -1; right <= 1; right++) {
            const wf_adaptive_edge *edge = wf_edge_coming(a, at, right, down);
            if (edge && !is_one(&a->edge[at], edge, right, down * a->step)) return true;
        }
    return false;
}

static void forget_crossed(wf_adaptive *a) {
    bool crossed[GRID_CELLS];
    for (int at = 0; at < GRID_CELLS; at++)
        crossed[at] = a->edge[at].found && is_crossed(a, at);
    for (int at = 0; at < GRID_CELLS; at++)
        if (crossed[at]) a->edge[at].found = false, a->edge[at].error = 0;
}

/* Edges where points would be many, and as far as they go on. */
static bool find_edges(wf_adaptive *a) {
    bool any = choose(a, true, wants_to_be_seen);
    for (int at = 0; at < GRID_CELLS; at++) a->edge[at].seen |= a->more[at] > 0;
    if (any && !draw_round(a)) return false;
    a->hopeless = is_hopeless(a);
    if (!choose(a, true, wants_edge)) return true;
    if (!wf_edges_find(a)) return false;
    while (choose(a, true, wants_to_follow))
        if (!wf_edges_follow(a)) return false;
    forget_crossed(a);
    wf_points_add_again(a);
    wf_pool_errors(a);
    return true;
}

/* Cells that stop by what they alone see would be too dark: as many samples as they had, which
 * know nothing of that, take the place of those. */
static bool draw_rare_again(wf_adaptive *a) {
    bool any = false;
    for (int at = 0; at < GRID_CELLS; at++) {
        a->more[at] = a->cell[at].rare ? a->cell[at].each : 0;
        any |= a->cell[at].rare;
    }
    if (!any) return true;
    wf_points_drop_rare(a);
    return draw_round(a);
}

static bool draw_specks(wf_adaptive *a) {
    wf_specks_find(a);
    return !choose(a, false, wants_sight) || draw_round(a);
}

static bool sample(wf_adaptive *a, bool empty) {
    if (!draw_round(a)) return false;
    if (empty) return true;
    if (!draw_specks(a) || !find_edges(a)) return false;
    while (choose(a, false, wants_samples))
        if (!draw_round(a) || !find_edges(a)) return false;
    return draw_rare_again(a);
}

/* ---- Tiles ---- */

int wf_adaptive_about(const wf_sampling *s) {
    return s->desc.error < COARSE_ERROR ? ABOUT : 0;
}

/* One row of the tile's cells and those beside it. */
static void begin_row(wf_adaptive *a, int row, bool own, int about) {
    int width = a->s->raster.width_px, x0 = a->tile->x0, x1 = a->tile->x1;
    for (int at = row * GRID_WIDTH; at < (row + 1) * GRID_WIDTH; at++) {
        wf_adaptive_cell *c = &a->cell[at];
        int x = wf_cell_x(a, at);
        c->own = own && x >= x0 && x < x1;
        c->there = x >= 0 && x < width && x >= x0 - about && x < x1 + about;
        a->more[at] = c->own ? FIRST_EACH : c->there ? FIRST_ABOUT : 0;
    }
}

/* The tile's rows and those about it that are wanted; lines of a field alone are every other.
 */
static void begin(wf_adaptive *a, int end) {
    int about = wf_adaptive_about(a->s), before = -2;
    a->c->kept.count = 0;
    a->step = 2;
    for (int row = 0; row < GRID_ROWS; row++) {
        int y = wf_cell_y(a, row * GRID_WIDTH);
        if (y < 0 || y >= a->s->raster.lines || y < a->first - about || y >= end + about)
            continue;
        if (!wf_find_row_time(a->s, y, &a->time[row])) continue;
        begin_row(a, row, y >= a->first && y < end, about);
        if (row == before + 1) a->step = 1;
        before = row;
    }
}

static void sum_errors(const wf_adaptive *a) {
    double error = a->s->desc.error;
    for (int at = 0; at < GRID_CELLS; at++) {
        if (!a->cell[at].own) continue;
        a->c->error.square += SAID * (a->cell[at].need + a->edge[at].error);
        a->c->error.cells++;
        a->c->error.short_of +=
            a->cell[at].each >= WF_MOST_EACH && a->cell[at].need > SHORT * error * error;
    }
}

bool wf_adaptive_tile(const wf_tile *tile, int first, int end, bool empty) {
    wf_adaptive a = {
        .tile = tile, .s = tile->s, .c = tile->c, .first = first, .caution = WF_FIRST_CAUTION};
    begin(&a, end);
    if (!sample(&a, empty)) return false;
    sum_errors(&a);
    return wf_points_emit(&a) && wf_edges_emit(&a);
}
