#ifndef WF_CONVERT_PLOT_WRITE_H
#define WF_CONVERT_PLOT_WRITE_H

#include <cairo.h>

#include "convert/plot.h"

/* Inside the plot module: a drawing's PNG, piece by piece to write. */
weft_status wf_plot_write_png(cairo_surface_t *surface, wf_plot_write_fn *write, void *to,
                              weft_error *err);

#endif
