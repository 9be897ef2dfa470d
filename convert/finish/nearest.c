/* The nearest picture of each field, whose flicker is weighed or bounded. */
#include "convert/finish/nearest.h"

#include <inttypes.h>
#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

enum { LUMINANCE = 3 }; /* after R', G' and B' */

/* A worker's own. */
typedef struct solver {
    wf_least_scratch *scratch;
    wf_least_counts counts;
    float
        *light; /* [5][width]: of pixels that change R'G'B', luminance as it was and will be */
    int *place; /* [width]: which these are */
    bool *clipped; /* [width] */
} solver;

struct wf_nearest {
    wf_crew *crew;
    wf_nearest_desc desc;
    wf_least *least;
    wf_seen *seen;   /* NULL, as is the next, where the limit is light */
    float *limits;   /* [lines][width]: of the field that is being solved */
    solver *solvers; /* [threads] */
    float *planes;   /* [fields][planes][lines][width]: luminance; or R, G, B and alpha */
    float *own;      /* [fields][own lines][4][width]: R'G'B' and its luminance, which is NaN
                        where it was clipped; NULL of channels */
    _Atomic int64_t clipped;
    int64_t field; /* that is being solved */
};

/* ---- Memory ---- */

static int planes_of(const wf_nearest_desc *d) {
    return d->channels ? 4 : 1;
}

static size_t width_of(const wf_nearest_desc *d) {
    return (size_t)d->raster->width_px;
}

static size_t plane_samples(const wf_nearest_desc *d) {
    return width_of(d) * (size_t)d->raster->lines;
}

static size_t own_samples(const wf_nearest_desc *d) {
    size_t lines = (size_t)wf_raster_field_lines(d->raster, 0);
    return d->channels ? 0 : (LUMINANCE + 1) * width_of(d) * lines;
}

static wf_least_desc least_of(const wf_nearest_desc *d) {
    return (wf_least_desc){.lines = d->raster->lines,
                           .weight = d->weight,
                           .limit =
                               d->limit, /* of what is seen pixels have limits of their own */
                           .most = (double)d->shown.most};
}

size_t wf_nearest_bytes(const wf_nearest_desc *d, int threads) {
    if (!d->held) return 0;
    size_t field = (size_t)planes_of(d) * plane_samples(d) + own_samples(d);
    size_t tile = (size_t)d->raster->lines * wf_least_tile_px * sizeof(double);
    size_t limits = d->limit_is_seen ? plane_samples(d) : 0;
    return ((size_t)d->fields * field + limits) * sizeof(float) + (size_t)threads * 16 * tile;
}

static bool make_solver(const wf_nearest *f, solver *s) {
    size_t width = width_of(&f->desc);
    s->scratch = wf_least_scratch_new(f->least);
    s->light = malloc(5 * width * sizeof *s->light);
    s->place = malloc(width * sizeof *s->place);
    s->clipped = malloc(width * sizeof *s->clipped);
    return s->scratch && s->light && s->place && s->clipped;
}

static bool make(wf_nearest *f) {
    const wf_nearest_desc *d = &f->desc;
    const wf_least_desc least = least_of(d);
    size_t fields = (size_t)d->fields;
    f->least = wf_least_new(&least);
    f->solvers = calloc((size_t)f->crew->threads, sizeof *f->solvers);
    f->planes = malloc(fields * (size_t)planes_of(d) * plane_samples(d) * sizeof *f->planes);
    f->own = malloc((fields * own_samples(d) + 1) * sizeof *f->own);
    bool good = f->least && f->solvers && f->planes && f->own;
    if (d->limit_is_seen) {
        f->seen = wf_seen_new(&d->viewing, 1, 1);
        f->limits = malloc(plane_samples(d) * sizeof *f->limits);
        good = good && f->seen && f->limits;
    }
    for (int t = 0; good && t < f->crew->threads; t++) good = make_solver(f, &f->solvers[t]);
    return good;
}

