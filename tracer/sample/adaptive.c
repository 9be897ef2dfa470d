/* As many samples as each place needs. A cell's samples are one scrambled Sobol sequence, whose
 * quarters are sequences of their own: how far their means lie apart says how far the mean of
 * all may be from the truth, and rather too much, since all together lie more evenly than four
 * that know nothing of each other would. Where that is too far, for the cell itself or one
 * beside it, an edge is looked for (adaptive_edges.c), or the cell's samples become two
 * or four times as many; nothing drawn is drawn in vain.
 *
 * What few samples see alike is not to be believed where something else is near: there each
 * cell gets more, unless the edges beside it are known to pass it by. */
#include "tracer/sample/adaptive.h"

#include <math.h>

#include "tracer/sample/adaptive_edges.h"
#include "tracer/sample/adaptive_lines.h"
#include "tracer/sample/adaptive_points.h"

/* Samples of a quarter to begin with: of the tile's cells, and of those beside it, which are
 * only to show what comes near. */
#define FIRST_EACH   2
#define FIRST_BESIDE 1

/* Samples of a quarter, times the error asked for, that are believed: a part of a cell that
 * none of them sees may be as large as the share of one. */
#define BELIEVED 0.04

/* Differences of samples that make no difference if some are not seen, in errors asked for. */
#define SLIGHT 4

/* About how many samples an edge costs. As points a cell needs as many more as the square of
 * its error is too large, to this power. */
#define EDGE_SAMPLES 64
#define STEEPNESS    0.7

/* The square of the cosine between edges of neighbors that are one. */
#define ALIKE 0.8

/* Of the squares of errors: from here on four times as many samples are not too many. */
#define FAR_OVER 8

/* How far past a cell an edge passes it by. */
#define PAST 0.15

static const wf_adaptive_edge *edge_of(const wf_adaptive *a, const wf_adaptive_cell *c) {
    return &a->edge[c - a->cell];
}

/* The largest of a cell's and its neighbors': an edge that all quarters missed here was seen
 * next door. */
static double error_about(const wf_adaptive *a, int at) {
    double most = a->cell[at].error;
    for (int down = -1; down <= 1; down++)
        for (int right = -1; right <= 1; right++) {
            const wf_adaptive_cell *c = wf_cell_beside(a, at, right, down);
            if (c && c->own && c->error / 2 > most) most = c->error / 2;
        }
    return most;
}

/* ---- What may be hidden ---- */

static int believed_each(double error) {
    int each = 1;
    while (each < WF_MOST_EACH && each * error < BELIEVED) each *= 2;
    return each;
}

static bool is_believed(const wf_adaptive *a, int at) {
    return a->cell[at].each >= believed_each(a->s->desc.error);
}

/* Where an aperture's edge cuts cells, what lies two rows away matters to how a cell is filled.
 */
int wf_adaptive_rows_about(const wf_sampling *s) {
    if (believed_each(s->desc.error) <= FIRST_EACH) return 0;
    return wf_cuts_cells(s) ? 2 : 1;
}

/* The smaller of two slopes; 0 where one goes up and one goes down. */
static double gentler(double a, double b) {
    if (!(a * b > 0)) return 0;
    return fabs(a) < fabs(b) ? a : b;
}

/* How light changes from cell to cell: what is seen on both sides, not the step of an edge on
 * one. */
static double slope_of(const wf_adaptive_cell *before, const wf_adaptive_cell *here,
                       const wf_adaptive_cell *after, int channel) {
    if (!before || !after) return 0;
    return gentler(here->mean[channel] - before->mean[channel],
                   after->mean[channel] - here->mean[channel]);
}

/* Light that changes evenly about a cell, and how far from that makes no difference. */
typedef struct trend {
    double mean[3], right[3], down[3], margin[3];
} trend;

static trend trend_about(const wf_adaptive *a, int at) {
    const wf_adaptive_cell *c = &a->cell[at];
    trend t;
    for (int k = 0; k < 3; k++) {
        t.mean[k] = c->mean[k];
        t.right[k] = slope_of(wf_cell_beside(a, at, -1, 0), c, wf_cell_beside(a, at, 1, 0), k);
        t.down[k] = slope_of(wf_cell_beside(a, at, 0, -1), c, wf_cell_beside(a, at, 0, 1), k);
        t.margin[k] =
            (fabs(t.right[k]) + fabs(t.down[k])) / 2 + SLIGHT * a->s->desc.error / c->steep[k];
    }
    return t;
}

static bool follows(const trend *t, const wf_adaptive_cell *c, int right, int down) {
    bool all = true;
    for (int k = 0; k < 3; k++) {
        double even = t->mean[k] + right * t->right[k] + down * t->down[k];
        all &= (double)c->low[k] >= even - t->margin[k] &&
               (double)c->high[k] <= even + t->margin[k];
    }
    return all;
}

