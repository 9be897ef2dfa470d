/* As many samples as each place needs. A cell's samples are one scrambled Sobol sequence, whose
 * quarters are sequences of their own: how far their means lie apart says how far the mean of
 * all may be from the truth, and rather too much, since all together lie more evenly than four
 * that know nothing of each other would. Where that is too far, for the cell itself or one
 * beside it, the cell's samples are doubled; nothing drawn is drawn in vain. */
#include <math.h>

#include "tracer/sampling_inside.h"

/* The spread of four is often found too small; what is asked of it is so much less. */
#define CAUTION 0.7

/* ---- Errors ---- */

double wf_display_steepness(double v) {
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

static double mean_of(const wf_adaptive_cell *c, int quarter, int channel) {
    return c->sum[quarter][channel] / c->each;
}

static void find_error(const wf_adaptive *a, wf_adaptive_cell *c) {
    double square = 0;
    for (int k = 0; k < 3; k++) {
        double mean = 0, spread = 0;
        for (int quarter = 0; quarter < WF_QUARTERS; quarter++)
            mean += mean_of(c, quarter, k) / WF_QUARTERS;
        for (int quarter = 0; quarter < WF_QUARTERS; quarter++) {
            double apart = mean_of(c, quarter, k) - mean;
            spread += apart * apart;
        }
        double steep = wf_display_steepness(mean);
        square += spread / (WF_QUARTERS * (WF_QUARTERS - 1)) * steep * steep / 3;
    }
    c->error = square * share_of(&a->s->desc.gather.aperture);
}

/* The largest of a cell's and its neighbours': an edge that all quarters missed here was seen
 * next door. */
static double error_about(const wf_adaptive *a, int row, int column) {
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

static bool want_more(wf_adaptive *a) {
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

static bool draw_round(wf_adaptive *a) {
    if (!wf_points_draw(a)) return false;
    for (int at = 0; at < TILE_CELLS; at++)
        if (a->more[at]) find_error(a, &a->cell[at]);
    return true;
}

static void sum_errors(const wf_adaptive *a) {
    for (int row = 0; row < a->rows; row++)
        for (int i = 0; a->needed[row] && i < a->width; i++) {
            a->c->error.square += error_about(a, row, i);
            a->c->error.cells++;
        }
}

bool wf_adaptive_tile(const wf_tile *tile, int first, int end, bool empty) {
    wf_adaptive a = {.tile = tile, .s = tile->s, .c = tile->c, .first = first};
    a.rows = end - first;
    a.width = tile->x1 - tile->x0;
    a.c->kept.count = 0;
    for (int row = 0; row < a.rows; row++) {
        a.needed[row] = wf_find_row_time(a.s, first + row, &a.time[row]);
        for (int i = 0; i < a.width; i++) a.more[row * TILE_WIDTH + i] = a.needed[row];
    }
    do {
        if (!draw_round(&a)) return false;
    } while (!empty && want_more(&a));
    wf_points_emit(&a);
    sum_errors(&a);
    return true;
}
