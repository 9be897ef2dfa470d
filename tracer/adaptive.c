/* As many samples as each place needs. A cell is sampled by a few sets that know nothing of
 * each other: how far their means lie apart says how far the mean of all is from the truth.
 * Where that is too far, for the cell itself or one beside it, every set of the cell is
 * doubled; sets are pieces of one scrambled Sobol sequence each, so that nothing drawn is drawn
 * in vain. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tracer/sampling_inside.h"

#define FIRST_EACH 8 /* samples of a set to begin with */
#define CELLS      (TILE_WIDTH * TILE_HEIGHT)
/* Of four sets the spread is often found too small; what is asked of it is so much less. */
#define CAUTION 0.7
/* Sampling stops where the sets agree, also where they do so by chance: against converged
 * pictures the error was up to 1.8 times the spread. */
#define MARGIN 2.0

typedef struct cell {
    int each; /* samples of each set */
    double sum[WF_SETS][3];
    double error; /* of the mean, display-encoded; squared */
} cell;

typedef struct adaptive {
    const wf_tile *tile;
    const wf_sampling *s;
    wf_sampling_scratch *c;
    int first, rows, width;
    cell cell[CELLS];
    bool more[CELLS];
    wf_row_time time[TILE_HEIGHT];
    bool needed[TILE_HEIGHT];
} adaptive;

/* ---- Samples ---- */

