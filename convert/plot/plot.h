#ifndef WF_CONVERT_PLOT_PLOT_H
#define WF_CONVERT_PLOT_PLOT_H

#include "convert/base/fail.h"

/* Frequency responses to be drawn, as values and in decibels, over one axis from 0 to x_end. */
typedef struct wf_plot_curve {
    const char *name;    /* for the legend */
    const double *value; /* [points] */
    bool dashed;         /* and with a dot where it meets x_mark in decibels */
} wf_plot_curve;

typedef struct wf_plot {
    const char *title, *subtitle;
    const char *x_label;
    double x_end, x_mark; /* x_mark: a frequency to point out */
    const char *mark_label;
    size_t points, curve_count;
    const wf_plot_curve *curves;
} wf_plot;

/* Points (x, y), joined in their order. */
typedef struct wf_xy_curve {
    const char *name; /* for the legend */
    const double *x, *y;
    size_t points;
    bool dashed;
} wf_xy_curve;

/* A point with its name beside it. */
typedef struct wf_xy_mark {
    char name[96];
    double x, y;
    bool other; /* of another kind: in another color */
} wf_xy_mark;

/* Curves and marks over two axes, whose ranges are what is drawn and a little more. */
typedef struct wf_plot_xy {
    const char *title, *subtitle;
    const char *x_label, *y_label;
    double x_step, y_step; /* of the grid */
    const char *x_format, *y_format;
    size_t curve_count, mark_count;
    const wf_xy_curve *curves;
    const wf_xy_mark *marks;
} wf_plot_xy;

/* Where the picture goes, piece by piece. */
typedef weft_status wf_plot_write_fn(void *to, const void *data, size_t bytes, weft_error *err);

/* How strong something is where in a picture. */
typedef struct wf_plot_map {
    const char *title, *subtitle;
    const float *value; /* [lines][width_px] */
    int width_px, lines;
    double pixel_aspect, high; /* high: what is drawn as strongest */
} wf_plot_map;

/* The entry points of the plot module draw what they are given and write a PNG: wf_plot_png a
 * wf_plot, wf_plot_xy_png a wf_plot_xy, wf_plot_heat a wf_plot_map. */
typedef weft_status wf_plot_fn(const void *drawn, wf_plot_write_fn *write, void *to,
                               weft_error *err);

#endif
