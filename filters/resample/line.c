/* Lines of a complete field: sums through horizontal kernels, over what exists. */
#include <string.h>

#include "filters/resample/resampler_inside.h"

static const float *done_row(const wf_field *f, const wf_scratch *s, int tap, int channel) {
    int sum = f->weights->taps[tap].sum;
    const wf_held *held = &s->held;
    bool at_hand = held->field == f && held->index == f->index && sum >= held->sums.first &&
                   sum < held->sums.end && f->weights->whole[sum];
    const float *row = at_hand ? held->done + (size_t)(sum - held->sums.first) * held->stride
                               : f->done + (size_t)sum * wf_done_samples(f->rs);
    return row + (size_t)channel * wf_row_samples(f->rs);
}

/* Whether a sample was added to any of the sums of these taps. */
static bool any_touched(const wf_field *f, wf_span taps) {
    bool any = false;
    for (int t = taps.first; t < taps.end; t++) any |= f->touched[f->weights->taps[t].sum];
    return any;
}

/* One channel of the sums of some taps: all of them go through the same kernel. */
static void add_up(const wf_field *f, const wf_scratch *s, wf_span taps, int channel,
                   double *row) {
    const wf_resampler *rs = f->rs;
    const float *first = NULL;
    int found = 0;
    for (int t = taps.first; t < taps.end; t++) {
        if (!f->touched[f->weights->taps[t].sum]) continue;
        const float *sum = done_row(f, s, t, channel);
        if (++found == 1)
            first = sum;
        else if (found == 2)
            rs->ops->set_rows(row, first, sum, wf_row_samples(rs));
        else
            rs->ops->add_row(row, sum, wf_row_samples(rs));
    }
    if (found == 1) rs->ops->set_rows(row, first, NULL, wf_row_samples(rs));
}

/* The sums of a line that share a kernel. */
typedef struct group {
    wf_span taps;
    int number;
} group;

/* False: there is none after it. */
static bool next_group(const wf_field *f, int line, group *g) {
    const wf_tap *taps = f->weights->taps;
    int end = f->weights->line_taps[line].end;
    g->taps.first = g->taps.end;
    g->number++;
    while (g->taps.end < end && taps[g->taps.end].kernel == taps[g->taps.first].kernel)
        g->taps.end++;
    return g->taps.first < end;
}

static group before_first(const wf_field *f, int line) {
    int first = f->weights->line_taps[line].first;
    return (group){{first, first}, -1};
}

static double *row_of(const wf_scratch *s, const group *g) {
    return s->rows + (size_t)g->number * wf_row_samples(s->rs);
}

/* Where in a row the cell lies that pixels of phase r take with weight t. */
static size_t place_of(const wf_resampler *rs, int r, int t) {
    int first = wf_axis_reach(&rs->x, rs->desc.aperture.reach_u, r).first;
    int cell = first - rs->columns.first + t;
    return (size_t)(cell % rs->lanes * rs->lane_length + cell / rs->lanes);
}

/* Pixels of one phase side by side: pixel phases * m + r takes weight[r][t] of row[cell]. */
static void add_strands(const group *g, const wf_kernel *kernel, wf_scratch *s) {
    const wf_resampler *rs = s->rs;
    size_t most = s->most_kernels * (size_t)rs->taps;
    for (int r = 0; r < rs->phases; r++)
        for (int t = 0; t < rs->taps; t++) {
            double weight = kernel->weight[r * rs->taps + t];
            if (weight == 0) continue;
            s->strands[(size_t)r * most + s->strand_counts[r]++] =
                (wf_strand){row_of(s, g) + place_of(rs, r, t), weight};
        }
}

