/* A fixed number of samples for each cell of a tile. */
#include "tracer/sample/fixed.h"

#include <math.h>

#include "tracer/sample/row_time.h"

/* Whether a sample at y, q from a window's middle is within an aperture of any line of a field.
 */
static bool is_within(const wf_sampling *s, int64_t field, double y, double q) {
    int step = wf_raster_line_step(&s->raster), parity = wf_raster_parity(&s->raster, field);
    for (int l = (int)floor((y - parity) / step) - 1, n = 0; n < 3; n++, l++) {
        double v = y - (parity + l * step + 0.5);
        if (wf_aperture_value(&s->desc.gather.aperture, s->tau, 0, v, q) != 0) return true;
    }
    return false;
}

/* The diamonds leave gaps between them. */
static bool is_within_reach(const wf_sampling *s, double y, double t) {
    const wf_aperture *a = &s->desc.gather.aperture;
    if (!a->kind->couples_vq || !(s->tau > 0) || s->skew > 0 || s->periods) return true;
    double q = t - s->start - s->tau / 2;
    for (int n = 0; n < wf_fields_of_unit(s); n++)
        if (is_within(s, s->field + n, y, q)) return true;
    return false;
}

/* Adds the samples of a row's cells within the tile behind n others; set: which of several. */
static size_t draw_cells(const wf_tile *t, int row, wf_row_time time, int set, size_t n) {
    wf_sampling_scratch *c = t->c;
    size_t count = (size_t)t->s->desc.count;
    for (int i = t->x0; i < t->x1; i++) {
        size_t first = n;
        wf_sampler_draw(t->s->sampler, (wf_cell){t->time, i, row, set}, c->x + first,
                        c->y + first, c->f + first);
        for (size_t k = first; k < first + count; k++) {
            double at = wf_on_time_grid(time.from + (double)c->f[k] * (time.to - time.from));
            c->x[n] = wf_in_cell(c->x[k], i);
            c->y[n] = wf_in_cell(c->y[k], row);
            c->t[n] = (float)at;
            c->trace_x[n] = (double)c->x[n];
            c->trace_y[n] = (double)c->y[n];
            c->trace_f[n] = wf_window_fraction(t->s, at, time.late, (double)c->f[k]);
            n += is_within_reach(t->s, c->trace_y[n], at);
        }
    }
    return n;
}

/* Traces what is drawn, all as late, and hands it over. */
static bool trace_drawn(const wf_tile *t, double late, size_t count) {
    wf_sampling_scratch *c = t->c;
    const wf_trace_samples traced = {
        .count = count,
        .x = c->trace_x,
        .y = c->trace_y,
        .f = c->trace_f,
        .late_s = t->s->periods ? 0 : late * wf_ratio_value(wf_sampling_period(t->s)),
        .rgb = {c->rgb[0], c->rgb[1], c->rgb[2]},
        .alpha = c->alpha};
    if (!count) return true;
    if (!wf_trace(t->s->tracer, c->trace, &traced)) return false;
    const wf_samples samples = {.count = count,
                                .x = c->x,
                                .y = c->y,
                                .t = c->t,
                                .field = t->s->field,
                                .rgb = {c->rgb[0], c->rgb[1], c->rgb[2]},
                                .alpha = c->alpha};
    t->receiver->samples(t->receiver->user, &samples);
    return true;
}

/* An instant that goes down the picture is another one for each line. */
static bool trace_instants(const wf_tile *t, int64_t field, int row, int *set) {
    int step = wf_raster_line_step(&t->s->raster);
    int parity = wf_raster_parity(&t->s->raster, field), first, end;
    wf_lines_of_row(t->s, field, row, &first, &end);
    for (int l = first; l < end; l++) {
        double late = wf_late_of_line(t->s, parity + l * step);
        size_t count = draw_cells(t, row, (wf_row_time){late, late, late}, (*set)++, 0);
        if (!trace_drawn(t, late, count)) return false;
    }
    return true;
}

bool wf_fixed_instants(const wf_tile *t, int first, int end) {
    for (int row = first; row < end; row++)
        for (int n = 0, set = 0; n < wf_fields_of_unit(t->s); n++)
            if (!trace_instants(t, t->s->field + n, row, &set)) return false;
    return true;
}

/* Rows that are as late are traced together as far as the scratch holds: packets are filled. */
bool wf_fixed_rows(const wf_tile *t, int first, int end) {
    size_t drawn = 0, most = TILE_WIDTH * (size_t)t->s->desc.count;
    double late = 0;
    for (int row = first; row < end; row++) {
        wf_row_time time;
        if (!wf_find_row_time(t->s, row, &time)) continue;
        if (drawn && (time.late != late || drawn + most > t->c->capacity)) {
            if (!trace_drawn(t, late, drawn)) return false;
            drawn = 0;
        }
        late = time.late;
        drawn = draw_cells(t, row, time, 0, drawn);
    }
    return trace_drawn(t, late, drawn);
}
