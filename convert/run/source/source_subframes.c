/* A sequence of subframes as a source. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "convert/read/rate.h"
#include "convert/run/source/fitting.h"
#include "convert/run/time/picture_rate.h"
#include "convert/run/time/planned.h"
#include "convert/run/sum/pictures.h"
#include "convert/run/source/refined.h"
#include "convert/run/source/subframe_check.h"
#include "convert/run/time/timecode_start.h"

/* run->source; the files are setup.sequence. */
typedef struct subframes {
    wf_source_options options;
    wf_first_subframe first; /* that is there */
    wf_shown shown;
    wf_refined refined;   /* units: of files that exist in part; none: all are whole */
    wf_rational *edges;   /* of the times that pictures are shown at; NULL: they have a rate */
    wf_rational *missing; /* numbers that fields of this chunk need and that have no file */
    size_t missing_count;
    wf_resampler *resampler;
    int64_t end_field; /* of all frames, whatever the chunk */
} subframes;

static weft_status takes(const weft_job *job, bool *takes, weft_error *err) {
    (void)err;
    *takes = job->command == WF_CONVERT;
    return WEFT_OK;
}

static void close_input(wf_run *run) {
    subframes *s = run->source;
    if (!s) return;
    wf_resampler_free(s->resampler);
    wf_shown_free(&s->shown);
    wf_refined_free(&s->refined);
    free(s->edges);
    free(s->missing);
    free(s);
    run->source = NULL;
}

/* ---- Input ---- */

static const wf_subframe_ref *first_present(const wf_sequence *sequence) {
    for (size_t k = 0; k < sequence->count; k++)
        if (sequence->refs[k].path) return &sequence->refs[k];
    return NULL;
}

/* A configuration's scene_linear role stands for light of which the files say nothing. */
static void look_at_colors(wf_run *run, const char *path) {
    const subframes *s = run->source;
    const wf_file_colors *colors = &s->first.colors;
    if (*colors->warning) wf_job_warn(run->job, "%s: %s", path, colors->warning);
    if (colors->primaries_said || colors->decoding.encoded)
        run->setup.scene_primaries = &colors->primaries;
}

static weft_status look_at_first(wf_run *run, const wf_subframe_ref *ref, weft_error *err) {
    subframes *s = run->source;
    wf_subframe *subframe;
    weft_status status = wf_subframe_open(ref->path, ref->part, &s->options, &subframe, err);
    if (status) return status;
    s->first = wf_first_subframe_of(subframe);
    wf_subframe_take(subframe, &run->report->taken);
    if (*s->first.pick.also)
        wf_job_warn(run->job,
                    "%s: the picture is '%s'; '%s' is named as the beauty too, and --layer or "
                    "--part takes it",
                    ref->path, *s->first.pick.layer ? s->first.pick.layer : s->first.part_name,
                    s->first.pick.also);
    wf_subframe_close(subframe);
    if (!run->job->from) look_at_colors(run, ref->path);
    return WEFT_OK;
}

static weft_status find_input(wf_run *run, weft_error *err) {
    const weft_job *job = run->job;
    wf_sequence *sequence = &run->setup.sequence;
    subframes *s = run->source;
    weft_status status =
        wf_sequence_expand(job->inputs, job->input_count, job->frames, sequence, err);
    if (status) return status;
    const wf_subframe_ref *ref = first_present(sequence);
    if (!ref)
        return wf_fail(err, WEFT_FAILED, "%s: no subframe of the selection exists",
                       job->inputs[0]);
    s->options = (wf_source_options){
        .layer = job->layer,
        .part = job->part,
        .want_alpha = (wf_job_shows_background(job) || wf_job_writes_alpha(job)) &&
                      job->alpha != WF_ALPHA_IGNORED,
        .alpha = job->alpha,
        .to_light = !job->from,
        .nan_fix = job->nan_fix,
        .max_memory_bytes = job->max_memory_bytes,
    };
    return look_at_first(run, ref, err);
}

static weft_status open_input(wf_run *run, weft_error *err) {
    run->setup.decodes = true;
    run->source = calloc(1, sizeof(subframes));
    return run->source ? find_input(run, err)
                       : wf_fail(err, WEFT_NO_MEMORY, "no memory for the job");
}

/* --from counts for all files, whatever they say. */
static void settle_decoding(wf_run *run) {
    subframes *s = run->source;
    const wf_transform *decode = &run->setup.decode;
    if (!run->job->from) return;
    s->options.to_light = decode->apply;
    s->options.decode = decode;
    wf_setup_take_from(run->job, &run->setup, &run->report->taken);
}

/* ---- Rate ---- */

