/* Whole pictures at an instant, sampled in a regular grid. */
#include "tracer/sample/sampling_inside.h"

bool wf_sampling_subframe(wf_sampling *s, wf_rational time_s) {
    const wf_window_of_time window = {.base_s = time_s};
    return wf_tracer_look(s->tracer, &window, s->desc.skip);
}

/* Samples are taken at the middles of the picture's own pixels. */
static bool trace_stretch(const wf_sampling *s, wf_sampling_scratch *c, const double cell[2],
                          int first, int count, int row, float *rgba) {
    const wf_trace_samples traced = {.count = (size_t)count,
                                     .x = c->trace_x,
                                     .y = c->trace_y,
                                     .f = c->trace_f,
                                     .rgb = {c->rgb[0], c->rgb[1], c->rgb[2]},
                                     .alpha = c->alpha};
    for (int i = 0; i < count; i++) {
        c->trace_x[i] = (first + i + 0.5) * cell[0];
        c->trace_y[i] = (row + 0.5) * cell[1];
        c->trace_f[i] = 0;
    }
    if (!wf_trace(s->tracer, c->trace, &traced)) return false;
    for (int i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++) rgba[4 * (first + i) + k] = c->rgb[k][i];
        rgba[4 * (first + i) + 3] = c->alpha[i];
    }
    return true;
}

bool wf_sampling_subframe_rows(const wf_sampling *s, wf_sampling_scratch *c, int across,
                               int down, int first, int end, float *rgba) {
    const double cell[2] = {(double)s->raster.width_px / across,
                            (double)s->raster.lines / down};
    int most = c->capacity < 256 ? (int)c->capacity : 256;
    for (int x = 0; x < across; x += most) {
        int count = across - x < most ? across - x : most;
        const double xs[2] = {x * cell[0], (x + count) * cell[0]};
        const double ys[2] = {first * cell[1], end * cell[1]};
        bool empty;
        if (!wf_trace_prepare(s->tracer, c->trace, xs, ys, &empty)) return false;
        for (int row = first; row < end; row++)
            if (!trace_stretch(s, c, cell, x, count, row,
                               rgba + (size_t)(row - first) * 4 * (size_t)across))
                return false;
    }
    return true;
}
