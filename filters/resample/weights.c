/* Builds the weights of the fields of one parity: which rows of cells add to which sums by how
 * much, and which sums make which line. */
#include "filters/resample/resampler_inside.h"

#include <stdlib.h>

/* What is being built of one parity's weights. Terms and taps arrive in the order of rows. */
typedef struct builder {
    wf_resampler *rs;
    wf_weights *weights;
    int term_capacity, tap_capacity;
    wf_span *reach; /* [lines]: rows of each */
    int *line_sum;  /* [lines]: the sum of a line in the band being built, or -1 */
} builder;

static int frame_line(const wf_weights *w, int line) {
    return w->first_line + line * w->line_step;
}

static bool reserve(void **array, int *capacity, int count, size_t size) {
    if (count < *capacity) return true;
    int more = *capacity ? 2 * *capacity : 1024;
    void *grown = realloc(*array, (size_t)more * size);
    if (!grown) return false;
    *array = grown;
    *capacity = more;
    return true;
}

static bool add_term(builder *b, wf_term term) {
    wf_weights *w = b->weights;
    if (!reserve((void **)&w->terms, &b->term_capacity, w->term_count, sizeof term))
        return false;
    w->terms[w->term_count++] = term;
    return true;
}

static bool add_tap(builder *b, int line, int sum, int kernel) {
    wf_weights *w = b->weights;
    wf_tap tap = {line, sum, kernel};
    if (kernel < 0 || !reserve((void **)&w->taps, &b->tap_capacity, w->tap_count, sizeof tap))
        return false;
    w->taps[w->tap_count++] = tap;
    return true;
}

/* The row's part in one line: a term of its own, unless rows are summed by themselves. */
static bool add_row_to_line(builder *b, int row, int line) {
    wf_resampler *rs = b->rs;
    const wf_aperture *a = &rs->desc.aperture;
    int j = frame_line(b->weights, line);
    double v0 = wf_axis_edge_in_picture(&rs->y, row, j);
    double v1 = wf_axis_edge_in_picture(&rs->y, row + 1, j);
    if (v0 >= v1) return true;
    if (rs->sums_by_row)
        return add_tap(b, line, b->weights->sum_count - 1, wf_kernel_for(rs, v0, v1));
    bool own_sum = a->kind->couples_uv || b->line_sum[line] < 0;
    if (own_sum) {
        b->line_sum[line] = b->weights->sum_count++;
        if (!add_tap(b, line, b->line_sum[line], wf_kernel_for(rs, v0, v1))) return false;
    }
    double weight = a->kind->couples_uv ? 1 : a->kind->cell_v(a, v0, v1);
    return add_term(b, (wf_term){row, line, b->line_sum[line], wf_axis_inside(&rs->y, row),
                                 weight, v0, v1});
}

static bool add_row(builder *b, int row, int *top_line) {
    wf_weights *w = b->weights;
    while (*top_line < w->lines && b->reach[*top_line].end <= row) ++*top_line;
    if (b->rs->sums_by_row) {
        bool inside = wf_axis_inside(&b->rs->y, row);
        if (!add_term(b, (wf_term){row, 0, w->sum_count++, inside, 1, 0, 0})) return false;
    }
    for (int line = *top_line; line < w->lines && b->reach[line].first <= row; line++)
        if (!add_row_to_line(b, row, line)) return false;
    return true;
}

static int by_sum_then_row(const void *left, const void *right) {
    const wf_term *a = left, *b = right;
    return a->sum != b->sum ? (a->sum > b->sum) - (a->sum < b->sum)
                            : (a->row > b->row) - (a->row < b->row);
}

static bool add_band(builder *b, int index, int *top_line) {
    wf_weights *w = b->weights;
    wf_band *band = &w->bands[index];
    band->rows = wf_resampler_band_rows(b->rs, index);
    band->terms.first = w->term_count;
    band->sums.first = w->sum_count;
    for (int line = 0; line < w->lines; line++) b->line_sum[line] = -1;
    for (int row = band->rows.first; row < band->rows.end; row++)
        if (!add_row(b, row, top_line)) return false;
    band->terms.end = w->term_count;
    band->sums.end = w->sum_count;
    size_t terms = (size_t)(band->terms.end - band->terms.first);
    if (terms) qsort(w->terms + band->terms.first, terms, sizeof *w->terms, by_sum_then_row);
    int sums = band->sums.end - band->sums.first;
    if (sums > w->most_sums) w->most_sums = sums;
    return true;
}

