/* weft trace: what a scene shows, stored for weft convert. */
#include <inttypes.h>
#include <limits.h>
#include <math.h>
#include <omp.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "convert/base/pattern.h"
#include "convert/base/values.h"
#include "convert/write/deep_write.h"
#include "convert/run/dry_run.h"
#include "convert/run/gathering.h"
#include "convert/run/render.h"

/* Rows that a thread traces at a time. */
#define BAND_ROWS 8

typedef struct tracing {
    weft_job *job;
    const wf_scene *scene;
    wf_sampling **sampling; /* [units]: one for each unit of a frame */
    int units, threads;
    wf_sampling_scratch **scratch; /* [threads] */
    weft_status status;            /* of the threads: the first failure */
    weft_error error;
    atomic_flag failed;
    atomic_bool stop;
    int64_t done, total;
    double started_s;
} tracing;

/* ---- Life ---- */

static bool make(tracing *t, weft_job *job, const wf_scene *scene, int units) {
    wf_sampling_desc desc = wf_render_sampling(job, scene);
    *t = (tracing){.job = job, .scene = scene, .units = units, .failed = ATOMIC_FLAG_INIT};
    t->threads = wf_gathering_threads(job);
    t->started_s = wf_now_s();
    t->sampling = calloc((size_t)units, sizeof(wf_sampling *));
    t->scratch = calloc((size_t)t->threads, sizeof(wf_sampling_scratch *));
    bool good = t->sampling && t->scratch;
    for (int n = 0; good && n < units; n++) good = (t->sampling[n] = wf_sampling_new(&desc));
    for (int n = 0; good && n < t->threads; n++)
        good = (t->scratch[n] = wf_sampling_scratch_new(t->sampling[0]));
    return good;
}

static void unmake(tracing *t, wf_report *report) {
    for (int n = 0; t->scratch && n < t->threads; n++) {
        if (t->scratch[n]) {
            wf_trace_counts counts = wf_sampling_counted(t->scratch[n]);
            wf_report_traced(report, &counts);
        }
        wf_sampling_scratch_free(t->scratch[n]);
    }
    for (int n = 0; t->sampling && n < t->units; n++) wf_sampling_free(t->sampling[n]);
    free(t->sampling);
    free(t->scratch);
    report->frames = t->done;
}

static void tell_progress(tracing *t) {
    t->done++;
    if (!t->job->progress) return;
    weft_progress progress = {t->done, t->total, wf_now_s() - t->started_s, "trace"};
    t->job->progress(&progress, t->job->progress_user);
}

static bool stopped(const tracing *t) {
    return atomic_load(&t->stop) || t->job->cancelled;
}

static weft_status status_of(const tracing *t, weft_error *err) {
    if (t->job->cancelled) return wf_fail(err, WEFT_INTERRUPTED, "interrupted");
    return t->status ? wf_fail(err, t->status, "%s", t->error.text) : WEFT_OK;
}

static void fail(tracing *t, weft_status status, const weft_error *why) {
    if (!atomic_flag_test_and_set(&t->failed)) {
        t->status = status;
        t->error = *why;
    }
    atomic_store(&t->stop, true);
}

/* ---- Sample buffers ---- */

#define KEPT 6 /* channels of a sample: R G B t x y */
static const wf_deep_channel kept[KEPT] = {WF_DEEP_R, WF_DEEP_G, WF_DEEP_B,
                                           WF_DEEP_T, WF_DEEP_X, WF_DEEP_Y};

/* The samples of one row and unit, in the order of pixels. */
typedef struct row_samples {
    float *v[KEPT];
    size_t count, room;
} row_samples;

typedef struct band {
    int first, rows, units, unit; /* unit: the one in hand */
    double late;      /* of the unit's field: field periods after the frame's first */
    row_samples *row; /* [units][rows] */
    bool failed;
} band;

static bool grow(row_samples *r, size_t more) {
    if (r->count + more <= r->room) return true;
    size_t room = 2 * (r->count + more);
    for (int c = 0; c < KEPT; c++) {
        float *grown = realloc(r->v[c], room * sizeof *grown);
        if (!grown) return false;
        r->v[c] = grown;
    }
    r->room = room;
    return true;
}

/* Samples first <= k < end of a block, which are of one row. */
static bool keep_row(band *b, const wf_samples *s, int j, size_t first, size_t end) {
    row_samples *r = &b->row[b->unit * b->rows + j];
    const float *const from[KEPT] = {s->rgb[0], s->rgb[1], s->rgb[2], s->t, s->x, s->y};
    if (!grow(r, end - first)) return false;
    for (int c = 0; c < KEPT; c++)
        memcpy(r->v[c] + r->count, from[c] + first, (end - first) * sizeof(float));
    for (size_t k = r->count; k < r->count + end - first; k++) r->v[3][k] += (float)b->late;
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
        for (size_t k = 0; k < r->count; k++) upto[pixel_of(r->v[4][k], width)]++;
    }
    for (int i = 1; i < width; i++) upto[i] += upto[i - 1];
}

