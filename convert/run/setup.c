#include "convert/run/setup.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/job/colors.h"
#include "convert/run/timecode_start.h"

/* ---- Input ---- */

static const wf_subframe_ref *first_present(const wf_sequence *sequence) {
    for (size_t k = 0; k < sequence->count; k++)
        if (sequence->refs[k].path) return &sequence->refs[k];
    return NULL;
}

static bool shows_background(const weft_job *job) {
    return job->background[0] != 0 || job->background[1] != 0 || job->background[2] != 0;
}

static weft_status find_input(weft_job *job, wf_setup *s, weft_error *err) {
    weft_status status =
        wf_sequence_expand(job->inputs, job->input_count, job->frames, &s->sequence, err);
    if (status) return status;
    const wf_subframe_ref *ref = first_present(&s->sequence);
    if (!ref)
        return wf_fail(err, WEFT_FAILED, "%s: no subframe of the selection exists",
                       job->inputs[0]);
    s->source = (wf_source_options){
        .layer = job->layer,
        .part = job->part,
        .want_alpha = shows_background(job),
        .nan_fix = job->nan_fix,
        .max_memory_bytes = job->max_memory_bytes,
    };
    wf_subframe *subframe;
    status = wf_subframe_open(ref->path, ref->part, &s->source, &subframe, err);
    if (status) return status;
    s->first = *wf_subframe_info(subframe);
    wf_subframe_close(subframe);
    return WEFT_OK;
}

static weft_status settle_rate(const weft_job *job, const wf_setup *s, wf_rational *rate,
                               weft_error *err) {
    *rate = job->subframe_rate;
    if (!wf_ratio_given(*rate) && wf_ratio_given(s->first.rate))
        *rate = wf_ratio_div(s->first.rate, s->sequence.step);
    if (wf_ratio_given(*rate) && rate->num > 0) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE,
                   "%s: the files do not say how many subframes a second they are; give "
                   "--subframe-rate, such as --subframe-rate 240 or 480000/1001",
                   job->inputs[0]);
}

static const char *rate_text(wf_rational rate, char text[48]) {
    int used = snprintf(text, 48, "%" PRId64, rate.num);
    if (rate.den != 1) snprintf(text + used, 48 - (size_t)used, "/%" PRId64, rate.den);
    return text;
}

static bool is_whole(wf_rational r) {
    return wf_ratio_given(r) && r.den == 1;
}

/* Film that was rendered at 24 runs at 24000/1001 in 59.94 fields, and the other way round: a
 * tenth of a percent slower, with no frame lost. */
static weft_status settle_film(const weft_job *job, wf_rational *rate, weft_error *err) {
    wf_rational film = wf_raster_film_rate(&job->raster), given = *rate;
    const wf_rational speeds[] = {{1, 1}, {1000, 1001}, {1001, 1000}};
    for (size_t i = 0; i < sizeof speeds / sizeof *speeds; i++) {
        *rate = wf_ratio_mul(given, speeds[i]);
        if (!is_whole(wf_ratio_div(*rate, film))) continue;
        if (i)
            wf_job_warn(
                job,
                "%s subframes a second run at %s, since %s shows film at %s frames a second",
                rate_text(given, (char[48]){0}), rate_text(*rate, (char[48]){0}),
                job->raster.name, rate_text(film, (char[48]){0}));
        return WEFT_OK;
    }
    return wf_fail(err, WEFT_USAGE,
                   "%s: --cadence 2:3 takes film, 24 or 23.976 frames a second of one subframe "
                   "or more, such as 192, and not %s subframes a second",
                   job->inputs[0], rate_text(given, (char[48]){0}));
}

/* ---- Geometry ---- */

/* The simplest ratio within float32's accuracy of value: files hold 10:11 as 0.909090936. */
static wf_rational simplest_ratio(double value) {
    int64_t num[2] = {1, 0}, den[2] = {0, 1};
    double rest = value;
    for (int step = 0; step < 16; step++) {
        int64_t whole = (int64_t)floor(rest);
        int64_t n = whole * num[0] + num[1], d = whole * den[0] + den[1];
        num[1] = num[0], num[0] = n;
        den[1] = den[0], den[0] = d;
        if (fabs((double)n / (double)d - value) <= 2e-7 * value) break;
        rest = 1 / (rest - (double)whole);
    }
    return wf_ratio(num[0], den[0]);
}

