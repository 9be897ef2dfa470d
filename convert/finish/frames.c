/* Lines into frames, and frames into the sink. */
#include "convert/finish/frames.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

#include "color/codes/r103.h"
#include "convert/base/clock.h"
#include "convert/finish/key.h"

enum { ALPHA = 3 }; /* the plane of it */

/* The planes of a frame, and what r103 has done to its lines so far. */
typedef struct slot {
    void *plane[4]; /* NULL: there is none */
    void *key;      /* NULL: there is none */
    _Atomic int64_t pixels, touched, outside, clipped;
} slot;

/* What a worker finishes lines with. */
typedef struct finisher {
    float *line;    /* [4][width]: one line of scene-linear and alpha, then of R'G'B' and K */
    float *scratch; /* wf_encode_scratch */
} finisher;

struct wf_frames {
    wf_crew *crew;
    const wf_setup *setup;
    const wf_raster *raster; /* as fields are made */
    wf_nearest *flicker;     /* NULL: it is not held */
    int64_t field;           /* whose lines are taken from there */
    wf_outputs outputs;
    slot *slots; /* frame n is in slots[n % count] */
    int count;
    finisher *finishers; /* [threads] */
    int planes;
    size_t stride[4]; /* samples */
    wf_aside writing; /* of frame `written`, whose key is written_key */
    wf_frame written;
    const void *written_key;
    double write_s;
    wf_legal_counts legal; /* of the frames written */
    int64_t clipped;       /* pixels of them whose straight fill was above 1 */
    int64_t worst_outside; /* pixels of a frame that r103 left so: the most of all frames */
};

/* ---- Life ---- */

static bool is_linear(const wf_setup *s) {
    return s->output.kind->layout == WF_LINEAR;
}

static size_t sample_bytes(const wf_setup *s) {
    return is_linear(s) ? sizeof(float) : sizeof(uint16_t);
}

static size_t stride_of(const wf_setup *s, int c) {
    size_t width = (size_t)s->output_options.raster->width_px;
    return c && c != ALPHA && s->output_options.subsampled ? width / 2 : width;
}

static int planes_of(const wf_setup *s) {
    return s->output_options.alpha ? 4 : 3;
}

static size_t plane_bytes(const weft_job *job, const wf_setup *s, int c) {
    return stride_of(s, c) * (size_t)job->raster.lines * sample_bytes(s);
}

static size_t key_bytes(const weft_job *job, const wf_setup *s) {
    return (size_t)job->raster.width_px * (size_t)job->raster.lines * wf_key_sample_bytes(s);
}

/* Fields may be finished in any order, the first may belong to a frame begun before, and the
 * frame before that may still be written. */
static int slots_for(const weft_job *job, int fields) {
    int per_frame = wf_raster_fields_per_frame(&job->raster);
    return (fields + per_frame - 1) / per_frame + 2;
}

size_t wf_frames_bytes(const weft_job *job, const wf_setup *s, int threads, int fields) {
    size_t bytes = key_bytes(job, s);
    for (int c = 0; c < planes_of(s); c++) bytes += plane_bytes(job, s, c);
    wf_nearest_desc flicker = s->flicker;
    flicker.fields = fields;
    return bytes * (size_t)slots_for(job, fields) + wf_nearest_bytes(&flicker, threads);
}

static bool make_planes(wf_frames *f) {
    const weft_job *job = f->crew->job;
    f->slots = calloc((size_t)f->count, sizeof *f->slots);
    bool good = f->slots;
    for (int c = 0; c < f->planes; c++) f->stride[c] = stride_of(f->setup, c);
    size_t key = key_bytes(job, f->setup);
    for (int n = 0; good && n < f->count; n++) {
        for (int c = 0; c < f->planes; c++) {
            f->slots[n].plane[c] = malloc(plane_bytes(job, f->setup, c));
            good = good && f->slots[n].plane[c];
        }
        if (key) f->slots[n].key = malloc(key);
        good = good && (!key || f->slots[n].key);
    }
    return good;
}

static bool make_finishers(wf_frames *f) {
    size_t width = (size_t)f->raster->width_px;
    f->finishers = calloc((size_t)f->crew->threads, sizeof *f->finishers);
    bool good = f->finishers;
    for (int t = 0; good && t < f->crew->threads; t++) {
        finisher *own = &f->finishers[t];
        own->line = malloc((ALPHA + 1) * width * sizeof *own->line);
        own->scratch = malloc((1 + wf_encode_scratch(&f->setup->encoding)) * sizeof(float));
        good = own->line && own->scratch;
    }
    return good;
}

