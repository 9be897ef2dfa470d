/* Cells sampled at points, as many as each place needs. */
#include "tracer/sample/adaptive_points.h"

#include <stdlib.h>
#include <string.h>

#include "tracer/sample/adaptive_packets.h"

/* ---- Memory ---- */

#define COLUMNS 8

/* All arrays of floats of samples. */
static void find_columns(wf_adaptive_samples *k, float **column[COLUMNS]) {
    float **const all[COLUMNS] = {&k->x,      &k->y,      &k->t,      &k->fraction,
                                  &k->rgb[0], &k->rgb[1], &k->rgb[2], &k->weight};
    memcpy(column, all, sizeof all);
}

void wf_points_free(wf_adaptive_samples *k) {
    float **column[COLUMNS];
    find_columns(k, column);
    for (int n = 0; n < COLUMNS; n++) free(*column[n]);
    free(k->cell);
    *k = (wf_adaptive_samples){0};
}

bool wf_points_reserve(wf_adaptive_samples *k, size_t more) {
    float **column[COLUMNS];
    if (k->count + more <= k->capacity) return true;
    size_t capacity = 2 * (k->count + more);
    int *cells = realloc(k->cell, capacity * sizeof *cells);
    if (!cells) return false;
    k->cell = cells;
    find_columns(k, column);
    for (int n = 0; n < COLUMNS; n++) {
        float *grown = realloc(*column[n], capacity * sizeof *grown);
        if (!grown) return false;
        *column[n] = grown;
    }
    k->capacity = capacity;
    return true;
}

/* ---- Samples ---- */

static wf_cell cell_of(const wf_adaptive *a, int at, int set) {
    return (wf_cell){a->tile->time, wf_cell_x(a, at), wf_cell_y(a, at), set};
}

/* From a place in the cell, and its fraction of the window, to one on the raster and in time.
 */
static void place(const wf_adaptive *a, wf_adaptive_samples *k, int at, size_t n) {
    wf_row_time time = a->time[at / GRID_WIDTH];
    double t = time.from + (double)k->fraction[n] * (time.to - time.from);
    k->x[n] = wf_in_cell(k->x[n], wf_cell_x(a, at));
    k->y[n] = wf_in_cell(k->y[n], wf_cell_y(a, at));
    k->t[n] = (float)wf_on_time_grid(t);
}

size_t wf_points_place(const wf_adaptive *a, wf_adaptive_samples *k, int at,
                       const double p[3]) {
    size_t n = k->count++;
    k->x[n] = (float)p[0];
    k->y[n] = (float)p[1];
    k->fraction[n] = (float)p[2];
    k->cell[n] = at * WF_QUARTERS;
    place(a, k, at, n);
    return n;
}

void wf_points_even(const wf_adaptive *a, int at, int count, float *const places[3]) {
    wf_sampler_draw_more(a->s->sampler, cell_of(a, at, 1), 0, count, places[0], places[1],
                         places[2]);
}

/* A piece of one quarter of one cell, to be traced with others of its row. */
static bool draw(wf_adaptive *a, int at, int quarter, int from, int count) {
    wf_adaptive_samples *k = &a->c->kept;
    if (!wf_points_reserve(k, (size_t)count)) return false;
    size_t first = k->count;
    wf_sampler_draw_more(a->s->sampler, cell_of(a, at, a->cell[at].set), from, count,
                         k->x + first, k->y + first, k->fraction + first);
    for (size_t n = first; n < first + (size_t)count; n++) {
        place(a, k, at, n);
        k->cell[n] = at * WF_QUARTERS + quarter;
    }
    k->count += (size_t)count;
    return true;
}

/* Where the samples end that are of the same cell as the first. */
static size_t end_of_cell(const wf_adaptive_samples *k, size_t first) {
    size_t end = first + 1;
    while (end < k->count && k->cell[end] / WF_QUARTERS == k->cell[first] / WF_QUARTERS) end++;
    return end;
}

/* What the edge of a sample's cell says of its light. */
static void expect(const wf_adaptive *a, const wf_adaptive_samples *k, size_t n,
                   double rgb[3]) {
    int at = k->cell[n] / WF_QUARTERS;
    const double p[3] = {(double)k->x[n] - wf_cell_x(a, at), (double)k->y[n] - wf_cell_y(a, at),
                         (double)k->fraction[n]};
    wf_edge_colors(&a->edge[at], p, rgb);
}

/* Samples first <= n < end, of one quarter of a cell that has no edge. */
static void add_plain(const wf_adaptive_samples *k, size_t first, size_t end, double sum[3],
                      double square[3]) {
    for (int c = 0; c < 3; c++) {
        double all = sum[c], squares = square[c];
        for (size_t n = first; n < end; n++) {
            double v = (double)k->rgb[c][n];
            all += v;
            squares += v * v;
        }
        sum[c] = all;
        square[c] = squares;
    }
}

static void add_beyond(wf_adaptive *a, wf_adaptive_cell *cell, int quarter, size_t n) {
    const wf_adaptive_samples *k = &a->c->kept;
    double says[3];
    expect(a, k, n, says);
    for (int c = 0; c < 3; c++) {
        double v = (double)k->rgb[c][n] - says[c];
        cell->sum[quarter][c] += v;
        cell->square[c] += v * v;
        cell->expected[c] += says[c];
    }
}

