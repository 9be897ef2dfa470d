/* Cells sampled at points, as many as each place needs. */
#include <stdlib.h>

#include "tracer/sampling_inside.h"

/* Samples of a quarter to begin with, times the error asked for: a part of a cell that none of
 * them sees may be as large as the share of one. */
#define FIRST_SHARE 0.04

/* ---- Room ---- */

void wf_points_free(wf_adaptive_samples *k) {
    for (int n = 0; n < 7; n++) free(k->v[n]);
    free(k->cell);
    *k = (wf_adaptive_samples){0};
}

static bool make_room(wf_adaptive_samples *k, size_t more) {
    if (k->count + more <= k->room) return true;
    size_t room = 2 * (k->count + more);
    int *cells = realloc(k->cell, room * sizeof *cells);
    if (!cells) return false;
    k->cell = cells;
    for (int n = 0; n < 7; n++) {
        float *grown = realloc(k->v[n], room * sizeof *grown);
        if (!grown) return false;
        k->v[n] = grown;
    }
    k->room = room;
    return true;
}

/* ---- Samples ---- */

/* A piece of one quarter of one cell, to be traced with others of its row. Until then the place
 * of the weight holds the sample's number in the window. */
static bool draw(wf_adaptive *a, int at, int quarter, int from, int count) {
    wf_adaptive_samples *k = &a->c->kept;
    int i = a->tile->x0 + at % TILE_WIDTH, j = a->first + at / TILE_WIDTH;
    wf_row_time time = a->time[at / TILE_WIDTH];
    if (!make_room(k, (size_t)count)) return false;
    size_t first = k->count;
    wf_sampler_draw_more(a->s->sampler, (wf_cell){a->tile->time, i, j, 0}, from, count,
                         k->v[0] + first, k->v[1] + first, k->v[6] + first);
    for (size_t n = first; n < first + (size_t)count; n++) {
        double t = time.from + (double)k->v[6][n] * (time.to - time.from);
        k->v[0][n] = wf_in_cell(k->v[0][n], i);
        k->v[1][n] = wf_in_cell(k->v[1][n], j);
        k->v[2][n] = (float)wf_on_time_grid(t);
        k->cell[n] = at * WF_QUARTERS + quarter;
    }
    k->count += (size_t)count;
    return true;
}

/* Samples first <= n < first + count, which are as late as each other. */
static bool trace(wf_adaptive *a, double late, size_t first, size_t count) {
    wf_adaptive_samples *k = &a->c->kept;
    for (size_t i = 0; i < count; i++) {
        a->c->trace_x[i] = (double)k->v[0][first + i];
        a->c->trace_y[i] = (double)k->v[1][first + i];
        a->c->trace_f[i] = wf_window_fraction(a->s, (double)k->v[2][first + i], late,
                                              (double)k->v[6][first + i]);
    }
    const wf_trace_samples traced = {
        .count = count,
        .x = a->c->trace_x,
        .y = a->c->trace_y,
        .f = a->c->trace_f,
        .late_s = a->s->periods ? 0 : late * wf_ratio_value(wf_sampling_period(a->s)),
        .rgb = {k->v[3] + first, k->v[4] + first, k->v[5] + first}};
    if (!wf_trace(a->s->tracer, a->c->trace, &traced)) return false;
    for (size_t n = first; n < first + count; n++) {
        wf_adaptive_cell *cell = &a->cell[k->cell[n] / WF_QUARTERS];
        int quarter = k->cell[n] % WF_QUARTERS;
        for (int c = 0; c < 3; c++) cell->sum[quarter][c] += (double)k->v[3 + c][n];
    }
    return true;
}

static double late_of(const wf_adaptive *a, size_t sample) {
    return a->time[a->c->kept.cell[sample] / WF_QUARTERS / TILE_WIDTH].late;
}

/* Whole packets, whichever rows their samples are of. */
static bool trace_from(wf_adaptive *a, size_t first) {
    const wf_adaptive_samples *k = &a->c->kept;
    for (size_t end; first < k->count; first = end) {
        double late = late_of(a, first);
        for (end = first + 1; end < k->count && end - first < a->c->room;)
            if (late_of(a, end++) != late) {
                end--;
                break;
            }
        if (!trace(a, late, first, end - first)) return false;
    }
    return true;
}

static int first_each(const wf_adaptive *a) {
    int each = 2;
    while (each < WF_MOST_EACH && each * a->s->desc.error < FIRST_SHARE) each *= 2;
    return each;
}

/* The quarters that a cell has become halves: pairs are taken together, and as many new samples
 * are the other half. */
static bool draw_cell(wf_adaptive *a, int at) {
    wf_adaptive_cell *c = &a->cell[at];
    int was = c->each, first = was ? WF_QUARTERS / 2 : 0;
    c->each = was ? 2 * was : first_each(a);
    for (int k = 0; was && k < 3; k++) {
        for (int quarter = 0; quarter < WF_QUARTERS / 2; quarter++)
            c->sum[quarter][k] = c->sum[2 * quarter][k] + c->sum[2 * quarter + 1][k];
        for (int quarter = WF_QUARTERS / 2; quarter < WF_QUARTERS; quarter++)
            c->sum[quarter][k] = 0;
    }
    for (int quarter = first; quarter < WF_QUARTERS; quarter++)
        if (!draw(a, at, quarter, quarter * c->each, c->each)) return false;
    return true;
}

bool wf_points_draw(wf_adaptive *a) {
    size_t first = a->c->kept.count;
    for (int at = 0; at < TILE_CELLS; at++) {
        if (a->more[at] && !draw_cell(a, at)) return false;
    }
    return trace_from(a, first);
}

/* Cells count alike, however many samples they have. */
void wf_points_emit(const wf_adaptive *a) {
    const wf_adaptive_samples *k = &a->c->kept;
    for (size_t n = 0; n < k->count; n++)
        k->v[6][n] = (float)(1.0 / (WF_QUARTERS * a->cell[k->cell[n] / WF_QUARTERS].each));
    const wf_samples samples = {.count = k->count,
                                .x = k->v[0],
                                .y = k->v[1],
                                .t = k->v[2],
                                .field = a->s->field,
                                .rgb = {k->v[3], k->v[4], k->v[5]},
                                .weight = k->v[6]};
    if (k->count) a->tile->receiver->samples(a->tile->receiver->user, &samples);
}
