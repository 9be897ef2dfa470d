/* Samples that a renderer hands over (weft.h, Samples from a renderer): a run without a source,
 * whose fields are finished when its caller says that nothing more comes for them. */
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "convert/finish/frames.h"
#include "convert/run/sum/gathered_line.h"
#include "filters/raster/timing.h"

struct weft_fields {
    weft_job *job;
    weft_field_fn *fn;
    void *user;
    wf_setup setup;
    wf_crew crew;      /* of one: whoever pushes is the one thread */
    wf_frames *frames; /* NULL: the job has no output */
    wf_gather_desc desc;
    wf_gather **gather; /* [end]: NULL before a field's first sample and after it is finished */
    int64_t next, end;  /* the first that is not finished; how many there are */
    size_t in_hand;     /* gathers */
    int64_t filled;     /* pixels that no sample reached */
    float *rgb;         /* [lines][width][3] of a field */
    float *alpha;       /* [lines][width]; NULL: it is not gathered */
    float *line;        /* [3][width] */
    wf_raster raster;   /* the job's, whose fields have lines of their own */
    wf_nearest *flicker; /* of light that is handed over; NULL: it is not held */
};

/* ---- Life ---- */

static weft_status open_output(weft_fields *f, int64_t frames, weft_error *err) {
    if (!f->job->output) return WEFT_OK;
    weft_status status = wf_setup_output(f->job, &f->setup, err);
    if (status) return status;
    f->setup.end_frame = f->crew.total = frames;
    wf_setup_tell_frames(&f->setup);
    status = wf_frames_new(&f->crew, &f->setup, 2, &f->frames, err);
    return status ? status : wf_frames_open(f->frames, err);
}

/* Of light, for whoever is handed fields; what is written has its own. */
static weft_status hold_flicker(weft_fields *f, weft_error *err) {
    wf_nearest_desc desc = wf_setup_flicker_of_light(f->job, &f->raster);
    desc.fields = 1;
    return desc.held && f->fn ? wf_nearest_new(&f->crew, &desc, &f->flicker, err) : WEFT_OK;
}

static weft_status make_buffers(weft_fields *f, weft_error *err) {
    size_t row = 3 * (size_t)f->job->raster.width_px;
    f->gather = calloc((size_t)f->end + 1, sizeof(wf_gather *));
    f->rgb = malloc(row * (size_t)f->job->raster.lines * sizeof *f->rgb);
    f->line = malloc(row * sizeof *f->line);
    if (f->desc.alpha)
        f->alpha = malloc(row / 3 * (size_t)f->job->raster.lines * sizeof(float));
    return f->gather && f->rgb && f->line && (f->alpha || !f->desc.alpha)
               ? WEFT_OK
               : wf_fail(err, WEFT_NO_MEMORY, "no memory for fields");
}

weft_status weft_fields_new(weft_job *job, int64_t frames, weft_field_fn *fn, void *user,
                            weft_fields **out, weft_error *err) {
    if (frames < 1 || frames > 1 << 24)
        return wf_fail(err, WEFT_USAGE, "there must be from 1 to %d frames", 1 << 24);
    if (job->cadence != WF_CADENCE_NONE)
        return wf_fail(err, WEFT_USAGE,
                       "--cadence is for subframes and scenes, not for samples that are handed "
                       "over, whose times count fields");
    if (job->dry_run)
        return wf_fail(err, WEFT_USAGE, "--dry-run is for weft_job_run: samples are pushed");
    weft_status status = wf_job_check_alpha(job, err);
    if (!status) status = wf_job_check_flicker(job, err);
    if (status) return status;
    wf_job_settle(job);
    weft_fields *f = calloc(1, sizeof *f);
    if (!f) return wf_fail(err, WEFT_NO_MEMORY, "no memory for fields");
    *f = (weft_fields){.job = job, .fn = fn, .user = user};
    f->desc = wf_setup_gather(job);
    f->raster = job->raster;
    f->raster.all_lines = false;
    f->end = frames * wf_raster_fields_per_frame(&job->raster);
    status = wf_crew_new(job, 1, &f->crew, err);
    if (!status) status = make_buffers(f, err);
    if (!status) status = hold_flicker(f, err);
    if (!status) status = open_output(f, frames, err);
    if (status) {
        weft_fields_free(f);
        return status;
    }
    *out = f;
    return WEFT_OK;
}

