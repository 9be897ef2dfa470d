/* Where things of a plot are: looks, axes, panels. */
#ifndef WF_CONVERT_PLOT_LAYOUT_H
#define WF_CONVERT_PLOT_LAYOUT_H

#include "convert/plot/canvas.h"

/* Sizes of a look, in units of the picture. Offsets of text are to its baseline. */
typedef struct wf_look {
    int width, height;
    double left, right, top, bottom, gap; /* gap: between panels */
    double title_top;                     /* what a title adds to top */
    wf_font title, subtitle, label, heading, tick, word, name, point;
    double title_y, subtitle_y;
    double tick_x, tick_y, label_x, label_y; /* from the axes; from the picture's edges */
    double line, radius, rim;                /* width of lines; of dots */
    double dash, gap_between;                /* of dashed lines */
    wf_pen rule;
    bool rule_above; /* the text of a rule is above the axes, not within */
    bool snap;       /* the grid is on whole pixels */
    bool zero;       /* the grid's line at 0 stands out */
    const char *minus;
    enum { WF_LEGEND_BELOW, WF_LEGEND_UPPER, WF_LEGEND_LOWER } legend;
    double legend_margin, legend_nudge, legend_pad, legend_clear;
    double pixels_per_unit; /* of a PNG */
} wf_look;

/* An axis whose ends and ticks are settled, over a stretch of the picture. */
typedef struct wf_scale {
    double low, high, start, end; /* start, end: where low and high are */
    bool log;
    double tick[WF_PLOT_MOST_TICKS];
    size_t ticks;
    int digits;
} wf_scale;

typedef struct wf_layout {
    const wf_plot *plot;
    const wf_look *look;
    int width, height;  /* of the picture */
    double right;       /* what is free at the right of the axes */
    double axes_height; /* the height that the panels and what is above and between them take */
    wf_scale x;
} wf_layout;

/* A panel while it is drawn. */
typedef struct wf_axes {
    const wf_layout *layout;
    const wf_plot_panel *panel;
    wf_box box;
    wf_scale x, y;
} wf_axes;

/* legend_height is what a legend below the axes adds to the picture. */
void wf_layout_begin(const wf_plot *plot, double legend_height, wf_layout *out);
void wf_axes_begin(const wf_layout *layout, size_t panel, wf_axes *out);

const wf_look *wf_look_of(const wf_plot *plot);

/* Where a value is along the scale. */
double wf_scale_at(const wf_scale *scale, double value);

/* The value, or the end of the scale that it lies beyond. */
double wf_scale_within(const wf_scale *scale, double value);

/* Adds ticks at round numbers, linear, at most six steps from low to high, which is larger. */
void wf_scale_ticks(wf_scale *scale, double low, double high);

/* A number at the grid: with so many digits, or with up to three that count if digits is below
 * 0. */
void wf_number(double value, int digits, const char *minus, char *text, size_t size);

#endif
