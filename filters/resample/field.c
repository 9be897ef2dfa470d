/* Fields in flight: subframes times weights into sums, band by band. */
#include <stdlib.h>
#include <string.h>

#include "filters/resample/resampler_inside.h"

/* The sums of the parity that has more, so that a field of one can be renewed as one of the
 * other. */
static size_t most_sums(const wf_resampler *rs) {
    int top = rs->weights[0].sum_count, bottom = rs->weights[1].sum_count;
    return (size_t)(top > bottom ? top : bottom);
}

size_t wf_resampler_field_bytes(const wf_resampler *rs, bool carried) {
    size_t each = wf_done_samples(rs) * sizeof(float);
    if (carried) each += wf_sum_samples(rs) * sizeof(double);
    return most_sums(rs) * each;
}

/* ---- Scratch ---- */

/* The sums of the band that has most. */
static size_t slot_sum_count(const wf_resampler *rs) {
    int top = rs->weights[0].most_sums, bottom = rs->weights[1].most_sums;
    return (size_t)(top > bottom ? top : bottom);
}

/* Kernels of the line that has most. */
static size_t most_kernels(const wf_resampler *rs) {
    int top = rs->weights[0].most_kernels, bottom = rs->weights[1].most_kernels;
    return (size_t)(top > bottom ? top : bottom);
}

static size_t strand_count(const wf_resampler *rs) {
    return rs->polyphase ? (size_t)rs->phases * most_kernels(rs) * (size_t)rs->taps : 0;
}

size_t wf_scratch_bytes(const wf_resampler *rs, int fields_in_flight) {
    size_t width = (size_t)rs->x.pixels,
           kernel = (size_t)rs->phases * (size_t)rs->taps + 2 * width;
    size_t doubles = (size_t)fields_in_flight * slot_sum_count(rs) * wf_sum_samples(rs) +
                     most_kernels(rs) * wf_row_samples(rs) + kernel +
                     (size_t)rs->desc.channels * (size_t)rs->phases * wf_run_length(rs) +
                     2 * width;
    return doubles * sizeof(double) + slot_sum_count(rs) * wf_done_samples(rs) * sizeof(float) +
           strand_count(rs) * (sizeof(wf_strand) + sizeof(wf_quick_strand)) +
           width * sizeof(float);
}

static bool make_buffers(wf_scratch *s, int fields_in_flight) {
    const wf_resampler *rs = s->rs;
    size_t width = (size_t)rs->x.pixels, phases = (size_t)rs->phases;
    s->sums = malloc((size_t)fields_in_flight * s->slot_samples * sizeof *s->sums);
    s->live = calloc((size_t)fields_in_flight * s->slot_sums, sizeof *s->live);
    s->held.own = malloc(s->slot_sums * wf_done_samples(rs) * sizeof *s->held.own);
    s->rows = malloc(s->most_kernels * wf_row_samples(rs) * sizeof *s->rows);
    s->strands = malloc((strand_count(rs) + 1) * sizeof *s->strands);
    s->quick_strands = malloc((strand_count(rs) + 1) * sizeof *s->quick_strands);
    s->quick_exists = malloc(width * sizeof *s->quick_exists);
    s->strand_counts = malloc(phases * sizeof *s->strand_counts);
    s->picture =
        malloc((size_t)rs->desc.channels * phases * wf_run_length(rs) * sizeof *s->picture);
    s->inside = malloc(2 * width * sizeof *s->inside);
    s->totals = malloc(s->most_kernels * sizeof *s->totals);
    return s->sums && s->live && s->held.own && s->rows && s->strands && s->quick_strands &&
           s->quick_exists && s->strand_counts && s->picture && s->inside && s->totals &&
           wf_kernel_alloc(rs, &s->kernel);
}

wf_scratch *wf_scratch_new(const wf_resampler *rs, int fields_in_flight) {
    wf_scratch *s = calloc(1, sizeof *s);
    if (!s) return NULL;
    s->rs = rs;
    s->slot_sums = slot_sum_count(rs);
    s->slot_samples = s->slot_sums * wf_sum_samples(rs);
    s->most_kernels = most_kernels(rs);
    if (!make_buffers(s, fields_in_flight)) {
        wf_scratch_free(s);
        return NULL;
    }
    s->exists = s->inside + rs->x.pixels;
    return s;
}

