/* What the plot module draws: plots of curves, points and names over axes, and heat maps. */
#ifndef WF_CONVERT_PLOT_PLOT_H
#define WF_CONVERT_PLOT_PLOT_H

#include "convert/base/fail.h"

/* Sizes, margins and the place of the legend (layout.c). */
typedef enum wf_plot_look {
    WF_LOOK_PAGE,   /* 560x320, for a page of text; the legend is below the axes */
    WF_LOOK_WIDE,   /* 1280x1000, to be looked at by itself */
    WF_LOOK_PANELS, /* 1280x1120, several y axes over one x axis */
} wf_plot_look;

/* An SVG has the colors of the reader's scheme, light or dark; a PNG is light, and has twice as
 * many pixels as a WF_LOOK_PAGE has units. */
typedef enum wf_plot_format { WF_PLOT_PNG, WF_PLOT_SVG } wf_plot_format;

/* low is at the left or the lower end and may be the larger one. NAN: what the items reach, and
 * a little more. Of a logarithmic axis both are above 0. */
typedef struct wf_plot_axis {
    const char *label; /* NULL: none */
    double low, high;
    bool log;
    double step;        /* between lines of the grid, counted from low; 0: tick */
    const double *tick; /* [ticks], where the grid has lines; NULL: at round numbers */
    size_t ticks;
    int digits; /* after the point; below 0: up to three that count */
} wf_plot_axis;

typedef enum wf_plot_kind {
    WF_ITEM_LINE,   /* points joined in their order */
    WF_ITEM_POINTS, /* a dot each, within the axes */
    WF_ITEM_LABEL,  /* a dot at point 0, with text where it is least in the way */
    WF_ITEM_WORD,   /* text at point 0, dx and dy units from it */
    WF_ITEM_RULE,   /* a line across the axes at x[0] or y[0], the other being NULL; text */
    WF_ITEM_BAND,   /* a tint from x[0] to x[1], with text at its top */
    WF_ITEM_BOXES,  /* rectangles; box i reaches from point 2 i to point 2 i + 1 */
    WF_ITEM_MAP,    /* value as colors, from point 0 (the upper left corner) to point 1; text
                     * says what they are, at a bar beside the axes */
    WF_ITEM_RING,   /* a light circle about point 0, to point out a place of a map; text */
} wf_plot_kind;

/* Something that is drawn over the axes, in the order of the items. Lengths are units of the
 * picture. */
typedef struct wf_plot_item {
    wf_plot_kind kind;
    int series;       /* 1 to WF_PLOT_SERIES tells the color; 0: that of text */
    const char *name; /* in the legend; NULL: not there */
    const char *text;
    const double *x, *y; /* [points] */
    size_t points;
    const double
        *shade; /* [points] of gray, 0 to 1, in place of the series' color; NULL: none */
    bool dashed, hollow, below; /* hollow: of dots; below: where a ring's text is */
    bool marked;                /* a label of another kind, in another color */
    double radius;              /* 0: the look's */
    double dx, dy;
    double anchor;       /* the share of the text that is left of its place */
    const double *value; /* [rows][columns], of a map */
    size_t columns, rows;
    double least, most; /* values that have the darkest and the brightest color */
} wf_plot_item;

#define WF_PLOT_SERIES     8
#define WF_PLOT_MOST_TICKS 64

/* One y axis and what is drawn over it. */
typedef struct wf_plot_panel {
    const char *heading; /* above it; NULL: none */
    wf_plot_axis y;
    const wf_plot_item *item;
    size_t items;
} wf_plot_panel;

typedef struct wf_plot {
    wf_plot_look look;
    wf_plot_format format;
    const char *title, *subtitle; /* NULL: none */
    const char *description; /* what an SVG is to those who do not see it; NULL: the title */
    int width, height;       /* without a legend below; 0: the look's */
    wf_plot_axis x;          /* of all panels */
    const wf_plot_panel *panel;
    size_t panels;
} wf_plot;

/* How strong something is where in a picture. */
typedef struct wf_plot_map {
    const char *title, *subtitle;
    const float *value; /* [lines][width_px] */
    int width_px, lines;
    double pixel_aspect, high; /* high: what is drawn as strongest */
} wf_plot_map;

/* Where the picture goes, piece by piece. */
typedef weft_status wf_plot_write_fn(void *to, const void *data, size_t bytes, weft_error *err);

/* The entry points of the plot module: wf_plot_draw draws a wf_plot, wf_plot_heat a
 * wf_plot_map, into a PNG. WEFT_FAILED or WEFT_NO_MEMORY if it cannot, or what write returned.
 * Any thread. */
typedef weft_status wf_plot_fn(const void *drawn, wf_plot_write_fn *write, void *to,
                               weft_error *err);

#endif