weft_status wf_nearest_new(wf_crew *crew, const wf_nearest_desc *desc, wf_nearest **out,
                           weft_error *err) {
    wf_nearest *f = calloc(1, sizeof *f);
    if (f) {
        f->crew = crew;
        f->desc = *desc;
        f->field = -1;
    }
    if (f && make(f)) {
        *out = f;
        return WEFT_OK;
    }
    wf_nearest_free(f);
    return wf_fail(err, WEFT_NO_MEMORY, "no memory for fields whose flicker is held");
}

void wf_nearest_free(wf_nearest *f) {
    if (!f) return;
    for (int t = 0; f->solvers && t < f->crew->threads; t++) {
        wf_least_scratch_free(f->solvers[t].scratch);
        free(f->solvers[t].light);
        free(f->solvers[t].place);
        free(f->solvers[t].clipped);
    }
    wf_least_free(f->least);
    wf_seen_free(f->seen);
    free(f->limits);
    free(f->solvers);
    free(f->planes);
    free(f->own);
    free(f);
}

/* ---- Lines ---- */

static float *plane_of(const wf_nearest *f, int64_t field, int plane) {
    const wf_nearest_desc *d = &f->desc;
    size_t slot = (size_t)(field % d->fields) * (size_t)planes_of(d) + (size_t)plane;
    return f->planes + slot * plane_samples(d);
}

static float *line_of(const wf_nearest *f, int64_t field, int plane, int line) {
    return plane_of(f, field, plane) + (size_t)line * width_of(&f->desc);
}

/* R', G', B' or luminance of one of the field's own lines; NULL of other lines. */
static float *own_line(const wf_nearest *f, int64_t field, int line, int c) {
    const wf_nearest_desc *d = &f->desc;
    int step = wf_raster_line_step(d->raster), from = line - wf_raster_parity(d->raster, field);
    if (from % step) return NULL;
    size_t at = (LUMINANCE + 1) * (size_t)(from / step) + (size_t)c;
    return f->own + (size_t)(field % d->fields) * own_samples(d) + at * width_of(d);
}

static bool limited(const wf_nearest *f) {
    return f->desc.limit < HUGE_VAL;
}

/* Luminance as it was, of a field's own line. */
static void keep_luminance(const solver *s, const float *from, float *own, size_t width) {
    for (size_t x = 0; x < width; x++) own[x] = s->clipped[x] ? NAN : from[x];
}

void wf_nearest_put(wf_nearest *f, const wf_worker *worker, int64_t field, int line,
                    float *const rgb[3], const float *alpha) {
    const solver *s = &f->solvers[worker->number];
    size_t width = width_of(&f->desc), bytes = width * sizeof(float);
    if (f->desc.channels) {
        for (int c = 0; c < 3; c++) memcpy(line_of(f, field, c, line), rgb[c], bytes);
        memcpy(line_of(f, field, 3, line), alpha, bytes);
        return;
    }
    for (int c = 0; c < 3; c++) {
        float *own = own_line(f, field, line, c);
        if (own) memcpy(own, rgb[c], bytes);
    }
    float *luminance = line_of(f, field, 0, line), *own = own_line(f, field, line, LUMINANCE);
    f->clipped +=
        wf_displayed_light(&f->desc.shown, rgb, luminance, s->clipped, limited(f), width);
    if (own) keep_luminance(s, luminance, own, width);
}

/* Pixels whose luminance changes, or was clipped; others keep the bits that they had. */
static size_t find_changes(const solver *s, const float *from, const float *to, size_t width) {
    size_t count = 0;
    for (size_t x = 0; x < width; x++) {
        s->place[count] = (int)x;
        count += to[x] != from[x];
    }
    return count;
}

