#include "convert/run/pipeline.h"

#include <omp.h>
#include <stdlib.h>
#include <string.h>

/* Fields are finished in groups, so that a picture that does not change is inflated once a
 * group and threads meet seldom; but a group's sums must come from the caches when they are
 * finished. */
#define GROUP_BYTES   ((size_t)24 << 20)
#define MOST_IN_GROUP 16
/* Sums carried from group to group, where windows overlap; beyond this subframes are read
 * again. */
#define CARRIED_BYTES ((size_t)128 << 20)

void wf_worker_fail(wf_pipeline *p, wf_worker *worker, weft_status status) {
    if (!worker->status) worker->status = status;
    atomic_store(&p->stop, true);
}

weft_status wf_pipeline_status(const wf_pipeline *p, weft_error *err) {
    if (p->job->cancelled) return wf_fail(err, WEFT_INTERRUPTED, "interrupted");
    for (int t = 0; t < p->threads; t++)
        if (p->workers[t].status)
            return wf_fail(err, p->workers[t].status, "%s", p->workers[t].error.text);
    return WEFT_OK;
}

/* ---- Making ---- */

/* Most fields after n that begin before field n's window ends; fields of one instant end
 * together and are no overlap. */
static int64_t overlap_of(const wf_setup *s, int64_t first, int64_t end) {
    int64_t most = 0;
    for (int64_t n = first, m = first; n < end; n++) {
        wf_window window = wf_resampler_window(s->resampler, n);
        if (m < n) m = n;
        while (m + 1 < end &&
               wf_resampler_window(s->resampler, m + 1).first < window.first + window.count)
            m++;
        wf_window last = wf_resampler_window(s->resampler, m);
        bool same = last.first == window.first && last.count == window.count;
        if (!same && m - n > most) most = m - n;
    }
    return most;
}

static void choose_groups(wf_pipeline *p) {
    const wf_setup *s = p->setup;
    size_t allowed = p->job->max_memory_bytes / 8;
    size_t each = wf_resampler_field_bytes(s->resampler, false);
    size_t group = (allowed < GROUP_BYTES ? allowed : GROUP_BYTES) / each;
    p->group_most = group > MOST_IN_GROUP ? MOST_IN_GROUP : (int)group;
    /* The two fields of a segmented frame see the same subframes, and the three of film. */
    const wf_raster *raster = &p->job->raster;
    int fewest = raster->pulldown ? 3 : raster->scan == WF_SEGMENTED ? 2 : 1;
    if (p->group_most < fewest) p->group_most = fewest;
    int64_t overlap = overlap_of(s, 0, s->end_field);
    size_t carried = wf_resampler_field_bytes(s->resampler, true);
    size_t room = (allowed < CARRIED_BYTES ? allowed : CARRIED_BYTES) / carried;
    p->carried_most = (size_t)overlap <= room ? (int)overlap : 0;
    /* A chunk that starts inside an overlap must add in the same order as a whole run. */
    p->merge = p->job->skip && overlap == 0;
}

static weft_status make_worker(wf_pipeline *p, wf_worker *worker, weft_error *err) {
    const wf_setup *s = p->setup;
    weft_status status = wf_reader_new(&s->source, &worker->reader, err);
    if (!status) status = wf_finisher_new(p->frames, &worker->finisher, err);
    if (status) return status;
    worker->scratch = wf_scratch_new(s->resampler, p->group_most + p->carried_most);
    if (worker->scratch) return WEFT_OK;
    return wf_fail(err, WEFT_NO_MEMORY, "no memory for the buffers of a thread");
}

/* What a run holds at most, but for the libraries' own needs. */
static weft_status check_memory(wf_pipeline *p, weft_error *err) {
    const wf_resampler *rs = p->setup->resampler;
    size_t bytes = (size_t)p->group_most * wf_resampler_field_bytes(rs, false) +
                   (size_t)p->carried_most * wf_resampler_field_bytes(rs, true) +
                   (size_t)p->threads * wf_scratch_bytes(rs, p->group_most + p->carried_most);
    bytes += wf_frames_bytes(p->job, p->setup, p->group_most);
    p->bytes = bytes;
    if (bytes <= p->job->max_memory_bytes) return WEFT_OK;
    return wf_fail(
        err, WEFT_NO_MEMORY,
        "this conversion needs %zu MB and --max-memory allows %zu MB; allow more, or use "
        "fewer --threads",
        bytes >> 20, p->job->max_memory_bytes >> 20);
}

static weft_status fill_pipeline(wf_pipeline *p, weft_error *err) {
    choose_groups(p);
    weft_status status = check_memory(p, err);
    if (status) return status;
    size_t flight = (size_t)(p->group_most + p->carried_most);
    p->workers = calloc((size_t)p->threads, sizeof *p->workers);
    p->flight = calloc(flight, sizeof *p->flight);
    p->active = calloc(flight, sizeof *p->active);
    p->spare = calloc(flight, sizeof *p->spare);
    if (!p->workers || !p->flight || !p->active || !p->spare)
        return wf_fail(err, WEFT_NO_MEMORY, "no memory for %d threads", p->threads);
    status = wf_frames_new(p->job, p->setup, p->group_most, &p->frames, err);
    for (int t = 0; !status && t < p->threads; t++)
        status = make_worker(p, &p->workers[t], err);
    return status;
}

