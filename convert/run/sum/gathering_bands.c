/* Fields summed from samples: who takes a unit's samples, and the bands of rows that they come
 * in. */
#include <math.h>
#include <stdlib.h>

#include "convert/base/clock.h"
#include "convert/run/sum/gathering.h"

/* ---- Who takes a unit's samples ---- */

static bool takes_unit(const wf_run *run, int64_t field, int64_t unit, int64_t *last) {
    wf_needs needs = run->kind->needs(run, field);
    *last = needs.end - 1;
    return needs.first <= unit && unit < needs.end;
}

static int first_of_slot(const wf_gathering *g, int slot) {
    int n = 0;
    while (n < g->taker_count && g->takers[n].slot != slot) n++;
    return n;
}

static void add_taker(const wf_run *run, wf_gathering *g, int64_t unit, int64_t field,
                      int64_t shift) {
    int64_t last, place = field - g->flight_first;
    if (!takes_unit(run, field, unit, &last)) return;
    int parity = wf_raster_parity(&run->job->raster, field + shift);
    wf_taker t = {.field = field + shift, .shift = shift};
    t.waits = shift == 0 && place >= 0 && place < g->flight_count && !g->flight[place].follows;
    t.slot = g->way ? 2 * g->way[last - unit] + parity : 0;
    t.like = first_of_slot(g, t.slot);
    bool more = t.waits || (g->keeps && t.like == g->taker_count);
    if (more && g->taker_count < g->most_takers) g->takers[g->taker_count++] = t;
}

/* The fields in flight that need the unit; and, where what is still is kept, whoever else would
 * see it so, now or one field later. */
static void find_takers(const wf_run *run, wf_gathering *g, int64_t unit) {
    const wf_raster *raster = &run->job->raster;
    int64_t last, first = g->flight_first, end = first + g->flight_count;
    bool interlaced = raster->scan == WF_INTERLACED && !raster->pulldown;
    while (g->keeps && takes_unit(run, first - 1, unit, &last)) first--;
    while (g->keeps && takes_unit(run, end, unit, &last)) end++;
    g->taker_count = 0;
    for (int64_t shift = 0; shift <= interlaced; shift++)
        for (int64_t field = first; field < end; field++) add_taker(run, g, unit, field, shift);
}

/* ---- Bands ---- */

/* The unit in hand, for all threads. */
typedef struct bands {
    wf_run *run;
    wf_gathering *g;
    wf_taking taking;
} bands;

/* A receiver that tells of progress between tiles. */
typedef struct ticking {
    wf_crew *crew;
    const wf_worker *worker;
    wf_receiver to;
    int first, rows, width_px; /* of the band and of its tiles; how wide it is */
} ticking;

/* How much of a band lies before some samples: tiles come a row of them after the other. */
static double band_part(const ticking *t, const wf_samples *samples) {
    double row = floor(((double)samples->y[0] - t->first) / t->rows);
    double part = (row + (double)samples->x[0] / t->width_px) * t->rows / WF_GATHER_ROWS;
    return fmin(fmax(part, 0), 1);
}

static void pass_samples(void *user, const wf_samples *samples) {
    const ticking *t = user;
    t->to.samples(t->to.user, samples);
    if (samples->count) wf_crew_tick(t->crew, t->worker, band_part(t, samples));
}

static bool pass_tile(void *user, const wf_sample_tile *tile) {
    const ticking *t = user;
    return t->to.tile(t->to.user, tile);
}

static weft_status gather_band(const bands *b, wf_worker *worker, int first,
                               wf_band_sums *sums) {
    int lines = b->run->job->raster.lines;
    int end = first + WF_GATHER_ROWS < lines ? first + WF_GATHER_ROWS : lines;
    if (!wf_band_sums_new(&b->taking, first, end, sums))
        return wf_fail(&worker->error, WEFT_NO_MEMORY, "no memory for a band of a field");
    int rows = b->g->tiling.rows > 0 ? b->g->tiling.rows : WF_GATHER_ROWS;
    ticking t = {&b->run->crew, worker, wf_band_sums_receiver(sums),
                 first,         rows,   b->run->job->raster.width_px};
    const wf_receiver receiver = {&t, pass_samples, t.to.tile ? pass_tile : NULL};
    weft_status status =
        b->run->kind->samples->band(b->run, worker, first, end, &receiver, &worker->error);
    if (!status && !wf_band_sums_end(sums))
        status = wf_fail(&worker->error, WEFT_NO_MEMORY, "no memory for a band of a field");
    return status;
}