void wf_scratch_free(wf_scratch *s) {
    if (!s) return;
    free(s->sums);
    free(s->live);
    free(s->held.own);
    free(s->rows);
    free(s->strands);
    free(s->quick_strands);
    free(s->quick_exists);
    free(s->strand_counts);
    free(s->picture);
    free(s->inside);
    free(s->totals);
    wf_kernel_release(&s->kernel);
    free(s);
}

/* ---- A field's life ---- */

static bool inside_window(wf_window window, int64_t k) {
    return k >= window.first && k < window.first + window.count;
}

static wf_moment moment_of(const wf_field *f, int line, int64_t k) {
    const wf_timing *timing = &f->rs->timing;
    wf_window window = wf_timing_window(timing, f->index, line);
    wf_moment m = {0, 0, 0};
    if (!inside_window(window, k)) return m;
    if (window.alone) {
        m.weight = 1;
    } else {
        wf_timing_cell(timing, f->index, line, k, &m.q0, &m.q1);
        m.weight = m.q1 - m.q0;
    }
    return m;
}

static int moment_rows(const wf_field *f) {
    return f->rs->desc.timing.skew.num ? f->weights->lines : 1;
}

static void fill_moments(wf_field *f) {
    for (int l = 0; l < moment_rows(f); l++)
        for (int64_t n = 0; n < f->window.count; n++)
            f->moments[l * f->window.count + n] = moment_of(
                f, f->weights->first_line + l * f->weights->line_step, f->window.first + n);
}

bool wf_field_renew(wf_field *f, int64_t index) {
    const wf_resampler *rs = f->rs;
    f->index = index;
    f->weights = &rs->weights[wf_raster_parity(rs->desc.raster, index)];
    f->window = wf_resampler_window(rs, index);
    f->carried = f->last = f->complete = false;
    f->quick =
        rs->line_additions &&
        f->window.count * f->weights->most_terms + rs->line_additions <= WF_QUICK_ADDITIONS;
    free(f->moments);
    free(f->bands_left);
    free(f->overscan);
    f->overscan = NULL;
    f->bands_left = malloc((size_t)f->weights->lines * sizeof *f->bands_left);
    f->moments = malloc((size_t)moment_rows(f) * (size_t)f->window.count * sizeof *f->moments);
    if (!f->moments || !f->bands_left) return false;
    for (int l = 0; l < f->weights->lines; l++)
        atomic_init(&f->bands_left[l], f->weights->line_bands[l]);
    fill_moments(f);
    memset(f->inside, 0, 2 * most_sums(rs) * sizeof *f->inside);
    memset(f->touched, 0, most_sums(rs) * sizeof *f->touched);
    return true;
}

wf_field *wf_field_new(const wf_resampler *rs, int64_t index) {
    wf_field *f = calloc(1, sizeof *f);
    if (!f) return NULL;
    f->rs = rs;
    f->inside = malloc(2 * most_sums(rs) * sizeof *f->inside);
    f->touched = malloc(most_sums(rs) * sizeof *f->touched);
    if (!f->inside || !f->touched || !wf_field_renew(f, index)) {
        wf_field_free(f);
        return NULL;
    }
    f->exists = f->inside + most_sums(rs);
    return f;
}

void wf_field_free(wf_field *f) {
    if (!f) return;
    free(f->moments);
    free(f->bands_left);
    free(f->inside);
    free(f->touched);
    free(f->done);
    free(f->carry);
    free(f->overscan);
    free(f);
}

int64_t wf_field_index(const wf_field *f) {
    return f->index;
}

bool wf_field_begin_batch(wf_field *f, bool last, bool overscan) {
    size_t sums = (size_t)f->weights->sum_count;
    f->last = last;
    if (overscan && !f->overscan)
        f->overscan = calloc(sums * wf_columns_of(f->rs), sizeof *f->overscan);
    if (last && !f->done)
        f->done = malloc(most_sums(f->rs) * wf_done_samples(f->rs) * sizeof *f->done);
    if (!last && !f->carry) f->carry = malloc(sums * wf_sum_samples(f->rs) * sizeof *f->carry);
    return (!overscan || f->overscan) && (last ? f->done != NULL : f->carry != NULL);
}

void wf_field_end_batch(wf_field *f) {
    f->carried = !f->last;
    f->complete = f->last;
    if (f->last) {
        free(f->carry);
        f->carry = NULL;
    }
}

