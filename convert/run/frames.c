#include "convert/run/frames.h"

#include <stdatomic.h>
#include <stdlib.h>

/* The planes of a frame. */
typedef struct room {
    void *plane[3];
    _Atomic int64_t pixels, touched, outside; /* what r103 has done to its lines */
} room;

struct wf_frames {
    weft_job *job;
    const wf_setup *setup;
    wf_sink *sink; /* NULL: not open */
    room *rooms;   /* frame n in rooms[n % count] */
    int count;
    size_t stride[3]; /* samples */
    int64_t done, total;
    double write_s, started_s;
    wf_legal_counts legal; /* of the frames written */
    int64_t worst_outside; /* pixels of a frame that r103 left so: the most of all frames */
};

/* ---- Life ---- */

static size_t sample_bytes(const wf_setup *s) {
    return s->output.kind->layout == WF_LINEAR ? sizeof(float) : sizeof(uint16_t);
}

static size_t stride_of(const wf_setup *s, int c) {
    size_t width = (size_t)s->output_options.raster->width_px;
    return c && s->output_options.subsampled ? width / 2 : width;
}

static size_t plane_bytes(const weft_job *job, const wf_setup *s, int c) {
    return stride_of(s, c) * (size_t)job->raster.lines * sample_bytes(s);
}

/* Fields may be finished in any order, and the first may belong to a frame begun before. */
static int rooms_for(const weft_job *job, int fields) {
    int per_frame = wf_raster_fields_per_frame(&job->raster);
    return (fields + per_frame - 1) / per_frame + 1;
}

size_t wf_frames_bytes(const weft_job *job, const wf_setup *s, int fields) {
    size_t bytes = 0;
    for (int c = 0; c < 3; c++) bytes += plane_bytes(job, s, c);
    return bytes * (size_t)rooms_for(job, fields);
}

weft_status wf_frames_new(weft_job *job, const wf_setup *setup, int fields, wf_frames **out,
                          weft_error *err) {
    wf_frames *f = calloc(1, sizeof *f);
    if (!f) return wf_fail(err, WEFT_NO_MEMORY, "no memory for frames");
    *f = (wf_frames){.job = job, .setup = setup, .count = rooms_for(job, fields)};
    f->total = setup->end_frame - setup->first_frame;
    f->started_s = wf_now_s();
    f->rooms = calloc((size_t)f->count, sizeof *f->rooms);
    bool good = f->rooms;
    for (int c = 0; c < 3; c++) f->stride[c] = stride_of(setup, c);
    for (int n = 0; good && n < f->count; n++)
        for (int c = 0; c < 3; c++) {
            f->rooms[n].plane[c] = malloc(plane_bytes(job, setup, c));
            good = good && f->rooms[n].plane[c];
        }
    if (!good) {
        wf_frames_free(f);
        return wf_fail(err, WEFT_NO_MEMORY, "no memory for a frame");
    }
    *out = f;
    return WEFT_OK;
}

void wf_frames_free(wf_frames *f) {
    if (!f) return;
    if (f->sink) f->setup->output.ops->abandon(f->sink);
    for (int n = 0; f->rooms && n < f->count; n++)
        for (int c = 0; c < 3; c++) free(f->rooms[n].plane[c]);
    free(f->rooms);
    free(f);
}

weft_status wf_finisher_new(const wf_frames *f, wf_finisher *out, weft_error *err) {
    size_t width = (size_t)f->job->raster.width_px;
    *out = (wf_finisher){
        .line = malloc(3 * width * sizeof *out->line),
        .code_scratch = malloc((1 + wf_encode_scratch(&f->setup->encoding)) * sizeof(float))};
    if (out->line && out->code_scratch) return WEFT_OK;
    return wf_fail(err, WEFT_NO_MEMORY, "no memory for the buffers of a thread");
}

void wf_finisher_free(wf_finisher *finisher) {
    free(finisher->line);
    free(finisher->code_scratch);
}

/* ---- Lines ---- */

static int line_in_frame(const wf_frames *f, int64_t field, int line) {
    const wf_raster *raster = &f->job->raster;
    return wf_raster_parity(raster, field) + line * wf_raster_line_step(raster);
}