weft_status wf_frames_new(wf_crew *crew, const wf_setup *setup, int fields, wf_frames **out,
                          weft_error *err) {
    wf_frames *f = calloc(1, sizeof *f);
    if (!f) return wf_fail(err, WEFT_NO_MEMORY, "no memory for frames");
    *f = (wf_frames){.crew = crew, .setup = setup, .raster = &setup->made};
    f->count = slots_for(crew->job, fields);
    f->planes = planes_of(setup);
    if (!make_planes(f) || !make_finishers(f)) {
        wf_frames_free(f);
        return wf_fail(err, WEFT_NO_MEMORY, "no memory for a frame");
    }
    wf_nearest_desc flicker = setup->flicker;
    flicker.fields = fields;
    weft_status status =
        flicker.held ? wf_nearest_new(crew, &flicker, &f->flicker, err) : WEFT_OK;
    if (status) {
        wf_frames_free(f);
        return status;
    }
    *out = f;
    return WEFT_OK;
}

void wf_frames_free(wf_frames *f) {
    if (!f) return;
    wf_aside_end(&f->writing, NULL);
    wf_outputs_close(f->setup, &f->outputs);
    wf_nearest_free(f->flicker);
    for (int n = 0; f->slots && n < f->count; n++) {
        for (int c = 0; c < 4; c++) free(f->slots[n].plane[c]);
        free(f->slots[n].key);
    }
    for (int t = 0; f->finishers && t < f->crew->threads; t++) {
        free(f->finishers[t].line);
        free(f->finishers[t].scratch);
    }
    free(f->slots);
    free(f->finishers);
    free(f);
}

/* ---- Lines ---- */

static int line_in_frame(const wf_frames *f, int64_t field, int line) {
    return wf_raster_parity(f->raster, field) + line * wf_raster_line_step(f->raster);
}

static slot *slot_of(const wf_frames *f, int64_t field) {
    return &f->slots[field / wf_raster_fields_per_frame(f->raster) % f->count];
}

static void *frame_line(const wf_frames *f, int64_t field, int c, int line) {
    const slot *frame = slot_of(f, field);
    size_t at = (size_t)line_in_frame(f, field, line) * f->stride[c];
    return (char *)frame->plane[c] + at * sample_bytes(f->setup);
}

static float *worker_line(const wf_frames *f, const wf_worker *worker, int c) {
    return f->finishers[worker->number].line + (size_t)c * (size_t)f->raster->width_px;
}

/* Light that is written as it is goes into its frame at once. */
static void place(const wf_frames *f, const wf_worker *worker, int64_t field, int line,
                  float *rgb[3]) {
    for (int c = 0; c < 3; c++)
        rgb[c] =
            is_linear(f->setup) ? frame_line(f, field, c, line) : worker_line(f, worker, c);
}

static float *place_alpha(const wf_frames *f, const wf_worker *worker, int64_t field,
                          int line) {
    if (!wf_job_writes_alpha(f->crew->job)) return NULL;
    if (is_linear(f->setup) && f->planes > ALPHA) return frame_line(f, field, ALPHA, line);
    return worker_line(f, worker, ALPHA);
}

/* Where flicker is held, all lines of the frame come first. */
void wf_frames_place(const wf_frames *f, const wf_worker *worker, int64_t field, int line,
                     float *rgb[3]) {
    if (!f->flicker) place(f, worker, field, line, rgb);
    for (int c = 0; f->flicker && c < 3; c++) rgb[c] = worker_line(f, worker, c);
}

float *wf_frames_alpha(const wf_frames *f, const wf_worker *worker, int64_t field, int line) {
    if (!f->flicker) return place_alpha(f, worker, field, line);
    return wf_job_writes_alpha(f->crew->job) ? worker_line(f, worker, ALPHA) : NULL;
}

/* R'G'B' to codes: chroma, legal colors and quantizing. */
static void encode(wf_frames *f, const wf_worker *worker, int64_t field, int line,
                   float *const rgb[3]) {
    slot *frame = slot_of(f, field);
    wf_legal_counts legal = {0};
    wf_encoding encoding = f->setup->encoding;
    uint16_t *code[3];
    for (int c = 0; c < 3; c++) code[c] = frame_line(f, field, c, line);
    encoding.line = line_in_frame(f, field, line);
    encoding.legal = &legal;
    wf_encode_line(&encoding, rgb, f->finishers[worker->number].scratch, code);
    frame->pixels += legal.pixels;
    frame->touched += legal.touched;
    frame->outside += legal.outside;
}