static void add_up(wf_adaptive *a, int at, int quarter, size_t first, size_t end) {
    wf_adaptive_cell *cell = &a->cell[at];
    cell->beyond = a->edge[at].found;
    if (!cell->beyond)
        add_plain(&a->c->kept, first, end, cell->sum[quarter], cell->square);
    else
        for (size_t n = first; n < end; n++) add_beyond(a, cell, quarter, n);
}

static void forget_sums(wf_adaptive_cell *c) {
    memset(c->sum, 0, sizeof c->sum);
    memset(c->square, 0, sizeof c->square);
    memset(c->expected, 0, sizeof c->expected);
}

/* A cell's samples lie in the order of its sequence, so that those of a quarter follow those of
 * the one before. */
static void add_cell_again(wf_adaptive *a, int at, size_t first, size_t end, int *seen) {
    int each = a->cell[at].each;
    while (first < end) {
        size_t left = (size_t)(each - *seen % each),
               some = end - first < left ? end - first : left;
        add_up(a, at, *seen / each, first, first + some);
        *seen += (int)some;
        first += some;
    }
}

void wf_points_add_again(wf_adaptive *a) {
    const wf_adaptive_samples *k = &a->c->kept;
    int seen[GRID_CELLS] = {0};
    bool again[GRID_CELLS];
    for (int at = 0; at < GRID_CELLS; at++) {
        again[at] = a->edge[at].found || a->cell[at].beyond;
        if (again[at]) forget_sums(&a->cell[at]);
    }
    for (size_t n = 0, end; n < k->count; n = end) {
        int at = k->cell[n] / WF_QUARTERS;
        end = end_of_cell(k, n);
        if (again[at]) add_cell_again(a, at, n, end, &seen[at]);
    }
}

/* As many samples as are wanted: those that the cell has come first in the sequence, so that
 * its quarters become parts of fewer. */
static bool draw_cell(wf_adaptive *a, int at) {
    wf_adaptive_cell *c = &a->cell[at];
    double sum[WF_QUARTERS][3] = {{0}};
    int was = c->each, each = a->more[at];
    for (int quarter = 0; quarter < WF_QUARTERS; quarter++)
        for (int k = 0; k < 3; k++) sum[quarter * was / each][k] += c->sum[quarter][k];
    memcpy(c->sum, sum, sizeof sum);
    c->each = each;
    for (int quarter = 0; quarter < WF_QUARTERS; quarter++) {
        int first = quarter * each, end = first + each;
        if (first < WF_QUARTERS * was) first = WF_QUARTERS * was;
        if (first < end && !draw(a, at, quarter, first, end - first)) return false;
    }
    return true;
}

bool wf_points_draw(wf_adaptive *a) {
    size_t first = a->c->kept.count;
    for (int at = 0; at < GRID_CELLS; at++) {
        if (a->more[at] && !draw_cell(a, at)) return false;
    }
    if (!wf_points_trace(a, &a->c->kept, first)) return false;
    const int *cell = a->c->kept.cell;
    for (size_t end; first < a->c->kept.count; first = end) {
        for (end = first + 1; end < a->c->kept.count && cell[end] == cell[first];) end++;
        add_up(a, cell[first] / WF_QUARTERS, cell[first] % WF_QUARTERS, first, end);
    }
    return true;
}

/* ---- Handing over ---- */

/* Cells whose colors are handed over by themselves. */
typedef struct cell_colors {
    int index[GRID_CELLS]; /* of the cell's; -1: it has no samples */
    int x[GRID_CELLS], y[GRID_CELLS];
    float rgb[3][GRID_CELLS];
    wf_sample_cells cells;
} cell_colors;

static void list_cells(const wf_adaptive *a, const wf_adaptive_samples *k, cell_colors *c) {
    size_t count = 0;
    for (int at = 0; at < GRID_CELLS; at++) c->index[at] = -1;
    for (size_t n = 0; n < k->count; n = end_of_cell(k, n)) {
        int at = k->cell[n] / WF_QUARTERS;
        if (c->index[at] >= 0) continue;
        c->x[count] = wf_cell_x(a, at);
        c->y[count] = wf_cell_y(a, at);
        c->index[at] = (int)count++;
    }
    c->cells = (wf_sample_cells){count, c->x, c->y, {c->rgb[0], c->rgb[1], c->rgb[2]}, NULL};
}

/* The weighted sum of samples first <= n < end of one cell, beyond what it was. */
static void add_weighted(const wf_adaptive_samples *k, size_t first, size_t end,
                         double sum[3]) {
    double r = sum[0], g = sum[1], b = sum[2];
    for (size_t n = first; n < end; n++) {
        double weight = (double)k->weight[n];
        r += (double)k->rgb[0][n] * weight;
        g += (double)k->rgb[1][n] * weight;
        b += (double)k->rgb[2][n] * weight;
    }
    sum[0] = r;
    sum[1] = g;
    sum[2] = b;
}

