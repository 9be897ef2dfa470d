/* Plots as SVG: elements whose classes take their colors from a style of light and dark
 * schemes. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "convert/plot/canvas.h"

/* ---- Pieces ---- */

/* Text of XML. Control characters, which XML has not, become blanks. */
static void put_text(FILE *f, const char *text) {
    static const char *const entities[128] = {
        ['<'] = "&lt;", ['>'] = "&gt;", ['&'] = "&amp;", ['"'] = "&quot;"};
    for (; *text; text++) {
        unsigned char byte = (unsigned char)*text;
        if (byte < 128 && entities[byte])
            fputs(entities[byte], f);
        else
            fputc(byte < ' ' || byte == 127 ? ' ' : byte, f);
    }
}

/* A length to a hundredth, without zeros that say nothing. */
static void put_number(FILE *f, double value) {
    char text[32];
    double hundredths = round(value * 100) / 100;
    snprintf(text, sizeof text, "%.10g", hundredths == 0 ? 0 : hundredths);
    fputs(text, f);
}

static void put_attribute(FILE *f, const char *name, double value) {
    fprintf(f, " %s=\"", name);
    put_number(f, value);
    fputc('"', f);
}

static void put_pen(FILE *f, const wf_pen *pen) {
    char color[32] = "currentColor";
    if (pen->gray) {
        int level = (int)lround(255 * fmin(fmax(*pen->gray, 0), 1));
        snprintf(color, sizeof color, "rgb(%d,%d,%d)", level, level, level);
    }
    fprintf(f, " class=\"%s\"", wf_inks[pen->ink].name);
    if (pen->width > 0)
        fprintf(f, " fill=\"none\" stroke=\"%s\" stroke-width=\"%g\"", color, pen->width);
    else
        fprintf(f, " fill=\"%s\"", color);
    if (pen->clear > 0) fprintf(f, " opacity=\"%g\"", 1 - pen->clear);
    if (pen->dash > 0) fprintf(f, " stroke-dasharray=\"%g %g\"", pen->dash, pen->gap);
    if (pen->round) fputs(" stroke-linejoin=\"round\" stroke-linecap=\"round\"", f);
}

static void put_circle(FILE *f, double x, double y, double radius) {
    fputs("<circle", f);
    put_attribute(f, "cx", x);
    put_attribute(f, "cy", y);
    put_attribute(f, "r", radius);
}

static void put_box(FILE *f, const wf_box *box) {
    put_attribute(f, "x", box->x);
    put_attribute(f, "y", box->y);
    put_attribute(f, "width", box->width);
    put_attribute(f, "height", box->height);
}

/* ---- Drawing ---- */

static void svg_line(wf_canvas *c, const wf_pen *pen, const double *x, const double *y,
                     size_t n) {
    if (!c->svg) return;
    fputs("<polyline", c->svg);
    put_pen(c->svg, pen);
    fputs(" points=\"", c->svg);
    for (size_t i = 0; i < n; i++) {
        if (i) fputc(' ', c->svg);
        put_number(c->svg, x[i]);
        fputc(',', c->svg);
        put_number(c->svg, y[i]);
    }
    fputs("\"/>\n", c->svg);
}

static void svg_box(wf_canvas *c, const wf_pen *pen, const wf_box *box) {
    if (!c->svg) return;
    fputs("<rect", c->svg);
    put_box(c->svg, box);
    put_pen(c->svg, pen);
    fputs("/>\n", c->svg);
}

static void svg_ring(wf_canvas *c, const wf_pen *pen, double x, double y, double radius) {
    if (!c->svg) return;
    put_circle(c->svg, x, y, radius);
    put_pen(c->svg, pen);
    fputs("/>\n", c->svg);
}

static void svg_disk(wf_canvas *c, const wf_pen *pen, double x, double y, double radius,
                     double rim) {
    if (!c->svg) return;
    put_circle(c->svg, x, y, radius);
    put_pen(c->svg, pen);
    if (rim > 0)
        fprintf(c->svg, " style=\"stroke:var(--weft-paper)\" stroke-width=\"%g\"", rim);
    fputs("/>\n", c->svg);
}

static void svg_text(wf_canvas *c, const wf_font *font, double x, double y, double across,
                     const char *text) {
    const char *anchor = across <= 0 ? "start" : across < 1 ? "middle" : "end";
    if (!c->svg) return;
    fputs("<text", c->svg);
    if (font->upwards) {
        fputs(" transform=\"translate(", c->svg);
        put_number(c->svg, x);
        fputc(' ', c->svg);
        put_number(c->svg, y);
        fputs(") rotate(-90)\"", c->svg);
    } else {
        put_attribute(c->svg, "x", x);
        put_attribute(c->svg, "y", y);
    }
    fprintf(
        c->svg, " class=\"%s\" fill=\"currentColor\" font-size=\"%g\" text-anchor=\"%s\"%s>",
        wf_inks[font->ink].name, font->size, anchor, font->bold ? " font-weight=\"bold\"" : "");
    put_text(c->svg, text);
    fputs("</text>\n", c->svg);
}

