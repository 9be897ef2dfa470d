/* The parts of a plot, each drawn by a function. */
#ifndef WF_CONVERT_PLOT_PARTS_H
#define WF_CONVERT_PLOT_PARTS_H

#include "convert/plot/layout.h"

/* Titles, and the label of the x axis, which all panels have in common. */
void wf_draw_titles(wf_canvas *c, const wf_layout *layout);

/* The grid, its numbers, and the words about a panel. */
void wf_draw_axes(wf_canvas *c, const wf_axes *axes);

/* Everything over the axes but labels, in the order of the items. */
void wf_draw_items(wf_canvas *c, const wf_axes *axes);

/* Dots with names beside them, where they are in the way of least: of one another, of lines, of
 * `legend`, whose width is 0 if there is none within the axes. */
void wf_draw_labels(wf_canvas *c, const wf_axes *axes, const wf_box *legend);

/* The bar that tells the colors of the panel's first map that has text; none: nothing is drawn.
 * Its width, with the space before it, lies at the right of the axes. */
void wf_draw_bar(wf_canvas *c, const wf_axes *axes);
double wf_bar_width(const wf_plot *plot);

/* The height that a legend below the axes takes; 0 if there is none. */
double wf_legend_height(const wf_plot *plot);

/* The legend of the first panel's items; returns what it covers of the axes. */
wf_box wf_draw_legend(wf_canvas *c, const wf_axes *axes);

/* How the line, or the dots, of an item look. */
wf_pen wf_item_pen(const wf_look *look, const wf_plot_item *item);

#endif
