/* Fields summed from samples: how many are in flight, their memory, and their end. */
#include "convert/run/sum/gathering.h"

#include <stdlib.h>
#include <string.h>

#include "convert/base/clock.h"
#include "convert/run/sum/gathered_line.h"

static int lines_of(const wf_run *run, int64_t field) {
    const wf_raster *raster = &run->job->raster;
    return wf_raster_field_lines(raster, wf_raster_parity(raster, field));
}

/* ---- Memory ---- */

/* Fields that share a unit with a field are in flight with it. */
static int most_in_flight(const wf_run *run) {
    int per_frame = wf_raster_fields_per_frame(&run->job->raster), most = 1;
    int64_t first = run->setup.first_frame * per_frame, end = run->setup.end_frame * per_frame;
    for (int64_t n = first; n < end; n++) {
        int64_t past = run->kind->needs(run, n).end, m = n + 1;
        while (m < end && run->kind->needs(run, m).first < past) m++;
        if (m - n > most) most = (int)(m - n);
    }
    return most;
}

static size_t field_bytes(const wf_run *run, const wf_gathering *g) {
    const wf_raster *raster = &run->job->raster;
    return wf_gather_bytes(&g->desc, (raster->lines + 1) / wf_raster_line_step(raster));
}

/* What a patch takes beside its sums, about. */
#define PATCH_BYTES 512

static size_t kept_bytes(const wf_run *run, const wf_gathering *g) {
    const wf_aperture *aperture = &g->desc.aperture;
    int step = wf_raster_line_step(&run->job->raster);
    int lines = (g->tiling.rows + (int)(2 * aperture->reach_v)) / step + 2;
    int across = g->tiling.width_px + (int)(2 * aperture->reach_u) + 2;
    size_t pixel = wf_gather_bytes(&g->desc, 1) / (size_t)run->job->raster.width_px;
    size_t tile = (size_t)lines * (size_t)across * pixel + PATCH_BYTES;
    return 2 * field_bytes(run, g) + (size_t)g->tiling.count * 2 * (size_t)g->ways * tile;
}

/* What a run holds at most, without what it keeps. */
static size_t needed_bytes(const wf_run *run, const wf_gathering *g) {
    size_t band = wf_gather_bytes(&g->desc, WF_GATHER_ROWS + 4);
    return (size_t)g->flight_most * field_bytes(run, g) +
           (size_t)run->crew.threads * (size_t)g->flight_most * band +
           wf_frames_bytes(run->job, &run->setup, run->crew.threads, g->flight_most);
}

static weft_status check_memory(wf_run *run, const wf_gathering *g, weft_error *err) {
    size_t bytes = needed_bytes(run, g), allowed = run->job->max_memory_bytes;
    run->pace.memory_bytes = bytes;
    if (bytes <= allowed) return WEFT_OK;
    return wf_fail(err, WEFT_NO_MEMORY,
                   "this needs %zu MB and --max-memory allows %zu MB; allow more, or use fewer "
                   "--threads",
                   bytes >> 20, allowed >> 20);
}

/* ---- What is kept ---- */

/* Units that a field sees from beginning to end it sees alike; each of the others is in a way
 * of its own. */
static bool find_ways(const wf_run *run, wf_gathering *g, int *units) {
    wf_needs needs = run->kind->needs(run, 0);
    *units = (int)(needs.end - needs.first);
    g->way = calloc((size_t)*units, sizeof *g->way);
    g->ways = 1;
    for (int n = 0; g->way && n < *units; n++)
        if (!run->kind->samples->whole(run, 0, needs.end - 1 - n)) g->way[n] = g->ways++;
    return g->way;
}

/* What is still is kept where there is memory left. */
static bool prepare_to_keep(const wf_run *run, wf_gathering *g) {
    int tiles = g->tiling.count, units = 0;
    if (tiles > 0 && !find_ways(run, g, &units)) return false;
    g->most_takers = 2 * (g->flight_most + 4 * units);
    g->takers = calloc((size_t)g->most_takers, sizeof *g->takers);
    g->keeps = run->job->skip && tiles > 0 &&
               kept_bytes(run, g) + needed_bytes(run, g) <= run->job->max_memory_bytes;
    return g->takers && (!g->keeps || wf_tile_cache_new(tiles, 2 * g->ways, &g->cache));
}

/* ---- Life ---- */

