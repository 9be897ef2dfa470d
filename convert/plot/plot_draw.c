#include "convert/plot/plot_draw.h"

#include <math.h>

/* Told apart by most color-blind readers (Okabe and Ito's set, darkened for thin lines). */
const wf_rgb wf_palette[WF_COLORS] = {
    {0.00, 0.40, 0.66}, {0.84, 0.37, 0.00}, {0.00, 0.56, 0.42}, {0.72, 0.40, 0.60},
    {0.55, 0.45, 0.05}, {0.25, 0.63, 0.85}, {0.40, 0.27, 0.72}, {0.36, 0.38, 0.40}};

void wf_set_color(cairo_t *cr, wf_rgb c) {
    cairo_set_source_rgb(cr, c.r, c.g, c.b);
}

double wf_text_width(cairo_t *cr, const char *text) {
    cairo_text_extents_t extents;
    cairo_text_extents(cr, text, &extents);
    return extents.x_advance;
}

void wf_text_at(cairo_t *cr, double x, double y, double across, const char *text) {
    cairo_move_to(cr, x - across * wf_text_width(cr, text), y);
    cairo_show_text(cr, text);
}

void wf_font(cairo_t *cr, double size, bool bold) {
    cairo_select_font_face(cr, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cr, size);
}

void wf_segment(cairo_t *cr, double x0, double y0, double x1, double y1) {
    cairo_move_to(cr, x0, y0);
    cairo_line_to(cr, x1, y1);
    cairo_stroke(cr);
}

void wf_dot(cairo_t *cr, double x, double y, double radius) {
    cairo_new_path(cr);
    cairo_arc(cr, x, y, radius, 0, 2 * M_PI);
    cairo_fill_preserve(cr);
    wf_set_color(cr, wf_paper);
    cairo_set_line_width(cr, 2);
    cairo_stroke(cr);
}

/* ---- Writing ---- */

wf_canvas wf_canvas_new(int width, int height) {
    wf_canvas canvas = {.surface =
                            cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height)};
    canvas.cr = cairo_create(canvas.surface);
    wf_set_color(canvas.cr, wf_paper);
    cairo_paint(canvas.cr);
    return canvas;
}

typedef struct receiver {
    wf_plot_write_fn *write;
    void *to;
    weft_error *err;
    weft_status status; /* the first failure */
} receiver;

static cairo_status_t receive(void *closure, const unsigned char *data, unsigned length) {
    receiver *r = closure;
    if (!r->status) r->status = r->write(r->to, data, length, r->err);
    return r->status ? CAIRO_STATUS_WRITE_ERROR : CAIRO_STATUS_SUCCESS;
}

static weft_status write_png(cairo_surface_t *surface, wf_plot_write_fn *write, void *to,
                             weft_error *err) {
    receiver r = {.write = write, .to = to, .err = err};
    cairo_status_t status = cairo_surface_write_to_png_stream(surface, receive, &r);
    if (r.status) return r.status;
    if (status)
        return wf_fail(err, WEFT_FAILED, "the plot: %s", cairo_status_to_string(status));
    return WEFT_OK;
}

weft_status wf_canvas_finish(wf_canvas *canvas, wf_plot_write_fn *write, void *to,
                             weft_error *err) {
    cairo_status_t drawn = cairo_status(canvas->cr);
    weft_status status =
        drawn ? wf_fail(err, WEFT_FAILED, "the plot: %s", cairo_status_to_string(drawn))
              : write_png(canvas->surface, write, to, err);
    cairo_destroy(canvas->cr);
    cairo_surface_destroy(canvas->surface);
    return status;
}