static weft_status settle_rate(const weft_job *job, wf_run *run, weft_error *err) {
    subframes *s = run->source;
    bool given = wf_ratio_given(job->subframe_rate);
    char text[48] = "irregular";
    weft_status status = wf_refine_sequence(job, &s->first.info, &run->setup.sequence,
                                            &s->shown, &s->refined, err);
    if (status) return status;
    if (s->refined.units) {
        wf_take(&run->report->taken, "rate", "refined", "file");
        return WEFT_OK;
    }
    s->shown.rate = job->subframe_rate;
    status = wf_take_planned(job, &s->first.info, &run->setup.sequence, &s->shown.rate, err);
    if (!status && !wf_ratio_given(s->shown.rate))
        status = wf_shown_by_files(job->inputs[0], &s->first.info, &run->setup.sequence,
                                   &s->shown, err);
    if (status) return status;
    if (!s->shown.times_s) wf_rate_text(s->shown.rate, text);
    wf_take(&run->report->taken, "rate", text, given ? "option" : "file");
    return WEFT_OK;
}

static double mean_rate(const wf_run *run) {
    const subframes *s = run->source;
    size_t count = run->setup.sequence.count;
    if (!s->shown.times_s) return wf_ratio_value(s->shown.rate);
    return (double)count /
           wf_ratio_value(wf_ratio_difference(s->shown.times_s[count], s->shown.times_s[0]));
}

/* ---- Fields ---- */

/* Bands follow the chunks of the first file; others may differ and cost a little more. Whole
 * pictures are cut so that a band's sums stay in a core's cache. */
static void choose_bands(const subframes *s, wf_resample_desc *desc) {
    desc->band_rows =
        s->first.info.band_lines > 0 && !s->first.info.whole ? s->first.info.band_lines : 16;
    while (desc->band_rows < 16) desc->band_rows *= 2;
    desc->band_origin = s->first.info.data.y0 - s->first.info.display.y0;
}

/* How long the sequence is shown, in seconds. */
static wf_rational length(const subframes *s, size_t count) {
    return s->refined.units ? wf_ratio_difference(s->refined.end_s, s->refined.begin_s)
                            : wf_ratio_difference(s->shown.times_s[count], s->shown.times_s[0]);
}

static wf_resample_desc describe_fields(const wf_run *run) {
    const weft_job *job = run->job;
    const subframes *s = run->source;
    wf_resample_desc desc = wf_describe_fields(job, &s->first.info, s->shown.rate,
                                               (int64_t)run->setup.sequence.count);
    desc.timing.edges = s->edges;
    desc.channels = s->options.want_alpha ? 4 : 3; /* later files may have alpha */
    if (s->edges)
        desc.timing.shown = wf_ratio_div(length(s, run->setup.sequence.count),
                                         wf_raster_field_period(&job->raster));
    choose_bands(s, &desc);
    return desc;
}

/* Spans of a refined sequence may begin before or after its fields do. */
static void move_edges(const wf_raster *raster, const wf_refined *r, wf_rational *edges) {
    wf_rational late = wf_ratio_div(wf_ratio_difference(r->edge_s[0], r->begin_s),
                                    wf_raster_field_period(raster));
    for (size_t u = 0; u <= r->units; u++) edges[u] = wf_ratio_sum(edges[u], late);
}

static weft_status make_edges(const wf_run *run, weft_error *err) {
    subframes *s = run->source;
    const weft_job *job = run->job;
    size_t count = run->setup.sequence.count;
    char why[512];
    if (!s->shown.times_s) return WEFT_OK;
    s->edges = calloc(count + 1, sizeof *s->edges);
    if (!s->edges) return wf_fail(err, WEFT_NO_MEMORY, "no memory for times");
    if (!wf_timing_edges(&job->raster, s->shown.times_s, (int64_t)count,
                         job->subframe_time_center && !s->refined.units, s->edges, why,
                         sizeof why))
        return wf_fail(err, WEFT_FAILED, "%s: %s", job->inputs[0], why);
    if (s->refined.units) move_edges(&job->raster, &s->refined, s->edges);
    return WEFT_OK;
}

static weft_status refuse_few(const wf_run *run, weft_error *err) {
    const subframes *s = run->source;
    char text[48] = "their times";
    if (!s->edges) wf_rate_text(s->shown.rate, text);
    return wf_fail(
        err, WEFT_FAILED,
        "%s: %zu subframes at %s%s do not fill one frame of %s; select more, or check "
        "--subframe-rate",
        run->job->inputs[0], run->setup.sequence.count, text, s->edges ? "" : " a second",
        run->job->raster.name);
}

