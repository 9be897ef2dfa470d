/* Refining: what is rendered so far, which of the subframes of each field are needed first, and
 * which rectangles of others the estimates want. */
#include "convert/plan/refine.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "convert/base/names.h"
#include "convert/base/range.h"
#include "convert/media/exr_region.h"
#include "convert/read/rate.h"
#include "convert/read/sequence.h"
#include "convert/read/source.h"

static weft_status check_canceled(const wf_plan *plan, weft_error *err) {
    return plan->asked->canceled ? wf_fail(err, WEFT_INTERRUPTED, "interrupted") : WEFT_OK;
}

static wf_box whole_of(const wf_plan *plan) {
    return (wf_box){0, 0, plan->width_px, plan->lines};
}

void wf_refine_want(const wf_refining *r, wf_refine_slot *slot, wf_box box) {
    box = wf_box_overlap(box, whole_of(r->plan));
    if (slot->whole) return;
    if (slot->path) {
        if (wf_box_contains(slot->region, box)) return;
        box = wf_box_around(slot->region, box);
    }
    slot->wanted = slot->is_wanted ? wf_box_around(slot->wanted, box) : box;
    slot->is_wanted = true;
}

/* ---- What is there ---- */

/* Whether a folder holds no picture; what else lies there, such as a job, is nobody's concern.
 */
static weft_status look_into(const char *folder, bool *empty, weft_error *err) {
    wf_names names = {0};
    weft_error why;
    weft_status status = wf_names_read(folder, &names, &why);
    *empty = true;
    for (const char *name = NULL; (name = wf_names_next(&names, name));)
        if (wf_name_is_picture(name)) *empty = false;
    wf_names_free(&names);
    if (!status) return WEFT_OK;
    return wf_fail(err, status,
                   "--refine %.600s; give the folder that the subframes are rendered into, "
                   "which may be empty",
                   why.text);
}

static weft_status check_size(const wf_plan *plan, const char *path, weft_error *err) {
    const wf_source_options options = {.max_memory_bytes = plan->job.max_memory_bytes};
    wf_subframe *picture;
    weft_status status = wf_subframe_open(path, -1, &options, &picture, err);
    if (status) return status;
    wf_box display = wf_subframe_info(picture)->display;
    int width = display.x1 - display.x0, lines = display.y1 - display.y0;
    wf_subframe_close(picture);
    if (width == plan->width_px && lines == plan->lines) return WEFT_OK;
    int whole = plan->job.raster.lines;
    bool can_be = lines % (whole % 2 ? whole : whole / 2) == 0;
    return wf_fail(err, WEFT_FAILED,
                   can_be
                       ? "%s: it is %dx%d, and subframes of this plan are %dx%d; give --size "
                         "%dx%d, or render it again"
                       : "%s: it is %dx%d, and subframes of this plan are %dx%d; render it "
                         "again, or give the folder of this plan's",
                   path, width, lines, plan->width_px, plan->lines, width, lines);
}

/* Whether a file's weft:time, where it has one, is that of its number in the plan. */
static weft_status is_of_plan(const wf_plan *plan, const wf_subframe_ref *ref, bool *has_time,
                              bool *fits, weft_error *err) {
    wf_rational time_s, wished = wf_ratio_div(ref->number, plan->rate);
    weft_status status = wf_source_time(ref->path, ref->part, &time_s, err);
    *has_time = !status && wf_ratio_given(time_s);
    *fits = !*has_time || !wf_number_order(time_s, wished);
    return status;
}

static weft_status check_time(const wf_plan *plan, const wf_subframe_ref *ref,
                              weft_error *err) {
    bool has_time, fits;
    char rate[48];
    weft_status status = is_of_plan(plan, ref, &has_time, &fits, err);
    if (status || fits) return status;
    return wf_fail(err, WEFT_FAILED,
                   "%s: its weft:time is not that of its number at %s subframes a second; "
                   "give the --subframe-rate that it was planned with, or another folder",
                   ref->path, wf_rate_text(plan->rate, rate));
}

