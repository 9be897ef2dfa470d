/* The plot module: how strong something is where in a picture, as a heat map. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "convert/plot/canvas.h"

WEFT_API wf_plot_fn wf_plot_heat;

enum {
    MARGIN = 24,
    HEADER = 76,
    SCALE_WIDTH = 22,
    SCALE_SPACE = 110,
    FOOTER = 24,
    TICKS = 5,
    MOST_PIXELS = 30000
};

/* The map as it would be on the display: pixels are not square. */
static void draw_map(wf_canvas *c, const wf_plot_map *map, double width) {
    size_t count = (size_t)map->width_px * (size_t)map->lines;
    uint32_t *pixel = malloc(count * sizeof *pixel);
    c->lost |= !pixel;
    for (size_t i = 0; pixel && i < count; i++)
        pixel[i] = wf_heat_color((double)map->value[i] / map->high);
    if (pixel)
        c->on->image(c, &(wf_box){MARGIN, HEADER, width, map->lines}, pixel, map->width_px,
                     map->lines, true);
    free(pixel);
}

static void draw_ramp(wf_canvas *c, const wf_plot_map *map, double x) {
    uint32_t *pixel = malloc((size_t)map->lines * sizeof *pixel);
    c->lost |= !pixel;
    for (int y = 0; pixel && y < map->lines; y++)
        pixel[y] = wf_heat_color(1 - (y + 0.5) / map->lines);
    if (pixel)
        c->on->image(c, &(wf_box){x, HEADER, SCALE_WIDTH, map->lines}, pixel, 1, map->lines,
                     false);
    free(pixel);
}

static void draw_numbers(wf_canvas *c, const wf_plot_map *map, double x) {
    const wf_font font = {.size = 14, .ink = WF_INK_TEXT};
    for (int i = 0; i <= TICKS; i++) {
        char text[32];
        double share = (double)i / TICKS, y = HEADER + (1 - share) * map->lines;
        snprintf(text, sizeof text, "%.3f", share * map->high);
        c->on->text(c, &font, x, fmin(fmax(y + 5, HEADER + 11), HEADER + map->lines), 0, text);
    }
}

static void draw(wf_canvas *c, const wf_plot_map *map, double width) {
    const wf_font title = {.size = 22, .bold = true, .ink = WF_INK_TEXT};
    const wf_font subtitle = {.size = 15, .ink = WF_INK_FAINT};
    double scale_x = MARGIN + width + 16;
    c->on->text(c, &title, MARGIN, 34, 0, map->title);
    c->on->text(c, &subtitle, MARGIN, 60, 0, map->subtitle);
    draw_map(c, map, width);
    draw_ramp(c, map, scale_x);
    draw_numbers(c, map, scale_x + SCALE_WIDTH + 8);
}

weft_status wf_plot_heat(const void *drawn, wf_plot_write_fn *write, void *to,
                         weft_error *err) {
    const wf_plot_map *map = drawn;
    double width = fmax(round(map->width_px * map->pixel_aspect), 1);
    if (width > MOST_PIXELS || map->lines > MOST_PIXELS)
        return wf_fail(err, WEFT_FAILED,
                       "the heat map would be %.0f pixels wide and %d high, and %d is the most",
                       width, map->lines, MOST_PIXELS);
    wf_canvas c;
    wf_canvas_png(&c, (int)width + 2 * MARGIN + SCALE_SPACE, map->lines + HEADER + FOOTER, 1);
    draw(&c, map, width);
    return c.on->finish(&c, write, to, err);
}
