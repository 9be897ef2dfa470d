/* The legend of a plot: a box in a corner of the axes, or lines of names below them. */
#include <math.h>

#include "convert/plot/parts.h"

/* ---- A box in a corner ---- */

#define ROW 30 /* its height, and so on: units of the large looks */

static void draw_sample(wf_canvas *c, const wf_look *look, const wf_plot_item *item, double x,
                        double y, double length) {
    wf_pen pen = wf_item_pen(look, item);
    if (item->kind == WF_ITEM_LINE) {
        c->on->line(c, &pen, (double[]){x, x + length}, (double[]){y, y}, 2);
        return;
    }
    pen = (wf_pen){.ink = pen.ink};
    c->on->disk(c, &pen, x + length / 2, y, 3.5, look->rim);
}

static size_t widest(const wf_plot *plot, double *width) {
    size_t count = 0;
    *width = 0;
    for (size_t i = 0; i < plot->panel->items; i++) {
        if (!plot->panel->item[i].name) continue;
        *width =
            fmax(*width, wf_text_width(&wf_look_of(plot)->name, plot->panel->item[i].name));
        count++;
    }
    return count;
}

static wf_box corner_box(const wf_axes *a) {
    const wf_look *look = a->layout->look;
    double width;
    size_t count = widest(a->layout->plot, &width);
    wf_box b = {.width = width + 84, .height = ROW * (double)count + 2 * look->legend_pad};
    b.x = a->box.x + a->box.width - b.width - look->legend_margin;
    b.y = look->legend == WF_LEGEND_UPPER
              ? a->box.y + look->legend_margin
              : a->box.y + a->box.height - b.height - look->legend_margin;
    return count ? b : (wf_box){0};
}

static wf_box draw_corner(wf_canvas *c, const wf_axes *a) {
    const wf_look *look = a->layout->look;
    const wf_pen ground = {.ink = WF_INK_PAPER, .clear = look->legend_clear};
    const wf_pen edge = {.ink = WF_INK_GRID, .width = 1};
    wf_box b = corner_box(a), drawn = b;
    if (b.width == 0) return b;
    drawn.x += look->legend_nudge;
    drawn.y += look->legend_nudge;
    c->on->box(c, &ground, &drawn);
    c->on->box(c, &edge, &drawn);
    double middle = b.y + look->legend_pad + ROW * 0.5;
    for (size_t i = 0; i < a->panel->items; i++) {
        const wf_plot_item *item = &a->panel->item[i];
        if (!item->name) continue;
        draw_sample(c, look, item, b.x + 16, middle, 40);
        c->on->text(c, &look->name, b.x + 68, middle + 6, 0, item->name);
        middle += ROW;
    }
    return b;
}

/* ---- Lines below ---- */

enum { LINE = 19, SAMPLE = 24, BEFORE_NAME = 7, BETWEEN = 16 };

/* Goes through the names from left to right and line by line; with no canvas it only counts. */
static int walk_names(wf_canvas *c, const wf_plot *plot, double left, double right,
                      double top) {
    const wf_look *look = wf_look_of(plot);
    double x = left;
    int lines = 0;
    for (size_t i = 0; i < plot->panel->items; i++) {
        const wf_plot_item *item = &plot->panel->item[i];
        if (!item->name) continue;
        double width = SAMPLE + BEFORE_NAME + wf_text_width(&look->name, item->name);
        if (!lines || x + width > right) {
            x = left;
            lines++;
        }
        double y = top + LINE * (lines - 0.5);
        if (c) draw_sample(c, look, item, x, y, SAMPLE);
        if (c) c->on->text(c, &look->name, x + SAMPLE + BEFORE_NAME, y + 4, 0, item->name);
        x += width + BETWEEN;
    }
    return lines;
}

static double right_of(const wf_plot *plot) {
    const wf_look *look = wf_look_of(plot);
    return (plot->width ? plot->width : look->width) - look->right;
}

double wf_legend_height(const wf_plot *plot) {
    const wf_look *look = wf_look_of(plot);
    if (look->legend != WF_LEGEND_BELOW) return 0;
    int lines = walk_names(NULL, plot, look->left, right_of(plot), 0);
    return lines ? LINE * lines + 8 : 0;
}

wf_box wf_draw_legend(wf_canvas *c, const wf_axes *a) {
    const wf_layout *layout = a->layout;
    if (layout->look->legend != WF_LEGEND_BELOW) return draw_corner(c, a);
    walk_names(c, layout->plot, layout->look->left, right_of(layout->plot),
               layout->axes_height + 5);
    return (wf_box){0};
}
