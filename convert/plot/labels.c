/* Labels of a plot: dots with their names beside them, where a name is in the way of least. */
#include <math.h>

#include "convert/plot/parts.h"

#define MOST_BOXES 64

/* What names and the legend take of the axes. */
typedef struct taken {
    wf_box box[MOST_BOXES];
    size_t count;
} taken;

static void take(taken *t, const wf_box *box) {
    if (t->count < MOST_BOXES && box->width > 0) t->box[t->count++] = *box;
}

static bool contains(const wf_box *b, double x, double y, double margin) {
    return x > b->x - margin && x < b->x + b->width + margin && y > b->y - margin &&
           y < b->y + b->height + margin;
}

static bool overlap(const wf_box *a, const wf_box *b) {
    return a->x < b->x + b->width && b->x < a->x + a->width && a->y < b->y + b->height &&
           b->y < a->y + a->height;
}

static double radius_of(const wf_axes *a, const wf_plot_item *item) {
    return item->radius > 0 ? item->radius : a->layout->look->radius;
}

/* How many of an item's points lie in a box. */
static double covered(const wf_axes *a, const wf_box *b, const wf_plot_item *item,
                      double margin) {
    size_t count = 0;
    for (size_t i = 0; i < item->points; i++)
        count +=
            contains(b, wf_scale_at(&a->x, item->x[i]), wf_scale_at(&a->y, item->y[i]), margin);
    return (double)count;
}

/* How badly a name would lie in a box: over other names, dots, lines, or off the axes. */
static double cost(const wf_axes *a, const taken *t, const wf_box *b, const wf_plot_item *own) {
    double sum = 0;
    if (b->x < a->box.x || b->x + b->width > a->layout->width - 8 || b->y < a->box.y ||
        b->y + b->height > a->box.y + a->box.height)
        sum += 200;
    for (size_t i = 0; i < t->count; i++)
        if (overlap(b, &t->box[i])) sum += 100;
    for (size_t i = 0; i < a->panel->items; i++) {
        const wf_plot_item *item = &a->panel->item[i];
        if (item->kind == WF_ITEM_LABEL && item != own)
            sum += 50 * covered(a, b, item, radius_of(a, item) + 2);
        if (item->kind == WF_ITEM_LINE) sum += 4 * covered(a, b, item, 3);
    }
    return sum;
}

/* Candidate i: where the name is beside the dot, -1 to the left and 1 above. */
static wf_box candidate(double x, double y, double gap, double width, double height,
                        const double place[2]) {
    double side = place[0], above = place[1];
    wf_box b = {.width = width, .height = height};
    b.x = side == 0 ? x + gap : side == -1 ? x - gap - width : x - width / 2;
    b.y = above == 0.5 ? y - height / 2 : above == 0 ? y - gap - height + 4 : y + gap - 4;
    return b;
}

static wf_box place_name(const wf_axes *a, const taken *t, const wf_plot_item *item) {
    static const double places[][2] = {{0, 0.5}, {-1, 0.5}, {0, 0},    {0, 1},
                                       {-1, 0},  {-1, 1},   {-0.5, 0}, {-0.5, 1}};
    const wf_font *font = &a->layout->look->point;
    double width = wf_text_width(font, item->text) + 4, least = INFINITY;
    wf_box best = {0};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        wf_box b = candidate(wf_scale_at(&a->x, item->x[0]), wf_scale_at(&a->y, item->y[0]),
                             radius_of(a, item) + 5, width, font->size + 4, places[i]);
        double bad = cost(a, t, &b, item) + 0.1 * (double)i;
        if (bad < least) {
            least = bad;
            best = b;
        }
    }
    return best;
}

static void draw_label(wf_canvas *c, const wf_axes *a, taken *t, const wf_plot_item *item) {
    const wf_look *look = a->layout->look;
    wf_font font = look->point;
    font.ink = item->marked ? WF_INK_MARK : wf_ink_of_series(item->series);
    const wf_pen pen = {.ink = font.ink};
    c->on->disk(c, &pen, wf_scale_at(&a->x, item->x[0]), wf_scale_at(&a->y, item->y[0]),
                radius_of(a, item), look->rim);
    wf_box b = place_name(a, t, item);
    c->on->text(c, &font, b.x + 2, b.y + font.size - 1, 0, item->text);
    take(t, &b);
}

void wf_draw_labels(wf_canvas *c, const wf_axes *a, const wf_box *legend) {
    taken t = {.count = 0};
    take(&t, legend);
    for (size_t i = 0; i < a->panel->items; i++)
        if (a->panel->item[i].kind == WF_ITEM_LABEL) draw_label(c, a, &t, &a->panel->item[i]);
}
