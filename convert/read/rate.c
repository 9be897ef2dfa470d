/* The rate of a sequence, from what its files say and how they are numbered. */
#include "convert/read/rate.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "convert/base/range.h"
#include "convert/read/selection.h"
#include "convert/read/source.h"

#define LOWEST_RATE  1e-3
#define HIGHEST_RATE 1e6

static weft_status refuse(const char *input, const char *says, weft_error *err) {
    return wf_fail(err, WEFT_FAILED,
                   "%s: the files say %s, which is no rate of pictures; give --subframe-rate, "
                   "such as --subframe-rate 240 or 480000/1001",
                   wf_path_tail(input), says);
}

weft_status wf_rate_of_files(const char *input, const wf_image_info *first,
                             const wf_sequence *sequence, wf_rational *rate, weft_error *err) {
    char text[48], says[160];
    if (*first->no_rate && !first->counts_files) return refuse(input, first->no_rate, err);
    if (!wf_ratio_given(first->rate))
        return wf_fail(err, WEFT_USAGE,
                       "%s: the files do not say how many subframes a second they are; give "
                       "--subframe-rate, such as --subframe-rate 240 or 480000/1001",
                       wf_path_tail(input));
    *rate =
        wf_ratio_div(first->rate, first->counts_files ? sequence->step : sequence->number_step);
    bool given = wf_ratio_given(*rate);
    double value = given ? wf_ratio_value(*rate) : 0;
    if (value >= LOWEST_RATE && value <= HIGHEST_RATE) return WEFT_OK;
    snprintf(says, sizeof says, "%s a second in steps of %.9g", wf_rate_text(first->rate, text),
             wf_ratio_value(first->counts_files ? sequence->step : sequence->number_step));
    return refuse(input, says, err);
}

const char *wf_rate_text(wf_rational rate, char text[48]) {
    int used = snprintf(text, 48, "%" PRId64, rate.num);
    if (rate.den != 1) snprintf(text + used, 48 - (size_t)used, "/%" PRId64, rate.den);
    return text;
}

/* ---- Times ---- */

void wf_shown_free(wf_shown *shown) {
    free(shown->times_s);
    *shown = (wf_shown){0};
}

/* Whether an absent number is a missing file: a range has asked for it, or at least half of the
 * numbers are there. Else numbers are names of times. */
static bool misses(const wf_sequence *sequence) {
    return sequence->ranged || 2 * sequence->missing <= sequence->count;
}

/* The files of a sequence that are there, with their times. */
typedef struct timed {
    const wf_subframe_ref **ref;
    wf_rational *time_s; /* and space for one more */
    size_t count;
} timed;

static weft_status refuse_order(const timed *t, size_t k, weft_error *err) {
    char before[48], here[48];
    return wf_fail(err, WEFT_FAILED,
                   "%s: its weft:time is %s s, and that of %s, which is before it, %s s; times "
                   "must ascend, or --subframe-rate says how many subframes a second there are",
                   t->ref[k]->path, wf_rate_text(t->time_s[k], here), t->ref[k - 1]->path,
                   wf_rate_text(t->time_s[k - 1], before));
}

/* *all is false where a file has no time. */
static weft_status read_times(const wf_sequence *sequence, timed *t, bool *all,
                              weft_error *err) {
    weft_status status = WEFT_OK;
    *all = true;
    for (size_t k = 0; !status && *all && k < sequence->count; k++) {
        const wf_subframe_ref *ref = &sequence->refs[k];
        if (!ref->path) continue;
        size_t n = t->count++;
        t->ref[n] = ref;
        status = wf_source_time(ref->path, ref->part, &t->time_s[n], err);
        *all = !status && wf_ratio_given(t->time_s[n]);
        if (*all && n && wf_number_order(t->time_s[n - 1], t->time_s[n]) >= 0)
            status = refuse_order(t, n, err);
    }
    return status;
}

/* The seconds from number to number, if times grow evenly with numbers; else {0, 0}. */
static wf_rational even_step(const timed *t) {
    const wf_rational none = {0, 0};
    wf_rational from = t->ref[0]->number, start = t->time_s[0];
    size_t last = t->count - 1;
    wf_rational each = wf_ratio_div(wf_ratio_difference(t->time_s[last], start),
                                    wf_ratio_difference(t->ref[last]->number, from));
    for (size_t k = 1; k < last; k++) {
        wf_rational should = wf_ratio_mul(each, wf_ratio_difference(t->ref[k]->number, from));
        if (!wf_ratio_equal(wf_ratio_difference(t->time_s[k], start), should)) return none;
    }
    return each;
}

static void drop_missing(wf_sequence *sequence) {
    size_t kept = 0;
    for (size_t k = 0; k < sequence->count; k++)
        if (sequence->refs[k].path) sequence->refs[kept++] = sequence->refs[k];
    if (misses(sequence) && sequence->missing)
        wf_sequence_tell(
            sequence,
            "numbers are absent (%zu), and their times are not known: the pictures "
            "before them are shown longer",
            sequence->missing);
    sequence->count = kept;
    sequence->missing = 0;
}

static weft_status settle_times(const char *input, timed *t, wf_sequence *sequence,
                                wf_shown *shown, weft_error *err) {
    wf_rational each = misses(sequence) ? even_step(t) : (wf_rational){0, 0};
    if (wf_ratio_given(each)) {
        wf_rational apart = wf_ratio_mul(each, sequence->number_step);
        shown->rate = wf_ratio_div(wf_ratio(1, 1), apart);
        if (wf_ratio_given(shown->rate)) return WEFT_OK;
    }
    size_t n = t->count;
    drop_missing(sequence);
    t->time_s[n] =
        wf_ratio_sum(t->time_s[n - 1], wf_ratio_difference(t->time_s[n - 1], t->time_s[n - 2]));
    if (!wf_ratio_given(t->time_s[n]))
        return wf_fail(err, WEFT_FAILED,
                       "%s: the files' weft:time are too fine; give them with fewer digits",
                       wf_path_tail(input));
    shown->times_s = t->time_s;
    t->time_s = NULL;
    return WEFT_OK;
}

weft_status wf_shown_by_files(const char *input, const wf_image_info *first,
                              wf_sequence *sequence, wf_shown *shown, weft_error *err) {
    *shown = (wf_shown){0};
    size_t present = sequence->count - sequence->missing;
    bool all = wf_ratio_given(first->time_s) && present > 1;
    if (!all) return wf_rate_of_files(input, first, sequence, &shown->rate, err);
    timed t = {calloc(present, sizeof *t.ref), calloc(present + 1, sizeof *t.time_s), 0};
    weft_status status = t.ref && t.time_s
                             ? read_times(sequence, &t, &all, err)
                             : wf_fail(err, WEFT_NO_MEMORY, "no memory for times");
    if (!status && all) status = settle_times(input, &t, sequence, shown, err);
    free(t.ref);
    free(t.time_s);
    return status || all ? status : wf_rate_of_files(input, first, sequence, &shown->rate, err);
}
