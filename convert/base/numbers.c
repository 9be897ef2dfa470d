/* What the numbers of files mean: steps between them, and fractions whose decimals were cut. */
#include "convert/base/numbers.h"

#include <string.h>

#include "convert/base/range.h"

__extension__ typedef __int128 wide;

#define MOST_PARTS 1000

/* ---- Steps ---- */

static wf_rational gap_before(const wf_numbered *entry, size_t i) {
    return wf_number_minus(entry[i].number, entry[i - 1].number);
}

static size_t equal_gaps(const wf_numbered *entry, size_t count, wf_rational gap) {
    size_t equal = 0;
    for (size_t i = 1; i < count; i++) equal += wf_ratio_equal(gap_before(entry, i), gap);
    return equal;
}

static wf_rational common_gap(const wf_numbered *entry, size_t count) {
    wf_rational step = {0, 1};
    for (size_t i = 1; i < count && step.den; i++)
        step = wf_number_common_step(step, gap_before(entry, i));
    return step;
}

wf_rational wf_number_step(const wf_numbered *entry, size_t count, bool *stepped) {
    wf_rational natural = wf_natural_step(entry, count), common = common_gap(entry, count);
    size_t gaps = count - 1, equal = 0;
    bool wider = wf_ratio_given(natural) && wf_ratio_given(common) &&
                 wf_number_order(common, natural) > 0;
    if (wider) equal = equal_gaps(entry, count, common);
    *stepped = equal >= WF_GAPS_EQUAL && 2 * equal > gaps;
    return *stepped ? common : natural;
}

/* ---- Fractions ---- */

static int decimals_of(const wf_numbered *e) {
    const char *number = wf_base_name(e->name) + e->start;
    size_t length = (size_t)(e->end - e->start);
    const char *dot = length ? memchr(number, '.', length) : NULL;
    size_t decimals = dot ? length - (size_t)(dot - number) - 1 : 0;
    return decimals > WF_DECIMALS_KEPT ? WF_DECIMALS_KEPT : (int)decimals;
}

/* 10^decimals of the number that has most of them; 1 where all numbers are whole. */
static int64_t scale_of(const wf_numbered *entry, size_t count) {
    int most = 0;
    int64_t scale = 1;
    bool whole = true;
    for (size_t i = 0; i < count; i++) {
        if (entry[i].number.den == 1) continue;
        int decimals = decimals_of(&entry[i]);
        if (decimals > most) most = decimals;
        whole = false;
    }
    for (int d = 0; !whole && d < most; d++) scale *= 10;
    return scale;
}

/* number times parts, rounded to the nearest whole. */
static int64_t nearest(wf_rational number, int64_t parts) {
    wide twice = 2 * (wide)number.num * parts + number.den, den = 2 * (wide)number.den;
    wide quotient = twice / den;
    return (int64_t)(quotient - (twice % den < 0));
}

/* How far number is from the nearest whole of 1/parts, in units of 1/(scale parts). */
static wide off_by(wf_rational number, int64_t parts, int64_t scale) {
    wide written = (wide)number.num * (scale / number.den);
    return written * parts - (wide)nearest(number, parts) * scale;
}

/* Far above all frame numbers; parts of it are counted in 64 bits. */
#define LARGEST_NUMBER (INT64_C(1) << 52)

static bool is_small(wf_rational number) {
    int64_t whole = number.num / number.den;
    return whole < LARGEST_NUMBER && whole > -LARGEST_NUMBER;
}

/* Whether all numbers are wholes of 1/parts, rounded or cut off at one unit of 1/scale. */
static bool made_of(const wf_numbered *entry, size_t count, int64_t parts, int64_t scale) {
    bool rounded = true, cut = true;
    for (size_t i = 0; i < count && (rounded || cut); i++) {
        if (scale % entry[i].number.den || !is_small(entry[i].number)) return false;
        wide off = off_by(entry[i].number, parts, scale);
        rounded = rounded && 2 * (off < 0 ? -off : off) <= parts;
        cut = cut && off <= 0 && -off < parts;
    }
    return rounded || cut;
}

/* What density() and equal gaps are, were the numbers wholes of 1/parts. */
static double density_of_parts(const wf_numbered *entry, size_t count, int64_t parts) {
    int64_t first = nearest(entry[0].number, parts), before = first, step = 0;
    for (size_t i = 1; i < count; i++) {
        int64_t here = nearest(entry[i].number, parts), gap = here - before;
        if (gap <= 0) return 0;
        before = here;
        step = wf_number_common_step(wf_ratio(step, 1), wf_ratio(gap, 1)).num;
    }
    size_t equal = 0;
    for (size_t i = 1; i < count; i++)
        equal += nearest(entry[i].number, parts) - nearest(entry[i - 1].number, parts) == step;
    if (equal < WF_GAPS_EQUAL) return 0;
    return (double)count / ((double)((before - first) / step) + 1);
}

static double density_as_written(const wf_numbered *entry, size_t count) {
    bool stepped;
    wf_rational step = wf_number_step(entry, count, &stepped);
    if (count < 2 || !wf_ratio_given(step)) return 0;
    for (size_t i = 1; i < count; i++)
        if (!wf_number_order(entry[i].number, entry[i - 1].number)) return 0;
    int64_t numbers = wf_number_count(entry[0].number, entry[count - 1].number, step);
    return (double)count / (double)numbers;
}

/* A fraction of which the decimals tell less than a third of a step is not looked for: any
 * number would be near one. */
int64_t wf_number_parts(const wf_numbered *entry, size_t count) {
    int64_t scale = count > WF_GAPS_EQUAL ? scale_of(entry, count) : 1;
    double written = scale > 1 ? density_as_written(entry, count) : 1;
    for (int64_t parts = 2; parts <= MOST_PARTS && 3 * parts <= scale && written < 1; parts++)
        if (made_of(entry, count, parts, scale) &&
            density_of_parts(entry, count, parts) > written)
            return parts;
    return 0;
}

void wf_numbers_round(wf_numbered *entry, size_t count, int64_t parts) {
    for (size_t i = 0; i < count; i++)
        entry[i].number = wf_ratio(nearest(entry[i].number, parts), parts);
}

double wf_number_density(const wf_numbered *entry, size_t count) {
    int64_t parts = wf_number_parts(entry, count);
    return parts ? density_of_parts(entry, count, parts) : density_as_written(entry, count);
}
