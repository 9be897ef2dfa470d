/* Samples of a scene, unit of time by unit and tile by tile: what is seen, whether it is
 * wanted, and how it is sampled. */
#include <math.h>
#include <stdlib.h>

#include "tracer/sample/adaptive.h"
#include "tracer/sample/adaptive_edges.h"
#include "tracer/sample/adaptive_packets.h"
#include "tracer/sample/adaptive_points.h"
#include "tracer/sample/fixed.h"
#include "tracer/sample/row_time.h"

/* ---- Life ---- */

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
    size_t tiles = (size_t)wf_sampling_tiling(s).count;
    s->tile_error = calloc(tiles, sizeof *s->tile_error);
    s->tile_sight = calloc(tiles + 1, sizeof *s->tile_sight);
    return s->tracer && s->sampler && s->tile_error && s->tile_sight;
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
    free(s->tile_sight);
    free(s);
}

wf_sampling_scratch *wf_sampling_scratch_new(const wf_sampling *s) {
    wf_sampling_scratch *c = calloc(1, sizeof *c);
    if (!c) return NULL;
    size_t fixed = TILE_WIDTH * (size_t)s->desc.count;
    c->capacity = fixed > WF_MOST_EACH ? fixed : WF_MOST_EACH;
    float **const floats[] = {&c->x,      &c->y,      &c->f,      &c->t,
                              &c->rgb[0], &c->rgb[1], &c->rgb[2], &c->alpha};
    double **const doubles[] = {&c->trace_x, &c->trace_y, &c->trace_f};
    bool good = (c->trace = wf_trace_scratch_new(s->tracer)) != NULL;
    for (size_t n = 0; n < sizeof floats / sizeof *floats; n++)
        good = (*floats[n] = malloc(c->capacity * sizeof(float))) && good;
    for (size_t n = 0; n < sizeof doubles / sizeof *doubles; n++)
        good = (*doubles[n] = malloc(c->capacity * sizeof(double))) && good;
    if (good) return c;
    wf_sampling_scratch_free(c);
    return NULL;
}

void wf_sampling_scratch_free(wf_sampling_scratch *c) {
    if (!c) return;
    wf_trace_scratch_free(c->trace);
    float *const floats[] = {c->x, c->y, c->f, c->t, c->rgb[0], c->rgb[1], c->rgb[2], c->alpha};
    double *const doubles[] = {c->trace_x, c->trace_y, c->trace_f};
    for (size_t n = 0; n < sizeof floats / sizeof *floats; n++) free(floats[n]);
    for (size_t n = 0; n < sizeof doubles / sizeof *doubles; n++) free(doubles[n]);
    wf_points_free(&c->kept);
    wf_points_free(&c->probes);
    wf_edges_free(&c->edges);
    wf_packet_order_free(&c->order);
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
    wf_trace_sight *sight = &s->tile_sight[wf_sampling_tiling(s).count];
    s->still = wf_trace_still(s->tracer, c->trace, x, y, sight);
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
    if (t->s->desc.scene->background_clear > 0) return NULL; /* whose alpha `all` cannot tell */
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
        (wf_error_sum){sum->square - before.square, sum->cells - before.cells,
                       sum->short_of - before.short_of};
    return true;
}

static void recall_error(wf_tile *t, int first, int end, bool background) {
    wf_error_sum *sum = &t->c->error, *tile = &t->s->tile_error[tile_index(t, first)];
    if (background) *tile = (wf_error_sum){0, (double)((end - first) * (t->x1 - t->x0)), 0};
    sum->square += tile->square;
    sum->cells += tile->cells;
    sum->short_of += tile->short_of;
}

/* Adaptive tiles look at what is about them, too, which then has to be still as they are. */
static bool trace_tile(wf_tile *t, int first, int end) {
    int about = adapts(t->s) ? wf_adaptive_about(t->s) : 0;
    const double x[2] = {t->x0 - about, t->x1 + about}, y[2] = {first - about, end + about};
    wf_trace_sight *sight = &t->s->tile_sight[tile_index(t, first)];
    bool empty, still = t->s->still || wf_trace_still(t->s->tracer, t->c->trace, x, y, sight);
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
    return t->s->instants ? wf_fixed_instants(t, first, end) : wf_fixed_rows(t, first, end);
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