/* ---- Images ---- */

/* Bytes as base64, three at a time: up to two wait for the third. */
typedef struct base64 {
    FILE *f;
    unsigned waiting;
    int count;
} base64;

static void put_group(const base64 *b, int digits) {
    static const char alphabet[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (int i = 0; i < 4; i++)
        fputc(i < digits ? alphabet[b->waiting >> (18 - 6 * i) & 63] : '=', b->f);
}

static weft_status put_base64(void *to, const void *data, size_t bytes, weft_error *err) {
    base64 *b = to;
    (void)err;
    for (size_t i = 0; i < bytes; i++) {
        b->waiting |= (unsigned)((const unsigned char *)data)[i] << (16 - 8 * b->count);
        if (++b->count < 3) continue;
        put_group(b, 4);
        b->waiting = 0;
        b->count = 0;
    }
    return WEFT_OK;
}

static weft_status put_png(FILE *f, const uint32_t *pixel, int columns, int rows) {
    base64 b = {.f = f};
    cairo_surface_t *picture =
        cairo_image_surface_create_for_data((unsigned char *)(void *)(uintptr_t)pixel,
                                            CAIRO_FORMAT_RGB24, columns, rows, 4 * columns);
    weft_status status = wf_write_png(picture, put_base64, &b, NULL);
    cairo_surface_destroy(picture);
    if (b.count) put_group(&b, b.count + 1);
    return status;
}

static void svg_image(wf_canvas *c, const wf_box *box, const uint32_t *pixel, int columns,
                      int rows, bool smooth) {
    if (!c->svg) return;
    fputs("<image", c->svg);
    put_box(c->svg, box);
    fprintf(c->svg, " preserveAspectRatio=\"none\"%s href=\"data:image/png;base64,",
            smooth ? "" : " style=\"image-rendering:pixelated\"");
    weft_status status = put_png(c->svg, pixel, columns, rows);
    fputs("\"/>\n", c->svg);
    if (status) c->lost = true;
}

/* ---- The document ---- */

/* An inner picture keeps what is drawn within its bounds, and needs no name that others could
 * have. */
static void svg_clip(wf_canvas *c, const wf_box *box) {
    if (!c->svg) return;
    fputs("<svg", c->svg);
    put_box(c->svg, box);
    fputs(" viewBox=\"", c->svg);
    put_number(c->svg, box->x);
    fputc(' ', c->svg);
    put_number(c->svg, box->y);
    fputc(' ', c->svg);
    put_number(c->svg, box->width);
    fputc(' ', c->svg);
    put_number(c->svg, box->height);
    fputs("\">\n", c->svg);
}

static void svg_unclip(wf_canvas *c) {
    if (c->svg) fputs("</svg>\n", c->svg);
}

/* The style holds for all plots of a page that they are put into, and is the same in each. */
static void put_colors(FILE *f, bool dark) {
    const char *paper =
        dark ? wf_inks[WF_INK_PAPER].dark_text : wf_inks[WF_INK_PAPER].light_text;
    fprintf(f, ".weft-plot{--weft-paper:%s}", paper);
    for (int i = 0; i < WF_INKS; i++)
        fprintf(f, ".weft-plot .%s{color:%s}", wf_inks[i].name,
                dark ? wf_inks[i].dark_text : wf_inks[i].light_text);
}

static void put_head(FILE *f, int width, int height, const char *description) {
    fprintf(
        f,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"weft-plot\" viewBox=\"0 0 %d %d\" "
        "width=\"%d\" height=\"%d\" font-family=\"sans-serif\" role=\"img\" aria-label=\"",
        width, height, width, height);
    put_text(f, description);
    fputs("\">\n<title>", f);
    put_text(f, description);
    fputs("</title>\n<style>", f);
    put_colors(f, false);
    fputs("@media(prefers-color-scheme:dark){", f);
    put_colors(f, true);
    fputs("}</style>\n", f);
}

static weft_status svg_finish(wf_canvas *c, wf_plot_write_fn *write, void *to,
                              weft_error *err) {
    bool whole = c->svg && fputs("</svg>\n", c->svg) >= 0 && !ferror(c->svg) && !c->lost;
    if (c->svg && fclose(c->svg)) whole = false;
    weft_status status = whole ? write(to, c->text, c->length, err)
                               : wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    free(c->text);
    return status;
}

static const wf_canvas_kind svg = {svg_line,  svg_box,  svg_disk,   svg_ring,  svg_text,
                                   svg_image, svg_clip, svg_unclip, svg_finish};

/* canvas stays where it is: the stream keeps the addresses of its text and length. */
void wf_canvas_svg(wf_canvas *canvas, int width, int height, const char *description) {
    *canvas = (wf_canvas){.on = &svg};
    canvas->svg = open_memstream(&canvas->text, &canvas->length);
    if (!canvas->svg) return;
    put_head(canvas->svg, width, height, description);
    const wf_pen paper = {.ink = WF_INK_PAPER};
    svg_box(canvas, &paper, &(wf_box){0, 0, width, height});
}
