/* Titles, grids, and the numbers and words about the axes of a plot. */
#include <math.h>

#include "convert/plot/parts.h"

void wf_draw_titles(wf_canvas *c, const wf_layout *layout) {
    const wf_plot *plot = layout->plot;
    const wf_look *look = layout->look;
    double middle = look->left + (layout->width - look->left - layout->right) / 2;
    if (plot->title) c->on->text(c, &look->title, look->left, look->title_y, 0, plot->title);
    if (plot->subtitle)
        c->on->text(c, &look->subtitle, look->left, look->subtitle_y, 0, plot->subtitle);
    if (plot->x.label)
        c->on->text(c, &look->label, middle, layout->axes_height - look->label_y, 0.5,
                    plot->x.label);
}

/* On the middle of a pixel, so that a thin line is sharp. */
static double snapped(const wf_look *look, double place) {
    return look->snap ? round(place) + 0.5 : place;
}

static void draw_columns(wf_canvas *c, const wf_axes *a) {
    const wf_look *look = a->layout->look;
    const wf_pen grid = {.ink = WF_INK_GRID, .width = 1};
    double floor_y = a->box.y + a->box.height;
    for (size_t i = 0; i < a->x.ticks; i++) {
        char text[64];
        double x = snapped(look, wf_scale_at(&a->x, a->x.tick[i]));
        c->on->line(c, &grid, (double[]){x, x}, (double[]){a->box.y, floor_y}, 2);
        wf_number(a->x.tick[i], a->x.digits, look->minus, text, sizeof text);
        c->on->text(c, &look->tick, x, floor_y + look->tick_x, 0.5, text);
    }
}

static void draw_rows(wf_canvas *c, const wf_axes *a) {
    const wf_look *look = a->layout->look;
    double right = a->box.x + a->box.width, middle = look->snap ? 6 : 4;
    for (size_t i = 0; i < a->y.ticks; i++) {
        char text[64];
        double value = a->y.tick[i], y = snapped(look, wf_scale_at(&a->y, value));
        bool stands_out = look->zero && fabs(value) < 1e-9;
        const wf_pen grid = {.ink = stands_out ? WF_INK_FAINT : WF_INK_GRID, .width = 1};
        c->on->line(c, &grid, (double[]){a->box.x, right}, (double[]){y, y}, 2);
        wf_number(value, a->y.digits, look->minus, text, sizeof text);
        c->on->text(c, &look->tick, a->box.x - look->tick_y, y + middle, 1, text);
    }
}

void wf_draw_axes(wf_canvas *c, const wf_axes *a) {
    const wf_look *look = a->layout->look;
    wf_font upwards = look->label;
    upwards.upwards = true;
    draw_columns(c, a);
    draw_rows(c, a);
    if (a->panel->heading)
        c->on->text(c, &look->heading, a->box.x, a->box.y - 16, 0, a->panel->heading);
    if (a->panel->y.label)
        c->on->text(c, &upwards, look->label_x, a->box.y + a->box.height / 2, 0.5,
                    a->panel->y.label);
}
