/* Heat maps: the RMS of what is measured, pixel by pixel. */
#include "convert/check/heat.h"

#include <math.h>
#include <stdlib.h>

bool wf_heat_init(wf_heat *heat, size_t samples) {
    heat->samples = samples;
    heat->square = calloc(samples, sizeof *heat->square);
    heat->seen = calloc(samples, sizeof *heat->seen);
    return heat->square && heat->seen;
}

void wf_heat_free(wf_heat *heat) {
    free(heat->square);
    free(heat->seen);
    *heat = (wf_heat){0};
}

void wf_heat_add(wf_heat *heat, size_t at, float value) {
    if (!heat->square) return;
    heat->square[at] += value * value;
    heat->seen[at]++;
}

float *wf_heat_take(wf_heat *heat) {
    float *map = heat->square;
    for (size_t i = 0; map && i < heat->samples; i++)
        map[i] = heat->seen[i] ? sqrtf(map[i] / (float)heat->seen[i]) : 0;
    heat->square = NULL;
    return map;
}

double wf_heat_top(double value) {
    static const double steps[] = {0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50};
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++)
        if (value <= steps[i]) return steps[i];
    return isnan(value) ? 1 : 100;
}