static weft_status settle_fields(wf_run *run, weft_error *err) {
    subframes *s = run->source;
    char why[512];
    wf_timing timing;
    weft_status status = make_edges(run, err);
    if (status) return status;
    const wf_resample_desc desc = describe_fields(run);
    if (!wf_timing_init(&timing, &desc.timing, why, sizeof why))
        return wf_fail(err, WEFT_FAILED, "%s", why);
    int64_t frames = wf_timing_frames(&desc.timing);
    int64_t asked = run->job->output_end;
    if (asked > frames && wf_timing_covers(&desc.timing, asked - 1)) frames = asked;
    if (frames < 1) return refuse_few(run, err);
    return wf_fit_frames(run, &desc, frames, &s->end_field, &s->resampler, err);
}

static weft_status count(wf_run *run, weft_error *err) {
    subframes *s = run->source;
    settle_decoding(run);
    weft_status status = settle_rate(run->job, run, err);
    if (!status && run->job->raster.pulldown)
        status = wf_settle_film(run->job, "subframes", &s->shown.rate, err);
    if (!status && *run->setup.sequence.notice)
        wf_job_warn(run->job, "%s", run->setup.sequence.notice);
    if (!status) status = settle_fields(run, err);
    if (status) return status;
    wf_warn_of_few(run->job, mean_rate(run));
    wf_start_timecode(run->job, &run->setup, &s->first.info);
    return WEFT_OK;
}

static wf_needs needs(const wf_run *run, int64_t field) {
    const subframes *s = run->source;
    wf_window window = wf_resampler_window(s->resampler, field);
    return (wf_needs){window.first, window.first + window.count};
}

/* ---- Missing subframes ---- */

static void number_text(wf_rational number, char *text, size_t size) {
    if (number.den == 1)
        snprintf(text, size, "%lld", (long long)number.num);
    else
        snprintf(text, size, "%.9g", wf_ratio_value(number));
}

/* How many missing subframes the fields of this chunk need; their places go to k, of which
 * there is space for sequence.missing. */
static size_t find_missing(const wf_run *run, int64_t *k) {
    const wf_sequence *sequence = &run->setup.sequence;
    int per_frame = wf_raster_fields_per_frame(&run->job->raster);
    size_t missing = 0;
    int64_t next = 0, end = run->setup.end_frame * per_frame;
    for (int64_t n = run->setup.first_frame * per_frame; sequence->missing && n < end; n++) {
        wf_needs of = needs(run, n);
        for (next = next > of.first ? next : of.first; next < of.end; next++)
            if (!sequence->refs[next].path) k[missing++] = next;
    }
    return missing;
}

static weft_status list_missing(wf_run *run, weft_error *err) {
    const wf_sequence *sequence = &run->setup.sequence;
    subframes *s = run->source;
    int64_t *k = malloc((sequence->missing + 1) * sizeof *k);
    s->missing = malloc((sequence->missing + 1) * sizeof *s->missing);
    if (k && s->missing) s->missing_count = find_missing(run, k);
    for (size_t n = 0; n < s->missing_count; n++) s->missing[n] = sequence->refs[k[n]].number;
    free(k);
    return k && s->missing ? WEFT_OK : wf_fail(err, WEFT_NO_MEMORY, "no memory for numbers");
}

/* Faces what is missing: it is an error, or people are told what takes its place. */
static weft_status start(wf_run *run, weft_error *err) {
    const weft_job *job = run->job;
    const subframes *s = run->source;
    char number[32];
    weft_status status = list_missing(run, err);
    size_t missing = s->missing_count;
    if (status || !missing || wf_frames_all_there(job, &run->setup)) return status;
    number_text(s->missing[0], number, sizeof number);
    if (job->on_missing == WF_MISSING_ERROR)
        return wf_fail(
            err, WEFT_FAILED,
            "%s: subframe %s is missing (%zu of the %zu selected are missing and needed); "
            "render it, or give --on-missing hold or black",
            job->inputs[0], number, missing, run->setup.sequence.count);
    run->report->degraded = true;
    wf_job_warn(job, "%s: %zu subframe%s missing, the first is %s: %s", job->inputs[0], missing,
                missing == 1 ? " is" : "s are", number,
                job->on_missing == WF_MISSING_HOLD ? "their neighbors are held"
                                                   : "they are black");
    return WEFT_OK;
}

/* ---- Reading ---- */

/* The subframe shown at k: itself, or where it is missing and held, its nearest neighbor. */
static const wf_subframe_ref *shown_at(const wf_run *run, int64_t k) {
    const wf_sequence *sequence = &run->setup.sequence;
    if (sequence->refs[k].path || run->job->on_missing == WF_MISSING_BLACK)
        return &sequence->refs[k];
    for (int64_t earlier = k; earlier-- > 0;)
        if (sequence->refs[earlier].path) return &sequence->refs[earlier];
    size_t later = (size_t)k;
    while (later < sequence->count && !sequence->refs[later].path) later++;
    return &sequence->refs[later < sequence->count ? later : (size_t)k];
}

