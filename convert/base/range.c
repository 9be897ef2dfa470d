/* Lists of frame numbers, as --frames takes them, in exact ratios. */
#include "convert/base/range.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

__extension__ typedef __int128 wide;

static const wf_rational does_not_fit = {0, 0};

/* ---- Numbers ---- */

int wf_number_order(wf_rational a, wf_rational b) {
    if (a.den == b.den) return (a.num > b.num) - (a.num < b.num);
    wide left = (wide)a.num * b.den, right = (wide)b.num * a.den;
    return (left > right) - (left < right);
}

static int64_t divisor(int64_t a, int64_t b) {
    while (b) {
        int64_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

/* num/den reduced, den > 0. */
static wf_rational reduced(wide num, wide den) {
    wide a = num < 0 ? -num : num, b = den;
    while (b) {
        wide rest = a % b;
        a = b;
        b = rest;
    }
    num /= a;
    den /= a;
    bool fits = num >= INT64_MIN && num <= INT64_MAX && den <= INT64_MAX;
    return fits ? (wf_rational){(int64_t)num, (int64_t)den} : does_not_fit;
}

wf_rational wf_number_minus(wf_rational a, wf_rational b) {
    int64_t num;
    if (!a.den || !b.den) return does_not_fit;
    if (a.den == 1 && b.den == 1 && !__builtin_sub_overflow(a.num, b.num, &num))
        return (wf_rational){num, 1};
    return reduced((wide)a.num * b.den - (wide)b.num * a.den, (wide)a.den * b.den);
}

wf_rational wf_number_common_step(wf_rational a, wf_rational b) {
    if (!a.den || !b.den) return does_not_fit;
    if (wf_ratio_equal(a, b)) return a;
    int64_t shared = divisor(a.den, b.den), left, right, den;
    if (__builtin_mul_overflow(a.num, b.den / shared, &left) ||
        __builtin_mul_overflow(b.num, a.den / shared, &right) ||
        __builtin_mul_overflow(a.den, b.den / shared, &den))
        return does_not_fit;
    return wf_ratio(divisor(left, right), den);
}

int64_t wf_number_count(wf_rational first, wf_rational last, wf_rational step) {
    if (wf_number_order(last, first) < 0) return 0;
    wf_rational steps = wf_ratio_div(wf_number_minus(last, first), step);
    if (!wf_ratio_given(steps)) return INT64_MAX;
    int64_t whole = steps.num / steps.den;
    return whole < INT64_MAX ? whole + 1 : whole;
}

const char *wf_number_text(wf_rational number, char *text, size_t size) {
    int64_t den = number.den, scale = 1;
    int decimals = 0;
    while (decimals < 9 && den > 0 && scale % den) scale *= 10, decimals++;
    uint64_t size_of = number.num < 0 ? -(uint64_t)number.num : (uint64_t)number.num;
    const char *sign = number.num < 0 ? "-" : "";
    if (den <= 1 || scale % den) {
        snprintf(text, size, den == 1 ? "%s%" PRIu64 : "%s%" PRIu64 "/%" PRId64, sign, size_of,
                 den);
        return text;
    }
    uint64_t rest = size_of % (uint64_t)den * (uint64_t)(scale / den);
    snprintf(text, size, "%s%" PRIu64 ".%0*" PRIu64, sign, size_of / (uint64_t)den, decimals,
             rest);
    return text;
}

/* ---- Parsing ---- */

static weft_status refuse(const char *text, weft_error *err) {
    return wf_fail(
        err, WEFT_USAGE,
        "--frames: '%.200s' will not do; it takes first-last, first-lastxstep, numbers, "
        "and lists of these with commas, such as 1-96, 1-96x2 or 1001-1066x0.25",
        text);
}

/* "1-10:2" is meant as 1-10x2, and "1:10" as 1-10. */
static weft_status refuse_colon(const char *text, weft_error *err) {
    char right[64];
    size_t length = strlen(text);
    if (length >= sizeof right) return refuse(text, err);
    memcpy(right, text, length + 1);
    for (size_t i = 0, run = 0; i < length; i++) {
        if (right[i] == ',') run = i + 1;
        if (right[i] != ':') continue;
        right[i] = i > run && memchr(right + run + 1, '-', i - run - 1) ? 'x' : '-';
    }
    return wf_fail(err, WEFT_USAGE,
                   "--frames: steps are written with x and not with ':': "
                   "for '%s' write %s",
                   text, right);
}

/* Reads a number made of the given characters and moves past it. */
static bool read_number(const char **text, const char *of, bool may_be_negative,
                        wf_rational *out) {
    char copy[40];
    bool negative = may_be_negative && **text == '-';
    *text += negative;
    size_t length = strspn(*text, of);
    if (length >= sizeof copy) return false;
    memcpy(copy, *text, length);
    copy[length] = '\0';
    *text += length;
    if (!wf_ratio_parse(copy, out)) return false;
    if (negative) out->num = -out->num;
    return true;
}

typedef struct run_text {
    wf_rational first, last, step;
    bool single;
} run_text;

static bool read_run(const char **text, run_text *out) {
    *out = (run_text){.step = {1, 1}};
    if (!read_number(text, "0123456789.", true, &out->first)) return false;
    out->last = out->first;
    out->single = **text != '-';
    if (out->single) return true;
    ++*text;
    if (!read_number(text, "0123456789.", true, &out->last)) return false;
    if (**text != 'x') return true;
    ++*text;
    return read_number(text, "0123456789./", false, &out->step) && out->step.num > 0;
}

/* Puts first and step over one denominator, and makes sure that the last number fits. */
static bool settle_run(const run_text *text, int64_t count, wf_range_run *out) {
    int64_t shared = divisor(text->first.den, text->step.den), reach, last;
    *out = (wf_range_run){.count = count};
    return !__builtin_mul_overflow(text->first.den, text->step.den / shared, &out->den) &&
           !__builtin_mul_overflow(text->first.num, text->step.den / shared, &out->first) &&
           !__builtin_mul_overflow(text->step.num, text->first.den / shared, &out->step) &&
           !__builtin_mul_overflow(out->step, count, &reach) &&
           !__builtin_add_overflow(out->first, reach, &last);
}

static weft_status add_run(const run_text *run, const char *text, int64_t most,
                           wf_frame_range *out, weft_error *err) {
    char a[48], b[48];
    if (wf_number_order(run->last, run->first) < 0)
        return wf_fail(
            err, WEFT_USAGE,
            "--frames: '%.200s' runs backwards; write %s-%s, subframes are always taken "
            "in ascending order",
            text, wf_number_text(run->last, a, sizeof a),
            wf_number_text(run->first, b, sizeof b));
    int64_t count = wf_number_count(run->first, run->last, run->step);
    if (count > most - out->count)
        return wf_fail(err, WEFT_USAGE,
                       "--frames: '%.200s' is more than %" PRId64
                       " numbers; select fewer, or take "
                       "a longer step",
                       text, most);
    wf_range_run *settled = &out->run[out->runs];
    if (!settle_run(run, count, settled)) return refuse(text, err);
    if (run->single) settled->step = 0;
    out->runs++;
    out->count += count;
    return WEFT_OK;
}

weft_status wf_range_parse(const char *text, int64_t most, wf_frame_range *out,
                           weft_error *err) {
    *out = (wf_frame_range){0};
    if (strchr(text, ':')) return refuse_colon(text, err);
    size_t runs = 1;
    for (const char *c = text; *c; c++) runs += *c == ',';
    out->run = calloc(runs, sizeof *out->run);
    if (!out->run) return wf_fail(err, WEFT_NO_MEMORY, "--frames: out of memory");
    for (const char *at = text;; at++) {
        run_text run;
        if (!read_run(&at, &run) || (*at && *at != ',')) return refuse(text, err);
        weft_status status = add_run(&run, text, most, out, err);
        if (status || !*at) return status;
    }
}

void wf_range_free(wf_frame_range *range) {
    free(range->run);
    *range = (wf_frame_range){0};
}

/* ---- Merging ---- */

static int order(const void *a, const void *b) {
    return wf_number_order(*(const wf_rational *)a, *(const wf_rational *)b);
}

static bool fill(const wf_frame_range *range, wf_rational *numbers) {
    bool ascending = true;
    size_t n = 0;
    for (size_t r = 0; r < range->runs; r++) {
        const wf_range_run *run = &range->run[r];
        for (int64_t i = 0; i < run->count; i++, n++) {
            numbers[n] = wf_ratio(run->first + i * run->step, run->den);
            if (!i && n && wf_number_order(numbers[n - 1], numbers[n]) >= 0) ascending = false;
        }
    }
    return ascending;
}

/* The least and the greatest step from a number to the next; {0, 0} if there is only one
 * number. */
static void measure(const wf_rational *numbers, int64_t count, wf_rational *shortest,
                    wf_rational *longest) {
    *shortest = *longest = does_not_fit;
    for (int64_t i = 1; i < count; i++) {
        wf_rational way = wf_number_minus(numbers[i], numbers[i - 1]);
        if (i == 1 || wf_number_order(way, *shortest) < 0) *shortest = way;
        if (i == 1 || wf_number_order(way, *longest) > 0) *longest = way;
    }
}

/* A selection has one step, since it has one rate: "1-10,12-20x2" is refused. */
static weft_status settle_step(const wf_frame_range *range, const char *text,
                               const wf_rational *numbers, wf_rational *step, weft_error *err) {
    wf_rational longest;
    measure(numbers, range->count, step, &longest);
    bool even = wf_ratio_equal(*step, longest);
    for (size_t r = 0; r < range->runs; r++) {
        const wf_range_run *run = &range->run[r];
        if (!run->step) continue;
        wf_rational own = wf_ratio(run->step, run->den);
        if (range->count == 1) *step = own;
        if (run->count > 1 && !even && !wf_ratio_equal(own, *step))
            return wf_fail(err, WEFT_USAGE,
                           "--frames: '%.200s' has runs of different steps; subframes have one "
                           "rate, so give all runs the same step",
                           text);
    }
    return WEFT_OK;
}

weft_status wf_range_numbers(const wf_frame_range *range, const char *text, wf_rational **out,
                             wf_rational *step, weft_error *err) {
    wf_rational *numbers = malloc((size_t)range->count * sizeof *numbers);
    if (!numbers) return wf_fail(err, WEFT_NO_MEMORY, "--frames: out of memory");
    if (!fill(range, numbers)) qsort(numbers, (size_t)range->count, sizeof *numbers, order);
    weft_status status = WEFT_OK;
    for (int64_t i = 1; i < range->count && !status; i++) {
        char number[48];
        if (!wf_number_order(numbers[i - 1], numbers[i]))
            status = wf_fail(err, WEFT_USAGE, "--frames: '%.200s' has %s twice", text,
                             wf_number_text(numbers[i], number, sizeof number));
    }
    if (!status) status = settle_step(range, text, numbers, step, err);
    if (status)
        free(numbers);
    else
        *out = numbers;
    return status;
}
