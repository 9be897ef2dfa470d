/* Pictures through low passes down and across, by tiles of lines, leaving out what is nothing.
 */
#include "filters/seen/blur.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "filters/seen/seen_ops.h"

WF_ISA_DISPATCH(wf_seen_ops)

/* ---- Making them ---- */

/* What has the response exp(-(f / c)^2 / 2) between -1/2 and 1/2 cycles a sample: a Gaussian of
 * deviation 1 / (2 pi c) samples, or where that is less than a sample, what is left of it. */
static double tap(double c, int k) {
    enum { STEPS = 256 };
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        double f = 0.5 * (i + 0.5) / STEPS;
        sum += exp(-0.5 * f * f / (c * c)) * cos(2 * M_PI * f * k);
    }
    return sum / STEPS;
}

static bool make_low_pass(wf_low_pass *p, double deviation) {
    double sum = 0;
    p->reach = (int)ceil(4 * deviation) + (deviation > 2 ? 0 : 4);
    p->weight = malloc((size_t)(2 * p->reach + 1) * sizeof *p->weight);
    if (!p->weight) return false;
    float *half = p->weight + p->reach;
    for (int k = 0; k <= p->reach; k++) {
        double gauss = exp(-0.5 * k * k / (deviation * deviation));
        double value = deviation > 2 ? gauss : tap(1 / (2 * M_PI * deviation), k);
        half[k] = (float)value;
        sum += k ? 2 * value : value;
    }
    for (int k = 0; k <= p->reach; k++) {
        half[k] = (float)((double)half[k] / sum);
        p->weight[p->reach - k] = half[k];
    }
    return true;
}

/* The step of means, and what is left of the deviation, in such steps. */
static int step_of(double *deviation) {
    int step = 1;
    while (*deviation / (2 * step) > 2.5 && step < WF_BLUR_STEP) step *= 2;
    if (step > 1) *deviation = sqrt(*deviation * *deviation / (step * step) - 0.25);
    return step;
}

bool wf_blur_init(wf_blur *b, int width_px, int lines, double down, double across) {
    b->width_px = width_px;
    b->picture_lines = lines;
    b->step_y = step_of(&down);
    b->step_x = step_of(&across);
    b->lines = (lines + b->step_y - 1) / b->step_y;
    b->width = (width_px + b->step_x - 1) / b->step_x;
    if (!make_low_pass(&b->down, down) || !make_low_pass(&b->across, across)) return false;
    if (b->step_x == 1 && b->step_y == 1) return true;
    size_t bytes = (size_t)b->lines * (size_t)b->width * sizeof(float);
    bool made = true;
    for (int p = 0; p < 2; p++) {
        made &= !!(b->mean[p] = malloc(bytes));
        made &= !!(b->out[p] = malloc(bytes));
    }
    return made;
}

void wf_blur_free(wf_blur *b) {
    free(b->down.weight);
    free(b->across.weight);
    for (int p = 0; p < 2; p++) {
        free(b->mean[p]);
        free(b->out[p]);
    }
}

size_t wf_blur_margin(const wf_blur *b) {
    return 2 * (size_t)b->step_x;
}

int wf_blur_spans(int width_px) {
    return (width_px + WF_BLUR_SPAN - 1) / WF_BLUR_SPAN;
}

bool wf_blur_room_init(wf_blur_room *room, const wf_blur *blurs, int count, int every) {
    int down = 0, width_px = blurs[0].width_px;
    for (int i = 0; i < count; i++) {
        if (blurs[i].down.reach > down) down = blurs[i].down.reach;
        if (blurs[i].across.reach > room->reach) room->reach = blurs[i].across.reach;
    }
    size_t rows = 2 * (size_t)down + (size_t)every * WF_BLUR_TILE;
    room->stride = (size_t)width_px + 2 * (size_t)room->reach + 2;
    room->row = malloc(rows * sizeof *room->row);
    room->wide = malloc(WF_BLUR_TILE * room->stride * sizeof *room->wide);
    room->line = malloc(room->stride * sizeof *room->line);
    room->middle = malloc((size_t)wf_blur_spans(width_px) * sizeof *room->middle);
    return room->row && room->wide && room->line && room->middle;
}

void wf_blur_room_free(wf_blur_room *room) {
    free(room->row);
    free(room->wide);
    free(room->line);
    free(room->middle);
}

