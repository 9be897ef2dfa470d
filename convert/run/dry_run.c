/* --dry-run: finding out what would be done. */
#include "convert/run/dry_run.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>

#include "convert/base/pattern.h"
#include "convert/run/dry_run_parts.h"
#include "convert/run/sum/needs.h"
#include "filters/raster/timing.h"

void wf_dry_run_free(wf_dry_run *d) {
    if (d) free(d->fields);
    free(d);
}

static const wf_raster *raster_of(const wf_run *run) {
    return run->setup.output_options.raster;
}

/* ---- Fields ---- */

/* Fields look at the same times whatever there is to see. */
static weft_status find_times(const wf_run *run, wf_timing *timing, weft_error *err) {
    const wf_gather_desc gather = wf_setup_gather(run->job);
    const wf_raster *raster = raster_of(run);
    const wf_timing_desc desc = {
        .raster = raster,
        .subframe_rate = wf_ratio_div(wf_ratio(1, 1), wf_raster_field_period(raster)),
        .subframes = 1,
        .width = gather.width,
        .position = gather.position,
        .skew = wf_ratio_given(gather.skew) ? gather.skew : wf_ratio(0, 1)};
    char why[512];
    if (wf_timing_init(timing, &desc, why, sizeof why)) return WEFT_OK;
    return wf_fail(err, WEFT_FAILED, "%s", why);
}

static void add_field(wf_dry_run *d, const wf_run *run, const wf_timing *timing, int64_t n) {
    wf_dry_field field = {.index = n};
    wf_timing_seconds(timing, n, raster_of(run)->lines, &field.from_s, &field.to_s);
    if (d->reads) field.needs = run->kind->needs(run, n);
    for (int64_t k = field.needs.first; k < field.needs.end; k++)
        field.missing += !run->setup.sequence.refs[k].path;
    d->fields[d->field_count++] = field;
}

/* Adds the samples of the units that a field needs and no field before it did. */
static void add_samples(wf_dry_run *d, const wf_run *run, int64_t field, int64_t *next) {
    wf_needs needs = run->kind->needs(run, field);
    if (needs.first < *next) needs.first = *next;
    if (needs.end <= needs.first) return;
    d->samples += (needs.end - needs.first) * run->kind->samples_a_unit(run);
    *next = needs.end;
}

/* ---- Files ---- */

static void add_opened(wf_dry_run *d, const wf_run *run, int64_t first, int64_t past,
                       bool *needed) {
    wf_walk walk = wf_walk_begin();
    wf_units units;
    for (int64_t n = first, end; n < past; n = end) {
        end = wf_walk_group_end(run, n, past);
        wf_walk_group(run, &walk, n, end);
        while (wf_walk_units(run, &walk, &units))
            d->opened += run->kind->opens(run, &units, needed);
    }
}

static void add_inputs(wf_dry_run *d, const wf_run *run, const bool *needed) {
    const wf_sequence *sequence = &run->setup.sequence;
    const wf_subframe_ref *refs = sequence->refs;
    struct stat about;
    for (size_t k = 0; k < sequence->count; k++) {
        if (!needed[k]) continue;
        bool again = k && refs[k].part >= 0 && needed[k - 1]; /* parts of one file */
        if (again || stat(refs[k].path, &about)) continue;
        d->files++;
        d->read_bytes += about.st_size;
    }
}

static void name_output(const wf_output_kind *kind, const char *output, int64_t number,
                        char path[PATH_MAX]) {
    bool named = kind->sequence && wf_pattern_is(output) &&
                 wf_pattern_path(output, number, path, PATH_MAX);
    if (!named) snprintf(path, PATH_MAX, "%s", output);
}

/* Tells of an output by its kind and its name. */
static void find_present(wf_dry_output *o, const wf_setup *s, const wf_output_kind *kind,
                         const char *name) {
    int files = wf_output_files(&s->output_options);
    o->kind = kind->name;
    if (!kind->sequence) o->present = wf_output_present(kind, name, -1);
    for (int64_t n = s->first_frame * files; kind->sequence && n < s->end_frame * files; n++)
        o->present += wf_output_present(kind, name, n);
}