/* Whether nothing is near that might hide in a cell. */
static bool quiet(const wf_adaptive *a, int at) {
    trend t = trend_about(a, at);
    for (int down = -1; down <= 1; down++)
        for (int right = -1; right <= 1; right++) {
            const wf_adaptive_cell *c = wf_cell_beside(a, at, right, down);
            bool here = !right && !down;
            if (!c || follows(&t, c, right, down)) continue;
            if (here || !wf_edge_passes_by(edge_of(a, c), right, down, PAST)) return false;
        }
    return true;
}

/* ---- Who wants more ---- */

/* Each of these says how many samples of a quarter a cell is to have, or 1 if it is to be
 * looked at; 0: it is not in question. */
typedef int wants_fn(const wf_adaptive *a, int at);

/* Cells that show more than one thing. */
static int is_mixed(const wf_adaptive *a, int at) {
    trend t = trend_about(a, at);
    bool mixed = !is_believed(a, at) && !follows(&t, &a->cell[at], 0, 0);
    return mixed ? believed_each(a->s->desc.error) : 0;
}

/* Those which are themselves the trouble, not one beside them, and would need more samples as
 * points than an edge does. */
static int wants_edge(const wf_adaptive *a, int at) {
    const wf_adaptive_cell *c = &a->cell[at];
    if (a->edge[at].tried || a->edge[at].found || c->error <= wf_adaptive_target(a)) return 0;
    return WF_QUARTERS * c->each * pow(c->error / wf_adaptive_target(a), STEEPNESS) >
           EDGE_SAMPLES;
}

static int wants_to_follow(const wf_adaptive *a, int at) {
    int any = 0;
    if (a->edge[at].found || a->edge[at].followed || !is_believed(a, at)) return 0;
    for (int down = -1; down <= 1; down++)
        for (int right = -1; right <= 1; right++)
            any |= wf_edge_coming(a, at, right, down) != NULL;
    return any;
}

static int is_suspect(const wf_adaptive *a, int at) {
    bool suspect = !a->edge[at].found && !is_believed(a, at) && !quiet(a, at);
    return suspect ? believed_each(a->s->desc.error) : 0;
}

/* Cells of one color beside which others are. Where an aperture's edge cuts cells, few samples
 * say badly how much of each it sees. */
static int wants_to_be_filled(const wf_adaptive *a, int at) {
    trend t = trend_about(a, at);
    if (a->edge[at].found || a->cell[at].error > wf_adaptive_target(a) ||
        !follows(&t, &a->cell[at], 0, 0))
        return 0;
    int unlike = 0;
    for (int down = -ABOUT_ROWS; down <= ABOUT_ROWS; down++)
        for (int right = -1; right <= 1; right++) {
            const wf_adaptive_cell *c = wf_cell_beside(a, at, right, down);
            unlike |= c && !follows(&t, c, right, down);
        }
    return unlike;
}

/* Twice as many, or four times if that is sure to be too few. */
static int wants_samples(const wf_adaptive *a, int at) {
    int each = a->cell[at].each;
    double over = error_about(a, at) / wf_adaptive_target(a);
    if (a->edge[at].found || each >= WF_MOST_EACH || over <= 1) return 0;
    return over > FAR_OVER && 4 * each <= WF_MOST_EACH ? 4 * each : 2 * each;
}

/* Among the tile's own cells, or those about it, too. */
static bool choose(wf_adaptive *a, bool about, wants_fn *wants) {
    int any = 0;
    for (int at = 0; at < GRID_CELLS; at++) {
        const wf_adaptive_cell *c = &a->cell[at];
        a->more[at] = (about ? c->there : c->own) ? wants(a, at) : 0;
        any |= a->more[at];
    }
    return any;
}

/* ---- Rounds ---- */

static bool draw_round(wf_adaptive *a) {
    if (!wf_points_draw(a)) return false;
    for (int at = 0; at < GRID_CELLS; at++)
        if (a->more[at]) wf_cell_find_error(a, &a->cell[at]);
    return true;
}

static bool draw_all(wf_adaptive *a, bool about, wants_fn *wants) {
    while (choose(a, about, wants))
        if (!draw_round(a)) return false;
    return true;
}

/* Edges where there is trouble, and as far as they go on, once more samples are where that may
 * be. */
static bool find_edges(wf_adaptive *a) {
    if (!draw_all(a, true, is_mixed)) return false;
    if (choose(a, true, wants_edge) && !wf_edges_find(a)) return false;
    do {
        if (!draw_all(a, false, is_suspect)) return false;
        if (choose(a, false, wants_edge) && !wf_edges_find(a)) return false;
        if (choose(a, false, wants_to_follow) && !wf_edges_follow(a)) return false;
    } while (choose(a, false, wants_to_follow));
    return true;
}

