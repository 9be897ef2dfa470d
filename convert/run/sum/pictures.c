/* Fields summed from pictures: how many are in hand at once, their memory, and their end. */
#include "convert/run/sum/pictures.h"

#include <stdlib.h>
#include <string.h>

#include "convert/base/clock.h"

/* Fields are finished in groups, so that a picture that does not change is inflated once a
 * group and threads meet seldom; but a group's sums must come from the caches when they are
 * finished. */
#define GROUP_BYTES   ((size_t)24 << 20)
#define MOST_IN_GROUP 16

/* ---- How many at once ---- */

/* Most fields after n that begin before field n's window ends; fields of one instant end
 * together and are no overlap. */
static int64_t overlap_of(const wf_resampler *resampler, int64_t end) {
    int64_t most = 0;
    for (int64_t n = 0, m = 0; n < end; n++) {
        wf_window window = wf_resampler_window(resampler, n);
        if (m < n) m = n;
        while (m + 1 < end &&
               wf_resampler_window(resampler, m + 1).first < window.first + window.count)
            m++;
        wf_window last = wf_resampler_window(resampler, m);
        bool same = last.first == window.first && last.count == window.count;
        if (!same && m - n > most) most = m - n;
    }
    return most;
}

static size_t at_most(size_t a, size_t b) {
    return a < b ? a : b;
}

/* The two fields of a segmented frame see the same pictures, and the three of a film frame. */
static int fewest_together(const wf_raster *raster) {
    return raster->pulldown ? 3 : raster->scan == WF_SEGMENTED ? 2 : 1;
}

static void choose_pace(wf_run *run, wf_pictures *p, const wf_picture_desc *desc) {
    size_t allowed = run->job->max_memory_bytes / 8;
    size_t group =
        at_most(allowed, GROUP_BYTES) / wf_resampler_field_bytes(p->resampler, false);
    size_t carried =
        at_most(allowed, desc->carried_bytes) / wf_resampler_field_bytes(p->resampler, true);
    int fewest = fewest_together(&run->job->raster),
        together = (int)at_most(group, MOST_IN_GROUP);
    int64_t overlap = overlap_of(p->resampler, desc->end_field);
    run->pace = (wf_pace){
        .fields_together = together < fewest ? fewest : together,
        .fields_carried = (size_t)overlap <= carried && !desc->unforeseen ? (int)overlap : 0,
        .units_together = desc->open_together,
    };
    /* A chunk that starts inside an overlap must add in the same order as a whole run. */
    p->merge = run->job->skip && overlap == 0;
}

static int most_in_flight(const wf_run *run) {
    return run->pace.fields_together + run->pace.fields_carried;
}

static weft_status check_memory(wf_run *run, const wf_pictures *p, weft_error *err) {
    const wf_resampler *rs = p->resampler;
    size_t allowed = run->job->max_memory_bytes;
    size_t bytes =
        (size_t)run->pace.fields_together * wf_resampler_field_bytes(rs, false) +
        (size_t)run->pace.fields_carried * wf_resampler_field_bytes(rs, true) +
        (size_t)run->crew.threads * wf_scratch_bytes(rs, most_in_flight(run)) +
        wf_frames_bytes(run->job, &run->setup, run->crew.threads, run->pace.fields_together);
    run->pace.memory_bytes = bytes;
    if (bytes <= allowed) return WEFT_OK;
    return wf_fail(
        err, WEFT_NO_MEMORY,
        "this conversion needs %zu MB and --max-memory allows %zu MB; allow more, or use "
        "fewer --threads",
        bytes >> 20, allowed >> 20);
}

/* ---- Life ---- */

static weft_status make_buffers(const wf_run *run, wf_pictures *p,
                                const wf_source_options *options, weft_error *err) {
    size_t threads = (size_t)run->crew.threads, flight = (size_t)most_in_flight(run);
    p->reader = calloc(threads, sizeof(wf_reader *));
    p->scratch = calloc(threads, sizeof(wf_scratch *));
    p->flight = calloc(flight, sizeof(wf_field *));
    p->active = calloc(flight, sizeof(wf_field *));
    p->spare = calloc(flight, sizeof(wf_field *));
    if (!p->reader || !p->scratch || !p->flight || !p->active || !p->spare)
        return wf_fail(err, WEFT_NO_MEMORY, "no memory for %zu threads", threads);
    weft_status status = WEFT_OK;
    for (size_t t = 0; !status && t < threads; t++) {
        status = wf_reader_new(options, &p->reader[t], err);
        p->scratch[t] = wf_scratch_new(p->resampler, (int)flight);
        if (!status && !p->scratch[t])
            status = wf_fail(err, WEFT_NO_MEMORY, "no memory for the buffers of a thread");
    }
    return status;
}

