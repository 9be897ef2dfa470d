/* The bar beside a map that tells which value has which color. */
#include <math.h>

#include "convert/plot/parts.h"

enum { SPACE = 14, WIDTH = 12, NUMBERS = 40, WORDS = 16, STEPS = 64 };

static const wf_plot_item *told(const wf_plot_panel *panel) {
    for (size_t i = 0; i < panel->items; i++)
        if (panel->item[i].kind == WF_ITEM_MAP && panel->item[i].text) return &panel->item[i];
    return NULL;
}

double wf_bar_width(const wf_plot *plot) {
    for (size_t i = 0; i < plot->panels; i++)
        if (told(&plot->panel[i])) return SPACE + WIDTH + NUMBERS + WORDS;
    return 0;
}

static void draw_colors(wf_canvas *c, const wf_box *bar) {
    uint32_t pixel[STEPS];
    for (int y = 0; y < STEPS; y++) pixel[y] = wf_heat_color(1 - (y + 0.5) / STEPS);
    c->on->image(c, bar, pixel, 1, STEPS, false);
}

static void draw_numbers(wf_canvas *c, const wf_axes *a, const wf_box *bar,
                         const wf_plot_item *map) {
    const wf_look *look = a->layout->look;
    wf_scale scale = {.low = map->least, .high = map->most};
    scale.start = bar->y + bar->height;
    scale.end = bar->y;
    wf_scale_ticks(&scale, map->least, map->most);
    for (size_t i = 0; i < scale.ticks; i++) {
        char text[64];
        double y = wf_scale_at(&scale, scale.tick[i]);
        wf_number(scale.tick[i], -1, look->minus, text, sizeof text);
        c->on->text(c, &look->tick, bar->x + WIDTH + 5, y + 4, 0, text);
    }
}

void wf_draw_bar(wf_canvas *c, const wf_axes *a) {
    const wf_plot_item *map = told(a->panel);
    if (!map) return;
    wf_font upwards = a->layout->look->label;
    upwards.upwards = true;
    const wf_box bar = {a->box.x + a->box.width + SPACE, a->box.y, WIDTH, a->box.height};
    draw_colors(c, &bar);
    draw_numbers(c, a, &bar, map);
    c->on->text(c, &upwards, bar.x + WIDTH + NUMBERS + WORDS - 2, bar.y + bar.height / 2, 0.5,
                map->text);
}