static void *make_band(void *user, wf_worker *worker, int n) {
    const bands *b = user;
    double start = wf_now_s();
    wf_band_sums *sums = calloc(1, sizeof *sums);
    weft_status status =
        sums ? gather_band(b, worker, n * WF_GATHER_ROWS, sums)
             : wf_fail(&worker->error, WEFT_NO_MEMORY, "no memory for a band of a field");
    if (status) wf_crew_fail(&b->run->crew, worker, status);
    worker->source_s += wf_now_s() - start;
    return sums;
}

static void take_band(void *user, wf_worker *worker, int n, void *made) {
    wf_gathering *g = ((const bands *)user)->g;
    wf_band_sums *sums = made;
    (void)worker;
    (void)n;
    if (!sums) return;
    for (int t = 0; sums->sums && t < g->taker_count; t++)
        if (sums->sums[t])
            wf_gather_merge(g->flight[g->takers[t].field - g->flight_first].sums,
                            sums->sums[t]);
    g->tiles_reused += sums->reused;
    wf_band_sums_free(sums);
    free(sums);
}

static void gather_bands(wf_run *run, wf_gathering *g, int64_t unit) {
    int count = (run->job->raster.lines + WF_GATHER_ROWS - 1) / WF_GATHER_ROWS;
    find_takers(run, g, unit);
    bands b = {run, g, {&g->desc, g->takers, g->taker_count, g->keeps ? &g->cache : NULL}};
    wf_crew_in_order(&run->crew, count, make_band, take_band, &b);
}

/* ---- Still fields ---- */

static void take_kept(wf_gathering *g, wf_gathered *f, wf_gather *kept) {
    if (f->kept) return;
    wf_gather_free(f->sums);
    f->sums = kept;
    f->kept = true;
    g->fields_reused++;
}

/* Fields that see nothing move take the sums of one of their parity that was done before, or
 * wait for it to be. Whether any has to gather. */
static bool reuse_fields(const wf_run *run, wf_gathering *g) {
    bool gathers[2] = {false, false};
    for (int n = 0; n < g->flight_count; n++) {
        int parity = wf_raster_parity(&run->job->raster, g->flight_first + n);
        wf_gathered *f = &g->flight[n];
        f->still = true;
        f->follows = g->kept[parity] || gathers[parity];
        if (g->kept[parity])
            take_kept(g, f, g->kept[parity]);
        else
            gathers[parity] = true;
    }
    return gathers[0] || gathers[1];
}

/* Where in its frame the first field in flight stands once it has all units before this one. */
static void tell_part(wf_run *run, const wf_gathering *g, int64_t unit) {
    int per_frame = wf_raster_fields_per_frame(&run->job->raster);
    wf_needs needs = run->kind->needs(run, g->flight_first);
    double units = (double)(needs.end - needs.first), before = (double)(unit - needs.first);
    double field = (double)(g->flight_first % per_frame);
    wf_crew_part(&run->crew, (field + before / units) / per_frame, 1 / units / per_frame);
}

static weft_status add_unit(wf_run *run, int64_t unit, weft_error *err) {
    const wf_sample_reading *samples = run->kind->samples;
    wf_gathering *g = run->sums;
    tell_part(run, g, unit);
    weft_status status = samples->turn(run, unit, err);
    if (status) return status;
    bool still = g->keeps && samples->still(run);
    if (!still || reuse_fields(run, g)) gather_bands(run, g, unit);
    return wf_crew_status(&run->crew, err);
}

weft_status wf_gathering_add(wf_run *run, const wf_units *units, weft_error *err) {
    weft_status status = WEFT_OK;
    for (int i = 0; !status && i < units->count; i++)
        status = add_unit(run, units->unit[i], err);
    return status;
}
