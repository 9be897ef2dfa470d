#include "filters/resample/plan.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What is being built of one parity's plan: terms and taps arrive in the order of rows. */
typedef struct builder {
    wf_resampler *rs;
    wf_plan *plan;
    int term_room, tap_room;
    wf_span *reach; /* [lines]: rows of each */
    int *line_sum;  /* [lines]: the sum of a line in the band being built, or -1 */
} builder;

static int frame_line(const wf_plan *plan, int line) {
    return plan->first_line + line * plan->line_step;
}

static bool room_for(void **array, int *room, int count, size_t size) {
    if (count < *room) return true;
    int more = *room ? 2 * *room : 1024;
    void *grown = realloc(*array, (size_t)more * size);
    if (!grown) return false;
    *array = grown;
    *room = more;
    return true;
}

static bool add_term(builder *b, wf_term term) {
    wf_plan *plan = b->plan;
    if (!room_for((void **)&plan->terms, &b->term_room, plan->term_count, sizeof term))
        return false;
    plan->terms[plan->term_count++] = term;
    return true;
}

static bool add_tap(builder *b, int line, int sum, int kernel) {
    wf_plan *plan = b->plan;
    wf_tap tap = {line, sum, kernel};
    if (kernel < 0 ||
        !room_for((void **)&plan->taps, &b->tap_room, plan->tap_count, sizeof tap))
        return false;
    plan->taps[plan->tap_count++] = tap;
    return true;
}

/* The row's part in one line: a term of its own, unless rows are summed by themselves. */
static bool add_row_to_line(builder *b, int row, int line) {
    wf_resampler *rs = b->rs;
    const wf_aperture *a = &rs->desc.aperture;
    int j = frame_line(b->plan, line);
    double v0 = wf_axis_edge_in_picture(&rs->y, row, j);
    double v1 = wf_axis_edge_in_picture(&rs->y, row + 1, j);
    if (v0 >= v1) return true;
    if (rs->sums_by_row)
        return add_tap(b, line, b->plan->sum_count - 1, wf_kernel_for(rs, v0, v1));
    bool own_sum = a->kind->couples_uv || b->line_sum[line] < 0;
    if (own_sum) {
        b->line_sum[line] = b->plan->sum_count++;
        if (!add_tap(b, line, b->line_sum[line], wf_kernel_for(rs, v0, v1))) return false;
    }
    double weight = a->kind->couples_uv ? 1 : a->kind->cell_v(a, v0, v1);
    return add_term(b, (wf_term){row, line, b->line_sum[line], wf_axis_inside(&rs->y, row),
                                 weight, v0, v1});
}

static bool add_row(builder *b, int row, int *top_line) {
    wf_plan *plan = b->plan;
    while (*top_line < plan->lines && b->reach[*top_line].end <= row) ++*top_line;
    if (b->rs->sums_by_row) {
        bool inside = wf_axis_inside(&b->rs->y, row);
        if (!add_term(b, (wf_term){row, 0, plan->sum_count++, inside, 1, 0, 0})) return false;
    }
    for (int line = *top_line; line < plan->lines && b->reach[line].first <= row; line++)
        if (!add_row_to_line(b, row, line)) return false;
    return true;
}

static bool add_band(builder *b, int index, int *top_line) {
    wf_plan *plan = b->plan;
    wf_band *band = &plan->bands[index];
    band->rows = wf_resampler_band_rows(b->rs, index);
    band->terms.first = plan->term_count;
    band->sums.first = plan->sum_count;
    for (int line = 0; line < plan->lines; line++) b->line_sum[line] = -1;
    for (int row = band->rows.first; row < band->rows.end; row++)
        if (!add_row(b, row, top_line)) return false;
    band->terms.end = plan->term_count;
    band->sums.end = plan->sum_count;
    int sums = band->sums.end - band->sums.first;
    if (sums > plan->most_sums) plan->most_sums = sums;
    return true;
}

