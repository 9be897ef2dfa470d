/* Lines of a complete field: sums through horizontal kernels, over what exists. */
#include <string.h>

#include "filters/resample/resampler_inside.h"

static const float *done_row(const wf_field *f, int tap, int channel) {
    return f->done + (size_t)f->weights->taps[tap].sum * wf_done_samples(f->rs) +
           (size_t)channel * wf_row_samples(f->rs);
}

/* One channel of the sums of some taps: all of them go through the same kernel. False if no
 * sample was added to any. */
static bool add_up(const wf_field *f, wf_span taps, int channel, double *row) {
    const wf_resampler *rs = f->rs;
    const float *first = NULL;
    int found = 0;
    for (int t = taps.first; t < taps.end; t++) {
        if (!f->touched[f->weights->taps[t].sum]) continue;
        const float *sum = done_row(f, t, channel);
        if (++found == 1)
            first = sum;
        else if (found == 2)
            rs->ops->set_rows(row, first, sum, wf_row_samples(rs));
        else
            rs->ops->add_row(row, sum, wf_row_samples(rs));
    }
    if (found == 1) rs->ops->set_rows(row, first, NULL, wf_row_samples(rs));
    return found > 0;
}

/* Pixels of one phase side by side: out[r][m] += sum over t of weight[r][t] row[cell], for
 * pixel phases * m + r. */
static void filter_phases(const wf_resampler *rs, const double *weight, const double *row,
                          double *out) {
    double reach = rs->desc.aperture.reach_u;
    if (rs->phases == 1 && rs->lanes == 1) {
        int first = wf_axis_reach(&rs->x, reach, 0).first - rs->columns.first;
        rs->ops->add_taps(out, row + first, weight, (size_t)rs->taps, (size_t)rs->x.pixels);
        return;
    }
    for (int r = 0; r < rs->phases; r++) {
        size_t count = (size_t)((rs->x.pixels - r + rs->phases - 1) / rs->phases);
        int first = wf_axis_reach(&rs->x, reach, r).first - rs->columns.first;
        for (int t = 0; t < rs->taps; t++) {
            double w = weight[r * rs->taps + t];
            if (w == 0) continue;
            int cell = first + t, lane = cell % rs->lanes, at = cell / rs->lanes;
            rs->ops->add_tap(out + (size_t)r * wf_run_length(rs),
                             row + lane * rs->lane_length + at, w, count);
        }
    }
}

static void filter_pixels(const wf_resampler *rs, const double *weight, const double *row,
                          double *out) {
    double reach = rs->desc.aperture.reach_u;
    for (int i = 0; i < rs->x.pixels; i++) {
        int r = i % rs->phases;
        wf_span span = wf_axis_reach(&rs->x, reach, i);
        double sum = 0;
        for (int a = span.first; a < span.end; a++)
            sum += weight[r * rs->taps + a - span.first] * row[a - rs->columns.first];
        out[(size_t)r * wf_run_length(rs) + (size_t)(i / rs->phases)] += sum;
    }
}

/* Adds the weight of the samples of subframes with overscan, pixel by pixel: which cells exist
 * there differs from subframe to subframe. */
static void add_overscan(const wf_field *f, wf_span taps, const wf_kernel *kernel,
                         wf_scratch *s) {
    const wf_resampler *rs = f->rs;
    double reach = rs->desc.aperture.reach_u;
    for (int i = 0; i < rs->x.pixels; i++) {
        const double *weight = kernel->weight + (i % rs->phases) * rs->taps;
        wf_span span = wf_axis_reach(&rs->x, reach, i);
        double total = 0;
        for (int t = taps.first; t < taps.end; t++) {
            const double *row =
                f->overscan + (size_t)f->weights->taps[t].sum * wf_columns_of(rs);
            for (int a = span.first; a < span.end; a++)
                total += weight[a - span.first] * row[a - rs->columns.first];
        }
        s->inside[i] += total;
        s->exists[i] += total;
    }
}

static void add_totals(const wf_field *f, wf_span taps, const wf_kernel *kernel,
                       wf_scratch *s) {
    double inside = 0, exists = 0;
    for (int t = taps.first; t < taps.end; t++) {
        inside += f->inside[f->weights->taps[t].sum];
        exists += f->exists[f->weights->taps[t].sum];
    }
    const wf_row_ops *ops = f->rs->ops;
    ops->add_tap(s->inside, kernel->inside, inside, (size_t)f->rs->x.pixels);
    ops->add_tap(s->exists, kernel->exists, exists, (size_t)f->rs->x.pixels);
    if (f->overscan) add_overscan(f, taps, kernel, s);
}

