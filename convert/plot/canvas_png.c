/* Plots on a PNG, by cairo. */
#include <math.h>
#include <string.h>

#include "convert/plot/canvas.h"

static void set_font(cairo_t *cr, const wf_font *font) {
    cairo_select_font_face(cr, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           font->bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cr, font->size);
}

static double advance_of(cairo_t *cr, const char *text) {
    cairo_text_extents_t extents;
    cairo_text_extents(cr, text, &extents);
    return extents.x_advance;
}

double wf_text_width(const wf_font *font, const char *text) {
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 1, 1);
    cairo_t *cr = cairo_create(surface);
    set_font(cr, font);
    double width = advance_of(cr, text);
    cairo_destroy(cr);
    cairo_surface_destroy(surface);
    return width;
}

/* ---- Drawing ---- */

static void set_pen(cairo_t *cr, const wf_pen *pen) {
    wf_rgb c = wf_inks[pen->ink].light;
    if (pen->gray) c = (wf_rgb){*pen->gray, *pen->gray, *pen->gray};
    if (pen->clear > 0)
        cairo_set_source_rgba(cr, c.r, c.g, c.b, 1 - pen->clear);
    else
        cairo_set_source_rgb(cr, c.r, c.g, c.b);
    cairo_set_line_width(cr, pen->width);
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(cr, pen->round ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
    cairo_set_dash(cr, (const double[]){pen->dash, pen->gap}, pen->dash > 0 ? 2 : 0, 0);
}

/* Strokes or fills the path. */
static void paint(cairo_t *cr, const wf_pen *pen) {
    if (pen->width > 0)
        cairo_stroke(cr);
    else
        cairo_fill(cr);
}

static void png_line(wf_canvas *c, const wf_pen *pen, const double *x, const double *y,
                     size_t n) {
    set_pen(c->cr, pen);
    cairo_new_path(c->cr);
    for (size_t i = 0; i < n; i++) cairo_line_to(c->cr, x[i], y[i]);
    cairo_stroke(c->cr);
}

static void png_box(wf_canvas *c, const wf_pen *pen, const wf_box *box) {
    set_pen(c->cr, pen);
    cairo_rectangle(c->cr, box->x, box->y, box->width, box->height);
    paint(c->cr, pen);
}

static void png_ring(wf_canvas *c, const wf_pen *pen, double x, double y, double radius) {
    set_pen(c->cr, pen);
    cairo_new_path(c->cr);
    cairo_arc(c->cr, x, y, radius, 0, 2 * M_PI);
    paint(c->cr, pen);
}

static void png_disk(wf_canvas *c, const wf_pen *pen, double x, double y, double radius,
                     double rim) {
    const wf_pen edge = {.ink = WF_INK_PAPER, .width = rim};
    png_ring(c, pen, x, y, radius);
    if (rim > 0) png_ring(c, &edge, x, y, radius);
}

static void png_text(wf_canvas *c, const wf_font *font, double x, double y, double across,
                     const char *text) {
    const wf_pen pen = {.ink = font->ink};
    cairo_save(c->cr);
    set_pen(c->cr, &pen);
    set_font(c->cr, font);
    cairo_translate(c->cr, x, y);
    if (font->upwards) cairo_rotate(c->cr, -M_PI / 2);
    cairo_move_to(c->cr, -across * advance_of(c->cr, text), 0);
    cairo_show_text(c->cr, text);
    cairo_restore(c->cr);
    cairo_new_path(c->cr);
}

/* A picture that cannot be made puts the canvas in error. */
static void png_image(wf_canvas *c, const wf_box *box, const uint32_t *pixel, int columns,
                      int rows, bool smooth) {
    cairo_surface_t *picture = cairo_image_surface_create(CAIRO_FORMAT_RGB24, columns, rows);
    unsigned char *data = cairo_image_surface_get_data(picture);
    size_t stride = (size_t)cairo_image_surface_get_stride(picture);
    for (int y = 0; y < rows && data; y++)
        memcpy(data + (size_t)y * stride, pixel + (size_t)y * (size_t)columns,
               (size_t)columns * sizeof *pixel);
    cairo_surface_mark_dirty(picture);
    cairo_save(c->cr);
    cairo_translate(c->cr, box->x, box->y);
    cairo_scale(c->cr, box->width / columns, box->height / rows);
    cairo_set_source_surface(c->cr, picture, 0, 0);
    if (!smooth) cairo_pattern_set_filter(cairo_get_source(c->cr), CAIRO_FILTER_NEAREST);
    cairo_paint(c->cr);
    cairo_restore(c->cr);
    cairo_surface_destroy(picture);
}

static void png_clip(wf_canvas *c, const wf_box *box) {
    cairo_save(c->cr);
    cairo_rectangle(c->cr, box->x, box->y, box->width, box->height);
    cairo_clip(c->cr);
}

static void png_unclip(wf_canvas *c) {
    cairo_restore(c->cr);
}

/* ---- Writing ---- */

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

static weft_status refuse(cairo_status_t status, weft_error *err) {
    if (status == CAIRO_STATUS_NO_MEMORY) return wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    return wf_fail(err, WEFT_FAILED, "the plot: %s", cairo_status_to_string(status));
}

weft_status wf_write_png(cairo_surface_t *surface, wf_plot_write_fn *write, void *to,
                         weft_error *err) {
    receiver r = {.write = write, .to = to, .err = err};
    cairo_status_t status = cairo_surface_write_to_png_stream(surface, receive, &r);
    if (r.status) return r.status;
    return status ? refuse(status, err) : WEFT_OK;
}

static weft_status png_finish(wf_canvas *c, wf_plot_write_fn *write, void *to,
                              weft_error *err) {
    cairo_status_t drawn = cairo_status(c->cr);
    if (c->lost) drawn = CAIRO_STATUS_NO_MEMORY;
    weft_status status = drawn ? refuse(drawn, err) : wf_write_png(c->surface, write, to, err);
    cairo_destroy(c->cr);
    cairo_surface_destroy(c->surface);
    return status;
}

static const wf_canvas_kind png = {png_line,  png_box,  png_disk,   png_ring,  png_text,
                                   png_image, png_clip, png_unclip, png_finish};

void wf_canvas_png(wf_canvas *canvas, int width, int height, double pixels_per_unit) {
    const wf_pen paper = {.ink = WF_INK_PAPER};
    *canvas = (wf_canvas){.on = &png};
    canvas->surface =
        cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)lround(width * pixels_per_unit),
                                   (int)lround(height * pixels_per_unit));
    canvas->cr = cairo_create(canvas->surface);
    cairo_scale(canvas->cr, pixels_per_unit, pixels_per_unit);
    png_box(canvas, &paper, &(wf_box){0, 0, width, height});
}