/* Leaves of the samples what they differ from the means of their cells: run by run, as they
 * lie. */
static void take_means(const wf_adaptive_samples *k, cell_colors *c) {
    double sum[GRID_CELLS][3] = {{0}};
    for (size_t first = 0, end; first < k->count; first = end) {
        end = end_of_cell(k, first);
        add_weighted(k, first, end, sum[c->index[k->cell[first] / WF_QUARTERS]]);
    }
    for (size_t i = 0; i < c->cells.count; i++)
        for (int ch = 0; ch < 3; ch++) c->rgb[ch][i] = (float)sum[i][ch];
    for (size_t first = 0, end; first < k->count; first = end) {
        end = end_of_cell(k, first);
        for (int ch = 0; ch < 3; ch++) {
            float mean = c->rgb[ch][c->index[k->cell[first] / WF_QUARTERS]];
            for (size_t n = first; n < end; n++) k->rgb[ch][n] -= mean;
        }
    }
}

static void hand_over(const wf_adaptive *a, const wf_adaptive_samples *k,
                      const wf_sample_cells *cells) {
    const wf_samples samples = {.count = k->count,
                                .x = k->x,
                                .y = k->y,
                                .t = k->t,
                                .field = a->s->field,
                                .rgb = {k->rgb[0], k->rgb[1], k->rgb[2]},
                                .weight = k->weight,
                                .cells = cells};
    if (k->count) a->tile->receiver->samples(a->tile->receiver->user, &samples);
}

void wf_points_hand_over(const wf_adaptive *a, const wf_adaptive_samples *k) {
    cell_colors colors;
    if (!wf_cells_are_weighed(a->s)) {
        hand_over(a, k, NULL);
        return;
    }
    list_cells(a, k, &colors);
    take_means(k, &colors);
    hand_over(a, k, &colors.cells);
}

/* Appends samples first <= n < end to others, or to those before them, for which there is
 * space. */
static void move_samples(wf_adaptive_samples *from, size_t first, size_t end,
                         wf_adaptive_samples *to) {
    float **column[2][COLUMNS];
    size_t count = end - first;
    find_columns(from, column[0]);
    find_columns(to, column[1]);
    for (int c = 0; c < COLUMNS && (from != to || first != to->count); c++)
        memmove(*column[1][c] + to->count, *column[0][c] + first, count * sizeof(float));
    memmove(to->cell + to->count, from->cell + first, count * sizeof *to->cell);
    to->count += count;
}

/* Keeps the samples of those cells alone. */
static void keep_cells(wf_adaptive_samples *k, const bool *kept) {
    wf_adaptive_samples all = *k;
    k->count = 0;
    for (size_t n = 0, end; n < all.count; n = end) {
        end = end_of_cell(&all, n);
        if (kept[all.cell[n] / WF_QUARTERS]) move_samples(k, n, end, k);
    }
}

/* Leaves out the samples of cells about the tile. */
static void drop_about(const wf_adaptive *a, wf_adaptive_samples *k) {
    bool own[GRID_CELLS];
    for (int at = 0; at < GRID_CELLS; at++) own[at] = a->cell[at].own;
    keep_cells(k, own);
}

void wf_points_drop_rare(wf_adaptive *a) {
    bool common[GRID_CELLS];
    for (int at = 0; at < GRID_CELLS; at++) common[at] = !a->cell[at].rare;
    keep_cells(&a->c->kept, common);
    for (int at = 0; at < GRID_CELLS; at++) {
        wf_adaptive_cell *c = &a->cell[at];
        if (!c->rare) continue;
        forget_sums(c);
        c->each = 0;
        c->set = WF_SECOND_SET;
    }
}

/* Takes out the samples of cells whose edge is known, into `rest`, less what the edge says. */
static bool part(const wf_adaptive *a, wf_adaptive_samples *k, wf_adaptive_samples *rest) {
    wf_adaptive_samples all = *k;
    k->count = rest->count = 0;
    for (size_t first = 0, end; first < all.count; first = end) {
        bool edge = a->edge[all.cell[first] / WF_QUARTERS].found;
        end = end_of_cell(&all, first);
        if (edge && !wf_points_reserve(rest, end - first)) return false;
        for (size_t n = first; edge && n < end; n++) {
            double says[3];
            expect(a, k, n, says);
            for (int c = 0; c < 3; c++) k->rgb[c][n] -= (float)says[c];
        }
        move_samples(k, first, end, edge ? rest : k);
    }
    return true;
}

/* Cells count alike, however many samples they have. */
bool wf_points_emit(const wf_adaptive *a) {
    static const wf_sample_cells none = {0};
    wf_adaptive_samples *k = &a->c->kept, *rest = &a->c->probes;
    drop_about(a, k);
    for (size_t n = 0; n < k->count; n++)
        k->weight[n] = (float)(1.0 / (WF_QUARTERS * a->cell[k->cell[n] / WF_QUARTERS].each));
    if (!part(a, k, rest)) return false;
    hand_over(a, rest, &none);
    wf_points_hand_over(a, k);
    return true;
}
