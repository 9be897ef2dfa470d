#ifndef WF_CONVERT_PLOT_PLOT_DRAW_H
#define WF_CONVERT_PLOT_PLOT_DRAW_H

#include <cairo.h>

#include "convert/plot/plot.h"

/* What the pictures of the plot module are drawn with. Lengths are pixels. */

typedef struct wf_rgb {
    double r, g, b;
} wf_rgb;

static const wf_rgb wf_ink = {0.13, 0.15, 0.20}, wf_faint = {0.45, 0.48, 0.54},
                    wf_grid = {0.90, 0.91, 0.93}, wf_mark = {0.80, 0.20, 0.25},
                    wf_paper = {1, 1, 1};

#define WF_COLORS 8
extern const wf_rgb wf_palette[WF_COLORS];

void wf_set_color(cairo_t *cr, wf_rgb c);

/* Text with its point (across of its width, 0: left, 1: right) at x, its baseline at y. */
void wf_text_at(cairo_t *cr, double x, double y, double across, const char *text);
double wf_text_width(cairo_t *cr, const char *text);

void wf_font(cairo_t *cr, double size, bool bold);
void wf_segment(cairo_t *cr, double x0, double y0, double x1, double y1);

/* A disk with a rim of paper about it. */
void wf_dot(cairo_t *cr, double x, double y, double radius);

typedef struct wf_canvas {
    cairo_surface_t *surface;
    cairo_t *cr;
} wf_canvas;

wf_canvas wf_canvas_new(int width, int height);

/* Writes the picture as PNG, unless something went wrong, and frees it. */
weft_status wf_canvas_finish(wf_canvas *canvas, wf_plot_write_fn *write, void *to,
                             weft_error *err);

#endif