/* Sums that share a kernel go through it together. */
static void add_group(const wf_field *f, wf_span taps, wf_scratch *s) {
    const wf_resampler *rs = f->rs;
    const wf_kernel *kernel =
        wf_kernel_ready(rs, f->weights->taps[taps.first].kernel, &s->kernel);
    size_t samples = (size_t)rs->phases * wf_run_length(rs);
    for (int c = 0; c < rs->desc.channels; c++) {
        double *out = s->picture + (size_t)c * samples;
        if (!add_up(f, taps, c, s->row)) break;
        if (rs->polyphase)
            filter_phases(rs, kernel->weight, s->row, out);
        else
            filter_pixels(rs, kernel->weight, s->row, out);
    }
    add_totals(f, taps, kernel, s);
}

/* The weighted sum of alpha at pixel i, of all that exists there. */
static double alpha_sum(const wf_resampler *rs, const wf_scratch *s, int i) {
    size_t run = wf_run_length(rs), phase = (size_t)(3 * rs->phases + i % rs->phases);
    return rs->desc.channels == 4 ? s->picture[phase * run + (size_t)(i / rs->phases)]
                                  : s->inside[i];
}

void wf_field_alpha(const wf_field *f, const wf_scratch *s, float *alpha) {
    for (int i = 0; i < f->rs->x.pixels; i++)
        alpha[i] = (float)(alpha_sum(f->rs, s, i) * s->exists[i]);
}

/* Lays the light over the background, whose share is what the input neither covers nor makes
 * opaque. exists holds reciprocals here. */
static void add_background(const wf_resampler *rs, const wf_scratch *s, float *const rgb[3]) {
    size_t run = wf_run_length(rs), samples = (size_t)rs->phases * run;
    for (int i = 0; i < rs->x.pixels; i++) {
        size_t at = (size_t)(i % rs->phases) * run + (size_t)(i / rs->phases);
        double clear = 1 - alpha_sum(rs, s, i) * s->exists[i];
        for (int c = 0; c < 3; c++) {
            double light = s->picture[(size_t)c * samples + at] * s->exists[i];
            rgb[c][i] = (float)(light + clear * (double)rs->desc.background[c]);
        }
    }
}

/* Divides by the weight of what exists, and brings the phases together. */
static void normalize(const wf_resampler *rs, const wf_scratch *s, float *const rgb[3]) {
    const float *background = rs->desc.background;
    size_t run = wf_run_length(rs), phases = (size_t)rs->phases, width = (size_t)rs->x.pixels;
    rs->ops->invert(s->exists, width);
    if (background[0] != 0 || background[1] != 0 || background[2] != 0) {
        add_background(rs, s, rgb);
        return;
    }
    for (size_t c = 0; phases == 1 && c < 3; c++)
        rs->ops->multiply(rgb[c], s->picture + c * run, s->exists, width);
    for (size_t c = 0; phases > 1 && c < 3; c++)
        for (size_t r = 0; r < phases; r++) {
            const double *light = s->picture + (c * phases + r) * run;
            for (size_t i = r, m = 0; i < width; i += phases, m++)
                rgb[c][i] = (float)(light[m] * s->exists[i]);
        }
}

void wf_field_line(const wf_field *f, int line, wf_scratch *s, float *const rgb[3]) {
    const wf_resampler *rs = f->rs;
    size_t samples = (size_t)rs->desc.channels * (size_t)rs->phases * wf_run_length(rs);
    memset(s->picture, 0, samples * sizeof *s->picture);
    memset(s->inside, 0, 2 * (size_t)rs->x.pixels * sizeof *s->inside);
    wf_span all = f->weights->line_taps[line], group = {all.first, all.first};
    while (group.end < all.end) {
        group.first = group.end;
        int kernel = f->weights->taps[group.first].kernel;
        while (group.end < all.end && f->weights->taps[group.end].kernel == kernel) group.end++;
        add_group(f, group, s);
    }
    normalize(rs, s, rgb);
}