/* Pixel by pixel the samples of all units, in the order in which they were traced. */
static bool weave(const band *b, int j, int width, wf_deep_line *line) {
    size_t total = 0;
    for (int u = 0; u < b->units; u++) total += b->row[u * b->rows + j].count;
    line->upto = malloc((size_t)width * sizeof *line->upto);
    float *all = malloc((KEPT * total + 1) * sizeof *all);
    int32_t *next = malloc(((size_t)width + 1) * sizeof *next);
    for (int c = 0; c < KEPT; c++)
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
            int at = next[pixel_of(r->v[4][k], width)]++;
            for (int c = 0; c < KEPT; c++) line->channel[kept[c]][at] = r->v[c][k];
        }
    }
    free(next);
    return good;
}

static void free_line(wf_deep_line *line) {
    free(line->upto);
    free(line->channel[kept[0]]);
}

static weft_status trace_band(tracing *t, int thread, const double *late, int units, band *b,
                              wf_deep_packed *packed, weft_error *err) {
    int width = t->job->raster.width_px;
    b->units = units;
    b->row = calloc((size_t)(units * b->rows), sizeof *b->row);
    b->failed = !b->row;
    const wf_receiver receiver = {.user = b, .samples = keep};
    for (b->unit = 0; !b->failed && b->unit < units; b->unit++) {
        b->late = late[b->unit];
        b->failed |= !wf_sampling_rows(t->sampling[b->unit], t->scratch[thread], b->first,
                                       b->first + b->rows, &receiver);
    }
    weft_status status = b->failed ? wf_fail(err, WEFT_NO_MEMORY, "no memory for samples") : 0;
    for (int j = 0; !status && j < b->rows; j++) {
        wf_deep_line line = {0};
        status = weave(b, j, width, &line)
                     ? wf_deep_pack(width, &line, &packed[j], err)
                     : wf_fail(err, WEFT_NO_MEMORY, "no memory for a line");
        free_line(&line);
    }
    for (int n = 0; b->row && n < units * b->rows; n++)
        for (int c = 0; c < KEPT; c++) free(b->row[n].v[c]);
    free(b->row);
    return status;
}

static void write_band(tracing *t, wf_deep_writer *file, const band *b,
                       wf_deep_packed *packed) {
    weft_error why;
    for (int j = 0; j < b->rows; j++) {
        weft_status status =
            stopped(t) ? WEFT_OK : wf_deep_write(file, b->first + j, &packed[j], &why);
        if (status) fail(t, status, &why);
        wf_deep_packed_free(&packed[j]);
    }
}

static void trace_rows(tracing *t, wf_deep_writer *file, const double *late, int units) {
    int lines = t->job->raster.lines;
#pragma omp parallel for num_threads(t->threads) schedule(dynamic, 1) ordered
    for (int first = 0; first < lines; first += BAND_ROWS) {
        band b = {.first = first,
                  .rows = lines - first < BAND_ROWS ? lines - first : BAND_ROWS};
        wf_deep_packed packed[BAND_ROWS] = {{0}};
        weft_error why;
        weft_status status = WEFT_OK;
        if (!stopped(t))
            status = trace_band(t, omp_get_thread_num(), late, units, &b, packed, &why);
        if (status) fail(t, status, &why);
#pragma omp ordered
        write_band(t, file, &b, packed);
    }
}

/* The units whose samples a frame's file holds: those of its own time; the first and the last
 * frame's also what windows reach before and behind all of them. */
typedef struct file_units {
    int64_t first, last, zero; /* zero: that of the frame's first field */
} file_units;