static weft_status begin(wf_run *run, weft_error *err) {
    wf_picture_desc desc = run->kind->pictures->describe(run);
    wf_pictures *p = run->sums = calloc(1, sizeof *p);
    if (!p) return wf_fail(err, WEFT_NO_MEMORY, "no memory for the job");
    p->resampler = desc.resampler;
    choose_pace(run, p, &desc);
    weft_status status = check_memory(run, p, err);
    if (!status) status = make_buffers(run, p, desc.options, err);
    if (status) return status;
    return wf_frames_new(&run->crew, &run->setup, run->pace.fields_together, &run->frames, err);
}

static void drop(wf_run *run) {
    wf_pictures *p = run->sums;
    for (int f = 0; f < p->flight_count; f++) wf_field_free(p->flight[f]);
    for (int f = 0; f < p->spare_count; f++) wf_field_free(p->spare[f]);
    p->flight_count = p->spare_count = 0;
}

static void end(wf_run *run) {
    wf_pictures *p = run->sums;
    if (!p) return;
    drop(run);
    for (int t = 0; t < run->crew.threads; t++) {
        if (p->reader) wf_reader_free(p->reader[t]);
        if (p->scratch) wf_scratch_free(p->scratch[t]);
    }
    free(p->reader);
    free(p->scratch);
    free(p->flight);
    free(p->active);
    free(p->spare);
    free(p);
    run->sums = NULL;
}

/* ---- Fields ---- */

static wf_field *field_for(wf_pictures *p, int64_t index) {
    if (!p->spare_count) return wf_field_new(p->resampler, index);
    wf_field *field = p->spare[--p->spare_count];
    if (wf_field_renew(field, index)) return field;
    wf_field_free(field);
    return NULL;
}

static weft_status launch(wf_run *run, int64_t index, weft_error *err) {
    wf_pictures *p = run->sums;
    wf_field *field = field_for(p, index);
    if (!field)
        return wf_fail(err, WEFT_NO_MEMORY, "no memory for field %lld", (long long)index);
    p->flight[p->flight_count++] = field;
    return WEFT_OK;
}

static void finish_line(void *user, wf_worker *worker, int line) {
    wf_run *run = user;
    const wf_pictures *p = run->sums;
    wf_pictures_finish_line(run, worker, p->flight[0], line);
}

/* Lines were finished with the last of their bands, but for those of a field that was complete
 * before its group was read. */
static weft_status finish(wf_run *run, int64_t field, weft_error *err) {
    wf_pictures *p = run->sums;
    const wf_raster *raster = &run->job->raster;
    int lines = wf_raster_field_lines(raster, wf_raster_parity(raster, field));
    if (!wf_field_lines_taken(p->flight[0]))
        wf_crew_each(&run->crew, lines, 4, finish_line, run);
    p->spare[p->spare_count++] = p->flight[0];
    p->flight_count--;
    memmove(p->flight, p->flight + 1, (size_t)p->flight_count * sizeof(wf_field *));
    return wf_crew_status(&run->crew, err);
}

static void tell(const wf_run *run, wf_report *report) {
    const wf_pictures *p = run->sums;
    for (int t = 0; p->reader && t < run->crew.threads; t++) {
        if (!p->reader[t]) continue;
        wf_source_counts counts = wf_reader_counts(p->reader[t]);
        report->chunks_decoded += counts.chunks_decoded;
        report->chunks_reused += counts.chunks_reused;
        report->nan_fixed += counts.nan.fixed;
        report->nan_alone += counts.nan.alone;
    }
    report->opened = p->opened;
    report->decode_s = wf_crew_times(&run->crew).source_s;
}

const wf_summing wf_summing_pictures = {
    .begin = begin,
    .launch = launch,
    .add = wf_pictures_add,
    .finish = finish,
    .drop = drop,
    .tell = tell,
    .end = end,
};