static int by_line_then_kernel(const void *left, const void *right) {
    const wf_tap *a = left, *b = right;
    if (a->line != b->line) return a->line < b->line ? -1 : 1;
    if (a->kernel != b->kernel) return a->kernel < b->kernel ? -1 : 1;
    return (a->sum > b->sum) - (a->sum < b->sum);
}

static void index_taps(wf_plan *plan) {
    qsort(plan->taps, (size_t)plan->tap_count, sizeof *plan->taps, by_line_then_kernel);
    for (int t = 0; t < plan->tap_count; t++) {
        wf_span *span = &plan->line_taps[plan->taps[t].line];
        if (!span->end) span->first = t;
        span->end = t + 1;
    }
}

static int floor_to_band(const wf_resampler *rs, int row) {
    int from = row - rs->desc.band_origin, rows = rs->desc.band_rows;
    int rest = from % rows;
    return row - (rest < 0 ? rest + rows : rest);
}

/* Which bands each line reaches, and the other way round. */
static void index_bands(builder *b) {
    wf_plan *plan = b->plan;
    int origin = floor_to_band(b->rs, b->rs->rows.first), rows = b->rs->desc.band_rows;
    for (int line = 0; line < plan->lines; line++) {
        int first = (b->reach[line].first - origin) / rows;
        int last = (b->reach[line].end - 1 - origin) / rows;
        plan->line_bands[line] = last - first + 1;
        for (int band = first; band <= last; band++) {
            wf_span *lines = &plan->bands[band].lines;
            if (!lines->end) lines->first = line;
            lines->end = line + 1;
        }
    }
}

static bool build(builder *b) {
    wf_plan *plan = b->plan;
    for (int line = 0; line < plan->lines; line++)
        b->reach[line] =
            wf_axis_reach(&b->rs->y, b->rs->desc.aperture.reach_v, frame_line(plan, line));
    int top_line = 0;
    for (int band = 0; band < b->rs->band_count; band++)
        if (!add_band(b, band, &top_line)) return false;
    index_taps(plan);
    index_bands(b);
    return true;
}

static bool build_plan(wf_resampler *rs, int parity) {
    wf_plan *plan = &rs->plan[parity];
    const wf_raster *raster = rs->desc.raster;
    plan->lines = wf_raster_field_lines(raster, parity);
    plan->first_line = parity;
    plan->line_step = wf_raster_line_step(raster);
    plan->bands = calloc((size_t)rs->band_count, sizeof *plan->bands);
    plan->line_taps = calloc((size_t)plan->lines, sizeof *plan->line_taps);
    plan->line_bands = calloc((size_t)plan->lines, sizeof *plan->line_bands);
    builder b = {.rs = rs, .plan = plan};
    b.reach = calloc((size_t)plan->lines, sizeof *b.reach);
    b.line_sum = calloc((size_t)plan->lines, sizeof *b.line_sum);
    bool room = plan->bands && plan->line_taps && plan->line_bands && b.reach && b.line_sum;
    bool built = room && build(&b);
    free(b.reach);
    free(b.line_sum);
    return built;
}

/* ---- Geometry ---- */

static wf_span reached(const wf_axis *axis, double reach) {
    return (wf_span){wf_axis_reach(axis, reach, 0).first,
                     wf_axis_reach(axis, reach, axis->pixels - 1).end};
}

static void lay_out_columns(wf_resampler *rs) {
    double reach = rs->desc.aperture.reach_u;
    rs->phases = wf_axis_phases(&rs->x);
    for (int r = 0; r < rs->phases; r++) {
        wf_span span = wf_axis_reach(&rs->x, reach, r);
        if (span.end - span.first > rs->taps) rs->taps = span.end - span.first;
    }
    int columns = rs->columns.end - rs->columns.first;
    rs->polyphase = rs->x.pixels / rs->phases >= 8;
    rs->lanes = rs->polyphase ? (int)(rs->phases * rs->x.unit / rs->x.cell) : 1;
    rs->lane_length = (columns + rs->lanes - 1) / rs->lanes;
}

