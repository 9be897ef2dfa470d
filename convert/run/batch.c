#include <omp.h>
#include <stdlib.h>
#include <string.h>

#include "convert/run/pipeline.h"

/* Files open at once; a window of more is read in several batches. */
#define MOST_OPEN 64
/* Whole pictures in memory at once, where a format cannot be read by chunks. */
#define MOST_WHOLE_BYTES ((size_t)256 << 20)

typedef struct batch {
    wf_pipeline *p;
    int64_t k[MOST_OPEN];
    wf_subframe *subframe[MOST_OPEN]; /* NULL: missing, black */
    bool borrowed[MOST_OPEN];         /* held: the one before it */
    int count;
    int64_t end;       /* of the group: fields before it are finished at once */
    wf_field **fields; /* those that this batch adds to */
    int field_count;
} batch;

/* ---- Opening ---- */

/* The subframe shown at k: itself, or where it is missing and held, its nearest neighbour. */
static const wf_subframe_ref *shown_at(const wf_pipeline *p, int64_t k) {
    const wf_sequence *sequence = &p->setup->sequence;
    if (sequence->refs[k].path || p->job->on_missing == WF_MISSING_BLACK)
        return &sequence->refs[k];
    for (int64_t earlier = k; earlier-- > 0;)
        if (sequence->refs[earlier].path) return &sequence->refs[earlier];
    size_t later = (size_t)k;
    while (later < sequence->count && !sequence->refs[later].path) later++;
    return &sequence->refs[later < sequence->count ? later : (size_t)k];
}

static weft_status check_size(const wf_pipeline *p, const char *path, const wf_image_info *info,
                              weft_error *err) {
    wf_box a = p->setup->first.display, b = info->display;
    if (a.x1 - a.x0 == b.x1 - b.x0 && a.y1 - a.y0 == b.y1 - b.y0) return WEFT_OK;
    return wf_fail(
        err, WEFT_FAILED,
        "%s: its display window is %dx%d, the sequence began with %dx%d; all subframes "
        "must have one size",
        path, b.x1 - b.x0, b.y1 - b.y0, a.x1 - a.x0, a.y1 - a.y0);
}

static void open_one(batch *b, int i, wf_worker *worker) {
    wf_pipeline *p = b->p;
    const wf_subframe_ref *ref = shown_at(p, b->k[i]);
    if (!ref->path) return;
    weft_status status = wf_subframe_open(ref->path, ref->part, &p->setup->source,
                                          &b->subframe[i], &worker->error);
    if (!status)
        status = check_size(p, ref->path, wf_subframe_info(b->subframe[i]), &worker->error);
    if (status) wf_worker_fail(p, worker, status);
}

static void borrow_held(batch *b) {
    for (int i = 1; i < b->count; i++) {
        b->borrowed[i] = shown_at(b->p, b->k[i]) == shown_at(b->p, b->k[i - 1]);
        if (b->borrowed[i]) b->subframe[i] = b->subframe[i - 1];
    }
}

static weft_status open_all(batch *b, weft_error *err) {
    wf_pipeline *p = b->p;
    double start = wf_now_s();
#pragma omp parallel for num_threads(p->threads) schedule(dynamic, 1)
    for (int i = 0; i < b->count; i++) {
        wf_worker *worker = &p->workers[omp_get_thread_num()];
        bool held = i && shown_at(p, b->k[i]) == shown_at(p, b->k[i - 1]);
        if (!held && !worker->status && !atomic_load(&p->stop)) open_one(b, i, worker);
    }
    p->workers[0].decode_s += wf_now_s() - start;
    for (int i = 0; i < b->count; i++) p->opened += b->subframe[i] != NULL;
    borrow_held(b);
    return wf_pipeline_status(p, err);
}

static void close_all(batch *b) {
    for (int i = 0; i < b->count; i++)
        if (!b->borrowed[i]) wf_subframe_close(b->subframe[i]);
}

/* ---- Bands ---- */

static wf_cells cells_of(const wf_image_info *info) {
    return (wf_cells){info->data.x0 - info->display.x0, info->data.y0 - info->display.y0,
                      info->data.x1 - info->display.x0, info->data.y1 - info->display.y0};
}

/* Rows of the band that the subframe holds, in its own coordinates; empty where first >= end.
 */
static wf_span rows_held(const wf_subframe *subframe, wf_span rows) {
    const wf_image_info *info = wf_subframe_info(subframe);
    int first = rows.first + info->display.y0, end = rows.end + info->display.y0;
    return (wf_span){first > info->data.y0 ? first : info->data.y0,
                     end < info->data.y1 ? end : info->data.y1};
}