weft_status wf_pipeline_new(weft_job *job, const wf_setup *setup, wf_pipeline **out,
                            weft_error *err) {
    wf_pipeline *p = calloc(1, sizeof *p);
    if (!p) return wf_fail(err, WEFT_NO_MEMORY, "no memory for the job");
    p->job = job;
    p->setup = setup;
    p->threads = job->threads > 0 ? job->threads : omp_get_num_procs();
    weft_status status = fill_pipeline(p, err);
    if (status) {
        wf_pipeline_free(p);
        return status;
    }
    *out = p;
    return WEFT_OK;
}

static void land_all(wf_pipeline *p) {
    for (int f = 0; f < p->flight_count; f++) wf_field_free(p->flight[f]);
    for (int f = 0; f < p->spare_count; f++) wf_field_free(p->spare[f]);
    p->flight_count = p->spare_count = 0;
}

void wf_pipeline_free(wf_pipeline *p) {
    if (!p) return;
    land_all(p);
    for (int t = 0; p->workers && t < p->threads; t++) {
        wf_reader_free(p->workers[t].reader);
        wf_scratch_free(p->workers[t].scratch);
        wf_finisher_free(&p->workers[t].finisher);
    }
    free(p->workers);
    free(p->flight);
    free(p->active);
    free(p->spare);
    wf_frames_free(p->frames);
    free(p);
}

/* ---- Fields to frames ---- */

void wf_pipeline_finish_line(wf_pipeline *p, wf_worker *worker, const wf_field *field, int l) {
    float *rgb[3];
    double start = wf_now_s();
    wf_frames_room(p->frames, &worker->finisher, wf_field_index(field), l, rgb);
    wf_field_line(field, l, worker->scratch, rgb);
    worker->resample_s += wf_now_s() - start;
    wf_frames_line(p->frames, &worker->finisher, wf_field_index(field), l);
}

/* All lines of a field that was complete before its group was read. */
static void finish_field(wf_pipeline *p, const wf_field *field) {
    int parity = wf_raster_parity(&p->job->raster, wf_field_index(field));
    int lines = wf_raster_field_lines(&p->job->raster, parity);
#pragma omp parallel for num_threads(p->threads) schedule(dynamic, 4)
    for (int l = 0; l < lines; l++)
        wf_pipeline_finish_line(p, &p->workers[omp_get_thread_num()], field, l);
}

static void land_first(wf_pipeline *p) {
    p->spare[p->spare_count++] = p->flight[0];
    p->flight_count--;
    p->flight_first++;
    memmove(p->flight, p->flight + 1, (size_t)p->flight_count * sizeof *p->flight);
}

static weft_status finish_group(wf_pipeline *p, int64_t first, int64_t end, weft_error *err) {
    int per_frame = wf_raster_fields_per_frame(&p->job->raster);
    for (int64_t n = first; n < end; n++) {
        if (p->job->cancelled) return wf_pipeline_status(p, err);
        if (!wf_field_lines_taken(p->flight[0])) finish_field(p, p->flight[0]);
        land_first(p);
        if (n % per_frame != per_frame - 1) continue;
        weft_status status = wf_frames_write(p->frames, n / per_frame, err);
        if (status) return status;
    }
    return WEFT_OK;
}

weft_status wf_pipeline_frames(wf_pipeline *p, int64_t first, int64_t end, weft_error *err) {
    int per_frame = wf_raster_fields_per_frame(&p->job->raster);
    int64_t past = end * per_frame;
    p->end_field = past;
    land_all(p);
    p->flight_first = first * per_frame;
    p->next_subframe = 0;
    for (int64_t n = first * per_frame; n < past;) {
        int64_t group_end = n + p->group_most < past ? n + p->group_most : past;
        weft_status status = wf_batch_read(p, n, group_end, err);
        if (!status) status = finish_group(p, n, group_end, err);
        if (status) return status;
        n = group_end;
    }
    return WEFT_OK;
}

void wf_pipeline_foresee(wf_pipeline *p, int64_t first, int64_t end, bool *needed) {
    int per_frame = wf_raster_fields_per_frame(&p->job->raster);
    int64_t past = end * per_frame;
    p->next_subframe = 0;
    for (int64_t n = first * per_frame; n < past; n += p->group_most)
        wf_batch_foresee(p, n, n + p->group_most < past ? n + p->group_most : past, needed);
}

wf_source_counts wf_pipeline_counts(const wf_pipeline *p) {
    wf_source_counts sum = {0};
    for (int t = 0; t < p->threads; t++) {
        wf_source_counts one = wf_reader_counts(p->workers[t].reader);
        sum.chunks_decoded += one.chunks_decoded;
        sum.chunks_reused += one.chunks_reused;
        sum.nan_fixed += one.nan_fixed;
    }
    return sum;
}

wf_worker wf_pipeline_times(const wf_pipeline *p) {
    wf_worker sum = {0};
    for (int t = 0; t < p->threads; t++) {
        sum.decode_s += p->workers[t].decode_s;
        sum.resample_s += p->workers[t].resample_s;
        sum.finisher.color_s += p->workers[t].finisher.color_s;
    }
    return sum;
}