static file_units units_of(const tracing *t, int64_t frame, int64_t last_frame) {
    const wf_raster *raster = &t->job->raster;
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

static weft_status look(tracing *t, const file_units *u, double *late, weft_error *err) {
    for (int64_t n = u->first; n <= u->last; n++) {
        late[n - u->first] = (double)(n - u->zero);
        if (!wf_sampling_look(t->sampling[n - u->first], t->scratch[0], n))
            return wf_fail(err, WEFT_NO_MEMORY, "no memory for the scene");
    }
    return WEFT_OK;
}

/* Windows are 64 field periods at most, before and behind. */
#define MOST_UNITS 136

static weft_status trace_file(tracing *t, const char *path, int64_t frame, int64_t last_frame,
                              weft_error *err) {
    wf_deep_writer *file = NULL;
    double late[MOST_UNITS];
    const file_units units = units_of(t, frame, last_frame);
    const char *space = *t->scene->color_space ? t->scene->color_space : "lin_rec709";
    weft_status status = look(t, &units, late, err);
    if (!status)
        status = wf_deep_writer_new(path, &t->job->raster, space,
                                    t->job->overwrite || t->job->resume, &file, err);
    if (status) return status;
    trace_rows(t, file, late, (int)(units.last - units.first + 1));
    status = status_of(t, err);
    if (!status) return wf_deep_commit(file, err);
    wf_deep_abandon(file);
    return status;
}

/* Windows longer than a field need the fields that they reach beyond the ends. */
static int units_needed(const weft_job *job) {
    double tau = wf_ratio_value(wf_setup_gather(job).width);
    return 4 + 2 * (int)ceil(tau);
}

static weft_status trace_samples(weft_job *job, const wf_scene *scene, wf_setup *s,
                                 int64_t last_frame, wf_report *report, weft_error *err) {
    tracing t;
    int64_t end;
    weft_status status = make(&t, job, scene, units_needed(job))
                             ? WEFT_OK
                             : wf_fail(err, WEFT_NO_MEMORY, "no memory for the scene");
    t.total = s->end_frame - s->first_frame;
    const wf_foresee_desc plan = {
        .job = job, .setup = s, .sampling = status ? NULL : *t.sampling};
    if (!status && job->dry_run) status = wf_foresee(&plan, report, err);
    for (int64_t n = s->first_frame;
         !status && !job->dry_run && wf_next_frames(job, s, &n, &end);)
        for (; !status && n < end; n++) {
            char path[PATH_MAX];
            if (!wf_pattern_path(job->output, n, path, sizeof path))
                status =
                    wf_fail(err, WEFT_FAILED, "%s: the name of frame %" PRId64 " is too long",
                            job->output, n);
            if (!status) status = trace_file(&t, path, n, last_frame, err);
            if (!status) tell_progress(&t);
        }
    unmake(&t, report);
    return status;
}

/* ---- Subframes ---- */

typedef struct subframes {
    int across, down, times; /* samples a pixel, a line, a field */
    wf_raster raster;        /* of their pictures */
    wf_rational rate;
    int64_t per_frame;
    float *plane[3];
} subframes;

/* A raster whose frames are the subframes. */
static void describe_subframes(const weft_job *job, subframes *f) {
    wf_parse_oversample(job->oversample, &f->across, &f->down, &f->times);
    f->raster = job->raster;
    f->raster.width_px *= f->across;
    f->raster.lines *= f->down;
    f->raster.scan = WF_PROGRESSIVE;
    f->raster.pixel_aspect =
        wf_ratio_mul(job->raster.pixel_aspect, wf_ratio(f->down, f->across));
    f->rate = wf_ratio_div(wf_ratio(f->times, 1), wf_raster_field_period(&job->raster));
    f->raster.frame_rate = f->rate;
    f->per_frame = (int64_t)f->times * (job->raster.scan == WF_INTERLACED ? 2 : 1);
}

static void trace_band_of(tracing *t, const subframes *f, int first, int rows, float *rgb) {
    weft_error why;
    size_t width = (size_t)f->raster.width_px;
    if (!wf_sampling_subframe_rows(t->sampling[0], t->scratch[omp_get_thread_num()],
                                   f->raster.width_px, f->raster.lines, first, first + rows,
                                   rgb)) {
        fail(t, wf_fail(&why, WEFT_NO_MEMORY, "no memory for rays"), &why);
        return;
    }
    for (size_t k = 0; k < (size_t)rows * width; k++)
        for (int c = 0; c < 3; c++)
            f->plane[c][(size_t)first * width + k] = rgb[3 * k + (size_t)c];
}

static void trace_picture(tracing *t, const subframes *f) {
    weft_error why;
    int lines = f->raster.lines;
#pragma omp parallel num_threads(t->threads)
    {
        float *rgb = malloc(3 * BAND_ROWS * (size_t)f->raster.width_px * sizeof *rgb);
        if (!rgb) fail(t, wf_fail(&why, WEFT_NO_MEMORY, "no memory for a band"), &why);
#pragma omp for schedule(dynamic, 1)
        for (int first = 0; first < lines; first += BAND_ROWS)
            if (rgb && !stopped(t))
                trace_band_of(t, f, first,
                              lines - first < BAND_ROWS ? lines - first : BAND_ROWS, rgb);
        free(rgb);
    }
}

static weft_status trace_subframe(tracing *t, const subframes *f, const wf_sink_ops *ops,
                                  wf_sink *sink, int64_t k, weft_error *err) {
    wf_frame frame = {.index = k};
    if (!wf_sampling_subframe(t->sampling[0], wf_ratio_div(wf_ratio(k, 1), f->rate)))
        return wf_fail(err, WEFT_NO_MEMORY, "no memory for the scene");
    trace_picture(t, f);
    weft_status status = status_of(t, err);
    for (int c = 0; c < 3; c++) {
        frame.plane[c] = f->plane[c];
        frame.stride[c] = (size_t)f->raster.width_px;
    }
    if (!status) status = ops->write(sink, &frame, err);
    if (!status) tell_progress(t);
    return status;
}

/* The setup of a run whose frames are the subframes. */
static void turn_to_subframes(const wf_scene *scene, const subframes *f, wf_setup *s) {
    s->first_frame *= f->per_frame;
    s->end_frame *= f->per_frame;
    s->output_options.raster = &f->raster;
    s->output_options.timecode = NULL;
    s->output_options.color_space = *scene->color_space ? scene->color_space : "lin_rec709";
    s->output_options.subframe_rate = f->rate;
    wf_setup_count_frames(s);
}

static weft_status open_subframes(const wf_setup *s, subframes *f, wf_sink **sink,
                                  weft_error *err) {
    size_t bytes = (size_t)f->raster.width_px * (size_t)f->raster.lines * sizeof(float);
    for (int c = 0; c < 3; c++)
        if (!(f->plane[c] = malloc(bytes)))
            return wf_fail(err, WEFT_NO_MEMORY, "no memory for a subframe");
    return s->output.ops->open(&s->output_options, sink, err);
}

static weft_status trace_subframes(weft_job *job, const wf_scene *scene, wf_setup *s,
                                   wf_report *report, weft_error *err) {
    subframes f = {0};
    tracing t;
    wf_sink *sink = NULL;
    describe_subframes(job, &f);
    turn_to_subframes(scene, &f, s);
    const wf_foresee_desc plan = {.job = job, .setup = s, .pictures = true};
    if (job->dry_run) return wf_foresee(&plan, report, err);
    weft_status status = make(&t, job, scene, 1)
                             ? WEFT_OK
                             : wf_fail(err, WEFT_NO_MEMORY, "no memory for the scene");
    if (!status) status = open_subframes(s, &f, &sink, err);
    t.total = s->end_frame - s->first_frame;
    for (int64_t k = s->first_frame; !status && k < s->end_frame; k++)
        if (!job->resume || !wf_output_present(s->output.kind, job->output, k))
            status = trace_subframe(&t, &f, s->output.ops, sink, k, err);
    if (sink && !status)
        status = s->output.ops->commit(sink, err);
    else if (sink)
        s->output.ops->abandon(sink);
    for (int c = 0; c < 3; c++) free(f.plane[c]);
    unmake(&t, report);
    return status;
}

/* ---- The job ---- */

static weft_status check_output(const weft_job *job, const wf_setup *s, weft_error *err) {
    if (s->output.kind->layout != WF_LINEAR)
        return wf_fail(err, WEFT_USAGE,
                       "%s: samples are stored as EXR, such as samples.####.exr", job->output);
    if (!wf_pattern_is(job->output))
        return wf_fail(err, WEFT_USAGE,
                       "%s: samples are many files; say where their number goes, such as "
                       "samples.####.exr",
                       job->output);
    return WEFT_OK;
}

/* A stored sample has one time; of an own width there must be one window that it belongs to. */
static weft_status check_widths(const weft_job *job, const wf_scene *scene, weft_error *err) {
    bool own = false;
    for (int n = 0; n < scene->op_count; n++) own |= scene->ops[n].own_width;
    if (!own || wf_ratio_value(wf_setup_gather(job).width) <= 1) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE,
                   "%s: solids with a temporal width of their own cannot be stored for windows "
                   "longer than a field; give --temporal-width 1 or less, or use weft render",
                   job->inputs[0]);
}

weft_status wf_run_trace(weft_job *job, wf_report *report, weft_error *err) {
    wf_setup s = {0};
    wf_scene scene = {0};
    int64_t first, last = 0;
    weft_status status = wf_setup_output(job, &s, err);
    if (!status) status = check_output(job, &s, err);
    if (!status) status = wf_render_load(job, &scene, err);
    if (!status) status = wf_render_frames(job, &scene, &s.first_frame, &s.end_frame, err);
    if (!status) {
        weft_job whole = *job;
        whole.chunk = whole.chunk_count = 1;
        wf_render_frames(&whole, &scene, &first, &last, err);
        wf_setup_count_frames(&s);
        if (!job->oversample) status = check_widths(job, &scene, err);
    }
    if (!status) {
        status = job->oversample ? trace_subframes(job, &scene, &s, report, err)
                                 : trace_samples(job, &scene, &s, last - 1, report, err);
    }
    wf_setup_free(&s);
    wf_scene_free(&scene);
    return status;
}
