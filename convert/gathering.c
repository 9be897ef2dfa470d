#include "convert/gathering.h"

#include <inttypes.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>

/* Rows that one thread gathers into sums of its own. Sums are added to the fields' in the order
 * of the bands, so that the bits do not depend on the threads. */
#define BAND_ROWS 16

typedef struct worker {
    wf_finisher finisher;
    weft_status status;
    weft_error error;
    double source_s, resample_s;
    int64_t filled;
} worker;

struct wf_gathering {
    weft_job *job;
    const wf_setup *setup;
    wf_sample_source source;
    wf_gather_desc desc;
    wf_frames *frames;
    worker *workers;
    int threads;
    atomic_bool stop;

    wf_gather **flight; /* fields flight_first on; room for flight_most */
    int64_t flight_first;
    int flight_count, flight_most;
    int64_t next_unit, end_field;
};

int wf_gathering_threads(const weft_job *job) {
    return job->threads > 0 ? job->threads : omp_get_num_procs();
}

static void fail(wf_gathering *g, worker *w, weft_status status) {
    if (!w->status) w->status = status;
    atomic_store(&g->stop, true);
}

static weft_status status_of(const wf_gathering *g, weft_error *err) {
    if (g->job->cancelled) return wf_fail(err, WEFT_INTERRUPTED, "interrupted");
    for (int t = 0; t < g->threads; t++)
        if (g->workers[t].status)
            return wf_fail(err, g->workers[t].status, "%s", g->workers[t].error.text);
    return WEFT_OK;
}

/* ---- Life ---- */

/* Fields that share a unit with a field are in flight with it. */
static int most_in_flight(const wf_gathering *g) {
    int per_frame = wf_raster_fields_per_frame(&g->job->raster), most = 1;
    int64_t begin = g->setup->first_frame * per_frame, end = g->setup->end_frame * per_frame;
    for (int64_t n = begin; n < end; n++) {
        int64_t first, last, m = n;
        g->source.units(g->source.self, n, &first, &last);
        for (int64_t next = first; next <= last && ++m < end;)
            g->source.units(g->source.self, m, &next, &(int64_t){0});
        if (m - n > most) most = (int)(m - n);
    }
    return most;
}

static size_t field_bytes(const wf_gathering *g) {
    const wf_raster *raster = &g->job->raster;
    return wf_gather_bytes(&g->desc, (raster->lines + 1) / wf_raster_line_step(raster));
}

static weft_status check_memory(const wf_gathering *g, weft_error *err) {
    size_t bytes =
        (size_t)g->flight_most * field_bytes(g) +
        (size_t)g->threads * (size_t)g->flight_most * wf_gather_bytes(&g->desc, BAND_ROWS + 4) +
        wf_frames_bytes(g->job, g->setup, g->flight_most);
    if (bytes <= g->job->max_memory_bytes) return WEFT_OK;
    return wf_fail(err, WEFT_NO_MEMORY,
                   "this needs %zu MB and --max-memory allows %zu MB; allow more, or use fewer "
                   "--threads",
                   bytes >> 20, g->job->max_memory_bytes >> 20);
}

static weft_status fill(wf_gathering *g, weft_error *err) {
    g->flight_most = most_in_flight(g);
    weft_status status = check_memory(g, err);
    if (status) return status;
    g->workers = calloc((size_t)g->threads, sizeof *g->workers);
    g->flight = calloc((size_t)g->flight_most, sizeof *g->flight);
    if (!g->workers || !g->flight) return wf_fail(err, WEFT_NO_MEMORY, "no memory for fields");
    status = wf_frames_new(g->job, g->setup, g->flight_most, &g->frames, err);
    for (int t = 0; !status && t < g->threads; t++)
        status = wf_finisher_new(g->frames, &g->workers[t].finisher, err);
    return status;
}

weft_status wf_gathering_new(weft_job *job, const wf_setup *setup,
                             const wf_sample_source *source, wf_gathering **out,
                             weft_error *err) {
    wf_gathering *g = calloc(1, sizeof *g);
    if (!g) return wf_fail(err, WEFT_NO_MEMORY, "no memory for the job");
    *g = (wf_gathering){.job = job, .setup = setup, .source = *source};
    g->desc = wf_setup_gather(job);
    g->threads = wf_gathering_threads(job);
    weft_status status = fill(g, err);
    if (status) {
        wf_gathering_free(g);
        return status;
    }
    *out = g;
    return WEFT_OK;
}

