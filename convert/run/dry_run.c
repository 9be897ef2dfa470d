/* --dry-run: seeing what would be done. */
#include "convert/run/dry_run.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>

#include "convert/base/pattern.h"
#include "convert/read/sequence.h"
#include "convert/run/dry_run_parts.h"

void wf_foreseen_free(wf_foreseen *f) {
    if (f) free(f->fields);
    free(f);
}

static const wf_raster *raster_of(const wf_foresee_desc *d) {
    return d->setup->output_options.raster;
}

/* ---- Fields ---- */

/* Fields look at the same times whatever there is to see. */
static weft_status see_times(const wf_foresee_desc *d, wf_timing *timing, weft_error *err) {
    const wf_gather_desc gather = wf_setup_gather(d->job);
    const wf_timing_desc desc = {
        .raster = raster_of(d),
        .subframe_rate = wf_ratio_div(wf_ratio(1, 1), wf_raster_field_period(raster_of(d))),
        .subframes = 1,
        .width = gather.width,
        .position = gather.position,
        .skew = wf_ratio_given(gather.skew) ? gather.skew : wf_ratio(0, 1)};
    char why[512];
    if (wf_timing_init(timing, &desc, why, sizeof why)) return WEFT_OK;
    return wf_fail(err, WEFT_FAILED, "%s", why);
}

static void see_field(wf_foreseen *f, const wf_foresee_desc *d, const wf_timing *timing,
                      int64_t n) {
    wf_seen_field field = {.index = n};
    wf_timing_seconds(timing, n, raster_of(d)->lines, &field.from_s, &field.to_s);
    if (d->pipeline) field.window = wf_resampler_window(d->setup->resampler, n);
    for (int64_t k = 0; k < field.window.count; k++)
        field.missing += !d->setup->sequence.refs[field.window.first + k].path;
    f->fields[f->field_count++] = field;
}

/* ---- Scenes ---- */

/* As many as the units that fields need, each of them once; *next is past those counted. */
static void see_samples(wf_foreseen *f, const wf_foresee_desc *d, int64_t field,
                        int64_t *next) {
    const wf_raster *r = &d->job->raster;
    int64_t first, last;
    wf_sampling_units(d->sampling, field, &first, &last);
    if (first < *next) first = *next;
    if (last >= first)
        f->samples += (last - first + 1) * d->job->samples * r->width_px * r->lines;
    if (last >= *next) *next = last + 1;
}

/* ---- Files ---- */

static void see_inputs(wf_foreseen *f, const wf_foresee_desc *d, const bool *needed) {
    const wf_sequence *sequence = &d->setup->sequence;
    const wf_subframe_ref *refs = sequence->refs;
    struct stat about;
    for (size_t k = 0; k < sequence->count; k++) {
        if (!needed[k]) continue;
        bool again = k && refs[k].part >= 0 && needed[k - 1]; /* parts of one file */
        if (again || stat(refs[k].path, &about)) continue;
        f->files++;
        f->read_bytes += about.st_size;
    }
}

static void name_output(const wf_foresee_desc *d, int64_t number, char path[PATH_MAX]) {
    const char *output = d->job->output;
    bool named = d->setup->output.kind->sequence && wf_pattern_is(output) &&
                 wf_pattern_path(output, number, path, PATH_MAX);
    if (!named) snprintf(path, PATH_MAX, "%s", output);
}

static void see_present(wf_foreseen *f, const wf_foresee_desc *d) {
    const wf_setup *s = d->setup;
    int files = wf_output_files(&s->output_options);
    f->kind = s->output.kind->name;
    if (!s->output.kind->sequence)
        f->present = wf_output_present(s->output.kind, d->job->output, -1);
    for (int64_t n = s->first_frame * files;
         s->output.kind->sequence && n < s->end_frame * files; n++)
        f->present += wf_output_present(s->output.kind, d->job->output, n);
}

/* ---- All of it ---- */

static void see_frames(wf_foreseen *f, const wf_foresee_desc *d, const wf_timing *timing,
                       bool *needed) {
    const wf_setup *s = d->setup;
    int per_frame = wf_raster_fields_per_frame(raster_of(d));
    int files = wf_output_files(&s->output_options);
    int64_t next = INT64_MIN;
    for (int64_t n = s->first_frame, end; wf_next_frames(d->job, s, &n, &end); n = end) {
        if (d->pipeline) wf_pipeline_foresee(d->pipeline, n, end, needed);
        for (int64_t k = n * per_frame; !d->pictures && k < end * per_frame; k++) {
            see_field(f, d, timing, k);
            if (d->sampling) see_samples(f, d, k, &next);
        }
        if (!f->frames) name_output(d, n * files, f->first_output);
        name_output(d, end * files - 1, f->last_output);
        f->frames += end - n;
    }
    f->outputs = !f->frames ? 0 : s->output.kind->sequence ? f->frames * files : 1;
    if (d->pictures)
        f->samples = f->frames * (int64_t)raster_of(d)->width_px * raster_of(d)->lines;
}

/* Samples are R G B t x y in float, behind a table of how many each pixel has. */
static wf_sink_size deep_size(const wf_foreseen *f, const wf_raster *r) {
    int64_t table = 4 * (int64_t)r->width_px * r->lines;
    return (wf_sink_size){24 * f->samples + f->frames * (4096 + table), WF_SIZE_MOST};
}

static wf_sink_size see_size(const wf_foreseen *f, const wf_foresee_desc *d) {
    if (d->job->command == WF_TRACE && !d->pictures) return deep_size(f, raster_of(d));
    return wf_output_size(&d->setup->output, &d->setup->output_options, f->frames);
}

static weft_status see(wf_foreseen *f, const wf_foresee_desc *d, weft_error *err) {
    const wf_setup *s = d->setup;
    size_t most = (size_t)((s->end_frame - s->first_frame) * 2) + 1;
    bool *needed = calloc(s->sequence.count + 1, sizeof *needed);
    f->fields = d->pictures ? NULL : calloc(most, sizeof *f->fields);
    wf_timing timing;
    weft_status status = needed && (f->fields || d->pictures)
                             ? see_times(d, &timing, err)
                             : wf_fail(err, WEFT_NO_MEMORY, "no memory for the plan");
    see_present(f, d);
    bool done = d->job->resume && !s->output.kind->sequence && f->present;
    if (!status && !done) see_frames(f, d, &timing, needed);
    if (!status && f->frames) f->size = see_size(f, d);
    if (!status && d->pipeline) see_inputs(f, d, needed);
    free(needed);
    return status;
}

weft_status wf_foresee(const wf_foresee_desc *d, wf_report *report, weft_error *err) {
    wf_foreseen *f = calloc(1, sizeof *f);
    report->plan = f;
    if (!f) return wf_fail(err, WEFT_NO_MEMORY, "no memory for the plan");
    f->reads = d->pipeline != NULL;
    weft_status status = see(f, d, err);
    if (status) return status;
    if (!(d->sampling || d->pictures) || wf_ratio_given(d->job->error)) f->samples = -1;
    if (d->pipeline) {
        f->opened = d->pipeline->opened;
        d->pipeline->opened = 0;
        f->memory_bytes = d->pipeline->bytes;
        f->threads = d->pipeline->threads;
    }
    report->add_plan = wf_foreseen_json;
    return wf_foreseen_text(f, d->job, err);
}
