/* --dry-run: telling what would be done. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "convert/run/dry_run_parts.h"

/* By wf_size_known. */
static const char *const sizes[] = {
    [WF_SIZE_UNKNOWN] = "not known",
    [WF_SIZE_EXACT] = "exact",
    [WF_SIZE_ABOUT] = "about",
    [WF_SIZE_MOST] = "at most",
};

/* ---- For people ---- */

static const char *fate(const weft_job *job, const wf_foreseen *f) {
    return !f->present      ? "new"
           : job->overwrite ? "overwritten"
           : job->resume    ? "kept"
                            : "refused";
}

static void put_outputs(FILE *to, const wf_foreseen *f, const weft_job *job) {
    fprintf(to, "output: %s, %" PRId64 " there already (%s)\n", f->kind, f->present,
            fate(job, f));
    if (!f->outputs) fputs("files: none, all of it is there\n", to);
    if (f->outputs == 1) fprintf(to, "files: %s\n", f->first_output);
    if (f->outputs > 1)
        fprintf(to, "files: %s .. %s (%" PRId64 ")\n", f->first_output, f->last_output,
                f->outputs);
    bool plain = f->size.known == WF_SIZE_EXACT;
    if (f->size.known == WF_SIZE_UNKNOWN)
        fprintf(to, "bytes: %s\n", f->outputs ? "not known, the codec decides" : "0");
    else
        fprintf(to, "bytes: %s%s%" PRId64 "\n", plain ? "" : sizes[f->size.known],
                plain ? "" : " ", f->size.bytes);
}

static void put_field(FILE *to, const wf_foreseen *f, size_t i) {
    const wf_seen_field *field = &f->fields[i];
    fprintf(to, "  field %" PRId64 ": %.6f to %.6f s", field->index, field->from_s,
            field->to_s);
    if (f->reads)
        fprintf(to, ", subframes %" PRId64 "..%" PRId64 " (%" PRId64 ")", field->window.first,
                field->window.first + field->window.count - 1, field->window.count);
    if (field->missing) fprintf(to, ", %" PRId64 " of them missing", field->missing);
    fputc('\n', to);
}

static void put_all(FILE *to, const wf_foreseen *f, const weft_job *job) {
    if (f->fields)
        fprintf(to, "%s: %" PRId64 " frames, %zu fields of %s\n", job->output, f->frames,
                f->field_count, job->raster.name);
    else
        fprintf(to, "%s: %" PRId64 " subframes for %s\n", job->output, f->frames,
                job->raster.name);
    put_outputs(to, f, job);
    if (f->reads)
        fprintf(to, "input: %" PRId64 " files, %" PRId64 " bytes, opened %" PRId64 " times\n",
                f->files, f->read_bytes, f->opened);
    if (f->samples >= 0) fprintf(to, "samples: %" PRId64 "\n", f->samples);
    if (f->memory_bytes)
        fprintf(to, "memory: %zu MB at most; threads: %d\n", f->memory_bytes >> 20, f->threads);
    for (size_t i = 0; i < f->field_count; i++) {
        bool middle = f->field_count > 9 && i >= 6 && i + 2 < f->field_count;
        if (!middle)
            put_field(to, f, i);
        else if (i == 6)
            fputs("  ...\n", to);
    }
}

weft_status wf_foreseen_text(const wf_foreseen *f, weft_job *job, weft_error *err) {
    size_t size;
    free(job->plan);
    job->plan = NULL;
    FILE *to = open_memstream(&job->plan, &size);
    if (to) put_all(to, f, job);
    if (to && !fclose(to)) return WEFT_OK;
    return wf_fail(err, WEFT_NO_MEMORY, "no memory for the plan");
}

/* ---- For the report ---- */

static void add_field(wf_json *json, const wf_foreseen *f, const wf_seen_field *field) {
    wf_json_open(json, NULL, '{');
    wf_json_int(json, "field", field->index);
    wf_json_real(json, "from_s", field->from_s);
    wf_json_real(json, "to_s", field->to_s);
    if (f->reads) {
        wf_json_int(json, "first", field->window.first);
        wf_json_int(json, "count", field->window.count);
        wf_json_int(json, "missing", field->missing);
    }
    wf_json_close(json);
}

static void add_outputs(wf_json *json, const wf_foreseen *f) {
    wf_json_text(json, "output", f->kind);
    wf_json_int(json, "present", f->present);
    wf_json_int(json, "outputs", f->outputs);
    if (f->outputs) {
        wf_json_text(json, "first_output", f->first_output);
        wf_json_text(json, "last_output", f->last_output);
    }
    if (!f->outputs || f->size.known) wf_json_int(json, "bytes_to_write", f->size.bytes);
    wf_json_text(json, "bytes_known", sizes[f->outputs ? f->size.known : WF_SIZE_EXACT]);
}

void wf_foreseen_json(wf_json *json, const void *plan) {
    const wf_foreseen *f = plan;
    wf_json_open(json, "plan", '{');
    wf_json_int(json, "frames", f->frames);
    wf_json_int(json, "fields_made", (int64_t)f->field_count);
    add_outputs(json, f);
    if (f->reads) {
        wf_json_int(json, "files", f->files);
        wf_json_int(json, "opened", f->opened);
        wf_json_int(json, "bytes_to_read", f->read_bytes);
        wf_json_int(json, "memory_bytes", (int64_t)f->memory_bytes);
        wf_json_int(json, "threads", f->threads);
    }
    if (f->samples >= 0) wf_json_int(json, "samples", f->samples);
    wf_json_open(json, "fields", '[');
    for (size_t i = 0; i < f->field_count; i++) add_field(json, f, &f->fields[i]);
    wf_json_close(json);
    wf_json_close(json);
}