wf_span wf_resampler_band_rows(const wf_resampler *rs, int band) {
    int first = floor_to_band(rs, rs->rows.first) + band * rs->desc.band_rows;
    int end = first + rs->desc.band_rows;
    return (wf_span){first > rs->rows.first ? first : rs->rows.first,
                     end < rs->rows.end ? end : rs->rows.end};
}

static bool set_up(wf_resampler *rs, char *why, size_t why_size) {
    const wf_aperture_kind *kind = rs->desc.aperture.kind;
    if (!wf_timing_init(&rs->timing, &rs->desc.timing, why, why_size)) return false;
    if (!wf_axis_init(&rs->x, &rs->desc.x) || !wf_axis_init(&rs->y, &rs->desc.y)) {
        snprintf(why, why_size,
                 "the input's pixels and the raster's have no exact common measure; "
                 "give a simpler --input-par");
        return false;
    }
    rs->columns = reached(&rs->x, rs->desc.aperture.reach_u);
    rs->rows = reached(&rs->y, rs->desc.aperture.reach_v);
    int first = floor_to_band(rs, rs->rows.first);
    rs->band_count = (rs->rows.end - first + rs->desc.band_rows - 1) / rs->desc.band_rows;
    rs->sums_by_row = kind->couples_uv && !rs->desc.timing.skew.num;
    rs->plans = wf_raster_fields_per_frame(rs->desc.raster);
    rs->ops = wf_row_ops_best();
    lay_out_columns(rs);
    return true;
}

static bool build_plans(wf_resampler *rs, char *why, size_t why_size) {
    for (int parity = 0; parity < rs->plans; parity++)
        if (!build_plan(rs, parity)) goto no_memory;
    if (wf_kernels_keep(rs)) return true;
no_memory:
    snprintf(why, why_size, "no memory for the weights of a %dx%d picture", rs->x.cells,
             rs->y.cells);
    return false;
}

bool wf_resampler_new(const wf_resample_desc *desc, wf_resampler **out, char *why,
                      size_t why_size) {
    wf_resampler *rs = calloc(1, sizeof *rs);
    if (!rs) {
        snprintf(why, why_size, "no memory for a resampler");
        return false;
    }
    rs->desc = *desc;
    if (!set_up(rs, why, why_size) || !build_plans(rs, why, why_size)) {
        wf_resampler_free(rs);
        return false;
    }
    *out = rs;
    return true;
}

void wf_resampler_free(wf_resampler *rs) {
    if (!rs) return;
    for (int p = 0; p < 2; p++) {
        free(rs->plan[p].bands);
        free(rs->plan[p].terms);
        free(rs->plan[p].taps);
        free(rs->plan[p].line_taps);
        free(rs->plan[p].line_bands);
    }
    for (int i = 0; i < rs->kernel_count; i++) wf_kernel_release(&rs->kernels[i]);
    free(rs->kernels);
    free(rs);
}

wf_window wf_resampler_window(const wf_resampler *rs, int64_t field) {
    return wf_timing_field(&rs->timing, field, rs->desc.raster->lines);
}

int wf_resampler_bands(const wf_resampler *rs) {
    return rs->band_count;
}

wf_span wf_resampler_columns(const wf_resampler *rs) {
    return rs->columns;
}

bool wf_resampler_overscan(const wf_resampler *rs, const wf_cells *data) {
    if (rs->x.padded || rs->y.padded) return false;
    bool beside = (data->x0 < 0 && rs->columns.first < 0) ||
                  (data->x1 > rs->x.cells && rs->columns.end > rs->x.cells);
    bool beyond = (data->y0 < 0 && rs->rows.first < 0) ||
                  (data->y1 > rs->y.cells && rs->rows.end > rs->y.cells);
    return beside || beyond;
}
