/* Lines, dots, words and whatever else is drawn over the axes of a plot: a function a kind. */
#include <math.h>
#include <stdlib.h>

#include "convert/plot/parts.h"

wf_pen wf_item_pen(const wf_look *look, const wf_plot_item *item) {
    wf_pen pen = {.ink = wf_ink_of_series(item->series), .width = look->line};
    pen.round = look->legend == WF_LEGEND_BELOW;
    if (!item->dashed) return pen;
    pen.dash = look->dash;
    pen.gap = look->gap_between;
    pen.round = false;
    return pen;
}

static double across(const wf_axes *a, double x) {
    return wf_scale_at(&a->x, x);
}

static double down(const wf_axes *a, double y) {
    return wf_scale_at(&a->y, y);
}

/* A line that leaves the axes goes on for their size beyond them, where it is cut off. */
static double at_most_beyond(double place, double start, double size) {
    return fmin(fmax(place, start - size), start + 2 * size);
}

static void draw_line(wf_canvas *c, const wf_axes *a, const wf_plot_item *item) {
    const wf_pen pen = wf_item_pen(a->layout->look, item);
    const wf_box inside = {a->box.x, a->box.y - 2, a->box.width, a->box.height + 4};
    double *place = malloc((2 * item->points + 1) * sizeof *place);
    if (!place) {
        c->lost = true;
        return;
    }
    for (size_t i = 0; i < item->points; i++) {
        place[i] = at_most_beyond(across(a, item->x[i]), a->box.x, a->box.width);
        place[item->points + i] = at_most_beyond(down(a, item->y[i]), a->box.y, a->box.height);
    }
    c->on->clip(c, &inside);
    c->on->line(c, &pen, place, place + item->points, item->points);
    c->on->unclip(c);
    free(place);
}

static void draw_points(wf_canvas *c, const wf_axes *a, const wf_plot_item *item) {
    const wf_look *look = a->layout->look;
    double radius = item->radius > 0 ? item->radius : look->radius;
    wf_pen pen = wf_item_pen(look, item);
    if (!item->hollow) pen = (wf_pen){.ink = pen.ink};
    for (size_t i = 0; i < item->points; i++) {
        double x = across(a, wf_scale_within(&a->x, item->x[i]));
        double y = down(a, wf_scale_within(&a->y, item->y[i]));
        pen.gray = item->shade ? &item->shade[i] : NULL;
        if (item->hollow)
            c->on->ring(c, &pen, x, y, radius);
        else
            c->on->disk(c, &pen, x, y, radius, item->shade ? 0 : look->rim);
    }
}

static void draw_word(wf_canvas *c, const wf_axes *a, const wf_plot_item *item) {
    wf_font font = a->layout->look->word;
    if (item->series) font.ink = wf_ink_of_series(item->series);
    c->on->text(c, &font, across(a, item->x[0]) + item->dx, down(a, item->y[0]) + item->dy,
                item->anchor, item->text);
}

static void draw_upright_rule(wf_canvas *c, const wf_axes *a, const wf_plot_item *item) {
    const wf_look *look = a->layout->look;
    double x = across(a, item->x[0]), floor_y = a->box.y + a->box.height;
    double at = look->snap ? round(x) + 0.5 : x;
    c->on->line(c, &look->rule, (double[]){at, at}, (double[]){a->box.y, floor_y}, 2);
    if (item->text && look->rule_above)
        c->on->text(c, &look->word, x, a->box.y - 12, 0.5, item->text);
    else if (item->text)
        c->on->text(c, &look->word, x + 4, a->box.y + 12, 0, item->text);
}

static void draw_rule(wf_canvas *c, const wf_axes *a, const wf_plot_item *item) {
    const wf_look *look = a->layout->look;
    if (item->x) {
        draw_upright_rule(c, a, item);
        return;
    }
    double y = down(a, item->y[0]), right = a->box.x + a->box.width;
    c->on->line(c, &look->rule, (double[]){a->box.x, right}, (double[]){y, y}, 2);
    if (item->text) c->on->text(c, &look->word, right - 4, y - 5, 1, item->text);
}

