/* Sequences of which some subframes exist in a rectangle alone: spans of time, and what each
 * shows. */
#include "convert/run/source/refined.h"

#include <stdlib.h>
#include <string.h>

#include "convert/base/range.h"
#include "convert/media/exr_region.h"

void wf_refined_free(wf_refined *r) {
    for (size_t i = 0; i < r->files; i++) free(r->file[i].ref.path);
    free(r->file);
    free(r->edge_s);
    free(r->latest);
    *r = (wf_refined){0};
}

static weft_status no_memory(weft_error *err) {
    return wf_fail(err, WEFT_NO_MEMORY, "no memory for the times of subframes");
}

/* ---- Files ---- */

/* Whether all of the display window is in a region. */
static bool covers(wf_box region, const wf_image_info *first) {
    return region.x0 <= 0 && region.y0 <= 0 &&
           region.x1 >= first->display.x1 - first->display.x0 &&
           region.y1 >= first->display.y1 - first->display.y0;
}

/* Files are copied: the sequence is made anew if any of them has a region. */
static weft_status read_regions(const wf_image_info *first, const wf_sequence *sequence,
                                wf_refined *r, bool *any, weft_error *err) {
    weft_status status = WEFT_OK;
    *any = false;
    for (size_t k = 0; !status && k < sequence->count; k++) {
        if (!sequence->refs[k].path) continue;
        wf_refined_file *file = &r->file[r->files];
        bool has;
        *file = (wf_refined_file){.ref = sequence->refs[k], .whole = true};
        status = wf_exr_region(sequence->refs[k].path, &file->region, &has, err);
        file->ref.path = strdup(sequence->refs[k].path);
        r->files++;
        if (!file->ref.path) return no_memory(err);
        if (!status && has) *any = true, file->whole = covers(file->region, first);
    }
    return status;
}

/* ---- Times ---- */

static weft_status times_by_files(wf_refined *r, bool *all, weft_error *err) {
    weft_status status = WEFT_OK;
    *all = true;
    for (size_t i = 0; !status && *all && i < r->files; i++) {
        wf_refined_file *file = &r->file[i];
        status = wf_source_time(file->ref.path, file->ref.part, &file->time_s, err);
        *all = !status && wf_ratio_given(file->time_s);
    }
    return status;
}

/* Numbers count as plans number them: the step between files is not the rate's. */
static weft_status times_by_numbers(const weft_job *job, const wf_image_info *first,
                                    const wf_sequence *sequence, wf_refined *r,
                                    weft_error *err) {
    wf_rational rate = job->subframe_rate, step = wf_ratio(1, 1), begin = {0, 1};
    weft_status status = WEFT_OK;
    if (!wf_ratio_given(rate)) {
        status = wf_rate_of_files(job->inputs[0], first, sequence, &rate, err);
        if (first->counts_files)
            rate = first->rate;
        else if (!status)
            step = sequence->number_step;
    }
    if (!job->output_first) begin = sequence->refs[0].number;
    for (size_t i = 0; !status && i < r->files; i++) {
        wf_rational n = wf_number_minus(r->file[i].ref.number, begin);
        r->file[i].time_s = wf_ratio_div(wf_ratio_div(n, step), rate);
        if (!wf_ratio_given(r->file[i].time_s))
            status = wf_fail(err, WEFT_FAILED, "%s: its time is too fine to be counted",
                             r->file[i].ref.path);
    }
    return status;
}

static weft_status check_times(const wf_refined *r, weft_error *err) {
    char here[48], before[48];
    for (size_t i = 1; i < r->files; i++)
        if (wf_number_order(r->file[i - 1].time_s, r->file[i].time_s) >= 0)
            return wf_fail(err, WEFT_FAILED,
                           "%s: its time is %s s, and that of %s, which is before it, %s s; "
                           "times must ascend",
                           r->file[i].ref.path, wf_rate_text(r->file[i].time_s, here),
                           r->file[i - 1].ref.path,
                           wf_rate_text(r->file[i - 1].time_s, before));
    if (r->files && !r->file[0].whole)
        return wf_fail(
            err, WEFT_FAILED,
            "%s: the first subframe has a weft:region, and nothing exists beside it; "
            "render all of it",
            r->file[0].ref.path);
    if (r->files < 2)
        return wf_fail(err, WEFT_FAILED, "%s: one subframe alone has no length; render more",
                       r->file[0].ref.path);
    return WEFT_OK;
}

/* ---- Spans ---- */

static wf_rational middle(wf_rational a, wf_rational b) {
    return wf_ratio_mul(wf_ratio_sum(a, b), wf_ratio(1, 2));
}