void weft_fields_free(weft_fields *f) {
    if (!f) return;
    for (int64_t n = 0; f->gather && n < f->end; n++) wf_gather_free(f->gather[n]);
    wf_frames_free(f->frames);
    wf_nearest_free(f->flicker);
    wf_setup_free(&f->setup);
    wf_crew_free(&f->crew);
    free(f->gather);
    free(f->rgb);
    free(f->alpha);
    free(f->line);
    free(f);
}

/* ---- Samples ---- */

static int lines_of(const weft_fields *f, int64_t field) {
    return wf_raster_field_lines(&f->job->raster, wf_raster_parity(&f->job->raster, field));
}

static weft_status begin_field(weft_fields *f, int64_t field, weft_error *err) {
    size_t bytes = wf_gather_bytes(&f->desc, lines_of(f, field));
    if (f->gather[field]) return WEFT_OK;
    if ((f->in_hand + 1) * bytes > f->job->max_memory_bytes)
        return wf_fail(err, WEFT_NO_MEMORY,
                       "%zu fields are in hand, and one more exceeds max-memory; say with "
                       "weft_fields_until which are done",
                       f->in_hand);
    f->gather[field] = wf_gather_new(&f->desc, field, 0, lines_of(f, field));
    if (!f->gather[field]) return wf_fail(err, WEFT_NO_MEMORY, "no memory for a field");
    f->in_hand++;
    return WEFT_OK;
}

/* In floats: GCC 12 fails to compile it for aarch64 in doubles. */
static void find_ends(const float *t, size_t count, double *low, double *high) {
    float least = t[0], most = t[0];
    for (size_t i = 1; i < count; i++) {
        least = fminf(least, t[i]);
        most = fmaxf(most, t[i]);
    }
    *low = (double)least;
    *high = (double)most;
}

static bool all_finite(const weft_samples *s) {
    const float *const arrays[] = {s->x,     s->y,    s->t,      s->red,
                                   s->green, s->blue, s->weight, s->alpha};
    bool finite = true;
    for (size_t n = 0; n < sizeof arrays / sizeof *arrays; n++)
        for (size_t i = 0; arrays[n] && i < s->count; i++)
            finite &= isfinite(arrays[n][i]) != 0;
    return finite;
}

static weft_status gather(weft_fields *f, const wf_samples *block, weft_error *err) {
    double low, high;
    int64_t first, last;
    find_ends(block->t, block->count, &low, &high);
    wf_gather_fields(&f->desc, block->field, low, high, &first, &last);
    if (first <= last && last >= 0 && first < f->next)
        return wf_fail(err, WEFT_USAGE,
                       "samples from %g field periods after field %" PRId64
                       " come late: field %" PRId64 " is finished",
                       low, block->field, first);
    for (int64_t n = first; n <= last && n < f->end; n++) {
        weft_status status = begin_field(f, n, err);
        if (status) return status;
        wf_gather_add(f->gather[n], block);
    }
    return WEFT_OK;
}

/* Where alpha is not written, what samples do not hide shows the background. rgb is
 * [3][count]. */
static void lay_over_background(const weft_job *job, wf_samples *block, float *rgb) {
    for (size_t c = 0; c < 3; c++) {
        float *to = rgb + c * block->count;
        for (size_t i = 0; i < block->count; i++)
            to[i] = block->rgb[c][i] + (1 - block->alpha[i]) * job->background[c];
        block->rgb[c] = to;
    }
}

