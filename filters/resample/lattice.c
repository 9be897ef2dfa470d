/* One axis of the lattice of input cells, in whole ticks. */
#include "filters/resample/lattice.h"

#include <math.h>

bool wf_axis_init(wf_axis *axis, const wf_fitting *fitting) {
    /* Keeps every product of a tick count and a number of cells or pixels inside 64 bits. */
    int64_t most = fitting->cells > fitting->pixels ? fitting->cells : fitting->pixels;
    int64_t limit = INT64_MAX / 16 / (most + 16);
    int64_t den = fitting->cell.den, num = fitting->cell.num;
    if (den <= 0 || num <= 0 || num > limit || den > limit) return false;
    *axis = (wf_axis){
        .unit = 2 * den,
        .cell = 2 * num,
        .origin = den * fitting->pixels - num * fitting->cells,
        .cells = fitting->cells,
        .pixels = fitting->pixels,
        .padded = fitting->padded,
    };
    return true;
}

static int64_t center_tick(const wf_axis *axis, int i) {
    return i * axis->unit + axis->unit / 2;
}

wf_span wf_axis_reach(const wf_axis *axis, double reach, int i) {
    int64_t half = (int64_t)lround(2 * reach) * (axis->unit / 2);
    int64_t center = center_tick(axis, i) - axis->origin;
    return (wf_span){(int)wf_floor_div(center - half, axis->cell),
                     (int)-wf_floor_div(-(center + half), axis->cell)};
}

static double from_center(const wf_axis *axis, int64_t tick, int i) {
    return (double)(tick - center_tick(axis, i)) / (double)axis->unit;
}

double wf_axis_edge(const wf_axis *axis, int a, int i) {
    return from_center(axis, axis->origin + a * axis->cell, i);
}

double wf_axis_edge_in_picture(const wf_axis *axis, int a, int i) {
    int64_t tick = axis->origin + a * axis->cell, end = axis->pixels * axis->unit;
    if (axis->padded && (a < 0 || a > axis->cells))
        tick = tick < 0 ? 0 : tick > end ? end : tick;
    return from_center(axis, tick, i);
}

bool wf_axis_inside(const wf_axis *axis, int a) {
    return a >= 0 && a < axis->cells;
}

int wf_axis_phases(const wf_axis *axis) {
    int64_t phases = wf_ratio(axis->cell, axis->unit).num;
    return phases < axis->pixels ? (int)phases : axis->pixels;
}
