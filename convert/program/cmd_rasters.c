/* weft rasters: the rasters that have names. */
#include <inttypes.h>
#include <stdio.h>

#include "convert/base/fail.h"
#include "convert/job/report.h"
#include "convert/program/cmd.h"

typedef struct rasters_state {
    bool json;
} rasters_state;

static weft_status print_json(const wf_raster *one, weft_error *err) {
    wf_json json = {0};
    if (one) {
        wf_report_raster(&json, NULL, one);
    } else {
        wf_json_open(&json, NULL, '{');
        wf_json_open(&json, "rasters", '[');
        for (size_t i = 0; wf_raster_at(i); i++) wf_report_raster(&json, NULL, wf_raster_at(i));
    }
    return wf_cmd_print_json(wf_json_finish(&json), err);
}

static void print_row(const wf_raster *r) {
    char size[32], rate[48], aspect[48], lines[48] = "-";
    snprintf(size, sizeof size, "%dx%d", r->width_px, r->lines);
    if (r->frame_rate.den == 1)
        snprintf(rate, sizeof rate, "%" PRId64, r->frame_rate.num);
    else
        snprintf(rate, sizeof rate, "%" PRId64 "/%" PRId64, r->frame_rate.num,
                 r->frame_rate.den);
    snprintf(aspect, sizeof aspect, "%" PRId64 ":%" PRId64, r->pixel_aspect.num,
             r->pixel_aspect.den);
    if (r->total_lines)
        snprintf(lines, sizeof lines, "{%d,%d} of %d", r->line1, r->line2, r->total_lines);
    printf("%-15s %-10s %-11s %-13s %-7s %-8s %s\n", r->name, size, rate, wf_raster_order(r),
           aspect, wf_matrix_name(r->matrix), lines);
}

static void print_table(const wf_raster *one) {
    printf("%-15s %-10s %-11s %-13s %-7s %-8s %s\n", "name", "size", "frames/s", "order",
           "aspect", "Y'CbCr", "lines");
    if (one) print_row(one);
    for (size_t i = 0; !one && wf_raster_at(i); i++) print_row(wf_raster_at(i));
    if (!one)
        puts("\n-wide after a 525 or 625 name makes it 16:9. Anything else is described:\n"
             "WxH@RATE(i|p|psf)[,tff|bff][,par=N:D][,601-525|601-625|709|2020]");
}

static weft_status run(const wf_cmd *cmd, int argc, char **argv, weft_error *err) {
    rasters_state state = {0};
    wf_raster one;
    int names = 0;
    char why[512];
    weft_status status = wf_cmd_parse(cmd, argc, argv, &state, NULL, &names, err);
    if (status) return status;
    if (names > 1)
        return wf_fail(err, WEFT_USAGE, "one raster at a time, and '%.200s' is a second",
                       argv[1]);
    if (names && !wf_raster_parse(argv[0], &one, why, sizeof why))
        return wf_fail(err, WEFT_USAGE, "%s", why);
    if (state.json) return print_json(names ? &one : NULL, err);
    print_table(names ? &one : NULL);
    return WEFT_OK;
}

static const wf_cmd_option options[] = {
    {{"json", NULL, NULL, "Print JSON.", "Options"}, .offset = offsetof(rasters_state, json)},
};

const wf_cmd wf_cmd_rasters = {
    .name = "rasters",
    .operands = "[NAME]",
    .summary = "the rasters that have names",
    .text =
        "Lists the rasters that have names, or shows one: its size, rate, and which field's\n"
        "lines are on top, computed from the numbers of the lines they stand on.\n"
        "\n"
        "  weft rasters 525i\n"
        "  weft rasters 180x122@30i,tff\n",
    .options = options,
    .option_count = sizeof options / sizeof *options,
    .run = run,
};
