/* How far off a field's pixels may be with the subframes there are, and which of those between
 * would bring them nearest. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "convert/plan/refine.h"
#include "convert/read/nan_fix.h"
#include "convert/read/source.h"

/* Between a subframe and the next one that exists at a pixel lie others that are not there,
 * which the field shows as the first of the two. If what is seen between them lies between what
 * both see, light is off by at most the sum of |difference| times the part of the window that
 * they have. On the display that is the most where light is least. What moves across a pixel
 * and is gone at both times is seen beside it: rectangles hold all between. */

enum { ROWS = 16, MARGIN_PX = 2 };

/* A subframe that is there, while a field is looked at. */
typedef struct seen {
    wf_refine_slot *slot;
    wf_subframe *picture;
    wf_reader *reader;
    float *rgb; /* [3][ROWS][width] */
} seen;

typedef struct estimate {
    wf_refining *refining;
    int64_t field;
    size_t first, last; /* slots */
    seen *there;
    int count;
    double *upto; /* [last - first + 1]: parts of the window that the slots before have */
    wf_box moved;
    wf_box *box; /* [last - first]: what is wanted of a slot; empty: nothing */
    int width, lines;
} estimate;

static double encoded(double light) {
    return light < 0.018 ? 4.5 * light : 1.099 * pow(light, 0.45) - 0.099;
}

/* The most that any line sees of a subframe: under skew they look one after the other. */
static double most_seen(const wf_plan *plan, int64_t field, int64_t number) {
    int last = plan->job.raster.lines - 1;
    double top = wf_resampler_share(plan->resampler, field, 0, number);
    double middle = wf_resampler_share(plan->resampler, field, last / 2, number);
    double bottom = wf_resampler_share(plan->resampler, field, last, number);
    return fmax(top, fmax(middle, bottom));
}

/* ---- Opening ---- */

static weft_status open_one(estimate *e, wf_refine_slot *slot, weft_error *err) {
    const wf_source_options options = {
        .to_light = true, .max_memory_bytes = e->refining->plan->job.max_memory_bytes};
    seen *s = &e->there[e->count++];
    *s = (seen){.slot = slot};
    s->rgb = malloc(3 * ROWS * (size_t)e->width * sizeof *s->rgb);
    if (!s->rgb) return wf_fail(err, WEFT_NO_MEMORY, "no memory for rows");
    weft_status status = wf_subframe_open(slot->path, -1, &options, &s->picture, err);
    return status ? status : wf_reader_new(&options, &s->reader, err);
}

static weft_status open_all(estimate *e, weft_error *err) {
    size_t slots = e->last - e->first + 1;
    e->there = calloc(slots, sizeof *e->there);
    e->upto = calloc(slots + 1, sizeof *e->upto);
    e->box = calloc(slots, sizeof *e->box);
    if (!e->there || !e->upto || !e->box)
        return wf_fail(err, WEFT_NO_MEMORY, "no memory for an estimate");
    weft_status status = WEFT_OK;
    for (size_t i = 0; !status && i < slots; i++) {
        wf_refine_slot *slot = &e->refining->slot[e->first + i];
        e->upto[i + 1] = e->upto[i] + most_seen(e->refining->plan, e->field, slot->number);
        if (slot->path) status = open_one(e, slot, err);
    }
    return status;
}

static void close_all(estimate *e) {
    for (int i = 0; i < e->count; i++) {
        wf_reader_free(e->there[i].reader);
        wf_subframe_close(e->there[i].picture);
        free(e->there[i].rgb);
    }
    free(e->there);
    free(e->upto);
    free(e->box);
}

/* ---- Reading ---- */

static void take_row(const wf_rows *rows, int c, int y, int from, int to, float *out) {
    size_t at = (size_t)(y - rows->y0) * rows->line_stride + (size_t)(from - rows->x0);
    if (rows->type == WF_HALF)
        wf_floats_of_halves(out, (const uint16_t *)rows->plane[c] + at, (size_t)(to - from));
    else
        memcpy(out, (const float *)rows->plane[c] + at, (size_t)(to - from) * sizeof *out);
}

/* Rows y0 to y1 of the display window; what the data window has not is 0. */
static weft_status read_band(const estimate *e, const seen *s, int y0, int y1,
                             weft_error *err) {
    const wf_image_info *info = wf_subframe_info(s->picture);
    int x = info->display.x0, y = info->display.y0, width = e->width;
    int first = y0 + y > info->data.y0 ? y0 + y : info->data.y0;
    int end = y1 + y < info->data.y1 ? y1 + y : info->data.y1;
    int from = info->data.x0 > x ? info->data.x0 : x;
    int to = info->data.x1 < x + width ? info->data.x1 : x + width;
    wf_rows rows;
    memset(s->rgb, 0, 3 * ROWS * (size_t)width * sizeof *s->rgb);
    if (first >= end || from >= to) return WEFT_OK;
    weft_status status = wf_reader_rows(s->reader, s->picture, first, end, &rows, err);
    for (int c = 0; !status && c < 3; c++)
        for (int line = first; line < end; line++)
            take_row(&rows, c, line, from, to,
                     s->rgb + ((size_t)c * ROWS + (size_t)(line - y - y0)) * (size_t)width +
                         (from - x));
    return status;
}

/* ---- A pixel ---- */

/* Between two subframes of `there` that follow each other at a pixel. */
typedef struct gap {
    int from, to;
    double off; /* the most that light may be off by */
} gap;

static bool exists(const seen *s, int x, int y) {
    const wf_box *r = &s->slot->region;
    return s->slot->whole || (x >= r->x0 && x < r->x1 && y >= r->y0 && y < r->y1);
}

static size_t place(const estimate *e, const seen *s) {
    return (size_t)(s->slot - e->refining->slot) - e->first;
}

