/* When the pictures of a pipe are shown, which comes with each of them. */
#include "convert/video/arrivals.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "convert/video/rate.h"
#include "filters/raster/timing.h"

/* Pictures from <= k < count are held, and a place for the end of the last. */
struct wf_arrivals {
    wf_arrivals_desc desc;
    int64_t from, count, capacity;
    int64_t *ticks;    /* after the first picture's */
    wf_rational *time; /* periods */
    wf_rational *edge; /* of the cell that begins with it */
    int64_t first_ticks, last_lasts;
    bool uneven, decided;
};

weft_status wf_arrivals_new(const wf_arrivals_desc *desc, wf_arrivals **out, weft_error *err) {
    wf_arrivals *a = *out = calloc(1, sizeof *a);
    if (!a) return wf_fail(err, WEFT_NO_MEMORY, "%s: no memory for its times", desc->path);
    a->desc = *desc;
    return WEFT_OK;
}

void wf_arrivals_free(wf_arrivals *a) {
    if (!a) return;
    free(a->ticks);
    free(a->time);
    free(a->edge);
    free(a);
}

/* ---- Places ---- */

static bool grow(void **array, size_t count, size_t each) {
    void *grown = realloc(*array, count * each);
    if (grown) *array = grown;
    return grown;
}

/* A place for a picture, and one for its end. */
static weft_status make_place(wf_arrivals *a, weft_error *err) {
    int64_t needed = a->count - a->from + 2;
    if (needed <= a->capacity) return WEFT_OK;
    size_t capacity = (size_t)(2 * needed);
    if (!grow((void **)&a->ticks, capacity, sizeof *a->ticks) ||
        !grow((void **)&a->time, capacity, sizeof *a->time) ||
        !grow((void **)&a->edge, capacity, sizeof *a->edge))
        return wf_fail(err, WEFT_NO_MEMORY, "%s: no memory for its times", a->desc.path);
    a->capacity = (int64_t)capacity;
    return WEFT_OK;
}

void wf_arrivals_forget(wf_arrivals *a, int64_t number) {
    int64_t gone = number - a->from, kept = a->count - number + 1;
    if (gone < 1 || kept < 2) return;
    memmove(a->ticks, a->ticks + gone, (size_t)kept * sizeof *a->ticks);
    memmove(a->time, a->time + gone, (size_t)kept * sizeof *a->time);
    memmove(a->edge, a->edge + gone, (size_t)kept * sizeof *a->edge);
    a->from = number;
}

/* ---- Times ---- */

static wf_rational periods(const wf_arrivals *a, int64_t ticks) {
    return wf_ratio_div(wf_ratio_mul(wf_ratio(ticks, 1), a->desc.tick_s), a->desc.period_s);
}

static wf_rational even_time(const wf_arrivals *a, int64_t number) {
    return wf_ratio_div(wf_ratio_div(wf_ratio(number, 1), a->desc.rate), a->desc.period_s);
}

static wf_rational midpoint(wf_rational left, wf_rational right) {
    return wf_ratio_mul(wf_ratio_sum(left, right), wf_ratio(1, 2));
}

static bool is_after(wf_rational a, wf_rational b) {
    return wf_ratio_difference(a, b).num > 0;
}

/* The edge at place i, whose time and the one before it are known. The first cell begins half
 * its length before its time, which the second picture tells. */
static void set_edge(wf_arrivals *a, int64_t i) {
    bool first = a->from + i == 0;
    a->edge[i] = first || !a->desc.center ? a->time[i] : midpoint(a->time[i - 1], a->time[i]);
    if (a->desc.center && a->from + i == 1)
        a->edge[i - 1] =
            wf_ratio_difference(a->time[i - 1], wf_ratio_mul(a->time[i], wf_ratio(1, 2)));
}

/* Where windows have been decided by the rate, a picture may come as late as a tick after its
 * place, and the next before it. */
static void set_time(wf_arrivals *a, int64_t number) {
    int64_t i = number - a->from;
    a->time[i] = a->uneven ? periods(a, a->ticks[i]) : even_time(a, number);
    if (i && a->uneven && !is_after(a->time[i], a->time[i - 1]))
        a->time[i] = wf_ratio_sum(a->time[i - 1], wf_ratio_mul(periods(a, 1), wf_ratio(1, 2)));
    set_edge(a, i);
}

static void turn_uneven(wf_arrivals *a) {
    a->uneven = true;
    for (int64_t k = a->from; !a->decided && k < a->count; k++) set_time(a, k);
}

