/* The plot module: draws plots of curves, points and names over axes. */
#include "convert/plot/plot.h"

#include "convert/plot/parts.h"

WEFT_API wf_plot_fn wf_plot_draw;

/* Labels and the legend are drawn over all items of the first panel. */
static void draw(wf_canvas *c, const wf_layout *layout) {
    const wf_plot *plot = layout->plot;
    wf_axes axes;
    wf_draw_titles(c, layout);
    for (size_t i = 0; i < plot->panels; i++) {
        wf_axes_begin(layout, i, &axes);
        wf_draw_axes(c, &axes);
        wf_draw_items(c, &axes);
        wf_draw_bar(c, &axes);
    }
    for (size_t i = 0; i < plot->panels; i++) {
        wf_axes_begin(layout, i, &axes);
        wf_box legend = i ? (wf_box){0} : wf_draw_legend(c, &axes);
        wf_draw_labels(c, &axes, &legend);
    }
}

weft_status wf_plot_draw(const void *drawn, wf_plot_write_fn *write, void *to,
                         weft_error *err) {
    const wf_plot *plot = drawn;
    const char *description = plot->description ? plot->description : plot->title;
    wf_layout layout;
    wf_canvas canvas;
    wf_layout_begin(plot, wf_legend_height(plot), &layout);
    if (plot->format == WF_PLOT_SVG)
        wf_canvas_svg(&canvas, layout.width, layout.height, description ? description : "");
    else
        wf_canvas_png(&canvas, layout.width, layout.height, layout.look->pixels_per_unit);
    draw(&canvas, &layout);
    return canvas.on->finish(&canvas, write, to, err);
}