static wf_rational input_pixel_aspect(const weft_job *job, const wf_setup *s) {
    if (wf_ratio_given(job->input_par)) return job->input_par;
    double aspect = s->first.pixel_aspect;
    return aspect > 1e-3 && aspect < 1e3 ? simplest_ratio(aspect) : wf_ratio(1, 1);
}

static void warn_of_aspect(const weft_job *job, const wf_setup *s, wf_rational par) {
    double width = s->first.display.x1 - s->first.display.x0;
    double height = s->first.display.y1 - s->first.display.y0;
    double input = width / height * wf_ratio_value(par);
    double raster = (double)job->raster.width_px / job->raster.lines *
                    wf_ratio_value(job->raster.pixel_aspect);
    if (job->fit == WF_FIT_STRETCH && fabs(input / raster - 1) > 0.01)
        wf_job_warn(
            job,
            "the input's picture is %.4f:1 (%.0fx%.0f, pixels %" PRId64 ":%" PRId64
            ") and the raster's %.4f:1 (%s): it will be stretched; --input-par says what "
            "the input's pixels are, --fit crop or pad keeps its shape",
            input, width, height, par.num, par.den, raster, job->raster.name);
}

/* Cell sizes for crop and pad: one scale for both axes, in the shape of the pixels. */
static void fit_evenly(const weft_job *job, wf_rational par, wf_fitting *x, wf_fitting *y) {
    wf_rational shape = wf_ratio_div(par, job->raster.pixel_aspect);
    wf_rational by_height = y->cell, by_width = wf_ratio_div(x->cell, shape);
    bool width_larger = wf_ratio_value(by_width) > wf_ratio_value(by_height);
    bool take_width = width_larger == (job->fit == WF_FIT_CROP);
    y->cell = take_width ? by_width : by_height;
    x->cell = wf_ratio_mul(y->cell, shape);
    x->padded = y->padded = job->fit == WF_FIT_PAD;
}

static void fit_picture(const weft_job *job, const wf_setup *s, wf_fitting *x, wf_fitting *y) {
    wf_rational par = input_pixel_aspect(job, s);
    *x = (wf_fitting){.pixels = job->raster.width_px,
                      .cells = s->first.display.x1 - s->first.display.x0};
    *y = (wf_fitting){.pixels = job->raster.lines,
                      .cells = s->first.display.y1 - s->first.display.y0};
    x->cell = wf_ratio(x->pixels, x->cells);
    y->cell = wf_ratio(y->pixels, y->cells);
    warn_of_aspect(job, s, par);
    if (job->fit != WF_FIT_STRETCH) fit_evenly(job, par, x, y);
}

static wf_rational temporal_width(const weft_job *job) {
    return wf_ratio_given(job->temporal_width) ? job->temporal_width
                                               : job->aperture.kind->default_width;
}

/* Bands follow the chunks of the first file; others may differ and cost a little more. Whole
 * pictures are cut so that a band's sums stay in a core's cache. */
static void choose_bands(const wf_setup *s, wf_resample_desc *desc) {
    desc->band_rows = s->first.band_lines > 0 && !s->first.whole ? s->first.band_lines : 16;
    while (desc->band_rows < 16) desc->band_rows *= 2;
    desc->band_origin = s->first.data.y0 - s->first.display.y0;
}

