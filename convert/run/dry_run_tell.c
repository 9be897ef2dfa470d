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

static const char *fate(const weft_job *job, const wf_dry_output *o) {
    return !o->present      ? "new"
           : job->overwrite ? "overwritten"
           : job->resume    ? "kept"
                            : "refused";
}

static void put_output(FILE *to, const wf_dry_output *o, const char *what,
                       const weft_job *job) {
    if (!o->kind) return;
    fprintf(to, "%s: %s, %" PRId64 " there already (%s)\n", what, o->kind, o->present,
            fate(job, o));
    if (!o->files) fputs("files: none, all of it is there\n", to);
    if (o->files == 1) fprintf(to, "files: %s\n", o->first);
    if (o->files > 1)
        fprintf(to, "files: %s .. %s (%" PRId64 ")\n", o->first, o->last, o->files);
    bool plain = o->size.known == WF_SIZE_EXACT;
    if (o->size.known == WF_SIZE_UNKNOWN)
        fprintf(to, "bytes: %s\n", o->files ? "not known, the codec decides" : "0");
    else
        fprintf(to, "bytes: %s%s%" PRId64 "\n", plain ? "" : sizes[o->size.known],
                plain ? "" : " ", o->size.bytes);
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
    put_output(to, &d->output, "output", job);
    put_output(to, &d->key, "key", job);
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

static void add_output(wf_json *json, const wf_dry_output *o) {
    wf_json_text(json, "output", o->kind);
    wf_json_int(json, "present", o->present);
    wf_json_int(json, "outputs", o->files);
    if (o->files) {
        wf_json_text(json, "first_output", o->first);
        wf_json_text(json, "last_output", o->last);
    }
    if (!o->files || o->size.known) wf_json_int(json, "bytes_to_write", o->size.bytes);
    wf_json_text(json, "bytes_known", sizes[o->files ? o->size.known : WF_SIZE_EXACT]);
}

static void add_key(wf_json *json, const wf_dry_output *key) {
    if (!key->kind) return;
    wf_json_open(json, "key", '{');
    add_output(json, key);
    wf_json_close(json);
}

void wf_dry_run_json(wf_json *json, const void *plan) {
    const wf_dry_run *d = plan;
    wf_json_open(json, "plan", '{');
    wf_json_int(json, "frames", d->frames);
    wf_json_int(json, "fields_made", (int64_t)d->field_count);
    add_output(json, &d->output);
    add_key(json, &d->key);
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
