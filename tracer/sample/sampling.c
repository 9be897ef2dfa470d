#include "tracer/sample/sampling_inside.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Life ---- */

wf_rational wf_sampling_period(const wf_sampling *s) {
    return wf_raster_field_period(&s->raster);
}

/* Instants that go down the picture have few samples each and are never adaptive. */
static bool adapts(const wf_sampling *s) {
    return s->desc.error > 0 && !s->instants;
}

static bool make_parts(wf_sampling *s) {
    const wf_raster *r = &s->raster;
    const wf_view view = {r->width_px, r->lines, wf_ratio_value(r->pixel_aspect),
                          wf_ratio_value(wf_sampling_period(s))};
    s->tracer = wf_tracer_new(s->desc.scene, &view);
    int count = adapts(s) ? WF_QUARTERS * WF_MOST_EACH : s->desc.count;
    s->sampler = wf_sampler_new(s->desc.sampler, count, s->desc.seed);
    s->tile_error = calloc((size_t)wf_sampling_tiling(s).count, sizeof *s->tile_error);
    return s->tracer && s->sampler && s->tile_error;
}

wf_sampling *wf_sampling_new(const wf_sampling_desc *desc) {
    wf_sampling *s = calloc(1, sizeof *s);
    if (!s) return NULL;
    s->desc = *desc;
    s->raster = *desc->gather.raster;
    s->tau = wf_ratio_value(desc->gather.width);
    s->skew = wf_ratio_given(desc->gather.skew) ? wf_ratio_value(desc->gather.skew) : 0;
    s->anchor = wf_position_anchor(desc->gather.position);
    s->instants = s->skew > 0 && !(s->tau > 0); /* each line has one of its own */
    if (!make_parts(s)) {
        wf_sampling_free(s);
        return NULL;
    }
    /* A sample that two fields share would be at two fractions of their windows. */
    s->periods = s->tau > 1 && !wf_tracer_own_widths(s->tracer);
    return s;
}

void wf_sampling_free(wf_sampling *s) {
    if (!s) return;
    wf_tracer_free(s->tracer);
    wf_sampler_free(s->sampler);
    free(s->tile_error);
    free(s);
}

wf_sampling_scratch *wf_sampling_scratch_new(const wf_sampling *s) {
    wf_sampling_scratch *c = calloc(1, sizeof *c);
    if (!c) return NULL;
    size_t fixed = TILE_WIDTH * (size_t)s->desc.count;
    c->room = fixed > WF_MOST_EACH ? fixed : WF_MOST_EACH;
    float **const floats[] = {&c->x, &c->y, &c->f, &c->t, &c->rgb[0], &c->rgb[1], &c->rgb[2]};
    double **const doubles[] = {&c->trace_x, &c->trace_y, &c->trace_f};
    bool room = (c->trace = wf_trace_scratch_new(s->tracer)) != NULL;
    for (size_t n = 0; n < sizeof floats / sizeof *floats; n++)
        room = (*floats[n] = malloc(c->room * sizeof(float))) && room;
    for (size_t n = 0; n < sizeof doubles / sizeof *doubles; n++)
        room = (*doubles[n] = malloc(c->room * sizeof(double))) && room;
    if (room) return c;
    wf_sampling_scratch_free(c);
    return NULL;
}

void wf_sampling_scratch_free(wf_sampling_scratch *c) {
    if (!c) return;
    wf_trace_scratch_free(c->trace);
    float *const floats[] = {c->x, c->y, c->f, c->t, c->rgb[0], c->rgb[1], c->rgb[2]};
    double *const doubles[] = {c->trace_x, c->trace_y, c->trace_f};
    for (size_t n = 0; n < sizeof floats / sizeof *floats; n++) free(floats[n]);
    for (size_t n = 0; n < sizeof doubles / sizeof *doubles; n++) free(doubles[n]);
    wf_points_free(&c->kept);
    wf_points_free(&c->probes);
    wf_edges_free(&c->edges);
    free(c);
}

wf_error_sum wf_sampling_error(const wf_sampling_scratch *c) {
    return c->error;
}

wf_trace_counts wf_sampling_counted(const wf_sampling_scratch *c) {
    return wf_trace_counted(c->trace);
}

/* ---- Units of time ---- */

