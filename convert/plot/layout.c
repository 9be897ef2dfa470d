/* Looks of plots, and where the ends and ticks of their axes are. */
#include "convert/plot/layout.h"

#include <math.h>
#include <string.h>

#include "convert/plot/parts.h"

/* clang-format off */
static const wf_look looks[] = {
    [WF_LOOK_PAGE] = {
        .width = 560, .height = 320, .left = 66, .right = 14,
        .top = 12, .bottom = 46, .gap = 40,
        .title_top = 26, .title_y = 22, .subtitle_y = 38,
        .title = {15, true, false, WF_INK_TEXT}, .subtitle = {12.5, false, false, WF_INK_FAINT},
        .label = {13, false, false, WF_INK_TEXT}, .heading = {13, true, false, WF_INK_TEXT},
        .tick = {12.5, false, false, WF_INK_FAINT}, .word = {12.5, false, false, WF_INK_FAINT},
        .name = {12.5, false, false, WF_INK_TEXT},
        .point = {12.5, false, false, WF_INK_TEXT},
        .tick_x = 16, .tick_y = 7, .label_x = 14, .label_y = 8,
        .line = 2, .radius = 2.6, .rim = 0.7, .dash = 5, .gap_between = 5,
        .rule = {.ink = WF_INK_FAINT, .width = 1, .dash = 2, .gap = 4},
        .minus = "\xE2\x88\x92", .legend = WF_LEGEND_BELOW, .pixels_per_unit = 2},
    [WF_LOOK_WIDE] = {
        .width = 1280, .height = 1000, .left = 120, .right = 60,
        .top = 120, .bottom = 100, .gap = 84,
        .title_y = 52, .subtitle_y = 84,
        .title = {30, true, false, WF_INK_TEXT}, .subtitle = {18, false, false, WF_INK_FAINT},
        .label = {18, false, false, WF_INK_TEXT}, .heading = {18, true, false, WF_INK_TEXT},
        .tick = {17, false, false, WF_INK_FAINT}, .word = {16, false, false, WF_INK_MARK},
        .name = {18, false, false, WF_INK_TEXT},
        .point = {18, true, false, WF_INK_TEXT},
        .tick_x = 26, .tick_y = 12, .label_x = 40, .label_y = 30,
        .line = 3, .radius = 6.5, .rim = 2, .dash = 9, .gap_between = 6,
        .rule = {.ink = WF_INK_MARK, .width = 1.5, .dash = 3, .gap = 5},
        .rule_above = true, .snap = true,
        .minus = "-", .legend = WF_LEGEND_LOWER,
        .legend_margin = 14.5, .legend_pad = 8, .pixels_per_unit = 1},
    [WF_LOOK_PANELS] = {
        .width = 1280, .height = 1120, .left = 96, .right = 40,
        .top = 150, .bottom = 84, .gap = 84,
        .title_y = 54, .subtitle_y = 86,
        .title = {30, true, false, WF_INK_TEXT}, .subtitle = {19, false, false, WF_INK_FAINT},
        .label = {18, false, false, WF_INK_TEXT}, .heading = {18, true, false, WF_INK_TEXT},
        .tick = {17, false, false, WF_INK_FAINT}, .word = {16, false, false, WF_INK_MARK},
        .name = {18, false, false, WF_INK_TEXT},
        .point = {18, true, false, WF_INK_TEXT},
        .tick_x = 26, .tick_y = 12, .label_x = 40, .label_y = 26,
        .line = 2.75, .radius = 6, .rim = 2, .dash = 9, .gap_between = 6,
        .rule = {.ink = WF_INK_MARK, .width = 1.5, .dash = 3, .gap = 5},
        .rule_above = true, .snap = true,
        .zero = true, .minus = "-", .legend = WF_LEGEND_UPPER,
        .legend_margin = 14, .legend_nudge = 0.5, .legend_pad = 10, .legend_clear = 0.08,
        .pixels_per_unit = 1},
};
/* clang-format on */

const wf_look *wf_look_of(const wf_plot *plot) {
    return &looks[plot->look];
}

/* ---- Scales ---- */

double wf_scale_at(const wf_scale *s, double value) {
    double low = s->low, high = s->high;
    if (s->log) {
        low = log10(low);
        high = log10(high);
        value = log10(fmax(value, 1e-300));
    }
    if (s->start > s->end) return s->end + (s->start - s->end) * (high - value) / (high - low);
    return s->start + (s->end - s->start) * (value - low) / (high - low);
}

double wf_scale_within(const wf_scale *s, double value) {
    return fmin(fmax(value, fmin(s->low, s->high)), fmax(s->low, s->high));
}

static void add_tick(wf_scale *s, double value) {
    if (s->ticks < WF_PLOT_MOST_TICKS) s->tick[s->ticks++] = value;
}

/* 1, 2 and 5 of every decade, or decades alone where there are many. */
static void choose_log_ticks(wf_scale *s, double low, double high) {
    int first = (int)floor(log10(low)), last = (int)ceil(log10(high));
    for (int decade = first; decade <= last; decade++)
        for (int digit = 1; digit <= 5; digit += digit == 1 ? 1 : 3) {
            double value = digit * pow(10, decade);
            bool dense = digit > 1 && last - first > 5;
            if (value >= low && value <= high && !dense) add_tick(s, value);
        }
}

