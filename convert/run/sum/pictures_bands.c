/* Fields summed from pictures: a few pictures are opened, read band by band of rows, each band
 * by one thread, and added to all fields that see them. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "convert/base/clock.h"
#include "convert/run/sum/pictures.h"

/* Pictures that are open together. */
typedef struct batch {
    wf_run *run;
    wf_pictures *p;
    const wf_units *units;
    wf_subframe *picture[WF_UNITS_TOGETHER]; /* NULL: missing, black */
    bool borrowed[WF_UNITS_TOGETHER];        /* it is the one before it */
    wf_field **fields;                       /* those that this batch adds to */
    int field_count;
} batch;

/* ---- Opening ---- */

/* Whether it shows the picture of the unit before it. */
static bool repeats(const batch *b, int i) {
    const int64_t *unit = b->units->unit;
    return i && b->run->kind->pictures->same(b->run, unit[i - 1], unit[i]);
}

static void open_one(void *user, wf_worker *worker, int i) {
    batch *b = user;
    if (repeats(b, i)) return;
    weft_status status =
        b->run->kind->pictures->open(b->run, b->units->unit[i], &b->picture[i], &worker->error);
    if (status) wf_crew_fail(&b->run->crew, worker, status);
}

static weft_status open_all(batch *b, weft_error *err) {
    double start = wf_now_s();
    const wf_picture_reading *reading = b->run->kind->pictures;
    weft_status status = reading->prepare ? reading->prepare(b->run, b->units, err) : WEFT_OK;
    if (status) return status;
    wf_crew_each(&b->run->crew, b->units->count, 1, open_one, b);
    b->run->crew.workers[0].source_s += wf_now_s() - start;
    for (int i = 0; i < b->units->count; i++) b->p->opened += b->picture[i] != NULL;
    for (int i = 0; i < b->units->count; i++) {
        b->borrowed[i] = repeats(b, i);
        if (b->borrowed[i]) b->picture[i] = b->picture[i - 1];
    }
    return wf_crew_status(&b->run->crew, err);
}

static void close_all(const batch *b) {
    for (int i = 0; i < b->units->count; i++)
        if (!b->borrowed[i]) wf_subframe_close(b->picture[i]);
}

/* ---- Reading ---- */

static wf_cells cells_of(const wf_image_info *info) {
    return (wf_cells){info->data.x0 - info->display.x0, info->data.y0 - info->display.y0,
                      info->data.x1 - info->display.x0, info->data.y1 - info->display.y0};
}

/* Rows of the band that the picture holds, in its own coordinates; empty where first >= end. */
static wf_span rows_held(const wf_subframe *picture, wf_span rows) {
    const wf_image_info *info = wf_subframe_info(picture);
    int first = rows.first + info->display.y0, end = rows.end + info->display.y0;
    return (wf_span){first > info->data.y0 ? first : info->data.y0,
                     end < info->data.y1 ? end : info->data.y1};
}

static weft_status read_rows(const batch *b, wf_worker *worker, const wf_subframe *picture,
                             wf_span held, wf_rows *rows) {
    double start = wf_now_s();
    weft_status status = wf_reader_rows(b->p->reader[worker->number], picture, held.first,
                                        held.end, rows, &worker->error);
    worker->source_s += wf_now_s() - start;
    return status;
}