void wf_gathering_free(wf_gathering *g) {
    if (!g) return;
    for (int n = 0; n < g->flight_count; n++) wf_gather_free(g->flight[n]);
    for (int t = 0; g->workers && t < g->threads; t++)
        wf_finisher_free(&g->workers[t].finisher);
    wf_frames_free(g->frames);
    free(g->workers);
    free(g->flight);
    free(g);
}

/* ---- One unit ---- */

static int lines_of(const wf_gathering *g, int64_t field) {
    return wf_raster_field_lines(&g->job->raster, wf_raster_parity(&g->job->raster, field));
}

/* Puts in flight the fields that need the unit. */
static weft_status launch(wf_gathering *g, int64_t unit, weft_error *err) {
    while (g->flight_count < g->flight_most) {
        int64_t field = g->flight_first + g->flight_count, first, last;
        if (field >= g->end_field) break;
        g->source.units(g->source.self, field, &first, &last);
        if (first > unit) break;
        wf_gather *gather = wf_gather_new(&g->desc, field, 0, lines_of(g, field));
        if (!gather) return wf_fail(err, WEFT_NO_MEMORY, "no memory for a field");
        g->flight[g->flight_count++] = gather;
    }
    return WEFT_OK;
}

/* The sums of a band of one thread: one gather for each field in flight. */
typedef struct strips {
    wf_gather **gather;
    int count;
} strips;

static void add_to_strips(void *user, const wf_samples *samples) {
    const strips *s = user;
    for (int n = 0; n < s->count; n++)
        if (s->gather[n]) wf_gather_add(s->gather[n], samples);
}

static bool needs(const wf_gathering *g, int64_t field, int64_t unit) {
    int64_t first, last;
    g->source.units(g->source.self, field, &first, &last);
    return first <= unit && unit <= last;
}

static weft_status make_strips(const wf_gathering *g, int64_t unit, int first_row, int end_row,
                               strips *s, weft_error *err) {
    s->count = g->flight_count;
    s->gather = calloc((size_t)s->count + 1, sizeof(wf_gather *));
    bool good = s->gather;
    for (int n = 0; good && n < s->count; n++) {
        int first, end;
        int64_t field = g->flight_first + n;
        if (!needs(g, field, unit)) continue;
        wf_gather_lines(&g->desc, field, first_row, end_row, &first, &end);
        s->gather[n] = wf_gather_new(&g->desc, field, first, end);
        good = s->gather[n];
    }
    return good ? WEFT_OK : wf_fail(err, WEFT_NO_MEMORY, "no memory for a band of a field");
}

static void merge_strips(const wf_gathering *g, strips *s) {
    for (int n = 0; s->gather && n < s->count; n++) {
        if (s->gather[n]) wf_gather_merge(g->flight[n], s->gather[n]);
        wf_gather_free(s->gather[n]);
    }
    free(s->gather);
}

static void gather_band(wf_gathering *g, int thread, int64_t unit, int first, strips *s) {
    worker *w = &g->workers[thread];
    int lines = g->job->raster.lines,
        end = first + BAND_ROWS < lines ? first + BAND_ROWS : lines;
    double start = wf_now_s();
    weft_status status = make_strips(g, unit, first, end, s, &w->error);
    const wf_receiver receiver = {s, add_to_strips};
    if (!status)
        status = g->source.band(g->source.self, thread, first, end, &receiver, &w->error);
    if (status) fail(g, w, status);
    w->source_s += wf_now_s() - start;
}

static weft_status gather_unit(wf_gathering *g, int64_t unit, weft_error *err) {
    weft_status status = launch(g, unit, err);
    if (!status) status = g->source.begin(g->source.self, unit, err);
    if (status) return status;
#pragma omp parallel for num_threads(g->threads) schedule(dynamic, 1) ordered
    for (int first = 0; first < g->job->raster.lines; first += BAND_ROWS) {
        strips s = {0};
        if (!atomic_load(&g->stop) && !g->job->cancelled)
            gather_band(g, omp_get_thread_num(), unit, first, &s);
#pragma omp ordered
        merge_strips(g, &s);
    }
    return status_of(g, err);
}

/* ---- One field ---- */