/* Out of gamut R'G'B' is far below black, where saturation cannot be compressed to: under r103
 * it ends at the limit. */
static void clip_below(const wf_setup *s, float *const rgb[3], size_t width) {
    const float low = (float)WF_R103_LOW;
    if (is_linear(s) || s->encoding.legalize != WF_LEGAL_R103) return;
    for (int c = 0; c < 3; c++)
        for (size_t x = 0; x < width; x++) rgb[c][x] = rgb[c][x] > low ? rgb[c][x] : low;
}

/* Light that is straight: of what lies there, whatever part of the pixel it covers. */
static void divide_by_alpha(float *const rgb[3], const float *alpha, size_t width) {
    for (int c = 0; c < 3; c++)
        for (size_t x = 0; x < width; x++)
            rgb[c][x] = alpha[x] > 1e-6f ? rgb[c][x] / alpha[x] : 0;
}

/* A line of the key, where there is one. */
static void put_key(const wf_frames *f, int64_t field, int line, const float *k) {
    size_t width = (size_t)f->raster->width_px, sample = wf_key_sample_bytes(f->setup);
    size_t at = (size_t)line_in_frame(f, field, line) * width;
    if (sample) wf_key_put(f->setup, k, width, (char *)slot_of(f, field)->key + at * sample);
}

/* Encoded color and alpha as the law of fill and key has them, and the codes of alpha, which
 * are of full range. */
static void finish_alpha(wf_frames *f, int64_t field, int line, float *const rgba[4],
                         size_t width) {
    const wf_setup *s = f->setup;
    if (is_linear(s)) return;
    wf_key_line(s->key_law, rgba, width);
    if (s->output_options.straight && s->key_law == WF_KEY_ENCODED)
        slot_of(f, field)->clipped += (int64_t)wf_key_straighten(rgba, width);
    if (f->planes <= ALPHA) return;
    int most = (1 << s->output_options.bits) - 1;
    uint16_t *code = frame_line(f, field, ALPHA, line);
    for (size_t x = 0; x < width; x++) code[x] = (uint16_t)lrintf(rgba[ALPHA][x] * (float)most);
}

/* Light to what is written of it, before codes. */
static void color_line(const wf_frames *f, float *const rgb[3], const float *alpha) {
    const wf_transform *transform = &f->setup->transform;
    size_t width = (size_t)f->raster->width_px;
    bool divided = f->setup->output_options.straight && f->setup->key_law == WF_KEY_LIGHT;
    if (alpha && divided) divide_by_alpha(rgb, alpha, width);
    if (!transform->apply) return;
    transform->apply(transform->self, rgb[0], rgb[1], rgb[2], width);
    clip_below(f->setup, rgb, width);
}

static void code_line(wf_frames *f, const wf_worker *worker, int64_t field, int line,
                      float *const rgb[3], float *alpha) {
    size_t width = (size_t)f->raster->width_px;
    if (alpha) finish_alpha(f, field, line, (float *[]){rgb[0], rgb[1], rgb[2], alpha}, width);
    if (alpha) put_key(f, field, line, alpha);
    if (!is_linear(f->setup)) encode(f, worker, field, line, rgb);
}

void wf_frames_line(wf_frames *f, wf_worker *worker, int64_t field, int line) {
    float *rgb[3];
    double start = wf_now_s();
    wf_frames_place(f, worker, field, line, rgb);
    float *alpha = wf_frames_alpha(f, worker, field, line);
    if (!alpha || !f->flicker) color_line(f, rgb, alpha);
    if (f->flicker)
        wf_nearest_put(f->flicker, worker, field, line, rgb, alpha);
    else
        code_line(f, worker, field, line, rgb, alpha);
    worker->color_s += wf_now_s() - start;
}

/* Line `line` of the nearest picture's own. With alpha it is light, which has its colors to
 * come. */
static void take_line(void *user, wf_worker *worker, int line) {
    wf_frames *f = user;
    float *rgb[3];
    double start = wf_now_s();
    place(f, worker, f->field, line, rgb);
    float *alpha = place_alpha(f, worker, f->field, line);
    wf_nearest_take(f->flicker, worker, f->field, line_in_frame(f, f->field, line), rgb, alpha);
    if (alpha) color_line(f, rgb, alpha);
    code_line(f, worker, f->field, line, rgb, alpha);
    worker->color_s += wf_now_s() - start;
}

