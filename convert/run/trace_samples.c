/* weft trace: samples, a deep EXR file a frame. */
#include <inttypes.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "convert/base/pattern.h"
#include "convert/run/dry_run.h"
#include "convert/run/source/source_scene.h"
#include "convert/run/trace.h"
#include "convert/write/deep_write.h"

/* Windows are 64 field periods at most, before and behind. */
#define MOST_UNITS 136

/* A frame in hand, which is several units at once. */
typedef struct tracing {
    wf_run *run;
    wf_scene_source *source;
    wf_sampling
        *sampling[MOST_UNITS]; /* one for each unit of a frame; the first is the source's */
    double late[MOST_UNITS];   /* of the units: field periods after the frame's first field */
    int units, most_units;     /* of this frame; of any */
    bool alpha;                /* it is stored, as the scene has it */
    wf_deep_writer *file;
} tracing;

/* ---- Life ---- */

/* Windows longer than a field need the fields that they reach beyond the ends. */
static int units_needed(const weft_job *job) {
    return 4 + 2 * (int)ceil(wf_ratio_value(wf_setup_width(job)));
}

static weft_status make(wf_run *run, tracing *t, weft_error *err) {
    wf_scene_source *source = run->source;
    wf_sampling_desc desc = wf_scene_sampling(run->job, &source->scene);
    *t = (tracing){.run = run,
                   .source = source,
                   .most_units = units_needed(run->job),
                   .alpha = wf_scene_has_alpha(&source->scene)};
    weft_status status = run->kind->start(run, err);
    if (status) return status;
    t->sampling[0] = source->sampling;
    for (int n = 1; n < t->most_units; n++)
        if (!(t->sampling[n] = wf_sampling_new(&desc)))
            return wf_fail(err, WEFT_NO_MEMORY, "no memory for the scene");
    return WEFT_OK;
}

static void unmake(tracing *t) {
    for (int n = 1; n < t->most_units; n++) wf_sampling_free(t->sampling[n]);
}

/* ---- Samples ---- */

#define KEPT 7 /* channels of a sample: R G B t x y, and A where the scene has it */
static const wf_deep_channel kept[KEPT] = {WF_DEEP_R, WF_DEEP_G, WF_DEEP_B, WF_DEEP_T,
                                           WF_DEEP_X, WF_DEEP_Y, WF_DEEP_A};
enum { KEPT_T = 3, KEPT_X = 4 };

/* The samples of one row and unit, in the order of pixels. */
typedef struct row_samples {
    float *v[KEPT];
    size_t count, capacity;
} row_samples;

/* Rows of a frame: their samples, and what becomes of these in the file. */
typedef struct band {
    int first, rows, units, unit; /* unit: the one in hand */
    int channels;                 /* that are kept: KEPT, or without A one less */
    double late;      /* of the unit's field: field periods after the frame's first */
    row_samples *row; /* [units][rows] */
    bool failed;
    wf_deep_packed packed[WF_TRACE_ROWS];
} band;

static bool grow(row_samples *r, int channels, size_t more) {
    if (r->count + more <= r->capacity) return true;
    size_t capacity = 2 * (r->count + more);
    for (int c = 0; c < channels; c++) {
        float *grown = realloc(r->v[c], capacity * sizeof *grown);
        if (!grown) return false;
        r->v[c] = grown;
    }
    r->capacity = capacity;
    return true;
}

/* Samples first <= k < end of a block, which are of one row. */
static bool keep_row(band *b, const wf_samples *s, int j, size_t first, size_t end) {
    row_samples *r = &b->row[b->unit * b->rows + j];
    const float *const from[KEPT] = {s->rgb[0], s->rgb[1], s->rgb[2], s->t,
                                     s->x,      s->y,      s->alpha};
    if (!grow(r, b->channels, end - first)) return false;
    for (int c = 0; c < b->channels; c++)
        memcpy(r->v[c] + r->count, from[c] + first, (end - first) * sizeof(float));
    for (size_t k = r->count; k < r->count + end - first; k++)
        r->v[KEPT_T][k] += (float)b->late;
    r->count += end - first;
    return true;
}

static void keep(void *user, const wf_samples *s) {
    band *b = user;
    for (size_t first = 0, end; first < s->count; first = end) {
        float row = floorf(s->y[first]);
        for (end = first + 1; end < s->count && floorf(s->y[end]) == row;) end++;
        b->failed |= !keep_row(b, s, (int)row - b->first, first, end);
    }
}

