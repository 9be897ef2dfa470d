/* The plot module: curves and named points over two axes. */
#include <math.h>
#include <stdio.h>

#include "convert/plot/plot_draw.h"

WEFT_API wf_plot_fn wf_plot_xy_png;

enum { WIDTH = 1280, HEIGHT = 1000, LEFT = 120, RIGHT = 60, TOP = 120, BOTTOM = 100 };

#define DOT        6.5
#define TEXT       18
#define MOST_BOXES 64

typedef struct range {
    double low, high, step;
} range;

/* A rectangle that text takes. */
typedef struct box {
    double x, y, width, height;
} box;

typedef struct page {
    cairo_t *cr;
    const wf_plot_xy *plot;
    range x, y;
    box taken[MOST_BOXES]; /* by labels and the legend */
    size_t taken_count;
} page;

/* ---- Axes ---- */

static void widen(range *r, double value) {
    r->low = fmin(r->low, value);
    r->high = fmax(r->high, value);
}

static void fit(page *p) {
    const wf_plot_xy *plot = p->plot;
    p->x = (range){INFINITY, -INFINITY, plot->x_step};
    p->y = (range){INFINITY, -INFINITY, plot->y_step};
    for (size_t c = 0; c < plot->curve_count; c++)
        for (size_t i = 0; i < plot->curves[c].points; i++) {
            widen(&p->x, plot->curves[c].x[i]);
            widen(&p->y, plot->curves[c].y[i]);
        }
    for (size_t m = 0; m < plot->mark_count; m++) {
        widen(&p->x, plot->marks[m].x);
        widen(&p->y, plot->marks[m].y);
    }
    for (int axis = 0; axis < 2; axis++) {
        range *r = axis ? &p->y : &p->x;
        r->low = floor(r->low / r->step - 0.3) * r->step;
        r->high = ceil(r->high / r->step + 0.3) * r->step;
    }
}

static double across(const page *p, double x) {
    return LEFT + (WIDTH - LEFT - RIGHT) * (x - p->x.low) / (p->x.high - p->x.low);
}

static double down(const page *p, double y) {
    return TOP + (HEIGHT - TOP - BOTTOM) * (p->y.high - y) / (p->y.high - p->y.low);
}

static void draw_axes(page *p) {
    char tick[32];
    int columns = (int)lround((p->x.high - p->x.low) / p->x.step);
    int rows = (int)lround((p->y.high - p->y.low) / p->y.step);
    wf_font(p->cr, 17, false);
    cairo_set_line_width(p->cr, 1);
    for (int i = 0; i <= columns; i++) {
        double value = p->x.low + i * p->x.step, x = round(across(p, value)) + 0.5;
        wf_set_color(p->cr, wf_grid);
        wf_segment(p->cr, x, TOP, x, HEIGHT - BOTTOM);
        wf_set_color(p->cr, wf_faint);
        snprintf(tick, sizeof tick, p->plot->x_format, value);
        wf_text_at(p->cr, x, HEIGHT - BOTTOM + 26, 0.5, tick);
    }
    for (int i = 0; i <= rows; i++) {
        double value = p->y.low + i * p->y.step, y = round(down(p, value)) + 0.5;
        wf_set_color(p->cr, wf_grid);
        wf_segment(p->cr, LEFT, y, WIDTH - RIGHT, y);
        wf_set_color(p->cr, wf_faint);
        snprintf(tick, sizeof tick, p->plot->y_format, value);
        wf_text_at(p->cr, LEFT - 12, y + 6, 1, tick);
    }
}

static void draw_words(page *p) {
    wf_set_color(p->cr, wf_ink);
    wf_font(p->cr, 30, true);
    wf_text_at(p->cr, LEFT, 52, 0, p->plot->title);
    wf_font(p->cr, TEXT, false);
    wf_text_at(p->cr, (WIDTH + LEFT - RIGHT) / 2.0, HEIGHT - 30, 0.5, p->plot->x_label);
    cairo_save(p->cr);
    cairo_translate(p->cr, 40, (HEIGHT + TOP - BOTTOM) / 2.0);
    cairo_rotate(p->cr, -M_PI / 2);
    wf_text_at(p->cr, 0, 0, 0.5, p->plot->y_label);
    cairo_restore(p->cr);
    wf_set_color(p->cr, wf_faint);
    wf_text_at(p->cr, LEFT, 84, 0, p->plot->subtitle);
}

/* ---- Curves ---- */

static void pen(const page *p, size_t curve) {
    static const double dashes[] = {9, 6};
    wf_set_color(p->cr, wf_palette[curve % WF_COLORS]);
    cairo_set_line_width(p->cr, 3);
    cairo_set_line_join(p->cr, CAIRO_LINE_JOIN_ROUND);
    cairo_set_dash(p->cr, dashes, p->plot->curves[curve].dashed ? 2 : 0, 0);
}

static void draw_curves(page *p) {
    for (size_t c = 0; c < p->plot->curve_count; c++) {
        const wf_xy_curve *curve = &p->plot->curves[c];
        pen(p, c);
        cairo_new_path(p->cr);
        for (size_t i = 0; i < curve->points; i++)
            cairo_line_to(p->cr, across(p, curve->x[i]), down(p, curve->y[i]));
        cairo_stroke(p->cr);
    }
    cairo_set_dash(p->cr, NULL, 0, 0);
}

