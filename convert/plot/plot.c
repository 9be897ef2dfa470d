/* The plot module: frequency responses drawn with Cairo. */

#include <cairo.h>
#include <math.h>
#include <stdio.h>

#include "convert/plot/plot_draw.h"

WEFT_API wf_plot_fn wf_plot_png;

enum {
    WIDTH = 1280,
    HEIGHT = 1120,
    LEFT = 96,
    RIGHT = 40,
    PANEL_GAP = 84,
    TOP = 150,
    BOTTOM = 84
};

/* One pair of axes: y runs from `low` at the bottom to `high` at the top. */
typedef struct panel {
    double x, y, width, height; /* pixels */
    double low, high, step;
    const char *label, *tick_format;
    double (*scale)(double value);
} panel;

static double as_value(double value) {
    return value;
}
static double as_decibels(double value) {
    return 20 * log10(fmax(fabs(value), 1e-12));
}

static double pixel_x(const panel *p, const wf_plot *plot, double x) {
    return p->x + p->width * x / plot->x_end;
}

static double pixel_y(const panel *p, double y) {
    return p->y + p->height * (p->high - y) / (p->high - p->low);
}

/* ---- Parts of the picture ---- */

static void draw_grid(cairo_t *cr, const panel *p, const wf_plot *plot) {
    char tick[32];
    wf_font(cr, 17, false);
    cairo_set_line_width(cr, 1);
    for (int i = 0; i <= 10; i++) {
        double x = round(pixel_x(p, plot, plot->x_end * i / 10)) + 0.5;
        wf_set_color(cr, wf_grid);
        wf_segment(cr, x, p->y, x, p->y + p->height);
        snprintf(tick, sizeof tick, "%.1f", plot->x_end * i / 10);
        wf_set_color(cr, wf_faint);
        wf_text_at(cr, x, p->y + p->height + 26, 0.5, tick);
    }
    int steps = (int)lround((p->high - p->low) / p->step);
    for (int i = 0; i <= steps; i++) {
        double value = p->low + i * p->step, y = round(pixel_y(p, value)) + 0.5;
        wf_set_color(cr, fabs(value) < 1e-9 ? wf_faint : wf_grid);
        wf_segment(cr, p->x, y, p->x + p->width, y);
        snprintf(tick, sizeof tick, p->tick_format, fabs(value) < 1e-9 ? 0 : value);
        wf_set_color(cr, wf_faint);
        wf_text_at(cr, p->x - 12, y + 6, 1, tick);
    }
    wf_set_color(cr, wf_ink);
    wf_font(cr, 18, true);
    wf_text_at(cr, p->x, p->y - 16, 0, p->label);
}

static void draw_mark(cairo_t *cr, const panel *p, const wf_plot *plot) {
    static const double dashes[] = {3, 5};
    double x = round(pixel_x(p, plot, plot->x_mark)) + 0.5;
    wf_set_color(cr, wf_mark);
    cairo_set_line_width(cr, 1.5);
    cairo_set_dash(cr, dashes, 2, 0);
    wf_segment(cr, x, p->y, x, p->y + p->height);
    cairo_set_dash(cr, NULL, 0, 0);
}

static void label_mark(cairo_t *cr, const panel *p, const wf_plot *plot) {
    wf_set_color(cr, wf_mark);
    wf_font(cr, 16, false);
    wf_text_at(cr, pixel_x(p, plot, plot->x_mark), p->y - 12, 0.5, plot->mark_label);
}

static void draw_curve(cairo_t *cr, const panel *p, const wf_plot *plot,
                       const wf_plot_curve *c) {
    for (size_t i = 0; i < plot->points; i++) {
        double x = plot->x_end * (double)i / (double)(plot->points - 1);
        double y = fmax(p->scale(c->value[i]), p->low - (p->high - p->low));
        cairo_line_to(cr, pixel_x(p, plot, x), pixel_y(p, y));
    }
    cairo_stroke(cr);
}

/* Color and dashes of curve i. */
static void pen(cairo_t *cr, const wf_plot *plot, size_t i) {
    static const double dashes[] = {9, 6};
    wf_set_color(cr, wf_palette[i % WF_COLORS]);
    cairo_set_line_width(cr, 2.75);
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
    cairo_set_dash(cr, dashes, plot->curves[i].dashed ? 2 : 0, 0);
}

static void draw_curves(cairo_t *cr, const panel *p, const wf_plot *plot) {
    cairo_save(cr);
    cairo_rectangle(cr, p->x, p->y - 2, p->width, p->height + 4);
    cairo_clip(cr);
    for (size_t i = 0; i < plot->curve_count; i++) {
        pen(cr, plot, i);
        draw_curve(cr, p, plot, &plot->curves[i]);
    }
    cairo_restore(cr);
}

