/* Has the plot module draw a picture into a file. */
#include <stdio.h>
#include <string.h>

#include "convert/base/module.h"
#include "convert/base/outfile.h"
#include "convert/plot/plot.h"
#include "convert/ask/draw.h"

static weft_status write_piece(void *to, const void *data, size_t bytes, weft_error *err) {
    return wf_outfile_write(to, data, bytes, err);
}

weft_status wf_draw(const char *symbol, const void *plot, const char *path, weft_error *err) {
    void *found;
    wf_plot_fn *draw;
    wf_outfile *file;
    char what[600];
    snprintf(what, sizeof what, "%.500s: a plot", path);
    weft_status status = wf_module_symbol("plot", symbol, what, &found, err);
    if (status) return status;
    memcpy(&draw, &found, sizeof draw);
    status = wf_outfile_open(path, true, &file, err);
    if (status) return status;
    status = draw(plot, write_piece, file, err);
    if (!status) return wf_outfile_commit(file, err);
    wf_outfile_abandon(file);
    return status;
}