/* In the lower right corner: much flicker and little sharpness is what nobody wants. */
static void draw_legend(page *p) {
    double row = 30, width = 0, height = row * (double)p->plot->curve_count + 16;
    wf_font(p->cr, TEXT, false);
    for (size_t c = 0; c < p->plot->curve_count; c++)
        width = fmax(width, wf_text_width(p->cr, p->plot->curves[c].name) + 84);
    box b = {WIDTH - RIGHT - width - 14.5, HEIGHT - BOTTOM - height - 14.5, width, height};
    cairo_rectangle(p->cr, b.x, b.y, b.width, b.height);
    wf_set_color(p->cr, wf_paper);
    cairo_fill_preserve(p->cr);
    wf_set_color(p->cr, wf_grid);
    cairo_set_line_width(p->cr, 1);
    cairo_stroke(p->cr);
    for (size_t c = 0; c < p->plot->curve_count; c++) {
        double middle = b.y + 8 + row * ((double)c + 0.5);
        pen(p, c);
        wf_segment(p->cr, b.x + 16, middle, b.x + 56, middle);
        cairo_set_dash(p->cr, NULL, 0, 0);
        wf_set_color(p->cr, wf_ink);
        wf_text_at(p->cr, b.x + 68, middle + 6, 0, p->plot->curves[c].name);
    }
    p->taken[p->taken_count++] = b;
}

/* ---- Marks and their names ---- */

static bool contains(const box *b, double x, double y, double margin) {
    return x > b->x - margin && x < b->x + b->width + margin && y > b->y - margin &&
           y < b->y + b->height + margin;
}

static bool overlap(const box *a, const box *b) {
    return a->x < b->x + b->width && b->x < a->x + a->width && a->y < b->y + b->height &&
           b->y < a->y + a->height;
}

/* How badly a name would lie in a box: over other names, dots, curves, or off the axes. */
static double cost(const page *p, const box *b, size_t own) {
    double sum = 0;
    if (b->x < LEFT || b->x + b->width > WIDTH - 8 || b->y < TOP ||
        b->y + b->height > HEIGHT - BOTTOM)
        sum += 200;
    for (size_t i = 0; i < p->taken_count; i++)
        if (overlap(b, &p->taken[i])) sum += 100;
    for (size_t m = 0; m < p->plot->mark_count; m++) {
        const wf_xy_mark *mark = &p->plot->marks[m];
        if (m != own && contains(b, across(p, mark->x), down(p, mark->y), DOT + 2)) sum += 50;
    }
    for (size_t c = 0; c < p->plot->curve_count; c++)
        for (size_t i = 0; i < p->plot->curves[c].points; i++)
            if (contains(b, across(p, p->plot->curves[c].x[i]),
                         down(p, p->plot->curves[c].y[i]), 3))
                sum += 4;
    return sum;
}

/* Beside the dot, wherever it is in the way of least. */
static box place_name(const page *p, size_t m) {
    static const double places[][2] = {{0, 0.5}, {-1, 0.5}, {0, 0},    {0, 1},
                                       {-1, 0},  {-1, 1},   {-0.5, 0}, {-0.5, 1}};
    const wf_xy_mark *mark = &p->plot->marks[m];
    double x = across(p, mark->x), y = down(p, mark->y), least = INFINITY;
    double width = wf_text_width(p->cr, mark->name) + 4, height = TEXT + 4;
    box best = {0};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        double side = places[i][0], above = places[i][1], gap = DOT + 5;
        box b = {.width = width, .height = height};
        b.x = side == 0 ? x + gap : side == -1 ? x - gap - width : x - width / 2;
        b.y = above == 0.5 ? y - height / 2 : above == 0 ? y - gap - height + 4 : y + gap - 4;
        double bad = cost(p, &b, m) + 0.1 * (double)i;
        if (bad < least) {
            least = bad;
            best = b;
        }
    }
    return best;
}

static void draw_marks(page *p) {
    wf_font(p->cr, TEXT, true);
    for (size_t m = 0; m < p->plot->mark_count; m++) {
        const wf_xy_mark *mark = &p->plot->marks[m];
        wf_rgb color = mark->other ? wf_mark : wf_ink;
        wf_set_color(p->cr, color);
        wf_dot(p->cr, across(p, mark->x), down(p, mark->y), DOT);
        box b = place_name(p, m);
        wf_set_color(p->cr, color);
        wf_text_at(p->cr, b.x + 2, b.y + TEXT - 1, 0, mark->name);
        if (p->taken_count < MOST_BOXES) p->taken[p->taken_count++] = b;
    }
}

weft_status wf_plot_xy_png(const void *drawn, wf_plot_write_fn *write, void *to,
                           weft_error *err) {
    const wf_plot_xy *plot = drawn;
    wf_canvas canvas = wf_canvas_new(WIDTH, HEIGHT);
    page p = {.cr = canvas.cr, .plot = plot};
    fit(&p);
    draw_axes(&p);
    draw_words(&p);
    draw_curves(&p);
    draw_legend(&p);
    draw_marks(&p);
    return wf_canvas_finish(&canvas, write, to, err);
}