/* Periods begin at the instants of fields, wherever windows lie about them. */
void wf_sampling_units(const wf_sampling *s, int64_t field, int64_t *first, int64_t *last) {
    int64_t instant = wf_raster_instant(&s->raster, field);
    double from = -s->anchor * s->tau;
    *first = *last = instant;
    if (!s->periods) return;
    *first += (int64_t)floor(from);
    *last += (int64_t)ceil(from + s->tau + s->skew) - 1;
}

bool wf_sampling_look(wf_sampling *s, wf_sampling_scratch *c, int64_t unit) {
    wf_rational period = wf_sampling_period(s), base = wf_ratio(unit * period.num, period.den);
    const wf_window_of_time window = {.base_s = base,
                                      .width_fields = s->periods ? 1 : s->tau,
                                      .anchor = s->periods ? 0 : s->anchor,
                                      .late_s =
                                          s->periods ? 0 : s->skew * wf_ratio_value(period)};
    s->unit = unit;
    s->field = wf_raster_first_field(&s->raster, unit);
    s->start = s->periods ? 0 : -s->anchor * s->tau;
    if (!wf_tracer_look(s->tracer, &window, s->desc.skip)) return false;
    const double x[2] = {0, s->raster.width_px}, y[2] = {0, s->raster.lines};
    s->still = wf_trace_still(s->tracer, c->trace, x, y);
    s->nothing = wf_trace_nothing(s->tracer, c->trace, x, y);
    return true;
}

/* What a field sees of later periods is not known yet. */
bool wf_sampling_still(const wf_sampling *s) {
    return s->periods ? wf_tracer_still(s->tracer) : s->still;
}

bool wf_sampling_whole(const wf_sampling *s, int64_t field, int64_t unit) {
    double from = (double)(unit - wf_raster_instant(&s->raster, field)) + s->anchor * s->tau;
    return s->periods && !s->desc.gather.aperture.kind->couples_vq && from >= s->skew &&
           from + 1 <= s->tau;
}

/* ---- Rows ---- */

/* Fields that see the unit's first instant: both of a segmented frame, and those of film, of
 * whose three the last sees what the first does. */
static int fields_of_unit(const wf_sampling *s) {
    bool shared = s->raster.scan == WF_SEGMENTED || s->raster.pulldown;
    return shared ? wf_raster_fields_per_frame(&s->raster) : 1;
}

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
    for (int n = 0; n < fields_of_unit(s); n++)
        if (is_within(s, s->field + n, y, q)) return true;
    return false;
}

double wf_window_fraction(const wf_sampling *s, double t, double late, double f) {
    if (s->periods) return t;
    return s->tau > 0 ? (t - late - s->start) / s->tau : f;
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
        .rgb = {c->rgb[0], c->rgb[1], c->rgb[2]}};
    if (!count) return true;
    if (!wf_trace(t->s->tracer, c->trace, &traced)) return false;
    const wf_samples samples = {.count = count,
                                .x = c->x,
                                .y = c->y,
                                .t = c->t,
                                .field = t->s->field,
                                .rgb = {c->rgb[0], c->rgb[1], c->rgb[2]}};
    t->receiver->samples(t->receiver->user, &samples);
    return true;
}

/* Lines of a field that a row's samples can reach: first <= l < end. */
static void lines_of(const wf_sampling *s, int64_t field, int row, int *first, int *end) {
    wf_gather_lines(&s->desc.gather, field, row, row + 1, first, end);
    double reach = s->desc.gather.aperture.reach_v;
    int step = wf_raster_line_step(&s->raster), parity = wf_raster_parity(&s->raster, field);
    /* Lines that only the row's very edge touches need no samples of it. */
    while (*first < *end && parity + *first * step + 0.5 + reach <= row) ++*first;
    while (*first < *end && parity + (*end - 1) * step + 0.5 - reach >= row + 1) --*end;
}

static double late_of(const wf_sampling *s, double line) {
    return s->skew * line / s->raster.lines;
}

/* An instant that goes down the picture is another one for each line. */
static bool trace_instants(const wf_tile *t, int64_t field, int row, int *set) {
    int step = wf_raster_line_step(&t->s->raster);
    int parity = wf_raster_parity(&t->s->raster, field), first, end;
    lines_of(t->s, field, row, &first, &end);
    for (int l = first; l < end; l++) {
        double late = late_of(t->s, parity + l * step);
        size_t count = draw_cells(t, row, (wf_row_time){late, late, late}, (*set)++, 0);
        if (!trace_drawn(t, late, count)) return false;
    }
    return true;
}