/* The part of the window that is seen between two, by subframes that are not there. */
static double part_between(const estimate *e, const gap *g) {
    return e->upto[place(e, &e->there[g->to])] - e->upto[place(e, &e->there[g->from]) + 1];
}

/* Subframes that are not there between two, within the window: of these the middle one. */
static size_t middle_of(const estimate *e, const gap *g) {
    size_t from = place(e, &e->there[g->from]) + 1, to = place(e, &e->there[g->to]);
    while (to > from && e->upto[to] == e->upto[to - 1]) to--;
    return from + (to - from) / 2;
}

static void add_pixel(wf_box *box, int x, int y) {
    *box = wf_box_around(*box, (wf_box){x, y, x + 1, y + 1});
}

/* One channel: what it may be off by, on the display; gaps get what each adds. */
static double channel_error(const estimate *e, gap *gaps, int count, size_t at) {
    double least = INFINITY, off = 0;
    for (int i = 0; i < count; i++) {
        double a = (double)e->there[gaps[i].from].rgb[at];
        double b = (double)e->there[gaps[i].to].rgb[at];
        double part = part_between(e, &gaps[i]), by = fabs(a - b) * part;
        least = fmin(least, part > 0 ? fmin(a, b) : a);
        off += by;
        if (by > gaps[i].off) gaps[i].off = by;
    }
    if (!(off > 0)) return 0;
    if (!(least > 0)) least = 0;
    return encoded(least + off) - encoded(least);
}

/* How far apart two subframes are at a pixel, on the display. */
static double apart(const estimate *e, const gap *g, size_t at) {
    double a = (double)e->there[g->from].rgb[at], b = (double)e->there[g->to].rgb[at];
    return fabs(encoded(fmax(a, 0)) - encoded(fmax(b, 0)));
}

/* What differs between subframes of the window itself. */
static void note_motion(estimate *e, const gap *gaps, int count, int x, int y, int row) {
    size_t plane = ROWS * (size_t)e->width, at = (size_t)row * (size_t)e->width + (size_t)x;
    for (int i = 0; i < count; i++) {
        size_t to = place(e, &e->there[gaps[i].to]);
        if (e->upto[to + 1] <= e->upto[to]) continue;
        for (size_t c = 0; c < 3; c++)
            if (apart(e, &gaps[i], at + c * plane) > e->refining->error)
                add_pixel(&e->moved, x, y);
    }
}

/* Whether all files hold the same there, as in most of a picture. */
static bool is_still(const estimate *e, int x, int row) {
    size_t plane = ROWS * (size_t)e->width, at = (size_t)row * (size_t)e->width + (size_t)x;
    for (int i = 1; i < e->count; i++)
        for (size_t c = 0; c < 3; c++)
            if (e->there[i].rgb[at + c * plane] != e->there[0].rgb[at + c * plane])
                return false;
    return true;
}

/* Pixel x of row `row` of the band at y0. Of gaps those are closed that add half of the most.
 */
static void look_at_pixel(estimate *e, int x, int y0, int row, gap *gaps) {
    int count = 0, from = 0, y = y0 + row;
    double worst = 0, most = 0;
    if (is_still(e, x, row)) return;
    for (int i = 1; i < e->count; i++) {
        if (!exists(&e->there[i], x, y)) continue;
        gaps[count++] = (gap){.from = from, .to = i};
        from = i;
    }
    for (int c = 0; c < 3; c++) {
        size_t at = ((size_t)c * ROWS + (size_t)row) * (size_t)e->width + (size_t)x;
        worst = fmax(worst, channel_error(e, gaps, count, at));
    }
    note_motion(e, gaps, count, x, y, row);
    if (worst <= e->refining->error) return;
    for (int i = 0; i < count; i++) most = fmax(most, gaps[i].off);
    for (int i = 0; i < count; i++)
        if (gaps[i].off > most / 2) add_pixel(&e->box[middle_of(e, &gaps[i])], x, y);
}

/* ---- A field ---- */

static weft_status look_at_band(estimate *e, int y0, gap *gaps, weft_error *err) {
    int y1 = y0 + ROWS < e->lines ? y0 + ROWS : e->lines;
    weft_status status = WEFT_OK;
    for (int i = 0; !status && i < e->count; i++)
        status = read_band(e, &e->there[i], y0, y1, err);
    for (int row = 0; !status && row < y1 - y0; row++)
        for (int x = 0; x < e->width; x++) look_at_pixel(e, x, y0, row, gaps);
    return status;
}

static void tell(const estimate *e) {
    for (size_t i = 0; i <= e->last - e->first; i++) {
        wf_box b = e->box[i];
        if (b.x0 >= b.x1) continue;
        b = (wf_box){b.x0 - MARGIN_PX, b.y0 - MARGIN_PX, b.x1 + MARGIN_PX, b.y1 + MARGIN_PX};
        wf_refine_want(e->refining, &e->refining->slot[e->first + i], b);
    }
}

weft_status wf_refine_estimate(wf_refining *refining, int64_t field, size_t first, size_t last,
                               wf_box *moved, weft_error *err) {
    estimate e = {.refining = refining,
                  .field = field,
                  .first = first,
                  .last = last,
                  .width = refining->plan->width_px,
                  .lines = refining->plan->lines};
    weft_status status = open_all(&e, err);
    gap *gaps = calloc((size_t)e.count + 1, sizeof *gaps);
    if (!status && !gaps) status = wf_fail(err, WEFT_NO_MEMORY, "no memory for an estimate");
    for (int y = 0; !status && y < e.lines; y += ROWS) status = look_at_band(&e, y, gaps, err);
    if (!status) tell(&e);
    *moved = e.moved;
    free(gaps);
    close_all(&e);
    return status;
}