bool wf_field_complete(const wf_field *f) {
    return f->complete;
}

/* ---- Adding up ---- */

static double *slot_sum(wf_scratch *s, int slot, int sum) {
    return s->sums + (size_t)slot * s->slot_samples + (size_t)sum * wf_sum_samples(s->rs);
}

void wf_band_open(const wf_field *f, int band, wf_scratch *s, int slot) {
    const wf_band *b = &f->weights->bands[band];
    size_t samples = wf_sum_samples(f->rs);
    bool *live = s->live + (size_t)slot * s->slot_sums;
    for (int sum = b->sums.first; sum < b->sums.end; sum++, live++) {
        *live = f->carried && f->touched[sum];
        if (*live)
            memcpy(slot_sum(s, slot, sum - b->sums.first), f->carry + (size_t)sum * samples,
                   samples * sizeof *f->carry);
    }
}

/* The weight of a row at subframe k: the integral of h over its cell, but for what u adds. */
static double weight_at(const wf_field *f, const wf_term *term, int64_t k) {
    if (!inside_window(f->window, k)) return 0;
    const wf_aperture_kind *kind = f->rs->desc.aperture.kind;
    int line = f->rs->desc.timing.skew.num ? term->line : 0;
    const wf_moment *m = &f->moments[line * f->window.count + (k - f->window.first)];
    if (kind->couples_vq && m->q0 < m->q1) {
        double tau = wf_ratio_value(f->rs->desc.timing.width);
        return kind->cell_vq(tau, term->v0, term->v1, m->q0, m->q1);
    }
    return term->weight * m->weight;
}

static double weight_of_all(const wf_field *f, const wf_term *term,
                            const wf_band_input *input) {
    double weight = 0;
    for (int i = 0; i < input->k_count; i++) weight += weight_at(f, term, input->k[i]);
    return weight;
}

static void add_constant(double *sum, double value, wf_span columns) {
    for (int a = columns.first; a < columns.end; a++) sum[a] += value;
}

static wf_span meet(wf_span a, wf_span b) {
    wf_span both = {a.first > b.first ? a.first : b.first, a.end < b.end ? a.end : b.end};
    return both.end < both.first ? (wf_span){both.first, both.first} : both;
}

static wf_span shifted(wf_span span, int by) {
    return (wf_span){span.first - by, span.end - by};
}

/* Adds to sum[] over the columns where samples of this row exist: the display window's, and
 * those of the data window beyond it. */
static void add_where_samples_exist(const wf_resampler *rs, const wf_term *term,
                                    const wf_band_input *input, double value, double *sum) {
    wf_span display = meet(rs->columns, (wf_span){0, rs->x.cells});
    wf_span data = meet(rs->columns, (wf_span){input->data.x0, input->data.x1});
    int origin = rs->columns.first;
    bool in_data = term->row >= input->data.y0 && term->row < input->data.y1;
    if (!term->inside) {
        if (in_data) add_constant(sum, value, shifted(data, origin));
        return;
    }
    add_constant(sum, value, shifted(display, origin));
    if (!in_data) return;
    wf_span left = meet(data, (wf_span){rs->columns.first, 0});
    wf_span right = meet(data, (wf_span){rs->x.cells, rs->columns.end});
    add_constant(sum, value, shifted(left, origin));
    add_constant(sum, value, shifted(right, origin));
}

static bool padded(const wf_resampler *rs) {
    return rs->x.padded || rs->y.padded;
}

static void count_weight(wf_field *f, const wf_term *term, const wf_band_input *input,
                         double weight) {
    if (wf_resampler_overscan(f->rs, &input->data)) {
        double *sum = f->overscan + (size_t)term->sum * wf_columns_of(f->rs);
        add_where_samples_exist(f->rs, term, input, weight, sum);
        return;
    }
    if (term->inside) f->inside[term->sum] += weight;
    if (term->inside || f->rs->y.padded) f->exists[term->sum] += weight;
}

static size_t sample_bytes(const wf_band_input *input) {
    return input->half ? 2 : 4;
}

/* The columns of a row of samples that are added to sums. */
static wf_span columns_added(const wf_resampler *rs, const wf_band_input *input) {
    wf_span reached = rs->columns;
    if (padded(rs)) reached = meet(reached, (wf_span){0, rs->x.cells});
    return meet(reached, (wf_span){input->here.x0, input->here.x1});
}