static weft_status fill_empty(wf_gathering *g, worker *w, const wf_gather *gather,
                              int64_t field, int line, int first, float *const rgb[3]) {
    int width = g->job->raster.width_px;
    int row =
        wf_raster_parity(&g->job->raster, field) + line * wf_raster_line_step(&g->job->raster);
    if (g->job->on_empty == WF_EMPTY_ERROR)
        return wf_fail(&w->error, WEFT_FAILED,
                       "field %" PRId64 ", line %d, pixel %d: no sample reached it; give more "
                       "samples, or --on-empty nearest",
                       field, row, first);
    for (int i = first; i < width; i++) {
        float near[3];
        if (wf_gather_reached(gather, line, i)) continue;
        if (!wf_gather_nearest(gather, line, i, near))
            return wf_fail(&w->error, WEFT_FAILED, "field %" PRId64 ": no sample reached it",
                           field);
        for (int c = 0; c < 3; c++) rgb[c][i] = near[c];
        w->filled++;
    }
    return WEFT_OK;
}

static void finish_line(wf_gathering *g, worker *w, const wf_gather *gather, int64_t field,
                        int line) {
    float *rgb[3];
    double start = wf_now_s();
    wf_frames_room(g->frames, &w->finisher, field, line, rgb);
    int empty = wf_gather_line(gather, line, rgb);
    weft_status status =
        empty < 0 ? WEFT_OK : fill_empty(g, w, gather, field, line, empty, rgb);
    w->resample_s += wf_now_s() - start;
    if (status)
        fail(g, w, status);
    else
        wf_frames_line(g->frames, &w->finisher, field, line);
}

static weft_status finish_field(wf_gathering *g, weft_error *err) {
    int64_t field = g->flight_first;
    wf_gather *gather = g->flight[0];
    int lines = lines_of(g, field);
#pragma omp parallel for num_threads(g->threads) schedule(dynamic, 4)
    for (int l = 0; l < lines; l++)
        if (!atomic_load(&g->stop))
            finish_line(g, &g->workers[omp_get_thread_num()], gather, field, l);
    wf_gather_free(gather);
    g->flight_first++;
    g->flight_count--;
    memmove(g->flight, g->flight + 1, (size_t)g->flight_count * sizeof *g->flight);
    return status_of(g, err);
}

static weft_status make_field(wf_gathering *g, int64_t field, weft_error *err) {
    int64_t first, last;
    weft_status status = WEFT_OK;
    g->source.units(g->source.self, field, &first, &last);
    if (g->next_unit < first) g->next_unit = first;
    for (; !status && g->next_unit <= last; g->next_unit++)
        status = gather_unit(g, g->next_unit, err);
    return status ? status : finish_field(g, err);
}

/* ---- All frames ---- */

static weft_status make_frames(wf_gathering *g, int64_t first, int64_t end, weft_error *err) {
    int per_frame = wf_raster_fields_per_frame(&g->job->raster);
    for (int n = 0; n < g->flight_count; n++) wf_gather_free(g->flight[n]);
    g->flight_count = 0;
    g->flight_first = first * per_frame;
    g->end_field = end * per_frame;
    g->next_unit = INT64_MIN;
    for (int64_t frame = first; frame < end; frame++) {
        for (int k = 0; k < per_frame; k++) {
            weft_status status = make_field(g, frame * per_frame + k, err);
            if (status) return status;
        }
        weft_status status = wf_frames_write(g->frames, frame, err);
        if (status) return status;
    }
    return WEFT_OK;
}

weft_status wf_gathering_run(wf_gathering *g, weft_error *err) {
    int64_t first = g->setup->first_frame, end;
    weft_status status = wf_frames_open(g->frames, err);
    while (!status && wf_next_frames(g->job, g->setup, &first, &end)) {
        status = make_frames(g, first, end, err);
        first = end;
    }
    return status ? status : wf_frames_commit(g->frames, err);
}

wf_gathering_counts wf_gathering_counted(const wf_gathering *g) {
    wf_gathering_counts sum = {.frames = wf_frames_done(g->frames),
                               .write_s = wf_frames_write_s(g->frames)};
    for (int t = 0; t < g->threads; t++) {
        sum.source_s += g->workers[t].source_s;
        sum.resample_s += g->workers[t].resample_s;
        sum.color_s += g->workers[t].finisher.color_s;
        sum.pixels_filled += g->workers[t].filled;
    }
    return sum;
}