void wf_arrivals_turn_uneven(wf_arrivals *a) {
    if (!a->uneven) turn_uneven(a);
}

static bool in_step(const wf_arrivals *a, int64_t number, int64_t ticks) {
    const wf_video_info info = {.tick_s = a->desc.tick_s};
    return wf_video_in_step(&info, a->desc.rate, number, ticks);
}

static weft_status refuse_order(const wf_arrivals *a, int64_t ticks, weft_error *err) {
    double tick_s = wf_ratio_value(a->desc.tick_s);
    return wf_fail(
        err, WEFT_FAILED,
        "%s: picture %" PRId64 " is shown at %.3f s, and the one before it at %.3f s; "
        "write its timestamps again, such as with ffmpeg -i IN -vf fps=120 -c:v ffv1 "
        "OUT.mkv, or give --subframe-rate to take all pictures as equally long",
        a->desc.path, a->count, (double)ticks * tick_s,
        (double)a->ticks[a->count - 1 - a->from] * tick_s);
}

static weft_status check_edge(const wf_arrivals *a, int64_t i, weft_error *err) {
    if (wf_ratio_given(a->edge[i])) return WEFT_OK;
    return wf_fail(err, WEFT_FAILED,
                   "%s: the time of picture %" PRId64
                   " is too fine to be counted exactly; give --subframe-rate to take all "
                   "pictures as equally long",
                   a->desc.path, a->from + i);
}

static weft_status check_length(const wf_arrivals *a, int64_t since, weft_error *err) {
    double tick_s = wf_ratio_value(a->desc.tick_s);
    double before_s = (double)a->ticks[a->count - 1 - a->from] * tick_s;
    double lasts_s = (double)since * tick_s - before_s;
    if (lasts_s <= WF_LONGEST_SHOWN_S) return WEFT_OK;
    return wf_fail(err, WEFT_FAILED,
                   "%s: picture %" PRId64
                   ", at %.3f s, would be shown for %.0f s: a timestamp is "
                   "damaged; give --subframe-rate to take all pictures as equally long",
                   a->desc.path, a->count - 1, before_s, lasts_s);
}

weft_status wf_arrivals_add(wf_arrivals *a, int64_t ticks, int64_t lasts, weft_error *err) {
    weft_status status = make_place(a, err);
    if (status) return status;
    if (!a->count) a->first_ticks = ticks;
    int64_t number = a->count, i = number - a->from, since = ticks - a->first_ticks;
    bool keeps = a->uneven || in_step(a, number, since);
    if ((a->uneven || !keeps) && i && since <= a->ticks[i - 1])
        return refuse_order(a, since, err);
    if (i) status = check_length(a, since, err);
    if (status) return status;
    a->ticks[i] = since;
    a->last_lasts = lasts;
    if (!keeps) turn_uneven(a);
    set_time(a, number);
    a->edge[i + 1] = WF_EDGE_UNKNOWN;
    a->count++;
    return check_edge(a, i, err);
}

void wf_arrivals_last_until(wf_arrivals *a, int64_t ticks) {
    int64_t last = a->count - 1 - a->from;
    if (a->count) a->last_lasts = ticks - a->first_ticks - a->ticks[last];
}

weft_status wf_arrivals_end(wf_arrivals *a, weft_error *err) {
    weft_status status = make_place(a, err);
    int64_t i = a->count - a->from;
    if (status || !a->uneven) return status;
    wf_rational before =
        i > 1 ? wf_ratio_difference(a->time[i - 1], a->time[i - 2]) : periods(a, 1);
    wf_rational lasts = a->last_lasts > 0 ? periods(a, a->last_lasts) : before;
    a->time[i] = wf_ratio_sum(a->time[i - 1], lasts);
    set_edge(a, i);
    return check_edge(a, i, err);
}

void wf_arrivals_decide(wf_arrivals *a) {
    a->decided = true;
}

/* ---- What is known ---- */

bool wf_arrivals_uneven(const wf_arrivals *a) {
    return a->uneven;
}

int64_t wf_arrivals_count(const wf_arrivals *a) {
    return a->count;
}

const wf_rational *wf_arrivals_edges(const wf_arrivals *a, int64_t *from) {
    *from = a->from;
    return a->edge;
}

wf_rational wf_arrivals_shown(const wf_arrivals *a, int64_t number) {
    return a->time[number - a->from];
}