static weft_status take_file(const wf_plan *plan, wf_refine_slot *slot,
                             const wf_subframe_ref *ref, weft_error *err) {
    bool has;
    weft_status status = check_size(plan, ref->path, err);
    if (!status) status = check_time(plan, ref, err);
    if (!status) status = wf_exr_region(ref->path, &slot->region, &has, err);
    if (status) return status;
    slot->path = strdup(ref->path);
    if (!slot->path) return wf_fail(err, WEFT_NO_MEMORY, "%s: out of memory", ref->path);
    slot->whole = !has || wf_box_contains(slot->region, whole_of(plan));
    if (slot->whole) slot->region = whole_of(plan);
    return WEFT_OK;
}

/* A file alone whose name has no number is counted as 0. */
static bool is_numbered(const wf_subframe_ref *ref) {
    wf_numbered unused;
    return wf_name_number_of(wf_base_name(ref->path), 0, &unused);
}

/* Files that are of other frames of the same shot say so by their times. */
static weft_status refuse_foreign(const wf_plan *plan, const wf_sequence *found,
                                  weft_error *err) {
    bool has_time, fits;
    weft_status status = is_of_plan(plan, &found->refs[0], &has_time, &fits, err);
    if (status || (has_time && fits && is_numbered(&found->refs[0]))) return status;
    return wf_fail(
        err, WEFT_FAILED,
        "--refine %.500s: none of its files has a number of this plan, which are %" PRId64
        " to %" PRId64 "; give the folder of these subframes, and the options that they "
        "were planned with",
        plan->job.refine, plan->subframe[0].number, plan->subframe[plan->count - 1].number);
}

/* Numbers of the folder that the plan has not are nobody's concern here. */
static weft_status take_files(wf_refining *r, const wf_sequence *found, weft_error *err) {
    size_t slot = 0, taken = 0;
    weft_status status = WEFT_OK;
    for (size_t k = 0; !status && k < found->count; k++) {
        const wf_subframe_ref *ref = &found->refs[k];
        while (slot < r->slots && r->slot[slot].number < ref->number.num) slot++;
        if (slot == r->slots) break;
        if (!ref->path || ref->number.den != 1 || r->slot[slot].number != ref->number.num ||
            !is_numbered(ref))
            continue;
        status = check_canceled(r->plan, err);
        if (!status) status = take_file(r->plan, &r->slot[slot], ref, err);
        taken++;
    }
    return status || taken ? status : refuse_foreign(r->plan, found, err);
}

static weft_status find_files(wf_refining *r, weft_error *err) {
    char *inputs[] = {r->plan->job.refine};
    bool empty;
    wf_sequence found = {0};
    weft_status status = look_into(r->plan->job.refine, &empty, err);
    if (status || empty) return status;
    status = wf_sequence_expand(inputs, 1, NULL, &found, err);
    if (!status) status = take_files(r, &found, err);
    wf_sequence_free(&found);
    return status;
}

/* ---- Fields ---- */

static size_t slot_of(const wf_refining *r, int64_t number) {
    size_t low = 0, high = r->slots;
    while (low < high) {
        size_t at = low + (high - low) / 2;
        if (r->slot[at].number < number)
            low = at + 1;
        else
            high = at;
    }
    return low;
}

/* The first of a field's window is needed whole, and a later one that is not before its last,
 * before anything can be said of those between. What moves alike in every field, as spokes do,
 * is seen by none of the first ones: two of a field see it. Every few fields have two, and what
 * moves in these is taken to move in those between. */
enum { FIELDS_FOR_TWO = 8 };

static bool has_two(const wf_plan *plan, int64_t field) {
    return (field - plan->first_field) % FIELDS_FOR_TWO == 0 || field == plan->end_field - 1;
}