/* Frames first <= n < end are among those that will be written. */
static void add_output(wf_dry_output *o, const wf_setup *s, const wf_output_kind *kind,
                       const char *name, const int64_t frames[2]) {
    int files = wf_output_files(&s->output_options);
    if (!o->files) name_output(kind, name, frames[0] * files, o->first);
    name_output(kind, name, frames[1] * files - 1, o->last);
    o->files = kind->sequence ? o->files + (frames[1] - frames[0]) * files : 1;
}

/* ---- All of it ---- */

static void add_fields(wf_dry_run *d, const wf_run *run, const wf_timing *timing, int64_t first,
                       int64_t end, bool *needed) {
    int per_frame = wf_raster_fields_per_frame(raster_of(run));
    int64_t next = INT64_MIN;
    if (d->reads) add_opened(d, run, first * per_frame, end * per_frame, needed);
    for (int64_t k = first * per_frame; k < end * per_frame; k++) {
        add_field(d, run, timing, k);
        if (run->kind->samples_a_unit) add_samples(d, run, k, &next);
    }
}

static void add_frames(wf_dry_run *d, const wf_run *run, const wf_timing *timing, bool pictures,
                       bool *needed) {
    const wf_setup *s = &run->setup;
    const weft_job *job = run->job;
    for (int64_t n = s->first_frame, end; wf_frames_next(job, s, &n, &end); n = end) {
        const int64_t frames[2] = {n, end};
        if (!pictures) add_fields(d, run, timing, n, end, needed);
        add_output(&d->output, s, s->output.kind, job->output, frames);
        if (s->key.kind) add_output(&d->key, s, s->key.kind, job->key, frames);
        d->frames += end - n;
    }
    if (pictures)
        d->samples = d->frames * (int64_t)raster_of(run)->width_px * raster_of(run)->lines;
}

/* Samples are R G B t x y in float, behind a table of how many each pixel has. */
static wf_sink_size deep_size(const wf_dry_run *d, const wf_raster *r) {
    int64_t table = 4 * (int64_t)r->width_px * r->lines;
    return (wf_sink_size){24 * d->samples + d->frames * (4096 + table), WF_SIZE_MOST};
}

static void find_sizes(wf_dry_run *d, const wf_run *run, bool pictures) {
    const wf_setup *s = &run->setup;
    bool deep = run->job->command == WF_TRACE && !pictures;
    d->output.size = deep ? deep_size(d, raster_of(run))
                          : wf_output_size(&s->output, &s->output_options, d->frames);
    if (s->key.kind) d->key.size = wf_output_size(&s->key, &s->key_options, d->frames);
}

static weft_status find_all(wf_dry_run *d, const wf_run *run, bool pictures, weft_error *err) {
    const wf_setup *s = &run->setup;
    size_t most = (size_t)((s->end_frame - s->first_frame) * 2) + 1;
    bool *needed = calloc(s->sequence.count + 1, sizeof *needed);
    d->fields = pictures ? NULL : calloc(most, sizeof *d->fields);
    wf_timing timing;
    weft_status status = needed && (d->fields || pictures)
                             ? find_times(run, &timing, err)
                             : wf_fail(err, WEFT_NO_MEMORY, "no memory for the plan");
    find_present(&d->output, s, s->output.kind, run->job->output);
    if (s->key.kind) find_present(&d->key, s, s->key.kind, run->job->key);
    if (!status && !wf_frames_all_there(run->job, s))
        add_frames(d, run, &timing, pictures, needed);
    if (!status && d->frames) find_sizes(d, run, pictures);
    if (!status && d->reads) add_inputs(d, run, needed);
    free(needed);
    return status;
}

weft_status wf_dry_run_make(wf_run *run, bool pictures, weft_error *err) {
    wf_dry_run *d = calloc(1, sizeof *d);
    run->report->plan = d;
    if (!d) return wf_fail(err, WEFT_NO_MEMORY, "no memory for the plan");
    d->taken = &run->report->taken;
    d->reads = run->kind->opens != NULL;
    d->memory_bytes = run->pace.memory_bytes;
    d->threads = run->crew.threads;
    weft_status status = find_all(d, run, pictures, err);
    if (status) return status;
    bool traced = pictures || run->kind->samples_a_unit;
    if (!traced || wf_ratio_given(run->job->error)) d->samples = -1;
    run->report->add_plan = wf_dry_run_json;
    return wf_dry_run_text(d, run->job, err);
}