static room *room_of(const wf_frames *f, int64_t field) {
    return &f->rooms[field / wf_raster_fields_per_frame(&f->job->raster) % f->count];
}

static void *frame_line(const wf_frames *f, int64_t field, int c, int line) {
    const room *frame = room_of(f, field);
    size_t at = (size_t)line_in_frame(f, field, line) * f->stride[c];
    return (char *)frame->plane[c] + at * sample_bytes(f->setup);
}

void wf_frames_room(const wf_frames *f, const wf_finisher *finisher, int64_t field, int line,
                    float *rgb[3]) {
    bool linear = f->setup->output.kind->layout == WF_LINEAR;
    for (int c = 0; c < 3; c++)
        rgb[c] = linear ? frame_line(f, field, c, line)
                        : finisher->line + (size_t)c * (size_t)f->job->raster.width_px;
}

void wf_frames_line(const wf_frames *f, wf_finisher *finisher, int64_t field, int line) {
    const wf_setup *s = f->setup;
    float *rgb[3];
    uint16_t *code[3];
    double start = wf_now_s();
    wf_frames_room(f, finisher, field, line, rgb);
    for (int c = 0; c < 3; c++) code[c] = frame_line(f, field, c, line);
    if (s->transform.apply)
        s->transform.apply(s->transform.self, rgb[0], rgb[1], rgb[2],
                           (size_t)f->job->raster.width_px);
    if (s->output.kind->layout != WF_LINEAR) {
        wf_legal_counts legal = {0};
        wf_encoding encoding = s->encoding;
        encoding.line = line_in_frame(f, field, line);
        encoding.legal = &legal;
        wf_encode_line(&encoding, rgb, finisher->code_scratch, code);
        room *frame = room_of(f, field);
        frame->pixels += legal.pixels;
        frame->touched += legal.touched;
        frame->outside += legal.outside;
    }
    finisher->color_s += wf_now_s() - start;
}

/* ---- Frames ---- */

weft_status wf_frames_open(wf_frames *f, weft_error *err) {
    return f->setup->output.ops->open(&f->setup->output_options, &f->sink, err);
}

static void tell_progress(const wf_frames *f) {
    if (!f->job->progress) return;
    weft_progress progress = {f->done, f->total, wf_now_s() - f->started_s,
                              wf_command_name(f->job->command)};
    f->job->progress(&progress, f->job->progress_user);
}

/* The planes are those of a later frame after this. */
static void count_legal(wf_frames *f, room *frame) {
    int64_t outside = atomic_exchange(&frame->outside, 0);
    f->legal.pixels += atomic_exchange(&frame->pixels, 0);
    f->legal.touched += atomic_exchange(&frame->touched, 0);
    f->legal.outside += outside;
    if (outside > f->worst_outside) f->worst_outside = outside;
}

weft_status wf_frames_write(wf_frames *f, int64_t index, weft_error *err) {
    wf_frame frame = {.index = index};
    for (int c = 0; c < 3; c++) {
        frame.plane[c] = f->rooms[index % f->count].plane[c];
        frame.stride[c] = f->stride[c];
    }
    count_legal(f, &f->rooms[index % f->count]);
    double start = wf_now_s();
    weft_status status = f->setup->output.ops->write(f->sink, &frame, err);
    f->write_s += wf_now_s() - start;
    f->done++;
    tell_progress(f);
    return status;
}

weft_status wf_frames_commit(wf_frames *f, weft_error *err) {
    double start = wf_now_s();
    weft_status status = f->setup->output.ops->commit(f->sink, err);
    f->sink = NULL;
    f->write_s += wf_now_s() - start;
    return status;
}

void wf_frames_tell_legal(const wf_frames *f, wf_report_legal *legal) {
    double pixels = (double)f->job->raster.width_px * f->job->raster.lines;
    legal->counts = f->legal;
    legal->worst_share = (double)f->worst_outside / pixels;
}

int64_t wf_frames_done(const wf_frames *f) {
    return f->done;
}

double wf_frames_write_s(const wf_frames *f) {
    return f->write_s;
}