/* The slots of a field's window. */
static void window_of(const wf_refining *r, int64_t field, size_t *first, size_t *last) {
    wf_window window = wf_resampler_window(r->plan->resampler, field);
    *first = slot_of(r, window.first);
    *last = slot_of(r, window.first + window.count - 1);
}

static weft_status refine_field(wf_refining *r, int64_t field, weft_error *err) {
    size_t first, last, after;
    window_of(r, field, &first, &last);
    bool two = has_two(r->plan, field);
    wf_refine_want(r, &r->slot[first], whole_of(r->plan));
    if (two) wf_refine_want(r, &r->slot[last], whole_of(r->plan));
    for (after = last; after < r->slots && !r->slot[after].whole;) after++;
    bool ready = r->slot[first].whole && after < r->slots && (!two || r->slot[last].whole);
    return ready ? wf_refine_estimate(r, field, first, after,
                                      &r->moved[field - r->plan->first_field], err)
                 : WEFT_OK;
}

/* Fields between two of two: what moves in these is looked for in them. */
static void look_between(wf_refining *r, int64_t field) {
    const wf_plan *plan = r->plan;
    int64_t at = field - plan->first_field, before = at / FIELDS_FOR_TWO * FIELDS_FOR_TWO;
    int64_t after = before + FIELDS_FOR_TWO, end = plan->end_field - plan->first_field - 1;
    size_t first, last;
    wf_box box = wf_box_around(r->moved[before], r->moved[after < end ? after : end]);
    window_of(r, field, &first, &last);
    if (box.x0 < box.x1 && last > first) wf_refine_want(r, &r->slot[last], box);
}

static weft_status refine_fields(wf_refining *r, weft_error *err) {
    const wf_plan *plan = r->plan;
    weft_status status = WEFT_OK;
    for (int64_t n = plan->first_field; !status && n < plan->end_field; n++) {
        status = check_canceled(plan, err);
        if (!status) status = refine_field(r, n, err);
    }
    for (int64_t n = plan->first_field; !status && n < plan->end_field; n++)
        if (!has_two(plan, n)) look_between(r, n);
    return status;
}

/* ---- The plan of it ---- */

static weft_status begin(const wf_plan *plan, wf_refining *r, weft_error *err) {
    if (!wf_ratio_given(plan->job.error))
        return wf_fail(
            err, WEFT_USAGE,
            "--refine needs to know how far off pixels may be; give --error too, such "
            "as --error 0.005");
    if (plan->job.raster.pulldown)
        return wf_fail(err, WEFT_USAGE,
                       "--refine and --cadence: film is converted at an even rate, and what is "
                       "refined has times of its own; plan without --refine");
    size_t fields = (size_t)(plan->end_field - plan->first_field);
    *r = (wf_refining){plan, wf_ratio_value(plan->job.error),
                       calloc(plan->count + 1, sizeof *r->slot), plan->count,
                       calloc(fields, sizeof *r->moved)};
    if (!r->slot || !r->moved) return wf_fail(err, WEFT_NO_MEMORY, "no memory for the plan");
    for (size_t i = 0; i < r->slots; i++) r->slot[i].number = plan->subframe[i].number;
    return WEFT_OK;
}

static void end(const wf_refining *r, wf_plan *plan) {
    plan->count = 0;
    for (size_t i = 0; i < r->slots; i++)
        if (r->slot[i].is_wanted)
            plan->subframe[plan->count++] =
                (wf_plan_subframe){r->slot[i].number, r->slot[i].wanted};
}

weft_status wf_plan_refine(wf_plan *plan, weft_error *err) {
    wf_refining r = {0};
    weft_status status = begin(plan, &r, err);
    if (!status) status = find_files(&r, err);
    if (!status) status = refine_fields(&r, err);
    if (!status) end(&r, plan);
    for (size_t i = 0; i < r.slots && r.slot; i++) free(r.slot[i].path);
    free(r.slot);
    free(r.moved);
    return status;
}