static weft_status make_resampler(weft_job *job, wf_setup *s, weft_error *err) {
    wf_rational rate = {0, 0};
    weft_status status = settle_rate(job, s, &rate, err);
    if (!status && job->raster.pulldown) status = settle_film(job, &rate, err);
    if (status) return status;
    wf_resample_desc desc = {
        .raster = &job->raster,
        .aperture = job->aperture,
        .timing = {.raster = &job->raster,
                   .subframe_rate = rate,
                   .subframe_center = job->subframe_time_center,
                   .subframes = (int64_t)s->sequence.count,
                   .width = temporal_width(job),
                   .position = job->shutter_position,
                   .skew = wf_ratio_given(job->scan_skew) ? job->scan_skew : wf_ratio(0, 1)},
        .channels = s->source.want_alpha && s->first.has_alpha ? 4 : 3,
        .background = {job->background[0], job->background[1], job->background[2]},
    };
    fit_picture(job, s, &desc.x, &desc.y);
    choose_bands(s, &desc);
    int64_t frames = wf_timing_frames(&desc.timing);
    if (frames < 1)
        return wf_fail(
            err, WEFT_FAILED,
            "%s: %zu subframes at %" PRId64 "/%" PRId64
            " a second do not fill one frame of %s; select more, or check --subframe-rate",
            job->inputs[0], s->sequence.count, rate.num, rate.den, job->raster.name);
    s->first_frame = frames * (job->chunk - 1) / job->chunk_count;
    s->end_frame = frames * job->chunk / job->chunk_count;
    s->end_field = frames * wf_raster_fields_per_frame(&job->raster);
    char why[512];
    if (!wf_resampler_new(&desc, &s->resampler, why, sizeof why))
        return wf_fail(err, WEFT_FAILED, "%s", why);
    return WEFT_OK;
}

/* ---- Output ---- */

static int list_bits(unsigned mask, char *text, size_t size) {
    int used = 0;
    for (int bits = 1; bits < 32; bits++)
        if (mask & 1u << bits)
            used += snprintf(text + used, size - (size_t)used, "%s%d", used ? ", " : "", bits);
    return used;
}

static weft_status check_output(const weft_job *job, const wf_output_kind *kind, int bits,
                                weft_error *err) {
    if (kind->layout != WF_LINEAR && !(kind->bits_mask & 1u << bits)) {
        char there[64];
        list_bits(kind->bits_mask, there, sizeof there);
        return wf_fail(err, WEFT_USAGE, "%s: %s takes --bits %s, not %d", job->output,
                       kind->name, there, bits);
    }
    bool subsampled = kind->layout == WF_YCBCR && job->chroma != WF_CHROMA_444;
    if (subsampled && job->raster.width_px % 2)
        return wf_fail(err, WEFT_USAGE,
                       "%s: 4:2:2 takes an even width, and %s is %d pixels wide; "
                       "change the raster or give --chroma 444",
                       job->output, job->raster.name, job->raster.width_px);
    if (kind->fixed_422 && !subsampled)
        return wf_fail(err, WEFT_USAGE, "%s: %s is always 4:2:2; leave out --chroma 444",
                       job->output, kind->name);
    if (job->silent_tracks && !kind->container)
        return wf_fail(err, WEFT_USAGE,
                       "%s: %s has no sound; --audio is for .mov, .mxf and .mkv", job->output,
                       kind->name);
    if (job->separate_fields && !kind->sequence)
        return wf_fail(err, WEFT_USAGE,
                       "%s: %s holds frames; --fields separate is for image sequences, such as "
                       "out.####.dpx",
                       job->output, kind->name);
    if (job->separate_fields && job->raster.scan == WF_PROGRESSIVE)
        return wf_fail(err, WEFT_USAGE,
                       "--fields separate: %s is progressive and has no fields; leave it out",
                       job->raster.name);
    if (job->chunk_count > 1 && !kind->joins)
        return wf_fail(err, WEFT_USAGE,
                       "%s: chunks of %s cannot be joined; write an image sequence, "
                       ".y4m, .v210 or .uyvy",
                       job->output, kind->name);
    return WEFT_OK;
}

static void tell_changes(const weft_job *job, const wf_setup *s) {
    char text[512] = "";
    if (s->output.ops->tell) s->output.ops->tell(&s->output_options, text, sizeof text);
    if (*text) wf_job_warn(job, "%s", text);
    if (s->output.kind->layout == WF_LINEAR && job->legalize != WF_LEGAL_NONE)
        wf_job_warn(job, "%s: --legalize is for codes; float samples stay as they are",
                    job->output);
}

