/* Lays the input on the raster and makes a resampler, with the weights of both parities. */
#include "filters/resample/resampler_inside.h"

#include <stdio.h>
#include <stdlib.h>

/* ---- Geometry ---- */

int wf_band_floor(const wf_resampler *rs, int row) {
    int from = row - rs->desc.band_origin, rows = rs->desc.band_rows;
    int rest = from % rows;
    return row - (rest < 0 ? rest + rows : rest);
}

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
    int first = wf_band_floor(rs, rs->rows.first) + band * rs->desc.band_rows;
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
    int first = wf_band_floor(rs, rs->rows.first);
    rs->band_count = (rs->rows.end - first + rs->desc.band_rows - 1) / rs->desc.band_rows;
    rs->sums_by_row = kind->couples_uv && !rs->desc.timing.skew.num;
    rs->ops = wf_row_ops_best();
    lay_out_columns(rs);
    return true;
}

static bool build_weights(wf_resampler *rs, char *why, size_t why_size) {
    int parities = wf_raster_line_step(rs->desc.raster);
    bool built = true;
    for (int parity = 0; parity < parities; parity++)
        built = built && wf_weights_build(rs, parity);
    if (built && wf_kernels_keep(rs)) return true;
    snprintf(why, why_size, "no memory for the weights of a %dx%d picture", rs->x.cells,
             rs->y.cells);
    return false;
}

/* Additions between the sums of a line and its pixels. */
static int line_additions(const wf_resampler *rs, const wf_weights *w, wf_span taps) {
    int strands = 0, sums = 0, most_sums = 0;
    for (int t = taps.first; t < taps.end; t++) {
        bool begins = t == taps.first || w->taps[t].kernel != w->taps[t - 1].kernel;
        if (begins) strands += wf_kernel_strands(rs, w->taps[t].kernel);
        sums = begins ? 1 : sums + 1;
        if (sums > most_sums) most_sums = sums;
    }
    return strands + most_sums;
}

/* Quick fields are those of pictures, of which video has many, on rasters of like columns. */
static void count_additions(wf_resampler *rs) {
    const float *background = rs->desc.background;
    bool black = background[0] == 0 && background[1] == 0 && background[2] == 0;
    bool can = rs->desc.floats && rs->desc.channels == 3 && rs->phases == 1 && rs->polyphase &&
               black && rs->kernels[0].weight;
    for (int parity = 0; can && parity < 2; parity++) {
        const wf_weights *w = &rs->weights[parity];
        for (int line = 0; line < w->lines; line++) {
            int additions = line_additions(rs, w, w->line_taps[line]);
            if (additions > rs->line_additions) rs->line_additions = additions;
        }
    }
}

bool wf_resampler_new(const wf_resample_desc *desc, wf_resampler **out, char *why,
                      size_t why_size) {
    wf_resampler *rs = calloc(1, sizeof *rs);
    if (!rs) {
        snprintf(why, why_size, "no memory for a resampler");
        return false;
    }
    rs->desc = *desc;
    if (!set_up(rs, why, why_size) || !build_weights(rs, why, why_size)) {
        wf_resampler_free(rs);
        return false;
    }
    count_additions(rs);
    *out = rs;
    return true;
}

void wf_resampler_free(wf_resampler *rs) {
    if (!rs) return;
    for (int parity = 0; parity < 2; parity++) wf_weights_release(&rs->weights[parity]);
    for (int i = 0; i < rs->kernel_count; i++) wf_kernel_release(&rs->kernels[i]);
    free(rs->kernels);
    free(rs);
}

wf_window wf_resampler_window(const wf_resampler *rs, int64_t field) {
    return wf_timing_field(&rs->timing, field, rs->desc.raster->lines);
}

void wf_resampler_set_end(wf_resampler *rs, int64_t subframes) {
    rs->timing.subframes = rs->desc.timing.subframes = subframes;
}

bool wf_resampler_set_edges(wf_resampler *rs, const wf_rational *edges, int64_t from,
                            int64_t subframes) {
    rs->desc.timing.subframes = subframes;
    return wf_timing_set_edges(&rs->timing, edges, from, subframes);
}

int wf_resampler_bands(const wf_resampler *rs) {
    return rs->band_count;
}

wf_cells wf_resampler_reach(const wf_resampler *rs) {
    return (wf_cells){rs->columns.first, rs->rows.first, rs->columns.end, rs->rows.end};
}

double wf_resampler_share(const wf_resampler *rs, int64_t field, int line, int64_t k) {
    double q0, q1, width = wf_ratio_value(rs->desc.timing.width);
    wf_window window = wf_timing_window(&rs->timing, field, line);
    if (k < window.first || k >= window.first + window.count) return 0;
    if (window.alone) return 1;
    wf_timing_cell(&rs->timing, field, line, k, &q0, &q1);
    return (q1 - q0) / width;
}

bool wf_resampler_overscan(const wf_resampler *rs, const wf_cells *data) {
    if (rs->x.padded || rs->y.padded) return false;
    bool beside = (data->x0 < 0 && rs->columns.first < 0) ||
                  (data->x1 > rs->x.cells && rs->columns.end > rs->x.cells);
    bool beyond = (data->y0 < 0 && rs->rows.first < 0) ||
                  (data->y1 > rs->y.cells && rs->rows.end > rs->y.cells);
    return beside || beyond;
}