static void add_samples(const wf_field *f, const wf_term *term, const wf_band_input *input,
                        double weight, double *sum) {
    const wf_resampler *rs = f->rs;
    wf_span columns = columns_added(rs, input);
    size_t count = (size_t)(columns.end - columns.first);
    size_t skipped = (size_t)(term->row - input->here.y0) * input->line_stride +
                     (size_t)(columns.first - input->here.x0);
    sum += columns.first - rs->columns.first;
    for (int c = 0; c < rs->desc.channels && c < input->channels; c++) {
        const char *pixel = (const char *)input->plane[c] + skipped * sample_bytes(input);
        double *to = sum + (size_t)c * wf_columns_of(rs);
        if (input->half)
            rs->ops->add_half(to, (const uint16_t *)(const void *)pixel, weight, count);
        else
            rs->ops->add_floats(to, false,
                                (const float *[]){(const float *)(const void *)pixel}, &weight,
                                1, count);
    }
}

static bool has_samples(const wf_resampler *rs, const wf_term *term,
                        const wf_band_input *input) {
    if (padded(rs) && !term->inside) return false;
    return term->row >= input->here.y0 && term->row < input->here.y1 &&
           input->here.x1 > rs->columns.first && input->here.x0 < rs->columns.end;
}

/* The sum, zeros at first. It begins when something is added, so that what no picture shows
 * costs nothing. */
static double *begun_sum(const wf_resampler *rs, wf_scratch *s, int slot, int sum) {
    double *begun = slot_sum(s, slot, sum);
    bool *live = &s->live[(size_t)slot * s->slot_sums + (size_t)sum];
    if (!*live) memset(begun, 0, wf_sum_samples(rs) * sizeof *begun);
    *live = true;
    return begun;
}

static void add_term(const wf_field *f, const wf_term *term, const wf_band_input *input,
                     double weight, int sum, wf_scratch *s, int slot) {
    const wf_resampler *rs = f->rs;
    bool opaque = rs->desc.channels == 4 && input->channels < 4;
    if (!opaque && !has_samples(rs, term, input)) return;
    double *to = begun_sum(rs, s, slot, sum);
    if (has_samples(rs, term, input)) add_samples(f, term, input, weight, to);
    if (opaque) add_where_samples_exist(rs, term, input, weight, to + 3 * wf_columns_of(rs));
}

/* Rows that are added to one sum together: where they begin in each plane. */
enum { MOST_TOGETHER = 16 };
typedef struct rows_together {
    size_t count, at[MOST_TOGETHER];
    double weight[MOST_TOGETHER];
} rows_together;

/* The samples of a sum, of either kind, from `at` on. */
static void *sum_samples(const wf_field *f, double *sum, size_t at) {
    return f->quick ? (void *)((float *)sum + at) : (void *)(sum + at);
}

/* Zeros beside the columns that rows are added to. */
static void clear_ends(const wf_field *f, double *sum, wf_span columns) {
    const wf_resampler *rs = f->rs;
    size_t size = f->quick ? sizeof(float) : sizeof(double);
    size_t before = (size_t)(columns.first - rs->columns.first),
           after = (size_t)(rs->columns.end - columns.end);
    for (size_t c = 0; c < (size_t)rs->desc.channels; c++) {
        memset(sum_samples(f, sum, c * wf_columns_of(rs)), 0, before * size);
        memset(sum_samples(f, sum, (c + 1) * wf_columns_of(rs) - after), 0, after * size);
    }
}

static void add_together(const wf_field *f, const wf_band_input *input, rows_together *rows,
                         int sum, wf_scratch *s, int slot) {
    const wf_resampler *rs = f->rs;
    wf_span columns = columns_added(rs, input);
    size_t count = (size_t)(columns.end - columns.first),
           before = (size_t)(columns.first - rs->columns.first);
    double *begun = slot_sum(s, slot, sum);
    bool *live = &s->live[(size_t)slot * s->slot_sums + (size_t)sum];
    if (!rows->count) return;
    if (!*live) clear_ends(f, begun, columns);
    for (size_t c = 0; c < (size_t)rs->desc.channels; c++) {
        void *to = sum_samples(f, begun, c * wf_columns_of(rs) + before);
        const float *row[MOST_TOGETHER];
        for (size_t r = 0; r < rows->count; r++)
            row[r] = (const float *)input->plane[c] + rows->at[r];
        if (f->quick)
            rs->ops->quick_add_floats(to, !*live, row, rows->weight, rows->count, count);
        else
            rs->ops->add_floats(to, !*live, row, rows->weight, rows->count, count);
    }
    *live = true;
    rows->count = 0;
}