static weft_status begin(wf_run *run, weft_error *err) {
    wf_gathering *g = run->sums = calloc(1, sizeof *g);
    if (!g) return wf_fail(err, WEFT_NO_MEMORY, "no memory for the job");
    g->desc = wf_setup_gather(run->job);
    if (run->kind->samples->tiling) g->tiling = run->kind->samples->tiling(run);
    g->flight_most = most_in_flight(run);
    run->pace = (wf_pace){
        .fields_together = 1, .fields_carried = g->flight_most - 1, .units_together = 1};
    weft_status status = check_memory(run, g, err);
    if (status) return status;
    g->flight = calloc((size_t)g->flight_most, sizeof *g->flight);
    if (!g->flight || !prepare_to_keep(run, g))
        return wf_fail(err, WEFT_NO_MEMORY, "no memory for fields");
    return wf_frames_new(&run->crew, &run->setup, g->flight_most, &run->frames, err);
}

static void drop(wf_run *run) {
    wf_gathering *g = run->sums;
    for (int n = 0; n < g->flight_count; n++)
        if (!g->flight[n].kept) wf_gather_free(g->flight[n].sums);
    g->flight_count = 0;
}

static void end(wf_run *run) {
    wf_gathering *g = run->sums;
    if (!g) return;
    drop(run);
    for (int p = 0; p < 2; p++) wf_gather_free(g->kept[p]);
    wf_tile_cache_free(&g->cache);
    free(g->takers);
    free(g->way);
    free(g->flight);
    free(g);
    run->sums = NULL;
}

/* ---- Fields ---- */

static weft_status launch(wf_run *run, int64_t field, weft_error *err) {
    wf_gathering *g = run->sums;
    wf_gather *sums = wf_gather_new(&g->desc, field, 0, lines_of(run, field));
    if (!sums) return wf_fail(err, WEFT_NO_MEMORY, "no memory for a field");
    if (!g->flight_count) g->flight_first = field;
    g->flight[g->flight_count++] = (wf_gathered){.sums = sums};
    return WEFT_OK;
}

static wf_gathered_line line_of(const wf_run *run, const wf_gathering *g, int line) {
    const wf_raster *raster = &run->job->raster;
    int parity = wf_raster_parity(raster, g->flight_first);
    return (wf_gathered_line){.job = run->job,
                              .gather = g->flight[0].sums,
                              .field = g->flight_first,
                              .line = line,
                              .called = parity + line * wf_raster_line_step(raster),
                              .remedy = "--on-empty nearest"};
}

static void finish_line(void *user, wf_worker *worker, int line) {
    wf_run *run = user;
    wf_gathering *g = run->sums;
    wf_gathered_line gathered = line_of(run, g, line);
    int64_t filled = 0;
    float *rgb[3];
    double start = wf_now_s();
    wf_frames_place(run->frames, worker, g->flight_first, line, rgb);
    gathered.alpha = wf_frames_alpha(run->frames, worker, g->flight_first, line);
    weft_status status = wf_gathered_finish(&gathered, rgb, &filled, &worker->error);
    worker->resample_s += wf_now_s() - start;
    g->filled += filled;
    if (status)
        wf_crew_fail(&run->crew, worker, status);
    else
        wf_frames_line(run->frames, worker, g->flight_first, line);
}

/* Frees what the first field has gathered, or keeps it for those that look the same. */
static void let_go(const wf_run *run, wf_gathering *g) {
    wf_gathered done = g->flight[0];
    wf_gather **kept = &g->kept[wf_raster_parity(&run->job->raster, g->flight_first)];
    if (done.still && !*kept)
        *kept = done.sums;
    else if (!done.kept)
        wf_gather_free(done.sums);
    g->flight_first++;
    g->flight_count--;
    memmove(g->flight, g->flight + 1, (size_t)g->flight_count * sizeof *g->flight);
}

/* The first field may look as one that was finished since its own units were added. */
static void take_kept(const wf_run *run, wf_gathering *g) {
    wf_gathered *first = &g->flight[0];
    wf_gather *kept = g->kept[wf_raster_parity(&run->job->raster, g->flight_first)];
    if (!first->follows || first->kept || !kept) return;
    wf_gather_free(first->sums);
    first->sums = kept;
    first->kept = true;
    g->fields_reused++;
}

static weft_status finish(wf_run *run, int64_t field, weft_error *err) {
    take_kept(run, run->sums);
    wf_crew_each(&run->crew, lines_of(run, field), 4, finish_line, run);
    let_go(run, run->sums);
    return wf_crew_status(&run->crew, err);
}

static void tell(const wf_run *run, wf_report *report) {
    const wf_gathering *g = run->sums;
    report->tiles_reused = g->tiles_reused;
    report->fields_reused = g->fields_reused;
}

const wf_summing wf_summing_samples = {
    .begin = begin,
    .launch = launch,
    .add = wf_gathering_add,
    .finish = finish,
    .drop = drop,
    .tell = tell,
    .end = end,
};
