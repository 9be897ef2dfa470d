/* Which numbered files a job takes, and which of them are missing. */
#include "convert/read/selection.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/base/range.h"
#include "convert/base/numbers.h"

#define LONGEST_SHOWN 300

const char *wf_path_tail(const char *path) {
    size_t length = strlen(path);
    return length > LONGEST_SHOWN ? path + length - LONGEST_SHOWN : path;
}

void wf_sequence_free(wf_sequence *sequence) {
    for (size_t k = 0; k < sequence->count; k++) free(sequence->refs[k].path);
    free(sequence->refs);
    *sequence = (wf_sequence){0};
}

void wf_sequence_tell(wf_sequence *sequence, const char *format, ...) {
    va_list arguments;
    size_t used = strlen(sequence->notice), size = sizeof sequence->notice;
    if (used) used += (size_t)snprintf(sequence->notice + used, size - used, "; ");
    if (used >= size) return;
    va_start(arguments, format);
    vsnprintf(sequence->notice + used, size - used, format, arguments);
    va_end(arguments);
}

/* ---- Which numbers ---- */

/* The numbers to take: listed, or first + k step. */
typedef struct selection {
    wf_rational *listed;
    wf_rational first, step;
    size_t count;
} selection;

static wf_rational selected(const selection *s, size_t k) {
    if (s->listed) return s->listed[k];
    /* This does not overflow, since the last of them is the number of a file. */
    return wf_number_minus(s->first, wf_ratio_mul(s->step, (wf_rational){-(int64_t)k, 1}));
}

static weft_status refuse_twice(const wf_candidates *from, size_t i, weft_error *err) {
    char number[48];
    return wf_fail(err, WEFT_FAILED,
                   "%s: number %s is there twice, as %.250s and as %.250s; remove one of them",
                   wf_path_tail(from->input),
                   wf_number_text(from->entry[i].number, number, sizeof number),
                   from->entry[i - 1].name, from->entry[i].name);
}

static weft_status check_candidates(const wf_candidates *from, weft_error *err) {
    for (size_t i = 1; i < from->count; i++)
        if (!wf_number_order(from->entry[i - 1].number, from->entry[i].number))
            return refuse_twice(from, i, err);
    return WEFT_OK;
}

static weft_status take_all(const wf_candidates *from, wf_rational natural, selection *out,
                            weft_error *err) {
    wf_rational first = from->entry[0].number, last = from->entry[from->count - 1].number;
    int64_t count = wf_number_count(first, last, natural);
    *out = (selection){.first = first, .step = natural, .count = (size_t)count};
    if (count <= from->most) return WEFT_OK;
    char a[48], b[48];
    return wf_fail(err, WEFT_FAILED,
                   "%s: %zu files with numbers from %s to %s are spread over more than %" PRId64
                   "; select some of them with --frames",
                   wf_path_tail(from->input), from->count, wf_number_text(first, a, sizeof a),
                   wf_number_text(last, b, sizeof b), from->most);
}

static weft_status take_range(const wf_candidates *from, const char *frames, selection *out,
                              weft_error *err) {
    wf_frame_range range;
    weft_status status = wf_range_parse(frames, from->most, &range, err);
    if (!status) status = wf_range_numbers(&range, frames, &out->listed, &out->step, err);
    out->count = (size_t)range.count;
    wf_range_free(&range);
    return status;
}

/* ---- Their files ---- */

static char *join(const char *directory, const char *name) {
    size_t length = strlen(directory), rest = strlen(name) + 1;
    char *path = malloc(length + rest);
    if (!path) return NULL;
    memcpy(path, directory, length);
    memcpy(path + length, name, rest);
    return path;
}

/* Numbers and files are both in ascending order, so that one walk along them is enough. */
static bool fill(const wf_candidates *from, const selection *numbers, wf_sequence *out) {
    const wf_numbered *at = from->entry, *end = at + from->count;
    for (size_t k = 0; k < numbers->count; k++) {
        wf_subframe_ref *ref = &out->refs[out->count++];
        *ref = (wf_subframe_ref){.part = -1, .number = selected(numbers, k)};
        while (at < end && wf_number_order(at->number, ref->number) < 0) at++;
        if (at == end || wf_number_order(at->number, ref->number)) {
            out->missing++;
            continue;
        }
        ref->part = at->part;
        ref->path = join(from->directory, at->name);
        if (!ref->path) return false;
    }
    return true;
}

static weft_status list(const wf_candidates *from, const selection *numbers, const char *frames,
                        wf_sequence *out, weft_error *err) {
    char a[48], b[48];
    out->refs = malloc(numbers->count * sizeof *out->refs);
    if (!out->refs || !fill(from, numbers, out))
        return wf_fail(err, WEFT_NO_MEMORY, "%s: out of memory for %zu subframes",
                       wf_path_tail(from->input), numbers->count);
    if (out->missing < out->count) return WEFT_OK;
    return wf_fail(err, WEFT_FAILED,
                   "%s: --frames %.200s: none of these is there; the files' "
                   "numbers are %s to %s",
                   wf_path_tail(from->input), frames,
                   wf_number_text(from->entry[0].number, a, sizeof a),
                   wf_number_text(from->entry[from->count - 1].number, b, sizeof b));
}

/* ---- Steps ---- */

static void tell_step(const wf_candidates *from, wf_rational step, wf_sequence *out) {
    char text[48], number[3][48];
    for (size_t i = 0; i < 3; i++)
        wf_number_text(from->entry[i].number, number[i], sizeof number[i]);
    out->stepped = true;
    wf_sequence_tell(out,
                     "%s: numbers are %s apart (%s, %s, %s ..): the numbers between are taken "
                     "to be left out on purpose; --frames says otherwise",
                     wf_path_tail(from->input), wf_number_text(step, text, sizeof text),
                     number[0], number[1], number[2]);
}

/* How the selection is spaced, in numbers and in the files' own steps. */
static weft_status settle_step(wf_rational selected_step, wf_rational natural,
                               const char *frames, wf_sequence *out, weft_error *err) {
    out->step = wf_ratio(1, 1);
    out->number_step = natural;
    out->ranged = frames != NULL;
    if (!wf_ratio_given(selected_step)) return WEFT_OK;
    out->number_step = selected_step;
    out->step = wf_ratio_div(selected_step, natural);
    if (wf_ratio_given(out->step)) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE,
                   "--frames: '%.200s' has a step that is too long or too fine",
                   frames ? frames : "all");
}

weft_status wf_select(const wf_candidates *from, const char *frames, wf_sequence *out,
                      weft_error *err) {
    *out = (wf_sequence){0};
    weft_status status = check_candidates(from, err);
    if (status) return status;
    selection numbers = {0};
    bool stepped;
    wf_rational natural = wf_number_step(from->entry, from->count, &stepped);
    if (!wf_ratio_given(natural))
        return wf_fail(err, WEFT_FAILED, "%s: the files' numbers have no step in common",
                       wf_path_tail(from->input));
    status = frames ? take_range(from, frames, &numbers, err)
                    : take_all(from, natural, &numbers, err);
    if (!status) status = list(from, &numbers, frames, out, err);
    if (!status) status = settle_step(numbers.step, natural, frames, out, err);
    if (!status && stepped && !frames) tell_step(from, natural, out);
    free(numbers.listed);
    if (status) wf_sequence_free(out);
    return status;
}