static int pixel_of(float x, int width) {
    return x < 0 ? 0 : x >= (float)width ? width - 1 : (int)x;
}

/* How many samples there are up to the end of each pixel, of all units together. */
static void count_samples(const band *b, int j, int width, int32_t *upto) {
    memset(upto, 0, (size_t)width * sizeof *upto);
    for (int u = 0; u < b->units; u++) {
        const row_samples *r = &b->row[u * b->rows + j];
        for (size_t k = 0; k < r->count; k++) upto[pixel_of(r->v[KEPT_X][k], width)]++;
    }
    for (int i = 1; i < width; i++) upto[i] += upto[i - 1];
}

/* Pixel by pixel the samples of all units, in the order in which they were traced. */
static bool weave(const band *b, int j, int width, wf_deep_line *line) {
    size_t total = 0;
    for (int u = 0; u < b->units; u++) total += b->row[u * b->rows + j].count;
    line->upto = malloc((size_t)width * sizeof *line->upto);
    float *all = malloc(((size_t)b->channels * total + 1) * sizeof *all);
    int32_t *next = malloc(((size_t)width + 1) * sizeof *next);
    for (int c = 0; c < b->channels; c++)
        line->channel[kept[c]] = all ? all + (size_t)c * total : NULL;
    bool good = all && next && line->upto;
    if (good) {
        count_samples(b, j, width, line->upto);
        next[0] = 0;
        memcpy(next + 1, line->upto, (size_t)width * sizeof *next);
    }
    for (int u = 0; good && u < b->units; u++) {
        const row_samples *r = &b->row[u * b->rows + j];
        for (size_t k = 0; k < r->count; k++) {
            int at = next[pixel_of(r->v[KEPT_X][k], width)]++;
            for (int c = 0; c < b->channels; c++) line->channel[kept[c]][at] = r->v[c][k];
        }
    }
    free(next);
    return good;
}

static void free_line(wf_deep_line *line) {
    free(line->upto);
    free(line->channel[kept[0]]);
}

static bool draw_units(const tracing *t, const wf_worker *worker, band *b) {
    const wf_receiver receiver = {.user = b, .samples = keep};
    b->units = t->units;
    b->row = calloc((size_t)(b->units * b->rows), sizeof *b->row);
    b->failed = !b->row;
    for (b->unit = 0; !b->failed && b->unit < b->units; b->unit++) {
        b->late = t->late[b->unit];
        b->failed |= !wf_sampling_rows(t->sampling[b->unit], t->source->scratch[worker->number],
                                       b->first, b->first + b->rows, &receiver);
    }
    return !b->failed;
}

static weft_status pack_row(const band *b, int j, int width, wf_deep_packed *packed,
                            weft_error *err) {
    wf_deep_line line = {0};
    weft_status status = weave(b, j, width, &line)
                             ? wf_deep_pack(width, &line, packed, err)
                             : wf_fail(err, WEFT_NO_MEMORY, "no memory for a line");
    free_line(&line);
    return status;
}

static void free_rows(band *b) {
    for (int n = 0; b->row && n < b->units * b->rows; n++)
        for (int c = 0; c < KEPT; c++) free(b->row[n].v[c]);
    free(b->row);
    b->row = NULL;
}

static weft_status trace_band(const tracing *t, wf_worker *worker, band *b) {
    weft_status status = draw_units(t, worker, b)
                             ? WEFT_OK
                             : wf_fail(&worker->error, WEFT_NO_MEMORY, "no memory for samples");
    for (int j = 0; !status && j < b->rows; j++)
        status = pack_row(b, j, t->run->job->raster.width_px, &b->packed[j], &worker->error);
    free_rows(b);
    return status;
}

static void *make_band(void *user, wf_worker *worker, int n) {
    const tracing *t = user;
    int first = n * WF_TRACE_ROWS, left = t->run->job->raster.lines - first;
    band *b = calloc(1, sizeof *b);
    weft_status status =
        b ? WEFT_OK : wf_fail(&worker->error, WEFT_NO_MEMORY, "no memory for a band");
    if (b) {
        b->first = first;
        b->channels = KEPT - !t->alpha;
        b->rows = left < WF_TRACE_ROWS ? left : WF_TRACE_ROWS;
        status = trace_band(t, worker, b);
    }
    if (status) wf_crew_fail(&t->run->crew, worker, status);
    return b;
}