static weft_status read_input(const batch *b, wf_worker *worker, int i, wf_span rows,
                              wf_band_input *input) {
    const wf_subframe *picture = b->picture[i];
    *input = (wf_band_input){.k = &b->units->unit[i], .k_count = 1, .channels = 3};
    if (!picture) return WEFT_OK;
    const wf_image_info *info = wf_subframe_info(picture);
    wf_span held = rows_held(picture, rows);
    input->data = cells_of(info);
    input->channels = info->has_alpha ? 4 : 3;
    if (held.first >= held.end) return WEFT_OK;
    wf_rows read;
    weft_status status = read_rows(b, worker, picture, held, &read);
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

/* Whether picture i + 1 shows in this band what the reader has just returned for picture i. */
static weft_status next_is_same(const batch *b, wf_worker *worker, int i, wf_span rows,
                                bool *same) {
    *same = false;
    if (!b->p->merge || i + 1 >= b->units->count) return WEFT_OK;
    const wf_subframe *here = b->picture[i], *next = b->picture[i + 1];
    *same = here == next;
    if (*same || !here || !next || !same_boxes(here, next)) return WEFT_OK;
    wf_span held = rows_held(next, rows);
    *same = held.first >= held.end;
    if (*same) return WEFT_OK;
    double start = wf_now_s();
    weft_status status = wf_reader_same(b->p->reader[worker->number], next, held.first,
                                        held.end, same, &worker->error);
    worker->source_s += wf_now_s() - start;
    return status;
}

/* ---- Adding ---- */

static void add_to_fields(const batch *b, wf_worker *worker, int band,
                          const wf_band_input *input) {
    double start = wf_now_s();
    for (int f = 0; f < b->field_count; f++)
        wf_band_add(b->fields[f], band, b->p->scratch[worker->number], f, input);
    worker->resample_s += wf_now_s() - start;
}

static weft_status add_pictures(const batch *b, wf_worker *worker, int band) {
    wf_span rows = wf_resampler_band_rows(b->p->resampler, band);
    for (int i = 0; i < b->units->count; i++) {
        wf_band_input input;
        weft_status status = read_input(b, worker, i, rows, &input);
        for (bool same = true; !status && same;) {
            status = next_is_same(b, worker, i, rows, &same);
            if (!status && same) input.k_count++, i++;
        }
        if (status) return status;
        add_to_fields(b, worker, band, &input);
        if (b->run->job->canceled) return WEFT_INTERRUPTED;
    }
    return WEFT_OK;
}

void wf_pictures_finish_line(wf_run *run, wf_worker *worker, const wf_field *field, int line) {
    const wf_pictures *p = run->sums;
    int64_t index = wf_field_index(field);
    float *rgb[3];
    double start = wf_now_s();
    wf_frames_place(run->frames, worker, index, line, rgb);
    wf_field_line(field, line, p->scratch[worker->number], rgb);
    float *alpha = wf_frames_alpha(run->frames, worker, index, line);
    if (alpha) wf_field_alpha(field, p->scratch[worker->number], alpha);
    worker->resample_s += wf_now_s() - start;
    wf_frames_line(run->frames, worker, index, line);
}

/* Finishes the lines that have seen their last band, while their sums are in the caches. */
static void finish_lines(const batch *b, wf_worker *worker, int band, wf_field *field) {
    wf_span lines = wf_band_lines(field, band);
    for (int l = lines.first; l < lines.end; l++)
        if (wf_field_line_ready(field, l)) wf_pictures_finish_line(b->run, worker, field, l);
}

static void close_band(const batch *b, wf_worker *worker, int band, bool whole) {
    wf_scratch *scratch = b->p->scratch[worker->number];
    for (int f = 0; f < b->field_count; f++) {
        wf_field *field = b->fields[f];
        bool at_once = whole && wf_field_index(field) < b->units->group_end;
        double start = wf_now_s();
        wf_band_close(field, band, scratch, f, at_once);
        worker->resample_s += wf_now_s() - start;
        if (at_once) finish_lines(b, worker, band, field);
    }
}

static void add_band(void *user, wf_worker *worker, int band) {
    const batch *b = user;
    wf_scratch *scratch = b->p->scratch[worker->number];
    for (int f = 0; f < b->field_count; f++) wf_band_open(b->fields[f], band, scratch, f);
    weft_status status = add_pictures(b, worker, band);
    close_band(b, worker, band, !status);
    if (status) wf_crew_fail(&b->run->crew, worker, status);
}

/* ---- One batch ---- */

static bool any_overscan(const batch *b) {
    for (int i = 0; i < b->units->count; i++) {
        if (!b->picture[i]) continue;
        wf_cells data = cells_of(wf_subframe_info(b->picture[i]));
        if (wf_resampler_overscan(b->p->resampler, &data)) return true;
    }
    return false;
}

static weft_status begin_fields(batch *b, weft_error *err) {
    bool overscan = any_overscan(b);
    int64_t past = b->units->unit[b->units->count - 1] + 1;
    for (int f = 0; f < b->p->flight_count; f++) {
        wf_field *field = b->p->flight[f];
        if (wf_field_complete(field)) continue;
        int64_t index = wf_field_index(field);
        bool last = b->run->kind->needs(b->run, index).end <= past;
        if (!wf_field_begin_batch(field, last, overscan))
            return wf_fail(err, WEFT_NO_MEMORY, "no memory for the sums of field %lld",
                           (long long)index);
        b->fields[b->field_count++] = field;
    }
    return WEFT_OK;
}

/* After how many frames of the group these units come, and how many they are, by their time. */
static void tell_part(const batch *b) {
    wf_run *run = b->run;
    int per_frame = wf_raster_fields_per_frame(&run->job->raster);
    int64_t field = wf_field_index(b->p->flight[0]), past = b->units->group_end;
    int64_t begin = run->kind->needs(run, field).first, from = b->units->unit[0];
    double frames = (double)(past - field) / per_frame;
    double units = (double)(run->kind->needs(run, past - 1).end - begin);
    double before = fmax((double)(from - begin), 0) / units;
    double here = (double)(b->units->unit[b->units->count - 1] + 1 - from) / units;
    wf_crew_part(&run->crew, (double)(field % per_frame) / per_frame + frames * before,
                 frames * fmin(here, 1 - before));
}

static weft_status add_bands(batch *b, weft_error *err) {
    wf_crew *crew = &b->run->crew;
    tell_part(b);
    wf_crew_within(crew, wf_resampler_bands(b->p->resampler), add_band, b);
    weft_status status = wf_crew_status(crew, err);
    for (int f = 0; !status && f < b->field_count; f++) wf_field_end_batch(b->fields[f]);
    return status;
}

weft_status wf_pictures_add(wf_run *run, const wf_units *units, weft_error *err) {
    wf_pictures *p = run->sums;
    batch b = {.run = run, .p = p, .units = units, .fields = p->active};
    weft_status status = open_all(&b, err);
    if (!status) status = begin_fields(&b, err);
    if (!status) status = add_bands(&b, err);
    close_all(&b);
    return status;
}
