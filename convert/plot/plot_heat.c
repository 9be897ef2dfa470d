/* The plot module: how strong something is where in a picture, as a heat map. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>

#include "convert/plot/plot_draw.h"

WEFT_API wf_plot_fn wf_plot_heat;

enum {
    MARGIN = 24,
    HEADER = 76,
    SCALE_WIDTH = 22,
    SCALE_ROOM = 110,
    FOOTER = 24,
    TICKS = 5,
    MOST_PIXELS = 30000
};

/* From black over violet, red and yellow to white: lightness grows all the way, so that it
 * reads without color as well. */
static const double ramp[][3] = {{0.00, 0.00, 0.02}, {0.16, 0.06, 0.38}, {0.48, 0.11, 0.50},
                                 {0.80, 0.22, 0.38}, {0.97, 0.47, 0.18}, {0.99, 0.78, 0.28},
                                 {1.00, 0.99, 0.86}};
#define RAMP_LAST (sizeof ramp / sizeof *ramp - 1)

static uint32_t color_of(double share) {
    double at = fmin(fmax(share, 0), 1) * (double)RAMP_LAST;
    size_t low = at < (double)RAMP_LAST ? (size_t)at : RAMP_LAST - 1;
    uint32_t packed = 0;
    for (int c = 0; c < 3; c++) {
        double v = ramp[low][c] + (at - (double)low) * (ramp[low + 1][c] - ramp[low][c]);
        packed = packed << 8 | (uint32_t)lround(255 * v);
    }
    return packed;
}

static void fill_pixels(const wf_plot_map *map, unsigned char *data, int stride) {
    for (int y = 0; y < map->lines; y++) {
        uint32_t *to = (uint32_t *)(void *)(data + (size_t)y * (size_t)stride);
        const float *from = map->value + (size_t)y * (size_t)map->width_px;
        for (int x = 0; x < map->width_px; x++) to[x] = color_of((double)from[x] / map->high);
    }
}

/* The map as it would be on the display: pixels are not square. A picture that cannot be made
 * puts the canvas in error. */
static void draw_map(cairo_t *cr, const wf_plot_map *map, double width) {
    cairo_surface_t *picture =
        cairo_image_surface_create(CAIRO_FORMAT_RGB24, map->width_px, map->lines);
    if (!cairo_surface_status(picture))
        fill_pixels(map, cairo_image_surface_get_data(picture),
                    cairo_image_surface_get_stride(picture));
    cairo_surface_mark_dirty(picture);
    cairo_save(cr);
    cairo_translate(cr, MARGIN, HEADER);
    cairo_scale(cr, width / map->width_px, 1);
    cairo_set_source_surface(cr, picture, 0, 0);
    cairo_paint(cr);
    cairo_restore(cr);
    cairo_surface_destroy(picture);
}

static void draw_scale(cairo_t *cr, const wf_plot_map *map, double x) {
    for (int y = 0; y < map->lines; y++) {
        uint32_t c = color_of(1 - (y + 0.5) / map->lines);
        cairo_set_source_rgb(cr, (c >> 16) / 255.0, (c >> 8 & 255) / 255.0, (c & 255) / 255.0);
        cairo_rectangle(cr, x, HEADER + y, SCALE_WIDTH, 1);
        cairo_fill(cr);
    }
    wf_set_color(cr, wf_ink);
    wf_font(cr, 14, false);
    for (int i = 0; i <= TICKS; i++) {
        char text[32];
        double share = (double)i / TICKS, y = HEADER + (1 - share) * map->lines;
        snprintf(text, sizeof text, "%.3f", share * map->high);
        wf_text_at(cr, x + SCALE_WIDTH + 8, fmin(fmax(y + 5, HEADER + 11), HEADER + map->lines),
                   0, text);
    }
}

static void draw_titles(cairo_t *cr, const wf_plot_map *map) {
    wf_set_color(cr, wf_ink);
    wf_font(cr, 22, true);
    wf_text_at(cr, MARGIN, 34, 0, map->title);
    wf_set_color(cr, wf_faint);
    wf_font(cr, 15, false);
    wf_text_at(cr, MARGIN, 60, 0, map->subtitle);
}

weft_status wf_plot_heat(const void *drawn, wf_plot_write_fn *write, void *to,
                         weft_error *err) {
    const wf_plot_map *map = drawn;
    double width = fmax(round(map->width_px * map->pixel_aspect), 1);
    if (width > MOST_PIXELS || map->lines > MOST_PIXELS)
        return wf_fail(err, WEFT_FAILED,
                       "the heat map would be %.0f pixels wide and %d high, and %d is the most",
                       width, map->lines, MOST_PIXELS);
    wf_canvas canvas =
        wf_canvas_new((int)width + 2 * MARGIN + SCALE_ROOM, map->lines + HEADER + FOOTER);
    draw_titles(canvas.cr, map);
    draw_map(canvas.cr, map, width);
    draw_scale(canvas.cr, map, MARGIN + width + 16);
    return wf_canvas_finish(&canvas, write, to, err);
}