/* ---- Where there is something ---- */

bool wf_blur_marks_init(wf_blur_marks *m, int width_px, int lines) {
    m->spans = wf_blur_spans(width_px);
    m->above = calloc((size_t)(lines + 1) * (size_t)m->spans, sizeof *m->above);
    return m->above;
}

void wf_blur_marks_free(wf_blur_marks *m) {
    free(m->above);
}

static size_t span_width(int width, int span) {
    int left = width - span * WF_BLUR_SPAN;
    return (size_t)(left < WF_BLUR_SPAN ? left : WF_BLUR_SPAN);
}

void wf_blur_mark(wf_blur_marks *m, const float *picture, int width_px, int lines) {
    const wf_seen_ops *ops = wf_seen_ops_best();
    int *above = m->above;
    for (int y = 0; y < lines; y++, above += m->spans, picture += width_px)
        for (int j = 0; j < m->spans; j++)
            above[m->spans + j] =
                above[j] + ops->any(picture + j * WF_BLUR_SPAN, span_width(width_px, j));
}

/* Whether lines from .. to have something in a span. What lies beyond the picture is as in a
 * mirror, of lines that are as near. */
static bool marked(const wf_blur_marks *m, int from, int to, int lines, int span) {
    from = from < 0 ? 0 : from;
    to = to < lines ? to : lines - 1;
    if (from >= lines || to < 0) return true;
    return m->above[(to + 1) * m->spans + span] != m->above[from * m->spans + span];
}

/* ---- Low passes ---- */

/* Beyond its edges a picture is as in a mirror in its last line or column, so that what
 * alternates from line to line goes on to. */
static int mirrored(int at, int count) {
    int period = 2 * (count - 1);
    if (at >= 0 && at < count) return at;
    if (period == 0) return 0;
    at = at < 0 ? -at % period : at % period;
    return at < count ? at : period - at;
}

/* Lines of a picture or of means, through a blur's low passes or into `out`. */
typedef struct tile {
    int y, every, count;
    float *out;
    size_t stride;
} tile;

/* Spans down a tile, one after the other, so that the lines they are summed of stay near. */
static void pass_down(const wf_blur *b, wf_blur_room *room, const float *picture,
                      const wf_blur_marks *marks, const tile *t) {
    const wf_seen_ops *ops = wf_seen_ops_best();
    int reach = b->down.reach, last = t->y + (t->count - 1) * t->every;
    for (int k = 0; k < 2 * reach + 1 + last - t->y; k++)
        room->row[k] =
            picture + (size_t)mirrored(t->y - reach + k, b->lines) * (size_t)b->width;
    for (int j = 0; j < wf_blur_spans(b->width); j++) {
        size_t x = (size_t)j * WF_BLUR_SPAN, count = span_width(b->width, j);
        room->middle[j] = !marks || marked(marks, t->y - reach, last + reach, b->lines, j);
        for (int i = 0; i < t->count; i++) {
            float *out = room->wide + (size_t)i * room->stride + (size_t)room->reach + x;
            if (room->middle[j])
                ops->down(out, room->row + i * t->every, x, b->down.weight,
                          2 * (size_t)reach + 1, count);
            else
                memset(out, 0, count * sizeof *out);
        }
    }
}

/* Whether one of the spans from which a span takes something has any. */
static bool reached(const wf_blur *b, const wf_blur_room *room, int span) {
    int reach = b->across.reach, first = span * WF_BLUR_SPAN - reach;
    int last = (span + 1) * WF_BLUR_SPAN - 1 + reach;
    int from = first < 0 ? 0 : first / WF_BLUR_SPAN;
    int to = last < b->width ? last / WF_BLUR_SPAN : wf_blur_spans(b->width) - 1;
    if (reach >= b->width) return true;
    for (int j = from; j <= to; j++)
        if (room->middle[j]) return true;
    return false;
}