static int by_value(const void *a, const void *b) {
    return wf_number_order(*(const wf_rational *)a, *(const wf_rational *)b);
}

static weft_status refuse_layers(const wf_refined_file *file, weft_error *err) {
    return wf_fail(err, WEFT_FAILED,
                   "%s: more than %d subframes with a weft:region and no whole one among them; "
                   "render a whole one now and then",
                   file->ref.path, WF_REFINED_LAYERS);
}

/* Files before some other that one of a pixel of that may follow: none that is later hides
 * them. */
typedef struct open_files {
    const wf_refined_file *file[WF_REFINED_LAYERS];
    int count;
} open_files;

static bool hides(const wf_refined_file *later, const wf_refined_file *file) {
    return later->whole || (!file->whole && wf_box_contains(later->region, file->region));
}

static bool meet(const wf_refined_file *a, const wf_refined_file *b) {
    if (a->whole || b->whole) return true;
    wf_box both = wf_box_overlap(a->region, b->region);
    return both.x0 < both.x1 && both.y0 < both.y1;
}

/* Where cells end between a file and those before it that it follows at some pixel; NULL edges
 * are counted only. */
static size_t follow(open_files *open, const wf_refined_file *file, wf_rational *edges) {
    size_t count = 0;
    int kept = 0;
    for (int i = 0; i < open->count; i++) {
        const wf_refined_file *before = open->file[i];
        if (meet(before, file)) {
            if (edges) edges[count] = middle(before->time_s, file->time_s);
            count++;
        }
        if (!hides(file, before)) open->file[kept++] = before;
    }
    open->count = kept;
    return count;
}

/* All of these, to r->edge_s + *count on if there is any. */
static weft_status add_middles(const wf_refined *r, size_t *count, weft_error *err) {
    open_files open = {.count = 0};
    for (size_t i = 0; i < r->files; i++) {
        *count += follow(&open, &r->file[i], r->edge_s ? r->edge_s + *count : NULL);
        if (open.count == WF_REFINED_LAYERS) return refuse_layers(&r->file[i], err);
        open.file[open.count++] = &r->file[i];
    }
    return WEFT_OK;
}

static size_t without_repeats(wf_rational *edges, size_t count) {
    size_t kept = 0;
    qsort(edges, count, sizeof *edges, by_value);
    for (size_t i = 0; i < count; i++)
        if (!kept || wf_number_order(edges[kept - 1], edges[i])) edges[kept++] = edges[i];
    return kept;
}

/* The last picture lasts as long as the one before. With output frames that do not begin with 0
 * time does, and the first picture stands for what is before it. */
static weft_status set_edges(wf_refined *r, bool from_zero, weft_error *err) {
    const wf_refined_file *f = r->file, *last = f + r->files - 1;
    wf_rational ends = wf_ratio_difference(last->time_s, last[-1].time_s);
    size_t count = 0;
    r->end_s = wf_ratio_sum(last->time_s, ends);
    if (r->center) {
        wf_rational half =
            wf_ratio_mul(wf_ratio_difference(f[1].time_s, f[0].time_s), wf_ratio(1, 2));
        r->edge_s[count++] = wf_ratio_difference(f[0].time_s, half);
        weft_status status = add_middles(r, &count, err);
        if (status) return status;
        ends = wf_ratio_mul(ends, wf_ratio(1, 2));
    } else {
        for (size_t i = 0; i < r->files; i++) r->edge_s[count++] = f[i].time_s;
    }
    r->edge_s[count++] = wf_ratio_sum(last->time_s, ends);
    r->units = without_repeats(r->edge_s, count) - 1;
    r->begin_s = from_zero ? wf_ratio(0, 1) : f[0].time_s;
    if (from_zero && wf_number_order(r->edge_s[0], r->begin_s) > 0) r->edge_s[0] = r->begin_s;
    return WEFT_OK;
}

static void set_latest(wf_refined *r) {
    size_t i = 0;
    for (size_t u = 0; u < r->units; u++) {
        wf_rational at = middle(r->edge_s[u], r->edge_s[u + 1]);
        while (i + 1 < r->files && wf_number_order(r->file[i + 1].time_s, at) <= 0) i++;
        r->latest[u] = i;
    }
}

static weft_status make_spans(const weft_job *job, wf_refined *r, weft_error *err) {
    size_t most = r->files + 2;
    weft_status status = r->center ? add_middles(r, &most, err) : WEFT_OK;
    if (status) return status;
    r->edge_s = calloc(most, sizeof *r->edge_s);
    r->latest = calloc(most, sizeof *r->latest);
    if (!r->edge_s || !r->latest) return no_memory(err);
    status = set_edges(r, job->output_first > 0, err);
    if (status) return status;
    for (size_t u = 0; u <= r->units; u++)
        if (!wf_ratio_given(r->edge_s[u]))
            return wf_fail(err, WEFT_FAILED,
                           "%s: times are too fine; give them with fewer digits",
                           r->file[0].ref.path);
    set_latest(r);
    return WEFT_OK;
}