static bool trace_instant_rows(const wf_tile *t, int first, int end) {
    for (int row = first; row < end; row++)
        for (int n = 0, set = 0; n < fields_of_unit(t->s); n++)
            if (!trace_instants(t, t->s->field + n, row, &set)) return false;
    return true;
}

bool wf_find_row_time(const wf_sampling *s, int row, wf_row_time *time) {
    int step = wf_raster_line_step(&s->raster);
    double low = HUGE_VAL, high = -HUGE_VAL;
    *time = (wf_row_time){s->start, s->start + 1, 0};
    if (s->periods) return true;
    for (int n = 0; n < fields_of_unit(s); n++) {
        int first, end, parity = wf_raster_parity(&s->raster, s->field + n);
        lines_of(s, s->field + n, row, &first, &end);
        if (first >= end) continue;
        low = fmin(low, late_of(s, parity + first * step));
        high = fmax(high, late_of(s, parity + (end - 1) * step));
    }
    if (low > high) return false;
    *time = (wf_row_time){s->start + low, s->start + s->tau + high, (low + high) / 2};
    return true;
}

/* Rows that are as late are traced together as far as there is room: packets are filled. */
static bool trace_rows(const wf_tile *t, int first, int end) {
    size_t drawn = 0, most = TILE_WIDTH * (size_t)t->s->desc.count;
    double late = 0;
    for (int row = first; row < end; row++) {
        wf_row_time time;
        if (!wf_find_row_time(t->s, row, &time)) continue;
        if (drawn && (time.late != late || drawn + most > t->c->room)) {
            if (!trace_drawn(t, late, drawn)) return false;
            drawn = 0;
        }
        late = time.late;
        drawn = draw_cells(t, row, time, 0, drawn);
    }
    return trace_drawn(t, late, drawn);
}

/* ---- Tiles ---- */

/* The cells of tiles that are still have one time, whichever it is. */
#define STILL INT64_MIN

/* Whether the apertures of both parities reach the samples of one. */
static bool serves_both(const wf_sampling *s) {
    const wf_aperture *a = &s->desc.gather.aperture;
    if (s->periods) return true;
    return a->reach_v > 0.5 && !(s->skew > 0) && !(a->kind->couples_vq && s->tau > 0);
}

/* Where nothing but background is seen, in a tile and in those about it, that is known without
 * samples: a pixel that sees into this tile then sees no further than those. */
static const float *background_of(const wf_tile *t, int first, int end) {
    const wf_aperture *a = &t->s->desc.gather.aperture;
    const double x[2] = {t->x0 - TILE_WIDTH, t->x1 + TILE_WIDTH};
    const double y[2] = {first - TILE_HEIGHT, end + TILE_HEIGHT};
    /* Of windows that see several units nothing is known yet but of this one. */
    if (t->s->periods && !wf_tracer_still(t->s->tracer)) return NULL;
    if (!t->s->desc.skip || 2 * a->reach_u > TILE_WIDTH || 2 * a->reach_v > TILE_HEIGHT)
        return NULL;
    bool nothing = t->s->nothing || wf_trace_nothing(t->s->tracer, t->c->trace, x, y);
    return nothing ? t->s->desc.scene->background : NULL;
}

static int tiles_across(const wf_sampling *s) {
    return (s->raster.width_px + TILE_WIDTH - 1) / TILE_WIDTH;
}

static int tile_index(const wf_tile *t, int first) {
    return first / TILE_HEIGHT * tiles_across(t->s) + t->x0 / TILE_WIDTH;
}

static bool is_wanted(const wf_tile *t, int first, int end, const float *all, bool still) {
    const wf_receiver *r = t->receiver;
    const wf_sample_tile tile = {.index = tile_index(t, first),
                                 .left = t->x0,
                                 .right = t->x1,
                                 .first = first,
                                 .end = end,
                                 .all = all,
                                 .still = still,
                                 .both = serves_both(t->s)};
    return r->tile(r->user, &tile);
}

/* What an adaptive tile leaves uncertain is noted, and counts again where the tile is used
 * again. Nothing is uncertain of background. */
static bool adapt(wf_tile *t, int first, int end, bool empty) {
    wf_error_sum *sum = &t->c->error, before = *sum;
    if (!wf_adaptive_tile(t, first, end, empty)) return false;
    t->s->tile_error[tile_index(t, first)] =
        (wf_error_sum){sum->square - before.square, sum->cells - before.cells};
    return true;
}

