/* Windows of fields and cells of subframes, counted in ticks. */
#include "filters/raster/timing.h"

#include <stdio.h>

double wf_position_anchor(wf_position position) {
    static const double anchors[] = {[WF_START] = 0, [WF_CENTER] = 0.5, [WF_END] = 1};
    return anchors[position];
}

/* Ticks stay below this at field 10^8, far inside 127 bits. */
#define FINEST_TICK_RATE ((wf_ticks)1 << 96)

static wf_ticks floor_div(wf_ticks a, wf_ticks b) {
    wf_ticks quotient = a / b;
    return quotient - (a % b < 0 ? 1 : 0);
}

static wf_ticks clamp(wf_ticks value, wf_ticks low, wf_ticks high) {
    return value < low ? low : value > high ? high : value;
}

/* ratio * ticks, exact because ticks is a multiple of the denominator. */
static wf_ticks scaled(wf_rational ratio, wf_ticks ticks) {
    return ticks / ratio.den * ratio.num;
}

bool wf_timing_init(wf_timing *timing, const wf_timing_desc *desc, char *why, size_t why_size) {
    wf_rational period = wf_raster_field_period(desc->raster);
    wf_rational cell = wf_ratio_div(wf_ratio(1, 1), wf_ratio_mul(desc->subframe_rate, period));
    wf_ticks lines = desc->skew.num ? desc->raster->lines : 1;
    wf_ticks rate = 2 * (wf_ticks)cell.den * desc->width.den;
    if (!cell.den || rate > FINEST_TICK_RATE / desc->skew.den / lines) {
        snprintf(
            why, why_size,
            "subframe rate %lld/%lld, temporal width %lld/%lld and scan skew %lld/%lld are too "
            "fine to be counted exactly together; give them with fewer digits",
            (long long)desc->subframe_rate.num, (long long)desc->subframe_rate.den,
            (long long)desc->width.num, (long long)desc->width.den, (long long)desc->skew.num,
            (long long)desc->skew.den);
        return false;
    }
    rate *= desc->skew.den * lines;
    wf_ticks width = scaled(desc->width, rate);
    int half_widths = (int)(2 * wf_position_anchor(desc->position)); /* width is even */
    *timing = (wf_timing){
        .tick_rate = rate,
        .cell = scaled(cell, rate),
        .cell_zero = desc->subframe_center ? -scaled(cell, rate) / 2 : 0,
        .width = width,
        .opens = -half_widths * (width / 2),
        .skew_line = scaled(desc->skew, rate) / lines,
        .subframes = desc->subframes,
        .raster = desc->raster,
    };
    return true;
}

int64_t wf_timing_frames(const wf_timing_desc *desc) {
    wf_rational frames = wf_ratio_div(desc->raster->frame_rate, desc->subframe_rate);
    return wf_ratio_given(frames) ? wf_ratio_floor_mul(frames, desc->subframes) : 0;
}

static wf_ticks window_start(const wf_timing *t, int64_t field, int line) {
    return wf_raster_instant(t->raster, field) * t->tick_rate + t->opens + line * t->skew_line;
}

wf_window wf_timing_window(const wf_timing *t, int64_t field, int line) {
    wf_ticks start = window_start(t, field, line) - t->cell_zero, end = start + t->width;
    wf_ticks last_cell = t->subframes - 1;
    wf_ticks first = floor_div(start, t->cell), past = -floor_div(-end, t->cell);
    if (t->width > 0) {
        wf_ticks from = first < 0 ? 0 : first, to = past > t->subframes ? t->subframes : past;
        if (from < to) return (wf_window){(int64_t)from, (int64_t)(to - from), false};
    }
    return (wf_window){(int64_t)clamp(first, 0, last_cell), 1, true};
}

wf_window wf_timing_field(const wf_timing *t, int64_t field, int lines) {
    wf_window top = wf_timing_window(t, field, 0);
    if (!t->skew_line) return top;
    wf_window bottom = wf_timing_window(t, field, lines - 1);
    return (wf_window){top.first, bottom.first + bottom.count - top.first,
                       top.alone && bottom.alone};
}

void wf_timing_seconds(const wf_timing *t, int64_t field, int lines, double *from, double *to) {
    double tick = wf_ratio_value(wf_raster_field_period(t->raster)) / (double)t->tick_rate;
    *from = (double)window_start(t, field, 0) * tick;
    *to = (double)(window_start(t, field, lines - 1) + t->width) * tick;
}

void wf_timing_cell(const wf_timing *t, int64_t field, int line, int64_t k, double *q0,
                    double *q1) {
    wf_ticks start = window_start(t, field, line);
    wf_ticks cell = t->cell_zero + k * t->cell, center = start + t->width / 2;
    wf_ticks from = clamp(cell, start, start + t->width);
    wf_ticks to = clamp(cell + t->cell, start, start + t->width);
    *q0 = (double)(from - center) / (double)t->tick_rate;
    *q1 = (double)(to - center) / (double)t->tick_rate;
}