static weft_status read_input(batch *b, wf_worker *worker, int i, wf_span rows,
                              wf_band_input *input) {
    const wf_subframe *subframe = b->subframe[i];
    *input = (wf_band_input){.k = &b->k[i], .k_count = 1, .channels = 3};
    if (!subframe) return WEFT_OK;
    const wf_image_info *info = wf_subframe_info(subframe);
    wf_span held = rows_held(subframe, rows);
    input->data = cells_of(info);
    input->channels = info->has_alpha ? 4 : 3;
    if (held.first >= held.end) return WEFT_OK;
    wf_rows read;
    double start = wf_now_s();
    weft_status status =
        wf_reader_rows(worker->reader, subframe, held.first, held.end, &read, &worker->error);
    worker->decode_s += wf_now_s() - start;
    if (status) return status;
    input->here = (wf_cells){read.x0 - info->display.x0, read.y0 - info->display.y0,
                             read.x1 - info->display.x0, read.y1 - info->display.y0};
    memcpy(input->plane, read.plane, sizeof input->plane);
    input->line_stride = read.line_stride;
    input->channels = read.channels;
    input->half = read.type == WF_HALF;
    return WEFT_OK;
}

static bool same_boxes(const wf_subframe *a, const wf_subframe *b) {
    const wf_image_info *x = wf_subframe_info(a), *y = wf_subframe_info(b);
    return !memcmp(&x->data, &y->data, sizeof x->data) &&
           !memcmp(&x->display, &y->display, sizeof x->display);
}

/* Whether subframe i + 1 shows in this band what the reader has just returned for subframe i.
 */
static weft_status next_is_same(batch *b, wf_worker *worker, int i, wf_span rows, bool *same) {
    *same = false;
    if (!b->p->merge || i + 1 >= b->count) return WEFT_OK;
    const wf_subframe *here = b->subframe[i], *next = b->subframe[i + 1];
    *same = here == next;
    if (*same || !here || !next || !same_boxes(here, next)) return WEFT_OK;
    wf_span held = rows_held(next, rows);
    *same = held.first >= held.end;
    if (*same) return WEFT_OK;
    double start = wf_now_s();
    weft_status status =
        wf_reader_same(worker->reader, next, held.first, held.end, same, &worker->error);
    worker->decode_s += wf_now_s() - start;
    return status;
}

static void add_to_fields(batch *b, wf_worker *worker, int band, const wf_band_input *input) {
    double start = wf_now_s();
    for (int f = 0; f < b->field_count; f++)
        wf_band_add(b->fields[f], band, worker->scratch, f, input);
    worker->resample_s += wf_now_s() - start;
}

static weft_status add_subframes(batch *b, wf_worker *worker, int band) {
    wf_span rows = wf_resampler_band_rows(b->p->setup->resampler, band);
    for (int i = 0; i < b->count; i++) {
        wf_band_input input;
        weft_status status = read_input(b, worker, i, rows, &input);
        for (bool same = true; !status && same;) {
            status = next_is_same(b, worker, i, rows, &same);
            if (!status && same) input.k_count++, i++;
        }
        if (status) return status;
        add_to_fields(b, worker, band, &input);
        if (b->p->job->cancelled) return WEFT_INTERRUPTED;
    }
    return WEFT_OK;
}

/* Lines that have seen their last band, while their sums are near. */
static void finish_lines(batch *b, wf_worker *worker, int band) {
    for (int f = 0; f < b->field_count; f++) {
        wf_field *field = b->fields[f];
        wf_span lines = wf_band_lines(field, band);
        if (wf_field_index(field) >= b->end) continue;
        for (int l = lines.first; l < lines.end; l++)
            if (wf_field_line_ready(field, l)) wf_pipeline_finish_line(b->p, worker, field, l);
    }
}

static void read_band(batch *b, wf_worker *worker, int band) {
    for (int f = 0; f < b->field_count; f++)
        wf_band_open(b->fields[f], band, worker->scratch, f);
    weft_status status = add_subframes(b, worker, band);
    double start = wf_now_s();
    for (int f = 0; f < b->field_count; f++)
        wf_band_close(b->fields[f], band, worker->scratch, f);
    worker->resample_s += wf_now_s() - start;
    if (status)
        wf_worker_fail(b->p, worker, status);
    else
        finish_lines(b, worker, band);
}

static weft_status read_bands(batch *b, weft_error *err) {
    wf_pipeline *p = b->p;
    int bands = wf_resampler_bands(p->setup->resampler);
#pragma omp parallel for num_threads(p->threads) schedule(dynamic, 1)
    for (int band = 0; band < bands; band++)
        if (!atomic_load(&p->stop)) read_band(b, &p->workers[omp_get_thread_num()], band);
    return wf_pipeline_status(p, err);
}

/* ---- Fields and batches ---- */

static int64_t window_end(const wf_pipeline *p, int64_t field) {
    wf_window window = wf_resampler_window(p->setup->resampler, field);
    return window.first + window.count;
}