static void join(const wf_resampler *rs, const wf_term *term, const wf_band_input *input,
                 double weight, rows_together *rows) {
    int first = columns_added(rs, input).first;
    if (!has_samples(rs, term, input)) return;
    rows->weight[rows->count] = weight;
    rows->at[rows->count++] = (size_t)(term->row - input->here.y0) * input->line_stride +
                              (size_t)(first - input->here.x0);
}

void wf_band_add(wf_field *f, int band, wf_scratch *s, int slot, const wf_band_input *input) {
    const wf_band *b = &f->weights->bands[band];
    bool together = !input->half && input->channels >= f->rs->desc.channels;
    rows_together rows = {0};
    for (int t = b->terms.first; t < b->terms.end; t++) {
        const wf_term *term = &f->weights->terms[t];
        int sum = term->sum - b->sums.first;
        double weight = weight_of_all(f, term, input);
        if (weight != 0) count_weight(f, term, input, weight);
        if (weight != 0 && together) join(f->rs, term, input, weight, &rows);
        if (weight != 0 && !together) add_term(f, term, input, weight, sum, s, slot);
        bool ends = t + 1 == b->terms.end || term[1].sum != term->sum;
        if (ends || rows.count == MOST_TOGETHER) add_together(f, input, &rows, sum, s, slot);
    }
}

static void finish_sum(const wf_field *f, double *sum, float *done) {
    const wf_resampler *rs = f->rs;
    size_t columns = wf_columns_of(rs), lanes = (size_t)rs->lanes,
           length = (size_t)rs->lane_length;
    for (size_t c = 0; c < (size_t)rs->desc.channels; c++, done += wf_row_samples(rs)) {
        const void *from = sum_samples(f, sum, c * columns);
        if (f->quick)
            rs->ops->quick_split(done, from, lanes, length, columns);
        else
            rs->ops->split(done, from, lanes, length, columns);
    }
}

/* Whether sums lie in their slots as lines take them. */
static bool as_lines_take(const wf_field *f) {
    return f->quick && f->rs->lanes == 1;
}

static void hold(const wf_field *f, const wf_band *b, wf_scratch *s, int slot) {
    wf_held *held = &s->held;
    held->field = f;
    held->index = f->index;
    held->sums = b->sums;
    held->done = as_lines_take(f) ? (const float *)slot_sum(s, slot, 0) : held->own;
    held->stride = as_lines_take(f) ? (size_t)(slot_sum(s, slot, 1) - slot_sum(s, slot, 0)) *
                                          (sizeof(double) / sizeof(float))
                                    : wf_done_samples(f->rs);
}

void wf_band_close(wf_field *f, int band, wf_scratch *s, int slot, bool at_once) {
    const wf_band *b = &f->weights->bands[band];
    size_t samples = wf_sum_samples(f->rs), done = wf_done_samples(f->rs);
    const bool *live = s->live + (size_t)slot * s->slot_sums;
    at_once = at_once && f->last;
    s->held.field = NULL;
    if (at_once) hold(f, b, s, slot);
    for (int sum = b->sums.first; sum < b->sums.end; sum++) {
        int of_band = sum - b->sums.first;
        double *from = slot_sum(s, slot, of_band);
        f->touched[sum] = live[of_band];
        if (!f->touched[sum]) continue;
        if (!at_once || !f->weights->whole[sum]) {
            if (f->last)
                finish_sum(f, from, f->done + (size_t)sum * done);
            else
                memcpy(f->carry + (size_t)sum * samples, from, samples * sizeof *from);
        } else if (!as_lines_take(f)) {
            finish_sum(f, from, s->held.own + (size_t)of_band * done);
        }
    }
}

wf_span wf_band_lines(const wf_field *f, int band) {
    return f->last ? f->weights->bands[band].lines : (wf_span){0, 0};
}

bool wf_field_line_ready(wf_field *f, int line) {
    return atomic_fetch_sub_explicit(&f->bands_left[line], 1, memory_order_acq_rel) == 1;
}

bool wf_field_lines_taken(const wf_field *f) {
    return atomic_load(&f->bands_left[0]) == 0;
}