/* R'G'B' of these pixels, of which luminance is to be to[]. */
static void change_pixels(const wf_nearest *f, const solver *s, size_t count, const float *to,
                          float *const rgb[3]) {
    size_t width = width_of(&f->desc);
    float *const some[3] = {s->light, s->light + width, s->light + 2 * width};
    float *from = s->light + 3 * width, *then = from + width;
    for (int c = 0; c < 3; c++)
        for (size_t k = 0; k < count; k++) some[c][k] = rgb[c][s->place[k]];
    for (size_t k = 0; k < count; k++) then[k] = to[s->place[k]];
    wf_displayed_light(&f->desc.shown, some, from, NULL, limited(f), count);
    wf_displayed_change(&f->desc.shown, some, from, then, count);
    wf_displayed_encode(&f->desc.shown, some, count);
    for (int c = 0; c < 3; c++)
        for (size_t k = 0; k < count; k++) rgb[c][s->place[k]] = some[c][k];
}

void wf_nearest_take(const wf_nearest *f, const wf_worker *worker, int64_t field, int line,
                     float *const rgb[3], float *alpha) {
    const solver *s = &f->solvers[worker->number];
    size_t width = width_of(&f->desc), bytes = width * sizeof(float);
    const float *to = line_of(f, field, 0, line);
    if (f->desc.channels) {
        for (int c = 0; c < 3; c++) memcpy(rgb[c], line_of(f, field, c, line), bytes);
        memcpy(alpha, line_of(f, field, 3, line), bytes);
        return;
    }
    for (int c = 0; c < 3; c++) memcpy(rgb[c], own_line(f, field, line, c), bytes);
    size_t count = find_changes(s, own_line(f, field, line, LUMINANCE), to, width);
    if (count) change_pixels(f, s, count, to, rgb);
}

/* ---- Solving ---- */

static int tiles_of(const wf_nearest *f) {
    return (f->desc.raster->width_px + wf_least_tile_px - 1) / wf_least_tile_px;
}

static void solve_tile(void *user, wf_worker *worker, int n) {
    wf_nearest *f = user;
    solver *s = &f->solvers[worker->number];
    size_t width = width_of(&f->desc);
    float *plane = plane_of(f, f->field, n / tiles_of(f));
    wf_least_tile_within(f->least, s->scratch, n % tiles_of(f), (int)width, width, plane,
                         f->limits, plane, &s->counts);
}

static wf_least_counts counts_of(const wf_nearest *f) {
    wf_least_counts all = {.clipped = f->clipped};
    for (int t = 0; t < f->crew->threads; t++) {
        all.clipped += f->solvers[t].counts.clipped;
        all.solved += f->solvers[t].counts.solved;
        all.failed += f->solvers[t].counts.failed;
    }
    return all;
}

weft_status wf_nearest_solve(wf_nearest *f, int64_t field, weft_error *err) {
    f->field = field;
    if (f->seen) wf_seen_bound(f->seen, plane_of(f, field, 0), f->desc.limit, f->limits);
    wf_crew_each(f->crew, planes_of(&f->desc) * tiles_of(f), 1, solve_tile, f);
    weft_status status = wf_crew_status(f->crew, err);
    wf_least_counts counts = counts_of(f);
    if (status || !counts.failed) return status;
    return wf_fail(err, WEFT_FAILED,
                   "field %" PRId64 ": of %" PRId64
                   " columns the nearest picture within --flicker-limit %s%g was not found to "
                   "the accuracy that is promised; take a higher limit",
                   field, counts.failed, f->desc.limit_is_seen ? "visible:" : "",
                   f->desc.limit);
}

void wf_nearest_tell(const wf_nearest *f, wf_report *report) {
    wf_least_counts counts = counts_of(f);
    report->flicker.held = true;
    report->flicker.weight = f->desc.weight;
    report->flicker.limit = limited(f) ? f->desc.limit : 0;
    report->flicker.limit_is_seen = f->desc.limit_is_seen;
    report->flicker.clipped = counts.clipped;
    report->flicker.columns_solved = counts.solved;
}