static bool any_overscan(const batch *b) {
    for (int i = 0; i < b->count; i++) {
        if (!b->subframe[i]) continue;
        wf_cells data = cells_of(wf_subframe_info(b->subframe[i]));
        if (wf_resampler_overscan(b->p->setup->resampler, &data)) return true;
    }
    return false;
}

static wf_field *field_for(wf_pipeline *p, int64_t index) {
    if (!p->spare_count) return wf_field_new(p->setup->resampler, index);
    wf_field *field = p->spare[--p->spare_count];
    if (wf_field_renew(field, index)) return field;
    wf_field_free(field);
    return NULL;
}

static weft_status add_flight(wf_pipeline *p, weft_error *err) {
    int64_t index = p->flight_first + p->flight_count;
    wf_field *field = field_for(p, index);
    if (!field)
        return wf_fail(err, WEFT_NO_MEMORY, "no memory for field %lld", (long long)index);
    p->flight[p->flight_count++] = field;
    return WEFT_OK;
}

/* Puts in flight the fields of the group, and those after it that the batch's last subframe
 * already belongs to. */
static weft_status launch_fields(const batch *b, int64_t end, weft_error *err) {
    wf_pipeline *p = b->p;
    int64_t last = b->k[b->count - 1], most = end + p->carried_most;
    if (most > p->end_field) most = p->end_field;
    for (;;) {
        int64_t next = p->flight_first + p->flight_count;
        if (next >= most || wf_resampler_window(p->setup->resampler, next).first > last) break;
        weft_status status = add_flight(p, err);
        if (status) return status;
    }
    return WEFT_OK;
}

static weft_status begin_fields(batch *b, weft_error *err) {
    wf_pipeline *p = b->p;
    bool overscan = any_overscan(b);
    int64_t past = b->k[b->count - 1] + 1;
    for (int f = 0; f < p->flight_count; f++) {
        if (wf_field_complete(p->flight[f])) continue;
        bool last = window_end(p, p->flight_first + f) <= past;
        if (!wf_field_begin_batch(p->flight[f], last, overscan))
            return wf_fail(err, WEFT_NO_MEMORY, "no memory for the sums of field %lld",
                           (long long)(p->flight_first + f));
        b->fields[b->field_count++] = p->flight[f];
    }
    return WEFT_OK;
}

static weft_status run_batch(batch *b, int64_t end, weft_error *err) {
    weft_status status = open_all(b, err);
    if (!status) status = launch_fields(b, end, err);
    if (!status) status = begin_fields(b, err);
    if (!status) status = read_bands(b, err);
    for (int f = 0; !status && f < b->field_count; f++) wf_field_end_batch(b->fields[f]);
    close_all(b);
    return status;
}

static int most_open(const wf_pipeline *p) {
    const wf_image_info *info = &p->setup->first;
    if (!info->whole) return MOST_OPEN;
    size_t samples =
        (size_t)(info->data.x1 - info->data.x0) * (size_t)(info->data.y1 - info->data.y0);
    size_t pictures = MOST_WHOLE_BYTES / (samples * 4 * sizeof(float) + 1);
    return pictures < 1 ? 1 : pictures > MOST_OPEN ? MOST_OPEN : (int)pictures;
}

/* The next subframes from k on that fields from *field to end need. */
static void collect(batch *b, int64_t *field, int64_t *k, int most) {
    while (*field < b->end && b->count < most) {
        wf_window window = wf_resampler_window(b->p->setup->resampler, *field);
        if (*k < window.first) *k = window.first;
        if (*k >= window.first + window.count)
            ++*field;
        else
            b->k[b->count++] = (*k)++;
    }
}

weft_status wf_batch_read(wf_pipeline *p, int64_t first, int64_t end, weft_error *err) {
    int most = most_open(p);
    int64_t k = p->next_subframe;
    weft_status status = WEFT_OK;
    for (int64_t field = first; field < end && !status;) {
        batch b = {.p = p, .end = end, .fields = p->active};
        collect(&b, &field, &k, most);
        if (b.count) status = run_batch(&b, end, err);
    }
    if (p->carried_most) p->next_subframe = k;
    return status;
}

void wf_batch_foresee(wf_pipeline *p, int64_t first, int64_t end, bool *needed) {
    const wf_subframe_ref *refs = p->setup->sequence.refs;
    int most = most_open(p);
    int64_t k = p->next_subframe;
    for (int64_t field = first; field < end;) {
        batch b = {.p = p, .end = end};
        collect(&b, &field, &k, most);
        for (int i = 0; i < b.count; i++) {
            const wf_subframe_ref *shown = shown_at(p, b.k[i]);
            if (!shown->path) continue;
            needed[shown - refs] = true;
            p->opened += !i || shown != shown_at(p, b.k[i - 1]);
        }
    }
    if (p->carried_most) p->next_subframe = k;
}
