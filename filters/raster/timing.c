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

/* ---- Cells of one length ---- */

/* The cell that holds an instant: below 0 or beyond the last where none does. */
static wf_ticks even_cell_at(const wf_timing *t, wf_ticks instant) {
    return floor_div(instant - t->cell_zero, t->cell);
}

/* The first cell that begins at an instant or later. */
static wf_ticks even_cell_from(const wf_timing *t, wf_ticks instant) {
    return -floor_div(t->cell_zero - instant, t->cell);
}

/* ---- Cells with edges ---- */

/* < 0, 0, > 0 where an edge lies before, at or after an instant. Products fit, which
 * edges_are_coarse has seen to. */
static int order(const wf_timing *t, wf_rational edge, wf_ticks instant) {
    wf_ticks left = edge.num * t->tick_rate, right = instant * edge.den;
    return (left > right) - (left < right);
}

static wf_rational edge_at(const wf_timing *t, int64_t k) {
    return t->edges[k - t->edges_from];
}

/* How many edges, of subframes + 1, lie before an instant; with `at` those too that lie at it.
 */
static int64_t edges_before(const wf_timing *t, wf_ticks instant, bool at) {
    int64_t low = t->edges_from, high = t->subframes + 1;
    while (low < high) {
        int64_t middle = low + (high - low) / 2;
        if (order(t, edge_at(t, middle), instant) < (at ? 1 : 0))
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* A field is at most the 2^27th, and 127 bits hold what edges and instants are compared by. */
static bool edges_are_coarse(const wf_rational *edges, int64_t count, wf_ticks tick_rate) {
    for (int64_t k = 0; k < count; k++)
        if (tick_rate > ((wf_ticks)1 << 98) / edges[k].den) return false;
    return true;
}

static bool complain(char *why, size_t why_size, const char *text) {
    snprintf(why, why_size, "%s", text);
    return false;
}

/* Times become the midpoints between them in place, the first as far before the first time as
 * the second after it. */
static void move_to_midpoints(wf_rational *edges, int64_t count) {
    const wf_rational half = {1, 2};
    wf_rational before = wf_ratio_mul(wf_ratio_difference(edges[1], edges[0]), half);
    for (int64_t k = count; k > 0; k--)
        edges[k] = wf_ratio_mul(wf_ratio_sum(edges[k - 1], edges[k]), half);
    edges[0] = wf_ratio_difference(edges[0], before);
}

bool wf_timing_edges(const wf_raster *raster, const wf_rational *times_s, int64_t count,
                     bool center, wf_rational *edges, char *why, size_t why_size) {
    wf_rational period = wf_raster_field_period(raster);
    for (int64_t k = 0; k <= count; k++)
        edges[k] = wf_ratio_div(wf_ratio_difference(times_s[k], times_s[0]), period);
    if (center) move_to_midpoints(edges, count);
    for (int64_t k = 0; k <= count; k++) {
        if (!wf_ratio_given(edges[k]))
            return complain(why, why_size,
                            "the pictures' times are too fine to be counted exactly; give them "
                            "with fewer digits");
        if (k && wf_ratio_difference(edges[k], edges[k - 1]).num <= 0)
            return complain(why, why_size, "the pictures' times do not ascend");
    }
    return true;
}

/* ---- The timing ---- */

static bool refuse_fine(const wf_timing_desc *desc, char *why, size_t why_size) {
    snprintf(
        why, why_size,
        "subframe rate %lld/%lld, temporal width %lld/%lld and scan skew %lld/%lld are too "
        "fine to be counted exactly together; give them with fewer digits",
        (long long)desc->subframe_rate.num, (long long)desc->subframe_rate.den,
        (long long)desc->width.num, (long long)desc->width.den, (long long)desc->skew.num,
        (long long)desc->skew.den);
    return false;
}

/* All but the cells, of which a tick is a whole part. */
static void set_windows(wf_timing *timing, const wf_timing_desc *desc, wf_ticks rate) {
    wf_ticks width = scaled(desc->width, rate);
    int half_widths = (int)(2 * wf_position_anchor(desc->position)); /* width is even */
    wf_ticks lines = desc->skew.num ? desc->raster->lines : 1;
    *timing = (wf_timing){
        .tick_rate = rate,
        .width = width,
        .opens = -half_widths * (width / 2),
        .skew_line = scaled(desc->skew, rate) / lines,
        .subframes = desc->subframes,
        .raster = desc->raster,
    };
}

/* How many frames fit into so many field periods. */
static int64_t frames_in(const wf_raster *raster, wf_rational periods) {
    wf_rational frame = wf_ratio_mul(raster->frame_rate, wf_raster_field_period(raster));
    wf_rational frames = wf_ratio_mul(periods, frame);
    return wf_ratio_given(frames) && frames.num > 0 ? frames.num / frames.den : 0;
}

static bool set_edges(wf_timing *timing, const wf_timing_desc *desc, wf_ticks rate, char *why,
                      size_t why_size) {
    if (!edges_are_coarse(desc->edges, desc->subframes - desc->edges_from + 1, rate))
        return complain(
            why, why_size,
            "the pictures' times, the temporal width and the scan skew are too fine "
            "to be counted exactly together; give them with fewer digits");
    set_windows(timing, desc, rate);
    timing->edges = desc->edges;
    timing->edges_from = desc->edges_from;
    timing->least_frames = frames_in(desc->raster, desc->shown);
    return true;
}

bool wf_timing_init(wf_timing *timing, const wf_timing_desc *desc, char *why, size_t why_size) {
    wf_ticks lines = desc->skew.num ? desc->raster->lines : 1;
    wf_ticks rate = 2 * (wf_ticks)desc->width.den, finest = FINEST_TICK_RATE;
    if (desc->edges)
        return rate <= finest / desc->skew.den / lines
                   ? set_edges(timing, desc, rate * desc->skew.den * lines, why, why_size)
                   : refuse_fine(desc, why, why_size);
    wf_rational period = wf_raster_field_period(desc->raster);
    wf_rational cell = wf_ratio_div(wf_ratio(1, 1), wf_ratio_mul(desc->subframe_rate, period));
    rate *= cell.den;
    if (!cell.den || rate > finest / desc->skew.den / lines)
        return refuse_fine(desc, why, why_size);
    rate *= desc->skew.den * lines;
    set_windows(timing, desc, rate);
    timing->cell = scaled(cell, rate);
    timing->cell_zero = desc->subframe_center ? -timing->cell / 2 : 0;
    wf_rational frames = wf_ratio_div(desc->raster->frame_rate, desc->subframe_rate);
    timing->least_frames =
        wf_ratio_given(frames) ? wf_ratio_floor_mul(frames, desc->subframes) : 0;
    return true;
}

bool wf_timing_set_edges(wf_timing *t, const wf_rational *edges, int64_t from,
                         int64_t subframes) {
    const wf_ticks finest = (wf_ticks)1 << 94; /* for WF_EDGE_UNKNOWN, far beyond others */
    t->edges = edges;
    t->edges_from = from;
    t->subframes = subframes;
    return t->tick_rate <= finest &&
           edges_are_coarse(edges, subframes - from + 1, t->tick_rate);
}

/* ---- Windows ---- */

static wf_ticks window_start(const wf_timing *t, int64_t field, int line) {
    return wf_raster_instant(t->raster, field) * t->tick_rate + t->opens + line * t->skew_line;
}

/* The cell that holds an instant: below 0 or beyond the last where none does. */
static wf_ticks cell_at(const wf_timing *t, wf_ticks instant) {
    return t->edges ? edges_before(t, instant, true) - 1 : even_cell_at(t, instant);
}

/* The first cell that begins at an instant or later. */
static wf_ticks cell_from(const wf_timing *t, wf_ticks instant) {
    return t->edges ? edges_before(t, instant, false) : even_cell_from(t, instant);
}

wf_window wf_timing_window(const wf_timing *t, int64_t field, int line) {
    wf_ticks start = window_start(t, field, line), end = start + t->width;
    wf_ticks last_cell = t->subframes - 1;
    wf_ticks first = cell_at(t, start), past = cell_from(t, end);
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

/* From the window's center to an edge, held to the window. */
static double from_center(const wf_timing *t, wf_rational edge, wf_ticks start) {
    wf_ticks center = start + t->width / 2;
    if (order(t, edge, start) <= 0) return (double)(start - center) / (double)t->tick_rate;
    if (order(t, edge, start + t->width) >= 0)
        return (double)(start + t->width - center) / (double)t->tick_rate;
    return (double)(edge.num * t->tick_rate - center * edge.den) /
           ((double)edge.den * (double)t->tick_rate);
}

void wf_timing_cell(const wf_timing *t, int64_t field, int line, int64_t k, double *q0,
                    double *q1) {
    wf_ticks start = window_start(t, field, line);
    if (t->edges) {
        *q0 = from_center(t, edge_at(t, k), start);
        *q1 = from_center(t, edge_at(t, k + 1), start);
        return;
    }
    wf_ticks cell = t->cell_zero + k * t->cell, center = start + t->width / 2;
    wf_ticks from = clamp(cell, start, start + t->width);
    wf_ticks to = clamp(cell + t->cell, start, start + t->width);
    *q0 = (double)(from - center) / (double)t->tick_rate;
    *q1 = (double)(to - center) / (double)t->tick_rate;
}

/* ---- Frames ---- */

/* < 0, 0, > 0 where the last cell ends before, at or after an instant. */
static int end_order(const wf_timing *t, wf_ticks instant) {
    if (t->edges) return order(t, edge_at(t, t->subframes), instant);
    wf_ticks end = t->cell_zero + t->subframes * t->cell;
    return (end > instant) - (end < instant);
}

/* < 0, 0, > 0 where the last cell ends before, at or after the last window of a frame does. */
static int last_window_order(const wf_timing *t, int64_t frame) {
    int fields = wf_raster_fields_per_frame(t->raster);
    int64_t last = frame * fields + fields - 1;
    return end_order(t, window_start(t, last, t->raster->lines - 1) + t->width);
}

static bool is_whole(const wf_timing *t, int64_t frame) {
    int64_t first = frame * wf_raster_fields_per_frame(t->raster);
    if (end_order(t, wf_raster_instant(t->raster, first) * t->tick_rate) <= 0) return false;
    int end = last_window_order(t, frame);
    return t->width ? end >= 0 : end > 0;
}

bool wf_timing_covers(const wf_timing_desc *desc, int64_t frame) {
    wf_timing timing;
    char why[512];
    return wf_timing_init(&timing, desc, why, sizeof why) && timing.width &&
           last_window_order(&timing, frame) >= 0;
}

/* Windows of later frames are later, so that a frame that is not whole is the last to ask. */
int64_t wf_timing_frames(const wf_timing_desc *desc) {
    wf_timing timing;
    char why[512];
    if (!wf_timing_init(&timing, desc, why, sizeof why)) return 0;
    int64_t frames = timing.least_frames;
    while (is_whole(&timing, frames)) frames++;
    return frames;
}