weft_status weft_fields_push(weft_fields *f, const weft_samples *s, weft_error *err) {
    wf_samples block = {.count = s->count,
                        .x = s->x,
                        .y = s->y,
                        .t = s->t,
                        .field = s->field,
                        .rgb = {s->red, s->green, s->blue},
                        .weight = s->weight,
                        .alpha = s->alpha};
    if (!s->count) return WEFT_OK;
    if (!all_finite(s)) return wf_fail(err, WEFT_USAGE, "a sample is not finite");
    if (!s->alpha || !wf_job_shows_background(f->job)) return gather(f, &block, err);
    float *rgb = s->count > SIZE_MAX / 16 ? NULL : malloc(3 * s->count * sizeof *rgb);
    if (!rgb) return wf_fail(err, WEFT_NO_MEMORY, "no memory for samples");
    lay_over_background(f->job, &block, rgb);
    weft_status status = gather(f, &block, err);
    free(rgb);
    return status;
}

/* A row of a tile at a time. */
weft_status weft_fields_push_tile(weft_fields *f, const weft_tile *tile, weft_error *err) {
    size_t width = tile->width > 0 ? (size_t)tile->width : 0;
    float *v = malloc((6 * width + 1) * sizeof *v);
    weft_status status = v ? WEFT_OK : wf_fail(err, WEFT_NO_MEMORY, "no memory for a tile");
    double dx = (tile->x1 - tile->x0) / tile->width, dy = (tile->y1 - tile->y0) / tile->height;
    for (int j = 0; !status && j < tile->height; j++) {
        const float *row = tile->rgb + 3 * width * (size_t)j;
        for (size_t i = 0; i < width; i++) {
            v[i] = (float)(tile->x0 + ((double)i + 0.5) * dx);
            v[width + i] = (float)(tile->y0 + (j + 0.5) * dy);
            v[2 * width + i] = (float)tile->t;
            for (size_t c = 0; c < 3; c++) v[(3 + c) * width + i] = row[3 * i + c];
        }
        const weft_samples samples = {
            width,         v,
            v + width,     v + 2 * width,
            tile->field,   v + 3 * width,
            v + 4 * width, v + 5 * width,
            NULL,          tile->alpha ? tile->alpha + width * (size_t)j : NULL};
        status = weft_fields_push(f, &samples, err);
    }
    free(v);
    return status;
}

/* ---- Fields ---- */

/* Where alpha of a line is gathered; where flicker is held, [lines of the frame][width]. */
static float *alpha_line(const weft_fields *f, int line) {
    return f->alpha ? f->alpha + (size_t)line * (size_t)f->job->raster.width_px : NULL;
}

/* A line for whoever is handed the field. */
static void keep_line(const weft_fields *f, int line) {
    int width = f->job->raster.width_px;
    float *out = f->rgb + 3 * (size_t)line * (size_t)width;
    for (int i = 0; i < width; i++)
        for (int c = 0; c < 3; c++) out[3 * i + c] = f->line[c * width + i];
}

/* Takes a line through color into its frame. */
static void write_line(const weft_fields *f, int64_t field, int line) {
    size_t width = (size_t)f->job->raster.width_px;
    float *rgb[3];
    if (!f->frames) return;
    wf_frames_place(f->frames, f->crew.workers, field, line, rgb);
    for (size_t c = 0; c < 3; c++) memcpy(rgb[c], f->line + c * width, width * sizeof(float));
    float *alpha = wf_frames_alpha(f->frames, f->crew.workers, field, line);
    if (alpha) memcpy(alpha, alpha_line(f, line), width * sizeof *alpha);
    wf_frames_line(f->frames, f->crew.workers, field, line);
}

static void line_planes(const weft_fields *f, float *rgb[3]) {
    size_t width = (size_t)f->job->raster.width_px;
    for (size_t c = 0; c < 3; c++) rgb[c] = f->line + c * width;
}