/* The sequence that the rest of the run sees: a reference for each span. */
static weft_status replace(const wf_refined *r, wf_sequence *sequence, wf_shown *shown,
                           weft_error *err) {
    wf_subframe_ref *refs = calloc(r->units, sizeof *refs);
    wf_rational *times = malloc((r->units + 1) * sizeof *times);
    bool copied = refs && times;
    for (size_t u = 0; copied && u < r->units; u++) {
        refs[u] = r->file[r->latest[u]].ref;
        refs[u].path = strdup(refs[u].path);
        copied = refs[u].path != NULL;
    }
    for (size_t k = 0; copied && k < sequence->count; k++) free(sequence->refs[k].path);
    if (!copied) {
        for (size_t u = 0; refs && u < r->units; u++) free(refs[u].path);
        free(refs);
        free(times);
        return no_memory(err);
    }
    memcpy(times, r->edge_s, (r->units + 1) * sizeof *times);
    free(sequence->refs);
    sequence->refs = refs;
    sequence->count = r->units;
    sequence->missing = 0;
    *sequence->notice = '\0';
    *shown = (wf_shown){.times_s = times};
    return WEFT_OK;
}

weft_status wf_refine_sequence(const weft_job *job, const wf_image_info *first,
                               wf_sequence *sequence, wf_shown *shown, wf_refined *r,
                               weft_error *err) {
    bool any = false, all = true;
    *r = (wf_refined){.center = job->subframe_time_center};
    if (sequence->count < 2) return WEFT_OK;
    r->file = calloc(sequence->count, sizeof *r->file);
    if (!r->file) return no_memory(err);
    weft_status status = read_regions(first, sequence, r, &any, err);
    if (status || !any) {
        wf_refined_free(r);
        return status;
    }
    status = times_by_files(r, &all, err);
    if (!status && !all) status = times_by_numbers(job, first, sequence, r, err);
    if (!status) status = check_times(r, err);
    if (!status) status = make_spans(job, r, err);
    if (!status) status = replace(r, sequence, shown, err);
    return status;
}

/* ---- What a span shows ---- */

/* Files between two whole ones that hide or leave open what a span shows. */
typedef struct stacking {
    const wf_refined *r;
    wf_rational at; /* the middle of the span */
    const wf_refined_file **stack;
    int count;
} stacking;

/* How far a file's time lies from the span. */
static wf_rational distance(const stacking *s, const wf_refined_file *file) {
    wf_rational d = wf_ratio_difference(s->at, file->time_s);
    return d.num < 0 ? (wf_rational){-d.num, d.den} : d;
}

static bool is_hidden(const stacking *s, const wf_refined_file *file) {
    for (int i = 0; i < s->count; i++)
        if (s->stack[i]->whole ||
            (!file->whole && wf_box_contains(s->stack[i]->region, file->region)))
            return true;
    return false;
}

/* From the nearest in time on, to the first that is whole; what nearer ones cover is left out.
 */
static bool add(stacking *s, const wf_refined_file *file) {
    if (is_hidden(s, file)) return true;
    if (s->count == WF_REFINED_LAYERS) return false;
    s->stack[s->count++] = file;
    return true;
}

weft_status wf_refined_stack(const wf_refined *r, size_t unit,
                             const wf_refined_file *stack[WF_REFINED_LAYERS], int *count,
                             weft_error *err) {
    stacking s = {.r = r, .stack = stack};
    const wf_refined_file *first = r->file, *end = r->file + r->files;
    const wf_refined_file *before = first + r->latest[unit], *after = before + 1;
    bool whole = false, room = true;
    s.at = middle(r->edge_s[unit], r->edge_s[unit + 1]);
    while (!whole && room) {
        bool has_before = before >= first, has_after = r->center && after < end;
        if (!has_before && !has_after) break;
        bool take_after =
            has_after &&
            (!has_before || wf_number_order(distance(&s, after), distance(&s, before)) < 0);
        const wf_refined_file *next = take_after ? after++ : before--;
        room = add(&s, next);
        whole = next->whole;
    }
    for (int i = 0; i < s.count / 2; i++) {
        const wf_refined_file *swap = stack[i];
        stack[i] = stack[s.count - 1 - i];
        stack[s.count - 1 - i] = swap;
    }
    *count = s.count;
    if (room) return WEFT_OK;
    return refuse_layers(&first[r->latest[unit]], err);
}