/* Multiples of 1, 2, 2.5 or 5 times a power of ten: at most six steps. */
void wf_scale_ticks(wf_scale *s, double low, double high) {
    static const double multiples[] = {1, 2, 2.5, 5, 10};
    double span = high - low, step = pow(10, floor(log10(span / 4)));
    size_t m = 0;
    while (m < 4 && span / (step * multiples[m]) > 6) m++;
    step *= multiples[m];
    double first = ceil(low / step - 1e-9), last = floor(high / step + 1e-9);
    for (int i = 0; i < 8 && first + i <= last; i++) add_tick(s, (first + i) * step);
}

static void settle_ticks(wf_scale *s, const wf_plot_axis *axis) {
    double low = fmin(s->low, s->high), high = fmax(s->low, s->high);
    if (axis->step > 0)
        for (long i = 0; i <= lround((high - low) / axis->step); i++)
            add_tick(s, low + (double)i * axis->step);
    else if (axis->tick)
        for (size_t i = 0; i < axis->ticks; i++) add_tick(s, axis->tick[i]);
    else
        (s->log ? choose_log_ticks : wf_scale_ticks)(s, low, high);
}

/* Ends that are not given are what the items reach, and a little more. */
static void reach(const wf_plot_panel *panel, bool across, double *low, double *high) {
    *low = INFINITY;
    *high = -INFINITY;
    for (size_t i = 0; i < panel->items; i++) {
        const double *value = across ? panel->item[i].x : panel->item[i].y;
        for (size_t p = 0; value && p < panel->item[i].points; p++) {
            *low = fmin(*low, value[p]);
            *high = fmax(*high, value[p]);
        }
    }
}

static void settle_ends(wf_scale *s, const wf_plot_axis *axis, const wf_plot *plot,
                        size_t first, size_t end, bool across) {
    double low = INFINITY, high = -INFINITY, more;
    for (size_t i = first; i < end; i++) {
        double least, most;
        reach(&plot->panel[i], across, &least, &most);
        low = fmin(low, least);
        high = fmax(high, most);
    }
    if (!(low <= high)) low = axis->log ? 1 : 0, high = axis->log ? 10 : 1;
    more = axis->log    ? pow(10, 0.05)
           : low < high ? 0.03 * (high - low)
                        : fmax(fabs(low), 1) / 2;
    s->low = !isnan(axis->low) ? axis->low : axis->log ? low / more : low - more;
    s->high = !isnan(axis->high) ? axis->high : axis->log ? high * more : high + more;
    if (s->low == s->high) s->high = s->low + fmax(fabs(s->low), 1);
}

static void settle(wf_scale *s, const wf_plot_axis *axis, const wf_plot *plot, size_t first,
                   size_t end, bool across) {
    *s = (wf_scale){.log = axis->log, .digits = axis->digits};
    settle_ends(s, axis, plot, first, end, across);
    settle_ticks(s, axis);
}

/* ---- Panels ---- */

void wf_layout_begin(const wf_plot *plot, double legend_height, wf_layout *out) {
    const wf_look *look = wf_look_of(plot);
    double title = plot->title ? look->title_top : 0;
    *out = (wf_layout){.plot = plot, .look = look};
    out->width = plot->width ? plot->width : look->width;
    out->right = look->right + wf_bar_width(plot);
    out->axes_height = (plot->height ? plot->height : look->height) + title;
    out->height = (int)ceil(out->axes_height + legend_height);
    settle(&out->x, &plot->x, plot, 0, plot->panels, true);
}

void wf_axes_begin(const wf_layout *layout, size_t panel, wf_axes *out) {
    const wf_plot *plot = layout->plot;
    const wf_look *look = layout->look;
    double top = look->top + (plot->title ? look->title_top : 0);
    double gaps = look->gap * (double)(plot->panels - 1);
    double height = (layout->axes_height - top - look->bottom - gaps) / (double)plot->panels;
    *out = (wf_axes){.layout = layout, .panel = &plot->panel[panel], .x = layout->x};
    out->box = (wf_box){look->left, top + (height + look->gap) * (double)panel,
                        layout->width - look->left - layout->right, height};
    settle(&out->y, &plot->panel[panel].y, plot, panel, panel + 1, false);
    out->x.start = out->box.x;
    out->x.end = out->box.x + out->box.width;
    out->y.start = out->box.y + out->box.height;
    out->y.end = out->box.y;
}

/* ---- Numbers ---- */

/* "%.3g" but for large numbers, of which all digits before the point are shown. */
static void count_digits(double value, int digits, char *text, size_t size) {
    if (digits >= 0)
        snprintf(text, size, "%.*f", digits, value);
    else
        snprintf(text, size, fabs(value) >= 1000 && fabs(value) < 1e7 ? "%.0f" : "%.3g", value);
}

void wf_number(double value, int digits, const char *minus, char *text, size_t size) {
    char plain[64];
    count_digits(fabs(value), digits, plain, sizeof plain);
    bool zero = strspn(plain, "0.") == strlen(plain);
    snprintf(text, size, "%s%s", value < 0 && !zero ? minus : "", plain);
}