void wf_adaptive_free(wf_adaptive_samples *k) {
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

/* A piece of one set of one cell, to be traced with others of its row. Until then the place of
 * the weight holds the sample's number in the window. */
static bool draw(adaptive *a, int at, int set, int from, int count) {
    wf_adaptive_samples *k = &a->c->kept;
    int i = a->tile->x0 + at % TILE_WIDTH, j = a->first + at / TILE_WIDTH;
    wf_row_time time = a->time[at / TILE_WIDTH];
    if (!make_room(k, (size_t)count)) return false;
    size_t first = k->count;
    wf_sampler_draw_more(a->s->sampler, (wf_cell){a->s->unit, i, j, set}, from, count,
                         k->v[0] + first, k->v[1] + first, k->v[6] + first);
    for (size_t n = first; n < first + (size_t)count; n++) {
        double t = time.from + (double)k->v[6][n] * (time.to - time.from);
        k->v[0][n] = wf_in_cell(k->v[0][n], i);
        k->v[1][n] = wf_in_cell(k->v[1][n], j);
        k->v[2][n] = (float)wf_on_time_grid(t);
        k->cell[n] = at * WF_SETS + set;
    }
    k->count += (size_t)count;
    return true;
}

static bool trace(adaptive *a, int row, size_t first, size_t count) {
    wf_adaptive_samples *k = &a->c->kept;
    for (size_t i = 0; i < count; i++) {
        a->c->trace_x[i] = (double)k->v[0][first + i];
        a->c->trace_y[i] = (double)k->v[1][first + i];
        a->c->trace_f[i] = wf_window_fraction(a->s, (double)k->v[2][first + i],
                                              a->time[row].late, (double)k->v[6][first + i]);
    }
    const wf_trace_samples traced = {
        .count = count,
        .x = a->c->trace_x,
        .y = a->c->trace_y,
        .f = a->c->trace_f,
        .late_s =
            a->s->periods ? 0 : a->time[row].late * wf_ratio_value(wf_sampling_period(a->s)),
        .rgb = {k->v[3] + first, k->v[4] + first, k->v[5] + first}};
    if (!wf_trace(a->s->tracer, a->c->trace, &traced)) return false;
    for (size_t n = first; n < first + count; n++)
        for (int c = 0; c < 3; c++)
            a->cell[k->cell[n] / WF_SETS].sum[k->cell[n] % WF_SETS][c] +=
                (double)k->v[3 + c][n];
    return true;
}

/* ---- Errors ---- */

/* How steep Rec. 709's transfer is at a value: what an error of light is on the display. */
static double steepness(double v) {
    return v < 0.018 ? 4.5 : 0.45 * 1.099 * pow(v, -0.55);
}

/* The part of a cell's error that is left in an output pixel, which sees several cells: the
 * integral of h squared over the square of h's, and more where the aperture's edge cuts cells.
 */
static double share_of(const wf_aperture *a) {
    static const double shares[WF_PROFILES] = {
        [WF_PROFILE_LINE] = 1,      [WF_PROFILE_BOX] = 0.5,      [WF_PROFILE_NOTCH] = 0.384,
        [WF_PROFILE_SHAPED] = 0.35, [WF_PROFILE_DIAMOND] = 0.75, [WF_PROFILE_MITCHELL] = 1};
    return shares[a->kind->profile];
}

static void find_error(const adaptive *a, cell *c) {
    double square = 0;
    for (int k = 0; k < 3; k++) {
        double mean = 0, spread = 0;
        for (int set = 0; set < WF_SETS; set++) mean += c->sum[set][k] / (WF_SETS * c->each);
        for (int set = 0; set < WF_SETS; set++) {
            double apart = c->sum[set][k] / c->each - mean;
            spread += apart * apart;
        }
        double steep = steepness(mean);
        square += spread / (WF_SETS * (WF_SETS - 1)) * steep * steep / 3;
    }
    c->error = square * share_of(&a->s->desc.gather.aperture);
}

/* The largest of a cell's and its neighbours': an edge that all sets missed here was seen next
 * door. */
static double error_about(const adaptive *a, int row, int column) {
    double most = 0;
    for (int r = row - 1; r <= row + 1; r++)
        for (int i = column - 1; i <= column + 1; i++) {
            if (r < 0 || r >= a->rows || i < 0 || i >= a->width || !a->needed[r]) continue;
            double error = a->cell[r * TILE_WIDTH + i].error;
            if (r != row || i != column) error /= 2;
            most = error > most ? error : most;
        }
    return most;
}

static bool want_more(adaptive *a) {
    double most = a->s->desc.error * CAUTION;
    bool any = false;
    for (int row = 0; row < a->rows; row++)
        for (int i = 0; i < a->width; i++) {
            int at = row * TILE_WIDTH + i;
            a->more[at] = a->needed[row] && a->cell[at].each < WF_MOST_EACH &&
                          error_about(a, row, i) > most * most;
            any |= a->more[at];
        }
    return any;
}

/* ---- Rounds ---- */

/* Draws the cells of a row that want it: their first samples, or as many again as there are. */
static bool draw_row(adaptive *a, int row) {
    size_t first = a->c->kept.count;
    for (int at = row * TILE_WIDTH; at < (row + 1) * TILE_WIDTH; at++) {
        cell *c = &a->cell[at];
        int more = c->each ? c->each : FIRST_EACH;
        for (int set = 0; a->more[at] && set < WF_SETS; set++)
            if (!draw(a, at, set, c->each, more)) return false;
        if (a->more[at]) c->each += more;
    }
    for (size_t end = a->c->kept.count; first < end;) {
        size_t count = end - first < a->c->room ? end - first : a->c->room;
        if (!trace(a, row, first, count)) return false;
        first += count;
    }
    return true;
}

static bool draw_round(adaptive *a) {
    for (int row = 0; row < a->rows; row++)
        if (!draw_row(a, row)) return false;
    for (int at = 0; at < CELLS; at++)
        if (a->more[at]) find_error(a, &a->cell[at]);
    return true;
}

/* Cells count alike, however many samples they have. */
static void emit_all(const adaptive *a) {
    const wf_adaptive_samples *k = &a->c->kept;
    for (size_t n = 0; n < k->count; n++)
        k->v[6][n] = (float)(1.0 / (WF_SETS * a->cell[k->cell[n] / WF_SETS].each));
    const wf_samples samples = {.count = k->count,
                                .x = k->v[0],
                                .y = k->v[1],
                                .t = k->v[2],
                                .field = a->s->field,
                                .rgb = {k->v[3], k->v[4], k->v[5]},
                                .weight = k->v[6]};
    if (k->count) a->tile->emit(a->tile->user, &samples);
}

static void sum_errors(const adaptive *a) {
    for (int row = 0; row < a->rows; row++)
        for (int i = 0; a->needed[row] && i < a->width; i++) {
            a->c->error.square += MARGIN * MARGIN * error_about(a, row, i);
            a->c->error.cells++;
        }
}

bool wf_adaptive_tile(const wf_tile *tile, int first, int end, const wf_trace_tile *found) {
    adaptive a = {.tile = tile, .s = tile->s, .c = tile->c, .first = first};
    a.rows = end - first;
    a.width = tile->x1 - tile->x0;
    a.c->kept.count = 0;
    for (int row = 0; row < a.rows; row++) {
        a.needed[row] = wf_find_row_time(a.s, first + row, &a.time[row]);
        for (int i = 0; i < a.width; i++) a.more[row * TILE_WIDTH + i] = a.needed[row];
    }
    do {
        if (!draw_round(&a)) return false;
    } while (!found->empty && want_more(&a));
    emit_all(&a);
    sum_errors(&a);
    return true;
}
