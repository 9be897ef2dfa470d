/* What plots are drawn on: a PNG, made by cairo, or an SVG, which is text. */
#ifndef WF_CONVERT_PLOT_CANVAS_H
#define WF_CONVERT_PLOT_CANVAS_H

#include <cairo.h>
#include <stdio.h>

#include "convert/plot/ink.h"
#include "convert/plot/plot.h"

/* Places and lengths are units of the picture, from its upper left corner. */
typedef struct wf_box {
    double x, y, width, height;
} wf_box;

/* width 0 fills. Fields that are 0 mean: opaque, no dashes, square ends, the ink's own color.
 */
typedef struct wf_pen {
    wf_ink ink;
    double width, clear; /* clear: 0 is opaque, 1 leaves no trace */
    double dash, gap;
    bool round;
    const double *gray; /* 0 to 1, in place of the ink; NULL: the ink */
} wf_pen;

typedef struct wf_font {
    double size;
    bool bold, upwards; /* upwards: turned to the left by a quarter */
    wf_ink ink;
} wf_font;

typedef struct wf_canvas wf_canvas;

/* The operations that a kind of canvas has. */
typedef struct wf_canvas_kind {
    void (*line)(wf_canvas *c, const wf_pen *pen, const double *x, const double *y, size_t n);
    void (*box)(wf_canvas *c, const wf_pen *pen, const wf_box *box);
    void (*disk)(wf_canvas *c, const wf_pen *pen, double x, double y, double radius,
                 double rim);
    void (*ring)(wf_canvas *c, const wf_pen *pen, double x, double y, double radius);
    /* The share `across` of the text is left of x; y is its baseline. */
    void (*text)(wf_canvas *c, const wf_font *font, double x, double y, double across,
                 const char *text);
    /* pixel: [rows][columns], packed as by wf_heat_color. */
    void (*image)(wf_canvas *c, const wf_box *box, const uint32_t *pixel, int columns, int rows,
                  bool smooth);
    void (*clip)(wf_canvas *c, const wf_box *box); /* what is drawn until unclip stays in box */
    void (*unclip)(wf_canvas *c);
    weft_status (*finish)(wf_canvas *c, wf_plot_write_fn *write, void *to, weft_error *err);
} wf_canvas_kind;

struct wf_canvas {
    const wf_canvas_kind *on;
    cairo_surface_t *surface; /* of a PNG */
    cairo_t *cr;
    FILE *svg; /* what has been written of an SVG; NULL: memory is out */
    char *text;
    size_t length;
    bool lost; /* memory ran out while it was drawn on: finish says so */
};

/* Make a canvas of paper, which stays where it is until canvas->on->finish has written it
 * (unless something went wrong) and freed it in any case. A canvas that could not be made is
 * drawn on in vain and says so when it is finished. */
void wf_canvas_png(wf_canvas *canvas, int width, int height, double pixels_per_unit);
void wf_canvas_svg(wf_canvas *canvas, int width, int height, const char *description);

/* How wide text is, by cairo's idea of the font. */
double wf_text_width(const wf_font *font, const char *text);

/* Writes a surface as PNG. */
weft_status wf_write_png(cairo_surface_t *surface, wf_plot_write_fn *write, void *to,
                         weft_error *err);

#endif
