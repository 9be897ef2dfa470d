/* Cells sampled at points, as many as each place needs. */
#include "tracer/sample/adaptive_points.h"

#include <stdlib.h>
#include <string.h>

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
    wf_sampler_draw_more(a->s->sampler, cell_of(a, at, 0), from, count, k->x + first,
                         k->y + first, k->fraction + first);
    for (size_t n = first; n < first + (size_t)count; n++) {
        place(a, k, at, n);
        k->cell[n] = at * WF_QUARTERS + quarter;
    }
    k->count += (size_t)count;
    return true;
}

/* Samples first <= n < first + count, which are as late as each other. */
static bool trace(const wf_adaptive *a, wf_adaptive_samples *k, double late, size_t first,
                  size_t count) {
    for (size_t i = 0; i < count; i++) {
        a->c->trace_x[i] = (double)k->x[first + i];
        a->c->trace_y[i] = (double)k->y[first + i];
        a->c->trace_f[i] = wf_window_fraction(a->s, (double)k->t[first + i], late,
                                              (double)k->fraction[first + i]);
    }
    const wf_trace_samples traced = {
        .count = count,
        .x = a->c->trace_x,
        .y = a->c->trace_y,
        .f = a->c->trace_f,
        .late_s = a->s->periods ? 0 : late * wf_ratio_value(wf_sampling_period(a->s)),
        .rgb = {k->rgb[0] + first, k->rgb[1] + first, k->rgb[2] + first}};
    return wf_trace(a->s->tracer, a->c->trace, &traced);
}

static double late_of(const wf_adaptive *a, const wf_adaptive_samples *k, size_t sample) {
    return a->time[k->cell[sample] / WF_QUARTERS / GRID_WIDTH].late;
}

/* Whole packets, whichever rows their samples are of. */
bool wf_points_trace(const wf_adaptive *a, wf_adaptive_samples *k, size_t first) {
    for (size_t end; first < k->count; first = end) {
        double late = late_of(a, k, first);
        for (end = first + 1; end < k->count && end - first < a->c->capacity;)
            if (late_of(a, k, end++) != late) {
                end--;
                break;
            }
        if (!trace(a, k, late, first, end - first)) return false;
    }
    return true;
}

static void add_up(wf_adaptive *a, size_t first) {
    const wf_adaptive_samples *k = &a->c->kept;
    for (size_t n = first; n < k->count; n++) {
        wf_adaptive_cell *cell = &a->cell[k->cell[n] / WF_QUARTERS];
        int quarter = k->cell[n] % WF_QUARTERS;
        for (int c = 0; c < 3; c++) {
            float v = k->rgb[c][n];
            cell->sum[quarter][c] += (double)v;
            cell->low[c] = v < cell->low[c] ? v : cell->low[c];
            cell->high[c] = v > cell->high[c] ? v : cell->high[c];
        }
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
    for (int k = 0; !was && k < 3; k++) c->low[k] = HUGE_VALF, c->high[k] = -HUGE_VALF;
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
    add_up(a, first);
    return true;
}

/* ---- Handing over ---- */

void wf_points_hand_over(const wf_adaptive *a, const wf_adaptive_samples *k) {
    const wf_samples samples = {.count = k->count,
                                .x = k->x,
                                .y = k->y,
                                .t = k->t,
                                .field = a->s->field,
                                .rgb = {k->rgb[0], k->rgb[1], k->rgb[2]},
                                .weight = k->weight};
    if (k->count) a->tile->receiver->samples(a->tile->receiver->user, &samples);
}

/* Leaves out the samples of cells whose edge is known, and of those beside the tile. */
static void drop(wf_adaptive_samples *k, const wf_adaptive *a) {
    float **column[COLUMNS];
    size_t left = 0;
    find_columns(k, column);
    for (size_t n = 0; n < k->count; n++) {
        int at = k->cell[n] / WF_QUARTERS;
        if (!a->cell[at].own || a->edge[at].found) continue;
        for (int c = 0; c < COLUMNS; c++) (*column[c])[left] = (*column[c])[n];
        k->cell[left++] = k->cell[n];
    }
    k->count = left;
}

/* Cells count alike, however many samples they have. */
void wf_points_emit(const wf_adaptive *a) {
    wf_adaptive_samples *k = &a->c->kept;
    drop(k, a);
    for (size_t n = 0; n < k->count; n++)
        k->weight[n] = (float)(1.0 / (WF_QUARTERS * a->cell[k->cell[n] / WF_QUARTERS].each));
    wf_points_hand_over(a, k);
}