static void draw_band(wf_canvas *c, const wf_axes *a, const wf_plot_item *item) {
    const wf_pen tint = {.ink = WF_INK_MARK, .clear = 0.9};
    double x0 = across(a, wf_scale_within(&a->x, item->x[0]));
    double x1 = across(a, wf_scale_within(&a->x, item->x[1]));
    c->on->box(c, &tint, &(wf_box){fmin(x0, x1), a->box.y, fabs(x1 - x0), a->box.height});
    if (item->text)
        c->on->text(c, &a->layout->look->word, (x0 + x1) / 2, a->box.y + 13, 0.5, item->text);
}

/* What the points i and i + 1 span, within the axes. */
static wf_box spanned(const wf_axes *a, const wf_plot_item *item, size_t i) {
    double x0 = across(a, wf_scale_within(&a->x, item->x[i]));
    double x1 = across(a, wf_scale_within(&a->x, item->x[i + 1]));
    double y0 = down(a, wf_scale_within(&a->y, item->y[i]));
    double y1 = down(a, wf_scale_within(&a->y, item->y[i + 1]));
    return (wf_box){fmin(x0, x1), fmin(y0, y1), fabs(x1 - x0), fabs(y1 - y0)};
}

/* Boxes that touch are told apart by a gap of 4 units. */
static void draw_boxes(wf_canvas *c, const wf_axes *a, const wf_plot_item *item) {
    const wf_pen tint = {.ink = wf_ink_of_series(item->series), .clear = 0.45};
    for (size_t i = 0; i + 1 < item->points; i += 2) {
        wf_box b = spanned(a, item, i);
        b = (wf_box){b.x + 2, b.y + 2, fmax(b.width - 4, 0), fmax(b.height - 4, 0)};
        c->on->box(c, &tint, &b);
    }
}

static void draw_map(wf_canvas *c, const wf_axes *a, const wf_plot_item *item) {
    size_t count = item->rows * item->columns;
    uint32_t *pixel = malloc(count * sizeof *pixel);
    if (!pixel) {
        c->lost = true;
        return;
    }
    for (size_t i = 0; i < count; i++)
        pixel[i] = wf_heat_color((item->value[i] - item->least) / (item->most - item->least));
    wf_box box = spanned(a, item, 0);
    c->on->image(c, &box, pixel, (int)item->columns, (int)item->rows, false);
    free(pixel);
}

static void draw_ring(wf_canvas *c, const wf_axes *a, const wf_plot_item *item) {
    const wf_pen plain = {.ink = WF_INK_RING, .width = 1.4};
    const wf_pen dashed = {.ink = WF_INK_CARRIER, .width = 1.4, .dash = 3, .gap = 3};
    const wf_pen *pen = item->dashed ? &dashed : &plain;
    const wf_font font = {.size = 12, .ink = pen->ink};
    double radius = item->radius > 0 ? item->radius : 13;
    double x = across(a, item->x[0]), y = down(a, item->y[0]);
    c->on->ring(c, pen, x, y, radius);
    if (item->text)
        c->on->text(c, &font, x, y + (item->below ? radius + 13 : -radius - 5), 0.5,
                    item->text);
}

typedef void draw_fn(wf_canvas *c, const wf_axes *a, const wf_plot_item *item);

/* Labels come last of all, and are not drawn here. */
static draw_fn *const draw[] = {
    [WF_ITEM_LINE] = draw_line,   [WF_ITEM_POINTS] = draw_points, [WF_ITEM_LABEL] = NULL,
    [WF_ITEM_WORD] = draw_word,   [WF_ITEM_RULE] = draw_rule,     [WF_ITEM_BAND] = draw_band,
    [WF_ITEM_BOXES] = draw_boxes, [WF_ITEM_MAP] = draw_map,       [WF_ITEM_RING] = draw_ring,
};

void wf_draw_items(wf_canvas *c, const wf_axes *a) {
    for (size_t i = 0; i < a->panel->items; i++)
        if (draw[a->panel->item[i].kind])
            draw[a->panel->item[i].kind](c, a, &a->panel->item[i]);
}
