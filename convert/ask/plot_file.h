/* Plots as JSON. */
#ifndef WF_CONVERT_ASK_PLOT_FILE_H
#define WF_CONVERT_ASK_PLOT_FILE_H

#include <jansson.h>

#include "convert/plot/plot.h"

#define WF_PLOT_MOST_ITEMS 1000

/* A plot and what its pointers point into. */
typedef struct wf_plot_file {
    wf_plot plot;
    wf_plot_panel panel;
    wf_plot_item item[WF_PLOT_MOST_ITEMS];
    json_t *root;   /* owns the text */
    double **array; /* own the numbers */
    size_t arrays;
} wf_plot_file;

/* Reads a plot from path ("-": standard input) into *out, which wf_plot_file_free frees, also
 * after a failure. WEFT_USAGE for what makes no sense, with the file and the key; WEFT_FAILED
 * for what cannot be read. `weft plot --help` describes the keys. */
weft_status wf_plot_file_read(const char *path, wf_plot_file *out, weft_error *err);
void wf_plot_file_free(wf_plot_file *file);

#endif