weft_status wf_frames_field(wf_frames *f, int64_t field, weft_error *err) {
    if (!f->flicker) return WEFT_OK;
    weft_status status = wf_nearest_solve(f->flicker, field, err);
    if (status) return status;
    f->field = field;
    wf_crew_each(f->crew, wf_raster_field_lines(f->raster, wf_raster_parity(f->raster, field)),
                 4, take_line, f);
    return wf_crew_status(f->crew, err);
}

/* ---- Frames ---- */

weft_status wf_frames_open(wf_frames *f, weft_error *err) {
    return wf_outputs_open(f->setup, &f->outputs, err);
}

/* The planes are those of a later frame after this. */
static void count_legal(wf_frames *f, slot *frame) {
    int64_t outside = atomic_exchange(&frame->outside, 0);
    f->legal.pixels += atomic_exchange(&frame->pixels, 0);
    f->legal.touched += atomic_exchange(&frame->touched, 0);
    f->legal.outside += outside;
    f->clipped += atomic_exchange(&frame->clipped, 0);
    if (outside > f->worst_outside) f->worst_outside = outside;
}

static weft_status write_frame(void *user, weft_error *err) {
    wf_frames *f = user;
    double start = wf_now_s();
    weft_status status =
        wf_outputs_write(f->setup, &f->outputs, &f->written, f->written_key, err);
    f->write_s += wf_now_s() - start;
    return status;
}

weft_status wf_frames_write(wf_frames *f, int64_t index, weft_error *err) {
    slot *from = &f->slots[index % f->count];
    weft_status status = wf_aside_end(&f->writing, err);
    if (status) return status;
    f->written = (wf_frame){.index = index};
    f->written_key = from->key;
    for (int c = 0; c < f->planes; c++) {
        f->written.plane[c] = from->plane[c];
        f->written.stride[c] = f->stride[c];
    }
    count_legal(f, from);
    wf_aside_begin(&f->writing, write_frame, f);
    wf_crew_step(f->crew);
    return WEFT_OK;
}

weft_status wf_frames_commit(wf_frames *f, weft_error *err) {
    weft_status status = wf_aside_end(&f->writing, err);
    if (status) return status;
    double start = wf_now_s();
    status = wf_outputs_commit(f->setup, &f->outputs, err);
    f->write_s += wf_now_s() - start;
    return status;
}

static void tell_alpha(const wf_frames *f, double pixels, wf_report *report) {
    const wf_setup *s = f->setup;
    if (!wf_job_writes_alpha(f->crew->job)) return;
    report->key = s->key.kind ? s->key.kind->name : NULL;
    report->fill = s->output_options.straight ? "straight" : "premultiplied";
    report->key_law = s->key_law == WF_KEY_ENCODED ? "encoded" : "light";
    if (f->crew->done)
        report->fill_clipped_share = (double)f->clipped / pixels / (double)f->crew->done;
}

void wf_frames_tell(wf_frames *f, wf_report *report) {
    wf_aside_end(&f->writing, NULL); /* of a run that was canceled or failed */
    double pixels = (double)f->raster->width_px * f->raster->lines;
    report->write_s = f->write_s;
    report->legal.counts = f->legal;
    report->legal.worst_share = (double)f->worst_outside / pixels;
    tell_alpha(f, pixels, report);
    if (f->flicker) wf_nearest_tell(f->flicker, report);
}

/* ---- Which frames ---- */

static bool present(const weft_job *job, const wf_setup *s, int64_t file) {
    return wf_output_present(s->output.kind, job->output, file) &&
           (!s->key.kind || wf_output_present(s->key.kind, job->key, file));
}

static bool is_there(const weft_job *job, const wf_setup *s, int64_t frame) {
    int files = wf_output_files(&s->output_options);
    for (int n = 0; n < files; n++)
        if (!present(job, s, frame * files + n)) return false;
    return true;
}

bool wf_frames_next(const weft_job *job, const wf_setup *s, int64_t *first, int64_t *end) {
    bool leave_out = job->resume && s->output.kind->sequence;
    while (leave_out && *first < s->end_frame && is_there(job, s, *first)) ++*first;
    *end = leave_out && *first < s->end_frame ? *first + 1 : s->end_frame;
    while (leave_out && *end < s->end_frame && !is_there(job, s, *end)) ++*end;
    return *first < s->end_frame;
}

bool wf_frames_all_there(const weft_job *job, const wf_setup *s) {
    return job->resume && !s->output.kind->sequence && present(job, s, -1);
}
