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

static const char *fate(const weft_job *job, const wf_dry_run *d) {
    return !d->present      ? "new"
           : job->overwrite ? "overwritten"
           : job->resume    ? "kept"
                            : "refused";
}

static void put_outputs(FILE *to, const wf_dry_run *d, const weft_job *job) {
    fprintf(to, "output: %s, %" PRId64 " there already (%s)\n", d->kind, d->present,
            fate(job, d));
    if (!d->outputs) fputs("files: none, all of it is there\n", to);
    if (d->outputs == 1) fprintf(to, "files: %s\n", d->first_output);
    if (d->outputs > 1)
        fprintf(to, "files: %s .. %s (%" PRId64 ")\n", d->first_output, d->last_output,
                d->outputs);
    bool plain = d->size.known == WF_SIZE_EXACT;
    if (d->size.known == WF_SIZE_UNKNOWN)
        fprintf(to, "bytes: %s\n", d->outputs ? "not known, the codec decides" : "0");
    else
        fprintf(to, "bytes: %s%s%" PRId64 "\n", plain ? "" : sizes[d->size.known],
                plain ? "" : " ", d->size.bytes);
}

static void put_field(FILE *to, const wf_dry_run *d, size_t i) {
    const wf_dry_field *field = &d->fields[i];
    fprintf(to, "  field %" PRId64 ": %.6f to %.6f s", field->index, field->from_s,
            field->to_s);
    if (d->reads)
        fprintf(to, ", subframes %" PRId64 "..%" PRId64 " (%" PRId64 ")", field->needs.first,
                field->needs.end - 1, field->needs.end - field->needs.first);
    if (field->missing) fprintf(to, ", %" PRId64 " of them missing", field->missing);
    fputc('\n', to);
}

/* "input layer: rgba (file)". */
static void put_taken(FILE *to, const wf_taken_list *taken) {
    for (int i = 0; i < taken->count; i++) {
        const wf_taken *row = &taken->row[i];
        fprintf(to, "input %s: %s (%s)\n", row->key,
                *row->value ? row->value : "without a name", row->reason);
    }
}

static void put_all(FILE *to, const wf_dry_run *d, const weft_job *job) {
    if (d->fields)
        fprintf(to, "%s: %" PRId64 " frames, %zu fields of %s\n", job->output, d->frames,
                d->field_count, job->raster.name);
    else
        fprintf(to, "%s: %" PRId64 " subframes for %s\n", job->output, d->frames,
                job->raster.name);
    put_outputs(to, d, job);
    if (d->reads)
        fprintf(to, "input: %" PRId64 " files, %" PRId64 " bytes, opened %" PRId64 " times\n",
                d->files, d->read_bytes, d->opened);
    put_taken(to, d->taken);
    if (d->samples >= 0) fprintf(to, "samples: %" PRId64 "\n", d->samples);
    if (d->reads)
        fprintf(to, "memory: %zu MB at most; threads: %d\n", d->memory_bytes >> 20, d->threads);
    for (size_t i = 0; i < d->field_count; i++) {
        bool middle = d->field_count > 9 && i >= 6 && i + 2 < d->field_count;
        if (!middle)
            put_field(to, d, i);
        else if (i == 6)
            fputs("  ...\n", to);
    }
}

weft_status wf_dry_run_text(const wf_dry_run *d, weft_job *job, weft_error *err) {
    size_t size;
    free(job->plan);
    job->plan = NULL;
    FILE *to = open_memstream(&job->plan, &size);
    if (to) put_all(to, d, job);
    if (to && !fclose(to)) return WEFT_OK;
    return wf_fail(err, WEFT_NO_MEMORY, "no memory for the plan");
}

/* ---- For the report ---- */

static void add_field(wf_json *json, const wf_dry_run *d, const wf_dry_field *field) {
    wf_json_open(json, NULL, '{');
    wf_json_int(json, "field", field->index);
    wf_json_real(json, "from_s", field->from_s);
    wf_json_real(json, "to_s", field->to_s);
    if (d->reads) {
        wf_json_int(json, "first", field->needs.first);
        wf_json_int(json, "count", field->needs.end - field->needs.first);
        wf_json_int(json, "missing", field->missing);
    }
    wf_json_close(json);
}

static void add_outputs(wf_json *json, const wf_dry_run *d) {
    wf_json_text(json, "output", d->kind);
    wf_json_int(json, "present", d->present);
    wf_json_int(json, "outputs", d->outputs);
    if (d->outputs) {
        wf_json_text(json, "first_output", d->first_output);
        wf_json_text(json, "last_output", d->last_output);
    }
    if (!d->outputs || d->size.known) wf_json_int(json, "bytes_to_write", d->size.bytes);
    wf_json_text(json, "bytes_known", sizes[d->outputs ? d->size.known : WF_SIZE_EXACT]);
}

void wf_dry_run_json(wf_json *json, const void *plan) {
    const wf_dry_run *d = plan;
    wf_json_open(json, "plan", '{');
    wf_json_int(json, "frames", d->frames);
    wf_json_int(json, "fields_made", (int64_t)d->field_count);
    add_outputs(json, d);
    if (d->reads) {
        wf_json_int(json, "files", d->files);
        wf_json_int(json, "opened", d->opened);
        wf_json_int(json, "bytes_to_read", d->read_bytes);
        wf_json_int(json, "memory_bytes", (int64_t)d->memory_bytes);
        wf_json_int(json, "threads", d->threads);
    }
    if (d->samples >= 0) wf_json_int(json, "samples", d->samples);
    wf_json_open(json, "fields", '[');
    for (size_t i = 0; i < d->field_count; i++) add_field(json, d, &d->fields[i]);
    wf_json_close(json);
    wf_json_close(json);
}