static weft_status finish_lines(weft_fields *f, int64_t field, weft_error *err) {
    float *rgb[3];
    weft_status status = WEFT_OK;
    line_planes(f, rgb);
    for (int l = 0; !status && l < lines_of(f, field); l++) {
        const wf_gathered_line line = {.job = f->job,
                                       .gather = f->gather[field],
                                       .field = field,
                                       .line = l,
                                       .called = l,
                                       .remedy = "set on-empty to nearest",
                                       .alpha = alpha_line(f, l)};
        status = wf_gathered_finish(&line, rgb, &f->filled, err);
        if (status) return status;
        write_line(f, field, l);
        if (f->flicker)
            wf_nearest_put(f->flicker, f->crew.workers, field, l, rgb, alpha_line(f, l));
        else
            keep_line(f, l);
    }
    return f->frames ? wf_frames_field(f->frames, field, err) : WEFT_OK;
}

/* The field's own lines of the nearest picture, for whoever is handed it. */
static weft_status take_nearest(weft_fields *f, int64_t field, weft_error *err) {
    float *rgb[3];
    int parity = wf_raster_parity(&f->raster, field), step = wf_raster_line_step(&f->raster);
    weft_status status = wf_nearest_solve(f->flicker, field, err);
    line_planes(f, rgb);
    for (int l = 0; !status && l < wf_raster_field_lines(&f->raster, parity); l++) {
        wf_nearest_take(f->flicker, f->crew.workers, field, parity + l * step, rgb,
                        alpha_line(f, l));
        keep_line(f, l);
    }
    return status;
}

static void hand_over(const weft_fields *f) {
    const wf_raster *r = &f->raster;
    int64_t n = f->next;
    int parity = wf_raster_parity(r, n);
    const weft_field field = {.index = n,
                              .first_line = parity,
                              .line_step = wf_raster_line_step(r),
                              .lines = wf_raster_field_lines(r, parity),
                              .width_px = r->width_px,
                              .rgb = f->rgb,
                              .alpha = f->alpha};
    f->fn(&field, f->user);
}

static weft_status finish_field(weft_fields *f, weft_error *err) {
    int64_t n = f->next;
    int per_frame = wf_raster_fields_per_frame(&f->raster);
    weft_status status = begin_field(f, n, err);
    if (!status) status = finish_lines(f, n, err);
    if (!status && f->flicker) status = take_nearest(f, n, err);
    if (status) return status;
    if (f->fn) hand_over(f);
    wf_gather_free(f->gather[n]);
    f->gather[n] = NULL;
    f->in_hand--;
    f->next++;
    bool whole = f->frames && n % per_frame == per_frame - 1;
    return whole ? wf_frames_write(f->frames, n / per_frame, err) : WEFT_OK;
}

/* A field's window may hold samples before the instant of `field`: then it is not done. */
static bool is_done(const weft_fields *f, int64_t n, int64_t field) {
    int64_t instant = wf_raster_instant(&f->job->raster, n);
    int64_t limit = wf_raster_instant(&f->job->raster, field);
    double skew = wf_ratio_given(f->desc.skew) ? wf_ratio_value(f->desc.skew) : 0;
    double after = 1 - wf_position_anchor(f->desc.position);
    double end = after * wf_ratio_value(f->desc.width) + skew;
    return (double)instant + end <= (double)limit && instant < limit;
}

weft_status weft_fields_until(weft_fields *f, int64_t field, weft_error *err) {
    weft_status status = WEFT_OK;
    while (!status && f->next < f->end && is_done(f, f->next, field))
        status = finish_field(f, err);
    return status;
}

weft_status weft_fields_finish(weft_fields *f, weft_error *err) {
    weft_status status = WEFT_OK;
    while (!status && f->next < f->end) status = finish_field(f, err);
    return status || !f->frames ? status : wf_frames_commit(f->frames, err);
}