static bool same(const wf_run *run, int64_t a, int64_t b) {
    return shown_at(run, a) == shown_at(run, b);
}

static weft_status open_file(const wf_run *run, const wf_subframe_ref *ref, wf_subframe **out,
                             weft_error *err) {
    const subframes *s = run->source;
    weft_status status = wf_subframe_open(ref->path, ref->part, &s->options, out, err);
    if (status) return status;
    return wf_check_subframe(run->job, &s->first, ref->path, ref->part >= 0, *out, err);
}

/* A picture of several files, each where it exists. */
static weft_status open_stack(const wf_run *run, int64_t k, wf_subframe **out,
                              weft_error *err) {
    const subframes *s = run->source;
    const wf_refined_file *stack[WF_REFINED_LAYERS];
    wf_layer_over layers[WF_REFINED_LAYERS];
    int count, opened = 0;
    weft_status status = wf_refined_stack(&s->refined, (size_t)k, stack, &count, err);
    for (; !status && opened < count; opened++) {
        layers[opened] = (wf_layer_over){.region = stack[opened]->region};
        status = open_file(run, &stack[opened]->ref, &layers[opened].picture, err);
    }
    if (!status && count == 1)
        *out = layers[0].picture;
    else if (!status)
        return wf_subframe_composed(layers, count, out, err);
    for (int i = 0; status && i < opened; i++) wf_subframe_close(layers[i].picture);
    return status;
}

static weft_status open_picture(const wf_run *run, int64_t k, wf_subframe **out,
                                weft_error *err) {
    const subframes *s = run->source;
    if (s->refined.units) return open_stack(run, k, out, err);
    const wf_subframe_ref *ref = shown_at(run, k);
    return ref->path ? open_file(run, ref, out, err) : WEFT_OK;
}

/* Whole pictures in memory at once, where a format cannot be read by chunks. */
#define MOST_WHOLE_BYTES ((size_t)256 << 20)

static int open_together(const wf_image_info *info) {
    if (!info->whole) return WF_UNITS_TOGETHER;
    size_t samples =
        (size_t)(info->data.x1 - info->data.x0) * (size_t)(info->data.y1 - info->data.y0);
    size_t pictures = MOST_WHOLE_BYTES / (samples * 4 * sizeof(float) + 1);
    return pictures < 1 ? 1 : pictures > WF_UNITS_TOGETHER ? WF_UNITS_TOGETHER : (int)pictures;
}

/* Reading a picture again costs more than sums in memory. */
#define CARRIED_BYTES ((size_t)128 << 20)

static wf_picture_desc describe(const wf_run *run) {
    const subframes *s = run->source;
    return (wf_picture_desc){s->resampler, &s->options, open_together(&s->first.info),
                             s->end_field, false,       CARRIED_BYTES};
}

static int64_t opens(const wf_run *run, const wf_units *units, bool *needed) {
    int64_t opened = 0;
    for (int i = 0; i < units->count; i++) {
        const wf_subframe_ref *shown = shown_at(run, units->unit[i]);
        if (!shown->path) continue;
        needed[shown - run->setup.sequence.refs] = true;
        opened += !i || !same(run, units->unit[i - 1], units->unit[i]);
    }
    return opened;
}

/* ---- Report ---- */

static void tell(const wf_run *run, wf_report *report) {
    subframes *s = run->source;
    report->listed = (int64_t)run->setup.sequence.count;
    report->missing = s ? s->missing : NULL;
    report->missing_count = s ? s->missing_count : 0;
    if (s) s->missing = NULL; /* the report's now */
    if (!run->finished || !report->nan_fixed) return;
    report->degraded = true;
    char alone[96] = "";
    if (report->nan_alone)
        snprintf(alone, sizeof alone, ", but for %lld that had no finite one and are black",
                 (long long)report->nan_alone);
    wf_job_warn(run->job, "%lld pixels of the input were NaN or infinite: %s%s",
                (long long)report->nan_fixed,
                run->job->nan_fix == WF_NAN_BLACK ? "they are black"
                                                  : "they are the means of their neighbors",
                alone);
}

static const wf_picture_reading reading = {
    .describe = describe,
    .open = open_picture,
    .same = same,
};

const wf_source_kind wf_source_subframes = {
    .name = "subframes",
    .takes = takes,
    .open = open_input,
    .count = count,
    .start = start,
    .needs = needs,
    .summing = &wf_summing_pictures,
    .pictures = &reading,
    .tell = tell,
    .close = close_input,
    .opens = opens,
};