static int by_line_then_kernel(const void *left, const void *right) {
    const wf_tap *a = left, *b = right;
    if (a->line != b->line) return a->line < b->line ? -1 : 1;
    if (a->kernel != b->kernel) return a->kernel < b->kernel ? -1 : 1;
    return (a->sum > b->sum) - (a->sum < b->sum);
}

static int kernels_of(const wf_weights *w, wf_span taps) {
    int count = 0;
    for (int t = taps.first; t < taps.end; t++)
        count += t == taps.first || w->taps[t].kernel != w->taps[t - 1].kernel;
    return count;
}

static void index_taps(wf_weights *w) {
    qsort(w->taps, (size_t)w->tap_count, sizeof *w->taps, by_line_then_kernel);
    for (int t = 0; t < w->tap_count; t++) {
        wf_span *span = &w->line_taps[w->taps[t].line];
        if (!span->end) span->first = t;
        span->end = t + 1;
    }
    for (int line = 0; line < w->lines; line++) {
        int kernels = kernels_of(w, w->line_taps[line]);
        if (kernels > w->most_kernels) w->most_kernels = kernels;
    }
}

/* Which bands each line reaches, and the other way round. */
static void index_bands(builder *b) {
    wf_weights *w = b->weights;
    int origin = wf_band_floor(b->rs, b->rs->rows.first), rows = b->rs->desc.band_rows;
    for (int line = 0; line < w->lines; line++) {
        int first = (b->reach[line].first - origin) / rows;
        int last = (b->reach[line].end - 1 - origin) / rows;
        w->line_bands[line] = last - first + 1;
        for (int band = first; band <= last; band++) {
            wf_span *lines = &w->bands[band].lines;
            if (!lines->end) lines->first = line;
            lines->end = line + 1;
        }
    }
}

static void count_terms(wf_weights *w) {
    int count = 0;
    for (int t = 0; t < w->term_count; t++) {
        count = t && w->terms[t].sum == w->terms[t - 1].sum ? count + 1 : 1;
        if (count > w->most_terms) w->most_terms = count;
    }
}

static bool find_whole(wf_weights *w) {
    w->whole = malloc((size_t)w->sum_count * sizeof *w->whole);
    if (!w->whole) return false;
    for (int sum = 0; sum < w->sum_count; sum++) w->whole[sum] = true;
    for (int t = 0; t < w->tap_count; t++)
        if (w->line_bands[w->taps[t].line] > 1) w->whole[w->taps[t].sum] = false;
    return true;
}

static bool build(builder *b) {
    wf_weights *w = b->weights;
    for (int line = 0; line < w->lines; line++)
        b->reach[line] =
            wf_axis_reach(&b->rs->y, b->rs->desc.aperture.reach_v, frame_line(w, line));
    int top_line = 0;
    for (int band = 0; band < b->rs->band_count; band++)
        if (!add_band(b, band, &top_line)) return false;
    count_terms(w);
    index_taps(w);
    index_bands(b);
    return find_whole(w);
}

bool wf_weights_build(wf_resampler *rs, int parity) {
    wf_weights *w = &rs->weights[parity];
    const wf_raster *raster = rs->desc.raster;
    w->lines = wf_raster_field_lines(raster, parity);
    w->first_line = parity;
    w->line_step = wf_raster_line_step(raster);
    w->bands = calloc((size_t)rs->band_count, sizeof *w->bands);
    w->line_taps = calloc((size_t)w->lines, sizeof *w->line_taps);
    w->line_bands = calloc((size_t)w->lines, sizeof *w->line_bands);
    builder b = {.rs = rs, .weights = w};
    b.reach = calloc((size_t)w->lines, sizeof *b.reach);
    b.line_sum = calloc((size_t)w->lines, sizeof *b.line_sum);
    bool allocated = w->bands && w->line_taps && w->line_bands && b.reach && b.line_sum;
    bool built = allocated && build(&b);
    free(b.reach);
    free(b.line_sum);
    return built;
}

void wf_weights_release(wf_weights *w) {
    free(w->bands);
    free(w->terms);
    free(w->taps);
    free(w->line_taps);
    free(w->line_bands);
    free(w->whole);
}
