#include "convert/foresee.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>

typedef struct seen_field {
    int64_t index;
    wf_window window;
    int64_t missing;
} seen_field;

struct wf_foreseen {
    seen_field *fields;
    size_t field_count;
    int64_t frames, opened, files, missing, present, read_bytes;
    size_t memory_bytes;
    int threads;
    char output[64]; /* the kind's name */
};

void wf_foreseen_free(wf_foreseen *f) {
    if (f) free(f->fields);
    free(f);
}

static void see_fields(wf_foreseen *f, const wf_pipeline *p, int64_t first, int64_t end) {
    const wf_subframe_ref *refs = p->setup->sequence.refs;
    int per_frame = wf_raster_fields_per_frame(&p->job->raster);
    for (int64_t n = first * per_frame; n < end * per_frame; n++) {
        seen_field field = {n, wf_resampler_window(p->setup->resampler, n), 0};
        for (int64_t k = 0; k < field.window.count; k++)
            field.missing += !refs[field.window.first + k].path;
        f->fields[f->field_count++] = field;
    }
    f->frames += end - first;
}

static void see_files(wf_foreseen *f, const wf_setup *s, const bool *needed) {
    const wf_subframe_ref *refs = s->sequence.refs;
    struct stat about;
    for (size_t k = 0; k < s->sequence.count; k++) {
        if (!needed[k]) continue;
        bool again = k && refs[k].part >= 0 && needed[k - 1]; /* parts of one file */
        if (again || stat(refs[k].path, &about)) continue;
        f->files++;
        f->read_bytes += about.st_size;
    }
}

static void see_outputs(wf_foreseen *f, const wf_pipeline *p) {
    const wf_setup *s = p->setup;
    snprintf(f->output, sizeof f->output, "%s", s->sink->name);
    if (!s->sink->sequence) f->present = wf_sink_present(s->sink, p->job->output, -1);
    for (int64_t n = s->first_frame; s->sink->sequence && n < s->end_frame; n++)
        f->present += wf_sink_present(s->sink, p->job->output, n);
}

/* ---- Telling ---- */

static const char *fate(const weft_job *job, const wf_foreseen *f) {
    return !f->present      ? "new"
           : job->overwrite ? "overwritten"
           : job->resume    ? "kept"
                            : "refused";
}

static void put_field(FILE *to, const wf_foreseen *f, size_t i) {
    const seen_field *field = &f->fields[i];
    fprintf(to, "  field %" PRId64 ": subframes %" PRId64 "..%" PRId64 " (%" PRId64 ")",
            field->index, field->window.first, field->window.first + field->window.count - 1,
            (int64_t)field->window.count);
    if (field->missing) fprintf(to, ", %" PRId64 " of them missing", field->missing);
    fputc('\n', to);
}

static weft_status put_text(const wf_foreseen *f, weft_job *job, weft_error *err) {
    size_t size;
    free(job->plan);
    job->plan = NULL;
    FILE *to = open_memstream(&job->plan, &size);
    if (!to) return wf_fail(err, WEFT_NO_MEMORY, "no memory for the plan");
    fprintf(to, "%s: %" PRId64 " frames, %zu fields of %s\n", job->output, f->frames,
            f->field_count, job->raster.name);
    fprintf(to, "output: %s, %" PRId64 " there already (%s)\n", f->output, f->present,
            fate(job, f));
    fprintf(to, "input: %" PRId64 " files, %" PRId64 " bytes, opened %" PRId64 " times\n",
            f->files, f->read_bytes, f->opened);
    fprintf(to, "memory: %zu MB at most; threads: %d\n", f->memory_bytes >> 20, f->threads);
    for (size_t i = 0; i < f->field_count; i++) {
        bool middle = f->field_count > 9 && i >= 6 && i + 2 < f->field_count;
        if (!middle)
            put_field(to, f, i);
        else if (i == 6)
            fputs("  ...\n", to);
    }
    return fclose(to) ? wf_fail(err, WEFT_NO_MEMORY, "no memory for the plan") : WEFT_OK;
}

static void add_plan(wf_json *json, const void *plan) {
    const wf_foreseen *f = plan;
    wf_json_open(json, "plan", '{');
    wf_json_int(json, "frames", f->frames);
    wf_json_int(json, "fields_made", (int64_t)f->field_count);
    wf_json_text(json, "output", f->output);
    wf_json_int(json, "present", f->present);
    wf_json_int(json, "files", f->files);
    wf_json_int(json, "opened", f->opened);
    wf_json_int(json, "bytes_to_read", f->read_bytes);
    wf_json_int(json, "memory_bytes", (int64_t)f->memory_bytes);
    wf_json_int(json, "threads", f->threads);
    wf_json_open(json, "fields", '[');
    for (size_t i = 0; i < f->field_count; i++) {
        const seen_field *field = &f->fields[i];
        wf_json_open(json, NULL, '{');
        wf_json_int(json, "field", field->index);
        wf_json_int(json, "first", field->window.first);
        wf_json_int(json, "count", field->window.count);
        wf_json_int(json, "missing", field->missing);
        wf_json_close(json);
    }
    wf_json_close(json);
    wf_json_close(json);
}

weft_status wf_foresee(wf_pipeline *p, wf_report *report, weft_error *err) {
    const wf_setup *s = p->setup;
    int per_frame = wf_raster_fields_per_frame(&p->job->raster);
    size_t most = (size_t)((s->end_frame - s->first_frame) * per_frame) + 1;
    wf_foreseen *f = calloc(1, sizeof *f);
    bool *needed = calloc(s->sequence.count + 1, sizeof *needed);
    if (f) f->fields = calloc(most, sizeof *f->fields);
    report->plan = f;
    if (!f || !needed || !f->fields) {
        free(needed);
        return wf_fail(err, WEFT_NO_MEMORY, "no memory for the plan");
    }
    for (int64_t first = s->first_frame, end; wf_next_frames(p->job, s, &first, &end);) {
        wf_pipeline_foresee(p, first, end, needed);
        see_fields(f, p, first, end);
        first = end;
    }
    see_files(f, s, needed);
    see_outputs(f, p);
    free(needed);
    f->opened = p->opened;
    p->opened = 0;
    f->memory_bytes = p->bytes;
    f->threads = p->threads;
    report->add_plan = add_plan;
    return put_text(f, p->job, err);
}
