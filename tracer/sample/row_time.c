/* Which fields and lines a row of the raster serves, and the time in which its samples lie. */
#include "tracer/sample/row_time.h"

#include <math.h>

wf_rational wf_sampling_period(const wf_sampling *s) {
    return wf_raster_field_period(&s->raster);
}

int wf_fields_of_unit(const wf_sampling *s) {
    bool shared = s->raster.scan == WF_SEGMENTED || s->raster.pulldown;
    return shared ? wf_raster_fields_per_frame(&s->raster) : 1;
}

void wf_lines_of_row(const wf_sampling *s, int64_t field, int row, int *first, int *end) {
    wf_gather_lines(&s->desc.gather, field, row, row + 1, first, end);
    double reach = s->desc.gather.aperture.reach_v;
    int step = wf_raster_line_step(&s->raster), parity = wf_raster_parity(&s->raster, field);
    /* Lines that only the row's very edge touches need no samples of it. */
    while (*first < *end && parity + *first * step + 0.5 + reach <= row) ++*first;
    while (*first < *end && parity + (*end - 1) * step + 0.5 - reach >= row + 1) --*end;
}

double wf_late_of_line(const wf_sampling *s, double line) {
    return s->skew * line / s->raster.lines;
}

bool wf_find_row_time(const wf_sampling *s, int row, wf_row_time *time) {
    int step = wf_raster_line_step(&s->raster);
    double low = HUGE_VAL, high = -HUGE_VAL;
    *time = (wf_row_time){s->start, s->start + 1, 0};
    if (s->periods) return true;
    for (int n = 0; n < wf_fields_of_unit(s); n++) {
        int first, end, parity = wf_raster_parity(&s->raster, s->field + n);
        wf_lines_of_row(s, s->field + n, row, &first, &end);
        if (first >= end) continue;
        low = fmin(low, wf_late_of_line(s, parity + first * step));
        high = fmax(high, wf_late_of_line(s, parity + (end - 1) * step));
    }
    if (low > high) return false;
    *time = (wf_row_time){s->start + low, s->start + s->tau + high, (low + high) / 2};
    return true;
}

double wf_window_fraction(const wf_sampling *s, double t, double late, double f) {
    if (s->periods) return t;
    return s->tau > 0 ? (t - late - s->start) / s->tau : f;
}