/* Whether a neighbor's edge comes in across a cell's own: there is a corner, of which samples
 * may not have seen enough to tell. */
static bool is_crossed(const wf_adaptive *a, int at) {
    const double *n = a->edge[at].n;
    for (int down = -1; down <= 1; down++)
        for (int right = -1; right <= 1; right++) {
            const wf_adaptive_edge *edge = wf_edge_coming(a, at, right, down);
            if (!edge) continue;
            double along = wf_dot(edge->n, n);
            if (along * along < ALIKE * wf_dot(edge->n, edge->n) * wf_dot(n, n)) return true;
        }
    return false;
}

static void forget_crossed(wf_adaptive *a) {
    bool crossed[GRID_CELLS];
    for (int at = 0; at < GRID_CELLS; at++)
        crossed[at] = a->edge[at].found && is_crossed(a, at);
    for (int at = 0; at < GRID_CELLS; at++) {
        if (!crossed[at]) continue;
        a->edge[at].found = false;
        wf_cell_find_error(a, &a->cell[at]);
    }
}

static bool sample(wf_adaptive *a, bool empty) {
    if (!draw_round(a)) return false;
    if (empty) return true;
    if (!find_edges(a)) return false;
    forget_crossed(a);
    if (!draw_all(a, false, is_suspect)) return false;
    if (wf_cuts_cells(a->s) && choose(a, false, wants_to_be_filled) && !wf_edges_fill(a))
        return false;
    return draw_all(a, false, wants_samples);
}

/* ---- Tiles ---- */

/* One row of the tile's cells and those beside it. */
static void begin_row(wf_adaptive *a, int row, bool own, int columns) {
    int width = a->s->raster.width_px;
    for (int at = row * GRID_WIDTH; at < (row + 1) * GRID_WIDTH; at++) {
        wf_adaptive_cell *c = &a->cell[at];
        int x = wf_cell_x(a, at), x0 = a->tile->x0, x1 = a->tile->x1;
        c->own = own && x >= x0 && x < x1;
        c->there = x >= 0 && x < width && x >= x0 - columns && x < x1 + columns;
        a->more[at] = c->own ? FIRST_EACH : c->there ? FIRST_BESIDE : 0;
    }
}

/* The tile's rows and, unless it is empty, those about it. */
static void begin(wf_adaptive *a, int end, bool empty) {
    int rows = empty ? 0 : wf_adaptive_rows_about(a->s), columns = rows > 0 ? ABOUT : 0;
    a->c->kept.count = 0;
    for (int row = 0; row < GRID_ROWS; row++) {
        int y = wf_cell_y(a, row * GRID_WIDTH);
        if (y < 0 || y >= a->s->raster.lines || y < a->first - rows || y >= end + rows)
            continue;
        if (wf_find_row_time(a->s, y, &a->time[row]))
            begin_row(a, row, y >= a->first && y < end, columns);
    }
}

/* How far the light of two cells is apart on the display; squared. */
static double contrast_of(const wf_adaptive_cell *c, const wf_adaptive_cell *d) {
    double square = 0;
    for (int k = 0; k < 3; k++) {
        double apart = (c->mean[k] - d->mean[k]) * fmax(c->steep[k], d->steep[k]);
        square += apart * apart / 3;
    }
    return square;
}

/* Where an aperture's edge cuts cells: how much it sees of a cell beside others is as uncertain
 * as the share of its points is. */
static double cut_error(const wf_adaptive *a, int at) {
    const wf_adaptive_edge *edge = &a->edge[at];
    int pieces = wf_edge_pieces(&a->s->desc.gather.aperture);
    double points = edge->found ? edge->lines * pieces : WF_QUARTERS * a->cell[at].each,
           most = 0;
    if (!wf_cuts_cells(a->s)) return 0;
    for (int down = -1; down <= 1; down++)
        for (int right = -1; right <= 1; right++) {
            const wf_adaptive_cell *c = wf_cell_beside(a, at, right, down);
            if (c) most = fmax(most, contrast_of(&a->cell[at], c));
        }
    return most * wf_points_share_error(points) * wf_adaptive_share(a);
}

static void sum_errors(const wf_adaptive *a) {
    for (int at = 0; at < GRID_CELLS; at++) {
        if (!a->cell[at].own) continue;
        const wf_adaptive_edge *edge = &a->edge[at];
        double error = edge->found ? a->cell[at].error + edge->unseen : error_about(a, at);
        a->c->error.square += error + cut_error(a, at);
        a->c->error.cells++;
    }
}

bool wf_adaptive_tile(const wf_tile *tile, int first, int end, bool empty) {
    wf_adaptive a = {.tile = tile, .s = tile->s, .c = tile->c, .first = first};
    begin(&a, end, empty);
    if (!sample(&a, empty)) return false;
    sum_errors(&a);
    wf_points_emit(&a);
    return wf_edges_emit(&a);
}