static void recall_error(wf_tile *t, int first, int end, bool background) {
    wf_error_sum *sum = &t->c->error, *tile = &t->s->tile_error[tile_index(t, first)];
    if (background) *tile = (wf_error_sum){0, (double)((end - first) * (t->x1 - t->x0))};
    sum->square += tile->square;
    sum->cells += tile->cells;
}

/* Adaptive tiles look at what is about them, too, which then has to be still as they are. */
static bool trace_tile(wf_tile *t, int first, int end) {
    int rows = adapts(t->s) ? wf_adaptive_rows_about(t->s) : 0, columns = rows > 0 ? ABOUT : 0;
    const double x[2] = {t->x0 - columns, t->x1 + columns}, y[2] = {first - rows, end + rows};
    bool empty, still = t->s->still || wf_trace_still(t->s->tracer, t->c->trace, x, y);
    t->timeless = still || (!(t->s->tau > 0) && !wf_tracer_own_widths(t->s->tracer));
    t->time = still ? STILL : t->s->unit;
    const float *all = t->receiver->tile ? background_of(t, first, end) : NULL;
    if (all) wf_trace_skip(t->c->trace);
    if (t->receiver->tile && !is_wanted(t, first, end, all, still)) {
        if (adapts(t->s)) recall_error(t, first, end, all != NULL);
        return true;
    }
    if (!wf_trace_prepare(t->s->tracer, t->c->trace, x, y, &empty)) return false;
    if (adapts(t->s)) return adapt(t, first, end, empty);
    return t->s->instants ? trace_instant_rows(t, first, end) : trace_rows(t, first, end);
}

wf_sample_tiling wf_sampling_tiling(const wf_sampling *s) {
    int down = (s->raster.lines + TILE_HEIGHT - 1) / TILE_HEIGHT;
    return (wf_sample_tiling){tiles_across(s) * down, TILE_WIDTH, TILE_HEIGHT};
}

bool wf_sampling_rows(const wf_sampling *s, wf_sampling_scratch *scratch, int first, int end,
                      const wf_receiver *receiver) {
    int width = s->raster.width_px;
    for (int row = first; row < end; row += TILE_HEIGHT)
        for (int x = 0; x < width; x += TILE_WIDTH) {
            int last = row + TILE_HEIGHT < end ? row + TILE_HEIGHT : end;
            int right = x + TILE_WIDTH < width ? x + TILE_WIDTH : width;
            wf_tile t = {.s = s, .c = scratch, .x0 = x, .x1 = right, .receiver = receiver};
            if (!trace_tile(&t, row, last)) return false;
        }
    return true;
}

/* ---- Subframes ---- */

bool wf_sampling_subframe(wf_sampling *s, wf_rational time_s) {
    const wf_window_of_time window = {.base_s = time_s};
    return wf_tracer_look(s->tracer, &window, s->desc.skip);
}

/* Samples are taken at the middles of the picture's own pixels. */
static bool trace_stretch(const wf_sampling *s, wf_sampling_scratch *c, const double cell[2],
                          int first, int count, int row, float *rgb) {
    const wf_trace_samples traced = {.count = (size_t)count,
                                     .x = c->trace_x,
                                     .y = c->trace_y,
                                     .f = c->trace_f,
                                     .rgb = {c->rgb[0], c->rgb[1], c->rgb[2]}};
    for (int i = 0; i < count; i++) {
        c->trace_x[i] = (first + i + 0.5) * cell[0];
        c->trace_y[i] = (row + 0.5) * cell[1];
        c->trace_f[i] = 0;
    }
    if (!wf_trace(s->tracer, c->trace, &traced)) return false;
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) rgb[3 * (first + i) + k] = c->rgb[k][i];
    return true;
}

bool wf_sampling_subframe_rows(const wf_sampling *s, wf_sampling_scratch *c, int across,
                               int down, int first, int end, float *rgb) {
    const double cell[2] = {(double)s->raster.width_px / across,
                            (double)s->raster.lines / down};
    int most = c->room < 256 ? (int)c->room : 256;
    for (int x = 0; x < across; x += most) {
        int count = across - x < most ? across - x : most;
        const double xs[2] = {x * cell[0], (x + count) * cell[0]};
        const double ys[2] = {first * cell[1], end * cell[1]};
        bool empty;
        if (!wf_trace_prepare(s->tracer, c->trace, xs, ys, &empty)) return false;
        for (int row = first; row < end; row++)
            if (!trace_stretch(s, c, cell, x, count, row,
                               rgb + (size_t)(row - first) * 3 * (size_t)across))
                return false;
    }
    return true;
}
