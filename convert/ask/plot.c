/* Numbers in a JSON file as a plot. */
#include <stdlib.h>
#include <string.h>

#include "convert/ask/draw.h"
#include "convert/ask/plot_file.h"
#include "convert/base/fail.h"
#include "convert/base/names.h"
#include "convert/base/outfile.h"

/* The ending of a name tells; standard output is SVG. */
static weft_status choose_format(const char *output, wf_plot_format *format, weft_error *err) {
    if (!output)
        return wf_fail(err, WEFT_USAGE,
                       "no output; say -o FILE.svg or FILE.png, or -o - for an SVG on standard "
                       "output");
    *format = WF_PLOT_SVG;
    if (!strcmp(output, "-") || wf_name_ends_in(output, ".svg")) return WEFT_OK;
    *format = WF_PLOT_PNG;
    if (wf_name_ends_in(output, ".png")) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE, "%.300s: a plot is written as .svg or .png", output);
}

static weft_status draw(const char *input, const char *output, wf_plot_format format,
                        weft_error *err) {
    wf_plot_file *file = malloc(sizeof *file);
    if (!file) return wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    weft_status status = wf_plot_file_read(input, file, err);
    file->plot.format = format;
    if (!status) status = wf_draw("wf_plot_draw", &file->plot, output, err);
    wf_plot_file_free(file);
    free(file);
    return status;
}

weft_status weft_plot(const char *path, const char *output, weft_error *err) {
    wf_plot_format format;
    if (!path || !*path) return wf_fail(err, WEFT_USAGE, "the name of a plot's file is empty");
    weft_status status = choose_format(output, &format, err);
    if (!status) status = wf_outfile_check(output, true, err);
    return status ? status : draw(path, output, format, err);
}