static void write_band(void *user, wf_worker *worker, int n, void *made) {
    const tracing *t = user;
    wf_crew *crew = &t->run->crew;
    band *b = made;
    (void)n;
    for (int j = 0; b && j < b->rows; j++) {
        weft_status status =
            wf_crew_stopped(crew)
                ? WEFT_OK
                : wf_deep_write(t->file, b->first + j, &b->packed[j], &worker->error);
        if (status) wf_crew_fail(crew, worker, status);
        wf_deep_packed_free(&b->packed[j]);
    }
    free(b);
}

/* ---- Files ---- */

/* The units whose samples a frame's file holds: those of its own time; the first and the last
 * frame's also what windows reach before and behind all of them. */
typedef struct file_units {
    int64_t first, last, zero; /* zero: that of the frame's first field */
} file_units;

static file_units units_of(const tracing *t, int64_t frame, int64_t last_frame) {
    const wf_raster *raster = &t->run->job->raster;
    int per_frame = wf_raster_fields_per_frame(raster);
    int instants = raster->scan == WF_INTERLACED ? 2 : 1;
    file_units u = {frame * instants, (frame + 1) * instants - 1, frame * instants};
    int64_t reach, ignored;
    wf_sampling_units(t->sampling[0], 0, &reach, &ignored);
    if (frame == 0) u.first += reach;
    wf_sampling_units(t->sampling[0], (frame + 1) * per_frame - 1, &ignored, &reach);
    if (frame == last_frame && reach > u.last) u.last = reach;
    return u;
}

static weft_status turn_to(tracing *t, const file_units *u, weft_error *err) {
    t->units = (int)(u->last - u->first + 1);
    for (int n = 0; n < t->units; n++) {
        t->late[n] = (double)(u->first + n - u->zero);
        if (!wf_sampling_look(t->sampling[n], t->source->scratch[0], u->first + n))
            return wf_fail(err, WEFT_NO_MEMORY, "no memory for the scene");
    }
    return WEFT_OK;
}

static weft_status trace_file(tracing *t, const char *path, int64_t frame, int64_t last_frame,
                              weft_error *err) {
    const weft_job *job = t->run->job;
    wf_crew *crew = &t->run->crew;
    const file_units units = units_of(t, frame, last_frame);
    weft_status status = turn_to(t, &units, err);
    if (!status)
        status = wf_deep_writer_new(path, &job->raster, wf_scene_space(t->run), t->alpha,
                                    job->overwrite || job->resume, &t->file, err);
    if (status) return status;
    wf_crew_part(crew, 0, 1);
    wf_crew_in_order(crew, (job->raster.lines + WF_TRACE_ROWS - 1) / WF_TRACE_ROWS, make_band,
                     write_band, t);
    status = wf_crew_status(crew, err);
    if (!status) return wf_deep_commit(t->file, err);
    wf_deep_abandon(t->file);
    return status;
}

static weft_status trace_frame(tracing *t, int64_t frame, int64_t last_frame, weft_error *err) {
    char path[PATH_MAX];
    const char *output = t->run->job->output;
    if (!wf_pattern_path(output, frame, path, sizeof path))
        return wf_fail(err, WEFT_FAILED, "%s: the name of frame %" PRId64 " is too long",
                       output, frame);
    weft_status status = trace_file(t, path, frame, last_frame, err);
    if (!status) wf_crew_step(&t->run->crew);
    return status;
}

static weft_status trace_all(tracing *t, int64_t last_frame, weft_error *err) {
    const wf_run *run = t->run;
    weft_status status = WEFT_OK;
    int64_t end;
    wf_crew_begin(&t->run->crew);
    for (int64_t n = run->setup.first_frame;
         !status && wf_frames_next(run->job, &run->setup, &n, &end);)
        for (; !status && n < end; n++) status = trace_frame(t, n, last_frame, err);
    return status;
}

weft_status wf_store_samples(wf_run *run, int64_t last_frame, weft_error *err) {
    tracing t;
    weft_status status = make(run, &t, err);
    run->crew.total = run->setup.end_frame - run->setup.first_frame;
    if (!status)
        status = run->job->dry_run ? wf_dry_run_make(run, false, err)
                                   : trace_all(&t, last_frame, err);
    unmake(&t);
    wf_scene_tell_traced(run, run->report);
    run->report->frames = run->crew.done;
    return status;
}