static void pass_across(const wf_blur *b, wf_blur_room *room, const tile *t, bool *live) {
    const wf_seen_ops *ops = wf_seen_ops_best();
    int reach = b->across.reach, width = b->width;
    for (int j = 0; live && j < wf_blur_spans(width); j++) live[j] = reached(b, room, j);
    for (int i = 0; i < t->count; i++) {
        float *middle = room->wide + (size_t)i * room->stride + (size_t)room->reach;
        float *out = t->out + (size_t)i * t->stride;
        for (int k = 1; k <= reach; k++) {
            middle[-k] = middle[mirrored(-k, width)];
            middle[width + k - 1] = middle[mirrored(width + k - 1, width)];
        }
        for (int j = 0; j < wf_blur_spans(width); j++) {
            size_t x = (size_t)j * WF_BLUR_SPAN;
            if (live && !live[j]) continue;
            ops->across(out + x, middle + x, b->across.weight + reach, (size_t)reach,
                        span_width(width, j));
        }
    }
}

/* ---- Means ---- */

/* One line of means of a picture; at its edges they may be of fewer samples. */
static void mean_line(const wf_blur *b, float *part, const float *picture, int line,
                      float *out) {
    int from = line * b->step_y, lines = b->picture_lines - from, width = b->width_px;
    if (lines > b->step_y) lines = b->step_y;
    memset(part, 0, (size_t)width * sizeof *part);
    for (int y = from; y < from + lines; y++)
        for (int x = 0; x < width; x++)
            part[x] += picture[(size_t)y * (size_t)width + (size_t)x];
    for (int i = 0; i < b->width; i++) {
        int first = i * b->step_x,
            count = width - first < b->step_x ? width - first : b->step_x;
        float sum = 0;
        for (int x = first; x < first + count; x++) sum += part[x];
        out[i] = sum / (float)(count * lines);
    }
}

void wf_blur_prepare(wf_blur *b, wf_blur_room *room, const float *picture, int which) {
    size_t width = (size_t)b->width;
    float *mean = b->mean[which];
    if (!mean) return;
    for (int i = 0; i < b->lines; i++)
        mean_line(b, room->line, picture, i, mean + (size_t)i * width);
    for (int y = 0; y < b->lines; y += WF_BLUR_TILE) {
        int count = b->lines - y < WF_BLUR_TILE ? b->lines - y : WF_BLUR_TILE;
        const tile t = {y, 1, count, b->out[which] + (size_t)y * width, width};
        pass_down(b, room, mean, NULL, &t);
        pass_across(b, room, &t, NULL);
    }
}

/* Where among means a line lies: past mean *low by the share that is returned. */
static float between(int at, int step, int count, int *low, int *high) {
    int twice = 2 * at - (step - 1), below = twice < 0 ? -1 : twice / (2 * step);
    *low = below < 0 ? 0 : below < count ? below : count - 1;
    *high = below + 1 < count ? below + 1 : count - 1;
    return (float)(twice - 2 * step * below) / (float)(2 * step);
}

/* A line of means, stretched over pixels. Marks the spans in which there is something. */
static void stretch_line(const wf_blur *b, wf_blur_room *room, int which, int y, float *out,
                         bool *live) {
    const wf_seen_ops *ops = wf_seen_ops_best();
    int low, high, step = b->step_x, width = b->width;
    float share = between(y, b->step_y, b->lines, &low, &high), *line = room->line + 1;
    const float *above = b->out[which] + (size_t)low * (size_t)width;
    const float *below = b->out[which] + (size_t)high * (size_t)width;
    for (int i = 0; i < width; i++) line[i] = above[i] + share * (below[i] - above[i]);
    line[-1] = line[0];
    line[width] = line[width - 1];
    ops->stretch(out - step / 2, line, (size_t)step, (size_t)width);
    for (int j = 0; j < wf_blur_spans(b->width_px); j++) {
        int from = j * WF_BLUR_SPAN / step - 1, to = ((j + 1) * WF_BLUR_SPAN - 1) / step + 1;
        if (to > width) to = width;
        if (!live[j]) live[j] = ops->any(line + from, (size_t)(to - from + 1));
    }
}

void wf_blur_tile(const wf_blur *b, wf_blur_room *room, const float *picture, int which,
                  const wf_blur_marks *marks, int y, int every, int count, float *out,
                  size_t stride, bool *live) {
    const tile t = {y, every, count, out, stride};
    if (!b->mean[which]) {
        pass_down(b, room, picture, marks, &t);
        pass_across(b, room, &t, live);
        return;
    }
    for (int j = 0; j < wf_blur_spans(b->width_px); j++) live[j] = !marks;
    for (int i = 0; i < count; i++)
        stretch_line(b, room, which, y + i * every, out + (size_t)i * stride, live);
}