/* Where curve i meets the mark, or at the panel's edge if it does so beyond. */
static void draw_dot(cairo_t *cr, const panel *p, const wf_plot *plot, size_t i) {
    double at = plot->x_mark / plot->x_end * (double)(plot->points - 1);
    double y = p->scale(plot->curves[i].value[lround(at)]);
    pen(cr, plot, i);
    cairo_set_dash(cr, NULL, 0, 0);
    wf_dot(cr, pixel_x(p, plot, plot->x_mark), pixel_y(p, fmax(y, p->low)), 6);
}

static void draw_panel(cairo_t *cr, const panel *p, const wf_plot *plot) {
    draw_grid(cr, p, plot);
    draw_mark(cr, p, plot);
    draw_curves(cr, p, plot);
}

static double widest_name(cairo_t *cr, const wf_plot *plot) {
    double widest = 0;
    for (size_t i = 0; i < plot->curve_count; i++)
        widest = fmax(widest, wf_text_width(cr, plot->curves[i].name));
    return widest;
}

/* In the upper panel's right corner, where responses are low. */
static void draw_legend(cairo_t *cr, const panel *p, const wf_plot *plot) {
    wf_font(cr, 18, false);
    double row = 30, width = widest_name(cr, plot) + 84,
           height = row * (double)plot->curve_count + 20;
    double x = p->x + p->width - width - 14, y = p->y + 14;
    cairo_rectangle(cr, x + 0.5, y + 0.5, width, height);
    cairo_set_source_rgba(cr, wf_paper.r, wf_paper.g, wf_paper.b, 0.92);
    cairo_fill_preserve(cr);
    wf_set_color(cr, wf_grid);
    cairo_set_line_width(cr, 1);
    cairo_stroke(cr);
    for (size_t i = 0; i < plot->curve_count; i++) {
        double middle = y + 10 + row * ((double)i + 0.5);
        pen(cr, plot, i);
        wf_segment(cr, x + 16, middle, x + 56, middle);
        cairo_set_dash(cr, NULL, 0, 0);
        wf_set_color(cr, wf_ink);
        wf_text_at(cr, x + 68, middle + 6, 0, plot->curves[i].name);
    }
}

/* Widens the panel by whole steps to what the curves reach. */
static void fit_panel(panel *p, const wf_plot *plot) {
    for (size_t c = 0; c < plot->curve_count; c++)
        for (size_t i = 0; i < plot->points; i++) {
            double y = p->scale(plot->curves[c].value[i]);
            while (p->low > -80 && y < p->low - 0.01 * p->step) p->low -= p->step;
            while (p->high < 80 && y > p->high + 0.01 * p->step) p->high += p->step;
        }
}

static void draw(cairo_t *cr, const wf_plot *plot) {
    double height = (HEIGHT - TOP - BOTTOM - PANEL_GAP) / 2.0, width = WIDTH - LEFT - RIGHT;
    panel values = {LEFT, TOP, width, height, -0.2, 1, 0.2, "Response", "%.1f", as_value};
    panel decibels = {LEFT, TOP + height + PANEL_GAP, width,  height,     -80, 0,
                      10,   "Response, dB",           "%.0f", as_decibels};
    fit_panel(&values, plot);
    fit_panel(&decibels, plot);
    wf_set_color(cr, wf_ink);
    wf_font(cr, 30, true);
    wf_text_at(cr, LEFT, 54, 0, plot->title);
    wf_set_color(cr, wf_faint);
    wf_font(cr, 19, false);
    wf_text_at(cr, LEFT, 86, 0, plot->subtitle);
    draw_panel(cr, &values, plot);
    label_mark(cr, &values, plot);
    draw_panel(cr, &decibels, plot);
    for (size_t i = 0; i < plot->curve_count; i++)
        if (plot->curves[i].dashed) draw_dot(cr, &decibels, plot, i);
    draw_legend(cr, &values, plot);
    wf_set_color(cr, wf_ink);
    wf_font(cr, 18, false);
    wf_text_at(cr, LEFT + width / 2, HEIGHT - 26, 0.5, plot->x_label);
}

weft_status wf_plot_png(const void *drawn, wf_plot_write_fn *write, void *to, weft_error *err) {
    const wf_plot *plot = drawn;
    wf_canvas canvas = wf_canvas_new(WIDTH, HEIGHT);
    draw(canvas.cr, plot);
    return wf_canvas_finish(&canvas, write, to, err);
}