static void describe_sink(const weft_job *job, wf_setup *s, int bits, bool full) {
    s->output_options = (wf_output_options){
        .output = job->output,
        .raster = &job->raster,
        .layout = s->output.kind->layout,
        .bits = s->output.kind->layout == WF_LINEAR ? 32 : bits,
        .full_range = full,
        .subsampled = s->output.kind->layout == WF_YCBCR && job->chroma != WF_CHROMA_444,
        .separate_fields = job->separate_fields,
        .stream_header = job->chunk == 1,
        .timecode = job->timecode ? job->timecode : "00:00:00:00",
        .color_space = s->color_space,
        .codec = job->codec,
        .silent_tracks = job->silent_tracks,
        .threads = job->threads,
        .overwrite = job->overwrite,
        .resume = job->resume,
    };
}

weft_status wf_setup_sink(const weft_job *job, wf_setup *s, weft_error *err) {
    s->output = wf_output_for(job->output, job->codec, err);
    if (!s->output.kind) return WEFT_USAGE;
    int bits = job->bits ? job->bits : s->output.kind->default_bits;
    weft_status status = check_output(job, s->output.kind, bits, err);
    if (status) return status;
    bool full =
        job->range == WF_RANGE_UNSET ? s->output.kind->full_range : job->range == WF_RANGE_FULL;
    describe_sink(job, s, bits, full);
    if (s->output.ops->check && (status = s->output.ops->check(&s->output_options, err)))
        return status;
    tell_changes(job, s);
    snprintf(s->color_space, sizeof s->color_space, "%s",
             wf_colors_of(job->raster.matrix)->space);
    s->encoding = (wf_encoding){
        .luma = wf_colors_of(job->raster.matrix)->luma,
        .chroma = job->chroma,
        .legalize = job->legalize,
        .dither = job->dither,
        .ycbcr = s->output.kind->layout == WF_YCBCR,
        .full_range = full,
        .bits = bits,
        .width_px = job->raster.width_px,
    };
    return wf_setup_display(job, s, err);
}

weft_status wf_setup_output(weft_job *job, wf_setup *s, weft_error *err) {
    weft_status status = wf_setup_sink(job, s, err);
    if (!status) status = wf_setup_color(job, s, err);
    return status ? status : wf_setup_display(job, s, err);
}

void wf_setup_count_frames(wf_setup *s) {
    s->output_options.first_frame = s->first_frame;
    s->output_options.frame_count = s->end_frame - s->first_frame;
}

weft_status wf_setup_make(weft_job *job, wf_setup *s, weft_error *err) {
    *s = (wf_setup){0};
    weft_status status = wf_setup_output(job, s, err);
    if (!status) status = find_input(job, s, err);
    if (!status) status = make_resampler(job, s, err);
    if (!status) wf_start_timecode(job, s);
    wf_setup_count_frames(s);
    return status;
}

wf_gather_desc wf_setup_gather(const weft_job *job) {
    return (wf_gather_desc){.raster = &job->raster,
                            .aperture = job->aperture,
                            .width = temporal_width(job),
                            .position = job->shutter_position,
                            .skew = job->scan_skew};
}

wf_report_legal wf_setup_legal(const weft_job *job, const wf_setup *s) {
    if (!s->output.kind || s->output.kind->layout == WF_LINEAR) return (wf_report_legal){0};
    static const char *const legalize[] = {"none", "clip", "r103"};
    return (wf_report_legal){.legalize = legalize[job->legalize],
                             .dither = job->dither == WF_DITHER_TPDF ? "tpdf" : "none",
                             .range = s->output_options.full_range ? "full" : "narrow",
                             .bits = s->output_options.bits};
}

void wf_setup_free(wf_setup *s) {
    wf_sequence_free(&s->sequence);
    wf_resampler_free(s->resampler);
    if (s->transform.free) s->transform.free(s->transform.self);
    free(s->display);
    *s = (wf_setup){0};
}
