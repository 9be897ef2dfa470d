#include "convert/run/gathering.h"

#include <inttypes.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>

#include "convert/run/tile_cache.h"

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

/* A field that gathers samples. */
typedef struct flight {
    wf_gather *sums;
    bool still;   /* it sees nothing move: others of its parity look the same */
    bool follows; /* one of them, before it, gathers for both */
    bool kept;    /* and has: the sums are borrowed */
} flight;

struct wf_gathering {
    weft_job *job;
    const wf_setup *setup;
    wf_sample_source source;
    wf_gather_desc desc;
    wf_frames *frames;
    worker *workers;
    int threads;
    atomic_bool stop;

    flight *flight; /* fields flight_first on; room for flight_most */
    int64_t flight_first;
    int flight_count, flight_most;
    int64_t next_unit, end_field;

    /* What is still is kept: whole fields, one of each parity, and tiles. */
    bool keeps;
    int *way; /* [units of a field, from its last]: those of one number it sees alike; of a
                 source with tiles */
    int ways;
    wf_gather *kept[2];
    wf_tile_cache shelf;
    wf_taker *takers; /* of the unit in hand: room for most_takers */
    int taker_count, most_takers;
    int64_t tiles_reused, fields_reused;
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

/* What a patch takes beside its sums, about. */
#define PATCH_BYTES 512

static size_t kept_bytes(const wf_gathering *g) {
    const wf_sample_tiling *t = &g->source.tiling;
    const wf_aperture *aperture = &g->desc.aperture;
    int lines =
        (t->rows + (int)(2 * aperture->reach_v)) / wf_raster_line_step(&g->job->raster) + 2;
    int across = t->width_px + (int)(2 * aperture->reach_u) + 2;
    size_t pixel = wf_gather_bytes(&g->desc, 1) / (size_t)g->job->raster.width_px;
    size_t tile = (size_t)lines * (size_t)across * pixel + PATCH_BYTES;
    return 2 * field_bytes(g) + (size_t)t->count * 2 * (size_t)g->ways * tile;
}

/* Units that a field sees from beginning to end it sees alike; others each in a way of its own.
 */
static bool find_ways(wf_gathering *g, int *units) {
    int64_t first, last;
    g->source.units(g->source.self, 0, &first, &last);
    *units = (int)(last - first) + 1;
    g->way = calloc((size_t)*units, sizeof *g->way);
    g->ways = 1;
    for (int n = 0; g->way && n < *units; n++)
        if (!g->source.whole(g->source.self, 0, last - n)) g->way[n] = g->ways++;
    return g->way;
}

/* What a run holds at most, without what it keeps. */
static size_t needed_bytes(const wf_gathering *g) {
    return (size_t)g->flight_most * field_bytes(g) +
           (size_t)g->threads * (size_t)g->flight_most *
               wf_gather_bytes(&g->desc, BAND_ROWS + 4) +
           wf_frames_bytes(g->job, g->setup, g->flight_most);
}

static weft_status check_memory(const wf_gathering *g, weft_error *err) {
    size_t bytes = needed_bytes(g);
    if (bytes <= g->job->max_memory_bytes) return WEFT_OK;
    return wf_fail(err, WEFT_NO_MEMORY,
                   "this needs %zu MB and --max-memory allows %zu MB; allow more, or use fewer "
                   "--threads",
                   bytes >> 20, g->job->max_memory_bytes >> 20);
}

/* What is still is kept where there is memory left. */
static bool make_room_to_keep(wf_gathering *g) {
    int tiles = g->source.tiling.count, units = 0;
    if (tiles > 0 && !find_ways(g, &units)) return false;
    g->most_takers = 2 * (g->flight_most + 4 * units);
    g->takers = calloc((size_t)g->most_takers, sizeof *g->takers);
    g->keeps = g->job->skip && tiles > 0 &&
               kept_bytes(g) + needed_bytes(g) <= g->job->max_memory_bytes;
    return g->takers && (!g->keeps || wf_tile_cache_new(tiles, 2 * g->ways, &g->shelf));
}

static weft_status fill(wf_gathering *g, weft_error *err) {
    g->flight_most = most_in_flight(g);
    weft_status status = check_memory(g, err);
    if (status) return status;
    g->workers = calloc((size_t)g->threads, sizeof *g->workers);
    g->flight = calloc((size_t)g->flight_most, sizeof *g->flight);
    if (!g->workers || !g->flight || !make_room_to_keep(g))
        return wf_fail(err, WEFT_NO_MEMORY, "no memory for fields");
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

static void empty_flight(wf_gathering *g) {
    for (int n = 0; n < g->flight_count; n++)
        if (!g->flight[n].kept) wf_gather_free(g->flight[n].sums);
    g->flight_count = 0;
}

void wf_gathering_free(wf_gathering *g) {
    if (!g) return;
    empty_flight(g);
    for (int p = 0; p < 2; p++) wf_gather_free(g->kept[p]);
    wf_tile_cache_free(&g->shelf);
    free(g->takers);
    free(g->way);
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
        wf_gather *sums = wf_gather_new(&g->desc, field, 0, lines_of(g, field));
        if (!sums) return wf_fail(err, WEFT_NO_MEMORY, "no memory for a field");
        g->flight[g->flight_count++] = (flight){.sums = sums};
    }
    return WEFT_OK;
}

static bool needs(const wf_gathering *g, int64_t field, int64_t unit, int64_t *last) {
    int64_t first;
    g->source.units(g->source.self, field, &first, last);
    return first <= unit && unit <= *last;
}

static int like(const wf_gathering *g, int slot) {
    int n = 0;
    while (n < g->taker_count && g->takers[n].slot != slot) n++;
    return n;
}

static void add_taker(wf_gathering *g, int64_t unit, int64_t field, int64_t shift) {
    int64_t last, place = field - g->flight_first;
    if (!needs(g, field, unit, &last)) return;
    int parity = wf_raster_parity(&g->job->raster, field + shift);
    wf_taker t = {.field = field + shift, .shift = shift};
    t.waits = shift == 0 && place >= 0 && place < g->flight_count && !g->flight[place].follows;
    t.slot = g->way ? 2 * g->way[last - unit] + parity : 0;
    t.like = like(g, t.slot);
    bool more = t.waits || (g->keeps && t.like == g->taker_count);
    if (more && g->taker_count < g->most_takers) g->takers[g->taker_count++] = t;
}

/* The fields in flight that need the unit; and, where what is still is kept, whoever else would
 * see it so, now or one field later. */
static void find_takers(wf_gathering *g, int64_t unit) {
    int64_t last, first = g->flight_first, end = first + g->flight_count;
    bool interlaced = g->job->raster.scan == WF_INTERLACED && !g->job->raster.pulldown;
    while (g->keeps && needs(g, first - 1, unit, &last)) first--;
    while (g->keeps && needs(g, end, unit, &last)) end++;
    g->taker_count = 0;
    for (int64_t shift = 0; shift <= interlaced; shift++)
        for (int64_t field = first; field < end; field++) add_taker(g, unit, field, shift);
}

static void merge_strips(wf_gathering *g, wf_strips *s) {
    for (int n = 0; s->sums && n < g->taker_count; n++)
        if (s->sums[n])
            wf_gather_merge(g->flight[g->takers[n].field - g->flight_first].sums, s->sums[n]);
    g->tiles_reused += s->reused;
    wf_strips_free(s);
}

static void gather_band(wf_gathering *g, const wf_taking *taking, int thread, int first,
                        wf_strips *s) {
    worker *w = &g->workers[thread];
    int lines = g->job->raster.lines,
        end = first + BAND_ROWS < lines ? first + BAND_ROWS : lines;
    double start = wf_now_s();
    weft_status status = WEFT_OK;
    bool room = wf_strips_new(taking, first, end, s);
    const wf_receiver receiver = wf_strips_receiver(s);
    if (room) status = g->source.band(g->source.self, thread, first, end, &receiver, &w->error);
    if (!status && !(room && wf_strips_end(s)))
        status = wf_fail(&w->error, WEFT_NO_MEMORY, "no memory for a band of a field");
    if (status) fail(g, w, status);
    w->source_s += wf_now_s() - start;
}

static void gather_bands(wf_gathering *g, int64_t unit) {
    find_takers(g, unit);
    const wf_taking taking = {&g->desc, g->takers, g->taker_count, g->keeps ? &g->shelf : NULL};
#pragma omp parallel for num_threads(g->threads) schedule(dynamic, 1) ordered
    for (int first = 0; first < g->job->raster.lines; first += BAND_ROWS) {
        wf_strips s = {0};
        if (!atomic_load(&g->stop) && !g->job->cancelled)
            gather_band(g, &taking, omp_get_thread_num(), first, &s);
#pragma omp ordered
        merge_strips(g, &s);
    }
}

/* ---- Still fields ---- */

static void take_kept(wf_gathering *g, flight *f, wf_gather *kept) {
    if (f->kept) return;
    wf_gather_free(f->sums);
    f->sums = kept;
    f->kept = true;
    g->fields_reused++;
}

/* Fields that see nothing move take the sums of one of their parity that was done before, or
 * wait for it to be. Whether any has to gather. */
static bool reuse_fields(wf_gathering *g) {
    bool gathers[2] = {false, false};
    for (int n = 0; n < g->flight_count; n++) {
        int parity = wf_raster_parity(&g->job->raster, g->flight_first + n);
        flight *f = &g->flight[n];
        f->still = true;
        f->follows = g->kept[parity] || gathers[parity];
        if (g->kept[parity])
            take_kept(g, f, g->kept[parity]);
        else
            gathers[parity] = true;
    }
    return gathers[0] || gathers[1];
}

static weft_status gather_unit(wf_gathering *g, int64_t unit, weft_error *err) {
    weft_status status = launch(g, unit, err);
    if (!status) status = g->source.begin(g->source.self, unit, err);
    if (status) return status;
    bool still = g->keeps && g->source.still(g->source.self);
    if (!still || reuse_fields(g)) gather_bands(g, unit);
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

/* Frees what a field has gathered, or keeps it for those that look the same. */
static void let_go(wf_gathering *g) {
    flight done = g->flight[0];
    wf_gather **kept = &g->kept[wf_raster_parity(&g->job->raster, g->flight_first)];
    if (done.still && !*kept)
        *kept = done.sums;
    else if (!done.kept)
        wf_gather_free(done.sums);
    g->flight_first++;
    g->flight_count--;
    memmove(g->flight, g->flight + 1, (size_t)g->flight_count * sizeof *g->flight);
}

static weft_status finish_field(wf_gathering *g, weft_error *err) {
    int64_t field = g->flight_first;
    int lines = lines_of(g, field);
#pragma omp parallel for num_threads(g->threads) schedule(dynamic, 4)
    for (int l = 0; l < lines; l++)
        if (!atomic_load(&g->stop))
            finish_line(g, &g->workers[omp_get_thread_num()], g->flight[0].sums, field, l);
    let_go(g);
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
    empty_flight(g);
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

void wf_gathering_tell_legal(const wf_gathering *g, wf_report_legal *legal) {
    wf_frames_tell_legal(g->frames, legal);
}

wf_gathering_counts wf_gathering_counted(const wf_gathering *g) {
    wf_gathering_counts sum = {.frames = wf_frames_done(g->frames),
                               .write_s = wf_frames_write_s(g->frames),
                               .tiles_reused = g->tiles_reused,
                               .fields_reused = g->fields_reused};
    for (int t = 0; t < g->threads; t++) {
        sum.source_s += g->workers[t].source_s;
        sum.resample_s += g->workers[t].resample_s;
        sum.color_s += g->workers[t].finisher.color_s;
        sum.pixels_filled += g->workers[t].filled;
    }
    return sum;
}