static void filter_phases(const wf_resampler *rs, const wf_scratch *s, double *out) {
    size_t most = s->most_kernels * (size_t)rs->taps;
    for (size_t r = 0; r < (size_t)rs->phases; r++) {
        size_t count = ((size_t)rs->x.pixels - r + (size_t)rs->phases - 1) / (size_t)rs->phases;
        rs->ops->weave(out + r * wf_run_length(rs), s->strands + r * most, s->strand_counts[r],
                       count);
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

static wf_total total_of(const wf_field *f, wf_span taps) {
    wf_total total = {.kernel = f->weights->taps[taps.first].kernel};
    for (int t = taps.first; t < taps.end; t++) {
        total.inside += f->inside[f->weights->taps[t].sum];
        total.exists += f->exists[f->weights->taps[t].sum];
    }
    return total;
}

/* Whether pixels weigh what those of the line before did, as most lines' do. */
static bool same_totals(const wf_field *f, int line, wf_scratch *s) {
    bool same = true;
    int count = 0;
    for (group g = before_first(f, line); next_group(f, line, &g); count++) {
        wf_total total = total_of(f, g.taps), *kept = &s->totals[g.number];
        same = same && g.number < s->total_count && kept->kernel == total.kernel &&
               kept->inside == total.inside && kept->exists == total.exists;
        *kept = total;
    }
    same = same && s->total_count == count;
    s->total_count = f->overscan ? 0 : count;
    return same && !f->overscan;
}

static void add_totals(const wf_field *f, const group *g, const wf_kernel *kernel,
                       wf_scratch *s) {
    const wf_row_ops *ops = f->rs->ops;
    const wf_total *total = &s->totals[g->number];
    ops->add_tap(s->inside, kernel->inside, total->inside, (size_t)f->rs->x.pixels);
    ops->add_tap(s->exists, kernel->exists, total->exists, (size_t)f->rs->x.pixels);
    if (f->overscan) add_overscan(f, g->taps, kernel, s);
}

/* Pixels whose phases are too many for strands. */
static void add_pixels(const wf_field *f, const group *g, const wf_kernel *kernel,
                       wf_scratch *s) {
    const wf_resampler *rs = f->rs;
    size_t samples = (size_t)rs->phases * wf_run_length(rs);
    for (int c = 0; c < rs->desc.channels; c++) {
        add_up(f, s, g->taps, c, row_of(s, g));
        filter_pixels(rs, kernel->weight, row_of(s, g), s->picture + (size_t)c * samples);
    }
}

/* Sums that share a kernel go through it together. */
static void take_groups(const wf_field *f, int line, wf_scratch *s, bool new_totals) {
    const wf_resampler *rs = f->rs;
    for (group g = before_first(f, line); next_group(f, line, &g);) {
        int kernel = f->weights->taps[g.taps.first].kernel;
        const wf_kernel *ready = wf_kernel_ready(rs, kernel, &s->kernel);
        if (new_totals) add_totals(f, &g, ready, s);
        if (!any_touched(f, g.taps)) continue;
        if (rs->polyphase)
            add_strands(&g, ready, s);
        else
            add_pixels(f, &g, ready, s);
    }
}

static void weave_channel(const wf_field *f, int line, int channel, wf_scratch *s) {
    const wf_resampler *rs = f->rs;
    size_t samples = (size_t)rs->phases * wf_run_length(rs);
    for (group g = before_first(f, line); next_group(f, line, &g);)
        if (any_touched(f, g.taps)) add_up(f, s, g.taps, channel, row_of(s, &g));
    filter_phases(rs, s, s->picture + (size_t)channel * samples);
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

/* ---- Quick lines ---- */

static void turn_over(wf_scratch *s) {
    size_t width = (size_t)s->rs->x.pixels;
    s->rs->ops->invert(s->exists, width);
    for (size_t i = 0; i < width; i++) s->quick_exists[i] = (float)s->exists[i];
}

/* A sum by itself is a row as it is. */
static const float *quick_row(const wf_field *f, const wf_scratch *s, const group *g,
                              int channel) {
    float *sum = (float *)row_of(s, g);
    const float *row = NULL;
    for (int t = g->taps.first; t < g->taps.end; t++) {
        if (!f->touched[f->weights->taps[t].sum]) continue;
        const float *next = done_row(f, s, t, channel);
        if (row) f->rs->ops->quick_set_rows(sum, row, next, wf_row_samples(f->rs));
        row = row ? sum : next;
    }
    return row;
}

static void quick_channel(const wf_field *f, int line, int channel, wf_scratch *s, float *out) {
    const wf_resampler *rs = f->rs;
    size_t count = 0;
    for (group g = before_first(f, line); next_group(f, line, &g);) {
        const wf_kernel *kernel = &rs->kernels[f->weights->taps[g.taps.first].kernel];
        const float *row = quick_row(f, s, &g, channel);
        for (int t = 0; row && t < rs->taps; t++)
            if (kernel->weight[t] != 0)
                s->quick_strands[count++] =
                    (wf_quick_strand){row + place_of(rs, 0, t), (float)kernel->weight[t]};
    }
    rs->ops->quick_weave(out, s->quick_strands, count, s->quick_exists, (size_t)rs->x.pixels);
}

static void quick_line(const wf_field *f, int line, wf_scratch *s, float *const rgb[3]) {
    const wf_resampler *rs = f->rs;
    if (!same_totals(f, line, s)) {
        memset(s->inside, 0, 2 * (size_t)rs->x.pixels * sizeof *s->inside);
        for (group g = before_first(f, line); next_group(f, line, &g);)
            add_totals(f, &g, &rs->kernels[f->weights->taps[g.taps.first].kernel], s);
        turn_over(s);
    }
    for (int c = 0; c < 3; c++) quick_channel(f, line, c, s, rgb[c]);
}

void wf_field_line(const wf_field *f, int line, wf_scratch *s, float *const rgb[3]) {
    if (f->quick) {
        quick_line(f, line, s, rgb);
        return;
    }
    const wf_resampler *rs = f->rs;
    size_t width = (size_t)rs->x.pixels,
           samples = (size_t)rs->desc.channels * (size_t)rs->phases * wf_run_length(rs);
    bool new_totals = !same_totals(f, line, s);
    if (new_totals) memset(s->inside, 0, 2 * width * sizeof *s->inside);
    memset(s->strand_counts, 0, (size_t)rs->phases * sizeof *s->strand_counts);
    if (!rs->polyphase) memset(s->picture, 0, samples * sizeof *s->picture);
    take_groups(f, line, s, new_totals);
    for (int c = 0; rs->polyphase && c < rs->desc.channels; c++) weave_channel(f, line, c, s);
    if (new_totals) turn_over(s);
    normalize(rs, s, rgb);
}
